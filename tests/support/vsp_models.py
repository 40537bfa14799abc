"""Aircraft as conceptual-design tools export them: bare spline surfaces, no edges, no trimming.

A component is one map of (u, w) to space: along the span (or the body) and around the section. It is a grid of Bezier
patches, written whole, as skins, or patch by patch. Caps are part of the map, so that some patches have no area.
Run as a program it writes a few of them: vsp_models.py DIR
"""
import math
import random
import sys
from pathlib import Path

GAUSS = [(-0.9602898564975363, 0.1012285362903763), (-0.7966664774136267, 0.2223810344533745),
         (-0.5255324099163290, 0.3137066458778873), (-0.1834346424956498, 0.3626837833783620),
         (0.1834346424956498, 0.3626837833783620), (0.5255324099163290, 0.3137066458778873),
         (0.7966664774136267, 0.2223810344533745), (0.9602898564975363, 0.1012285362903763)]


def add(a, b):
    return tuple(x + y for x, y in zip(a, b))


def scale(s, a):
    return tuple(s * x for x in a)


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def bezier_of_power(coefficients):
    """Bezier ordinates of a polynomial on [0, 1]."""
    n = len(coefficients) - 1
    return [sum(math.comb(i, k) / math.comb(n, k) * coefficients[k] for k in range(i + 1)) for i in range(n + 1)]


def bernstein(n, t):
    return [math.comb(n, i) * t**i * (1 - t)**(n - i) for i in range(n + 1)]


def bernstein_slope(n, t):
    low = bernstein(n - 1, t)
    return [n * ((low[i - 1] if i > 0 else 0) - (low[i] if i < n else 0)) for i in range(n + 1)]


class Patch:
    """A Bezier patch: net[i][j] is a point, i along u, j along w."""

    def __init__(self, net):
        self.net = net

    @property
    def degrees(self):
        return len(self.net) - 1, len(self.net[0]) - 1

    def sum_of(self, at_u, at_w):
        total = (0.0, 0.0, 0.0)
        for a, row in zip(at_u, self.net):
            for b, point in zip(at_w, row):
                total = add(total, scale(a * b, point))
        return total

    def measures(self):
        """Area, and volume of the cone to the origin."""
        p, q = self.degrees
        area = volume = 0.0
        for x, weight_u in GAUSS:
            for y, weight_w in GAUSS:
                u, w = 0.5 * (x + 1), 0.5 * (y + 1)
                point = self.sum_of(bernstein(p, u), bernstein(q, w))
                normal = cross(self.sum_of(bernstein_slope(p, u), bernstein(q, w)),
                               self.sum_of(bernstein(p, u), bernstein_slope(q, w)))
                weight = 0.25 * weight_u * weight_w
                area += weight * math.hypot(*normal)
                volume += weight * sum(a * b for a, b in zip(point, normal)) / 3
        return area, volume

    def mapped(self, change):
        return Patch([[change(point) for point in row] for row in self.net])

    def raised(self, degree_u):
        """The same patch with a higher degree along u."""
        net = self.net
        while len(net) - 1 < degree_u:
            n = len(net)
            net = [[add(scale(i / n, net[i - 1][j] if i > 0 else (0, 0, 0)),
                        scale(1 - i / n, net[i][j] if i < n else (0, 0, 0))) for j in range(len(net[0]))]
                   for i in range(n + 1)]
        return Patch(net)

    def turned(self):
        """u and w exchanged."""
        return Patch([list(column) for column in zip(*self.net)])


class Surface:
    """Patches side by side in one spline, with knots of full multiplicity: kinks may lie at them."""

    def __init__(self, grid):
        p = max(row[0].degrees[0] for row in grid)
        grid = [[patch.raised(p) for patch in row] for row in grid]
        q = max(patch.degrees[1] for patch in grid[0])
        grid = [[patch.turned().raised(q).turned() for patch in row] for row in grid]
        self.degrees = (p, q)
        self.n_spans = (len(grid), len(grid[0]))
        self.net = []
        for i, row in enumerate(grid):
            for k in range(p + 1):
                if i > 0 and k == 0:
                    continue
                line = []
                for j, patch in enumerate(row):
                    line += patch.net[k][(1 if j > 0 else 0):]
                self.net.append(line)

    def knots(self, direction):
        degree, spans = self.degrees[direction], self.n_spans[direction]
        return [(float(i), degree + 1 if i in (0, spans) else degree) for i in range(spans + 1)]


class Component:
    """A named grid of patches."""

    def __init__(self, name, grid, caps=(0, 0)):
        self.name, self.grid, self.caps = name, grid, caps

    def measures(self):
        """Area and volume: the map is closed, or open with a plane through the origin before its first row."""
        each = [patch.measures() for row in self.grid for patch in row]
        return sum(a for a, _ in each), abs(sum(v for _, v in each))

    def mapped(self, change, name=None):
        return Component(name or self.name, [[p.mapped(change) for p in row] for row in self.grid], self.caps)

    def mirrored(self):
        return self.mapped(lambda p: (p[0], -p[1], p[2]), self.name + "_sym")

    def moved(self, by):
        return self.mapped(lambda p: add(p, by))

    def surfaces(self, layout):
        """patches: each for itself; skins: columns of patches, caps apart; whole: all around, caps apart; single: one
        surface with its caps."""
        first, last = self.caps
        blocks = [self.grid[:first], self.grid[first:len(self.grid) - last], self.grid[len(self.grid) - last:]]
        blocks = [block for block in blocks if block]
        if layout == "single":
            return [Surface(self.grid)]
        if layout == "whole":
            return [Surface(block) for block in blocks]
        if layout == "skins":
            return [Surface([[row[k]] for row in block]) for block in blocks for k in range(len(block[0]))]
        return [Surface([[patch]]) for row in self.grid for patch in row]


# NACA's thickness with x = s^2, half of it, for a thickness of 1: in s, s^2, s^4, s^6, s^8
SHARP = (0, 1.4845, -0.63, 0, -1.758, 0, 1.4215, 0, -0.518)
BLUNT = (0, 1.4845, -0.63, 0, -1.758, 0, 1.4215, 0, -0.5075)


def airfoil_polynomials(te):
    """Chord and half thickness over s in [0, 1], nose to trailing edge, as Bezier ordinates of degree 8."""
    return bezier_of_power([0, 0, 1, 0, 0, 0, 0, 0, 0]), bezier_of_power(list(BLUNT if te == "blunt" else SHARP))


class Section:
    """Of a wing: leading edge, chord, relative thickness, incidence in degrees."""

    def __init__(self, y, x=0.0, z=0.0, chord=1.0, thickness=0.12, twist=0.0):
        self.y, self.x, self.z, self.chord, self.thickness, self.twist = y, x, z, chord, thickness, twist

    def pieces(self, te, strips):
        """Curves from the trailing edge below around the nose to that above: lists of points."""
        along, half = airfoil_polynomials(te)
        lower = [self.place(x, -self.thickness * h) for x, h in zip(along[::-1], half[::-1])]
        upper = [self.place(x, self.thickness * h) for x, h in zip(along, half)]
        if not strips:
            return [lower, upper]
        middle = self.place(1.0, 0.0)
        return [[middle, lower[0]], lower, upper, [upper[-1], middle]]

    def place(self, x, h, side=0.0):
        angle = math.radians(self.twist)
        x, h = self.chord * x, self.chord * h
        return (self.x + x * math.cos(angle) + h * math.sin(angle), self.y + self.chord * side,
                self.z - x * math.sin(angle) + h * math.cos(angle))


def ruled(first, last):
    return [Patch([list(a), list(b)]) for a, b in zip(first, last)]


def flat_cap(section, te, strips):
    """From the middle line to the section."""
    middle = [[section.place(x, 0.0) for x in piece] for piece in chords_of(te, strips)]
    return ruled(middle, section.pieces(te, strips))


def chords_of(te, strips):
    along, _ = airfoil_polynomials(te)
    return [along[::-1], along] if not strips else [[1.0, 1.0], along[::-1], along, [1.0, 1.0]]


def round_cap(section, te, strips, side):
    """Half ellipses over the thickness, from the middle line to the section; side: -1 or 1 along y."""
    along, half = airfoil_polynomials(te)
    signed = [[-h for h in half[::-1]], half]
    if strips:
        signed = [[0.0, -half[-1]], *signed, [half[-1], 0.0]]
    kappa = 0.5522847498307936
    rise, out = (0.0, kappa, 1.0, 1.0), (1.0, 1.0, kappa, 0.0)
    width = [[abs(h) for h in piece] for piece in signed]
    if strips:
        width[0], width[-1] = [half[-1]] * 2, [half[-1]] * 2
    rows = []
    for r, o in zip(rise, out):
        rows.append([[section.place(x, section.thickness * r * h, section.thickness * side * o * w)
                      for x, h, w in zip(xs, hs, ws)] for xs, hs, ws in zip(chords_of(te, strips), signed, width)])
    return [Patch([row[k] for row in rows]) for k in range(len(signed))]


def wing(name, sections, te="sharp", root="flat", tip="flat", strips=False):
    """Ruled between sections. root, tip: none, flat, round, point (of no area)."""
    rows = [ruled(a.pieces(te, strips), b.pieces(te, strips)) for a, b in zip(sections, sections[1:])]
    caps = [0, 0]
    for k, (kind, section, side) in enumerate(((root, sections[0], -1), (tip, sections[-1], 1))):
        if kind == "none":
            continue
        caps[k] = 1
        if kind == "flat":
            row = flat_cap(section, te, strips)
        elif kind == "round":
            row = round_cap(section, te, strips, side)
        else:
            at = section.pieces(te, strips)[0][0]
            row = [Patch([[at] * 2] * 2) for _ in section.pieces(te, strips)]
        if k == 0:
            rows.insert(0, row)
        else:
            rows.append([Patch(patch.net[::-1]) for patch in row])
    return Component(name, rows, tuple(caps))


class Station:
    """Of a body: an ellipse across x."""

    def __init__(self, x, width, height=None, z=0.0, y=0.0):
        self.x, self.y, self.z, self.width = x, y, z, width
        self.height = width if height is None else height

    def quarters(self):
        k = 0.5522847498307936
        ring = [(1, 0), (1, k), (k, 1), (0, 1), (-k, 1), (-1, k), (-1, 0), (-1, -k), (-k, -1), (0, -1), (k, -1),
                (1, -k), (1, 0)]
        points = [(self.x, self.y + 0.5 * self.width * a, self.z + 0.5 * self.height * b) for a, b in ring]
        return [points[3 * i:3 * i + 4] for i in range(4)]


def body(name, stations, smooth=True, caps="flat"):
    """Quarters between stations, cubic along x where smooth. Caps flat (or of no area where a station is a point)."""
    rings = [s.quarters() for s in stations]
    rows = []
    for i in range(len(rings) - 1):
        if not smooth:
            rows.append(ruled(rings[i], rings[i + 1]))
            continue
        row = []
        for quarter in range(4):
            net = [[], [], [], []]
            for j in range(4):
                point = [ring[quarter][j] for ring in rings]
                step = scale(1 / 3, add(point[i + 1], scale(-1, point[i])))
                before = scale(1 / 6, add(point[i + 1], scale(-1, point[i - 1]))) if i > 0 else step
                after = scale(1 / 6, add(point[i + 2], scale(-1, point[i]))) if i + 2 < len(point) else step
                for k, p in enumerate((point[i], add(point[i], before), add(point[i + 1], scale(-1, after)),
                                       point[i + 1])):
                    net[k].append(p)
            row.append(Patch(net))
        rows.append(row)
    n_caps = [0, 0]
    if caps != "none":
        for k, station in enumerate((stations[0], stations[-1])):
            centre = (station.x, station.y, station.z)
            row = ruled([[centre] * 4] * 4, station.quarters())
            n_caps[k] = 1
            if k == 0:
                rows.insert(0, row)
            else:
                rows.append([Patch(patch.net[::-1]) for patch in row])
    return Component(name, rows, tuple(n_caps))


def nacelle(name, x, z, y, length, radius, thickness):
    """A ring: closed in both directions."""
    profile = [(x, radius), (x + 0.1 * length, radius + thickness), (x + 0.6 * length, radius + thickness),
               (x + length, radius), (x + 0.6 * length, radius - 0.5 * thickness),
               (x + 0.1 * length, radius - 0.5 * thickness), (x, radius)]
    rings = [Station(a, 2 * r, 2 * r, z, y).quarters() for a, r in profile]
    rows = []
    for k in range(0, 6, 3):
        rows.append([Patch([rings[k + i][quarter] for i in range(4)]) for quarter in range(4)])
    return Component(name, rows)


def rib(name, section, te="sharp"):
    """A sheet in a wing, between both skins."""
    lower, upper = section.pieces(te, False)
    return Component(name, [[Patch([lower[::-1], upper])]])


def spar(name, sections, at):
    """A sheet along a wing through the points of both skins at x = `at` of the chord."""
    along = math.sqrt(at)
    _, half = airfoil_polynomials("sharp")
    h = sum(a * b for a, b in zip(bernstein(8, along), half))
    ends = [[s.place(at, -s.thickness * h), s.place(at, s.thickness * h)] for s in sections]
    return Component(name, [[Patch([a, b])] for a, b in zip(ends, ends[1:])])


def leaves(n):
    """Sheets around one edge, along x."""
    rows = []
    for k in range(n):
        y, z = 5 * math.cos(2 * math.pi * k / n), 5 * math.sin(2 * math.pi * k / n)
        rows.append([Patch([[(0.0, 0.0, 0.0), (10.0, 0.0, 0.0)], [(0.0, y, z), (10.0, y, z)]])])
    return Component("leaves", rows)


def rooms(lengths, width, height):
    """Rooms in a row along x, each wall once: planes that share no edges."""
    def plane(a, b, c, d):
        return [Patch([[a, b], [c, d]])]

    def corners(x):
        return (x, 0.0, 0.0), (x, width, 0.0), (x, width, height), (x, 0.0, height)

    x, rows = 0.0, [plane(*(corners(0.0)[k] for k in (0, 1, 3, 2)))]
    for length in lengths:
        a, b = corners(x), corners(x + length)
        rows += [plane(a[k], a[(k + 1) % 4], b[k], b[(k + 1) % 4]) for k in range(4)]
        rows.append(plane(*(b[k] for k in (0, 1, 3, 2))))
        x += length
    return Component("rooms", rows)


def shaken(component, by, seed=1):
    """Every point of every patch moved by up to `by`: neighbours are equal within that only."""
    source = random.Random(seed)
    return component.mapped(lambda p: tuple(x + by * (2 * source.random() - 1) for x in p))


# Writers.

UNITS = {"mm": (1.0, ".MILLI.", 2, "MM"), "m": (1000.0, None, 6, "M"), "ft": (304.8, None, 4, "FT"),
         "in": (25.4, None, 1, "IN")}


def number(x):
    text = f"{x:.15g}"
    return text if "." in text or "e" in text else text + "."


def step_number(x):
    return number(x).replace("e", "E") if "." in number(x) else number(x).replace("e", ".E")


STEP_UNIT = {
    "mm": ["(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.))"],
    "m": ["(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT($,.METRE.))"],
    "ft": ["(CONVERSION_BASED_UNIT('FOOT',#7)LENGTH_UNIT()NAMED_UNIT(#8))",
           "(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.))",
           "LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(304.8),#6)", "DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,0.,0.)"],
    "in": ["(CONVERSION_BASED_UNIT('INCH',#7)LENGTH_UNIT()NAMED_UNIT(#8))",
           "(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.))",
           "LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4),#6)", "DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,0.,0.)"]}


class StepFile:
    def __init__(self, unit):
        self.lines, self.count = [], 30
        for k, text in enumerate(STEP_UNIT[unit]):
            self.lines.append(f"#{5 + k}={text};")
        self.lines += [
            "#9=UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.E-06),#5,'closure','');",
            "#10=(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.));",
            "#11=(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT());",
            "#12=(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((#9))"
            "GLOBAL_UNIT_ASSIGNED_CONTEXT((#5,#10,#11))REPRESENTATION_CONTEXT('STANDARD','3D'));",
            "#13=CARTESIAN_POINT('',(0.,0.,0.));", "#14=DIRECTION('',(0.,0.,1.));", "#15=DIRECTION('',(1.,0.,0.));",
            "#16=AXIS2_PLACEMENT_3D('',#13,#14,#15);", "#17=APPLICATION_CONTEXT('designs');",
            "#18=MECHANICAL_CONTEXT('',#17,'mechanical');", "#19=DESIGN_CONTEXT('',#17,'design');",
            "#20=PRODUCT('','model','',(#18));", "#21=PRODUCT_DEFINITION_FORMATION_WITH_SPECIFIED_SOURCE('','',#20,"
            ".MADE.);", "#22=PRODUCT_DEFINITION('','',#21,#19);", "#23=PRODUCT_DEFINITION_SHAPE('','',#22);",
            "#24=SHAPE_REPRESENTATION('',(#16),#12);", "#25=SHAPE_DEFINITION_REPRESENTATION(#23,#24);"]

    def add(self, text):
        self.count += 1
        self.lines.append(f"#{self.count}={text};")
        return f"#{self.count}"

    def add_surface(self, surface):
        net = [[self.add("CARTESIAN_POINT('',(" + ",".join(map(step_number, p)) + "))") for p in line]
               for line in surface.net]
        rows = ",".join("(" + ",".join(line) + ")" for line in net)
        knots = [surface.knots(0), surface.knots(1)]
        lists = ",".join("(" + ",".join(str(m) for _, m in k) + ")" for k in knots)
        lists += "," + ",".join("(" + ",".join(step_number(t) for t, _ in k) + ")" for k in knots)
        p, q = surface.degrees
        return self.add(f"B_SPLINE_SURFACE_WITH_KNOTS('',{p},{q},({rows}),.UNSPECIFIED.,.F.,.F.,.F.,{lists},"
                        ".UNSPECIFIED.)")

    def write(self, path):
        head = ("ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'1');\nFILE_NAME('model','2026-01-01T00:00:00',(''),"
                "(''),'','','');\nFILE_SCHEMA(('CONFIG_CONTROL_DESIGN'));\nENDSEC;\nDATA;\n")
        Path(path).write_text(head + "\n".join(self.lines) + "\nENDSEC;\nEND-ISO-10303-21;\n", encoding="ascii")


def write_step(path, components, layout="skins", unit="ft"):
    """One set of surfaces for each component."""
    file = StepFile(unit)
    for component in components:
        members = ",".join(file.add_surface(s) for s in component.surfaces(layout))
        members = file.add(f"GEOMETRIC_SET('{component.name}',({members}))")
        shape = file.add(f"GEOMETRICALLY_BOUNDED_SURFACE_SHAPE_REPRESENTATION('',({members}),#12)")
        file.add(f"SHAPE_REPRESENTATION_RELATIONSHIP('','',#24,{shape})")
    file.write(path)


def write_iges(path, components, layout="skins", unit="ft"):
    """Surfaces of type 128 without trimming."""
    directory, parameters = [], []
    for component in components:
        for surface in component.surfaces(layout):
            p, q = surface.degrees
            values = [128, len(surface.net) - 1, len(surface.net[0]) - 1, p, q, 0, 0, 1, 0, 0]
            for direction in (0, 1):
                values += [t for t, m in surface.knots(direction) for _ in range(m)]
            values += [1.0] * (len(surface.net) * len(surface.net[0]))
            values += [x for column in zip(*surface.net) for point in column for x in point]
            values += [0.0, float(surface.n_spans[0]), 0.0, float(surface.n_spans[1])]
            text = [number(v) if isinstance(v, float) else str(v) for v in values]
            start = len(parameters) + 1
            owner = 2 * (len(directory) // 2) + 1
            line = ""
            for k, item in enumerate(text):
                item += ";" if k == len(text) - 1 else ","
                if len(line) + len(item) > 64:
                    parameters.append((line, owner))
                    line = ""
                line += item
            parameters.append((line, owner))
            n_lines = len(parameters) - start + 1
            label = component.name[:8]
            directory.append(f"{128:8d}{start:8d}{0:8d}{0:8d}{0:8d}{0:8d}{0:8d}{0:8d}{'00000000':>8}")
            directory.append(f"{128:8d}{0:8d}{0:8d}{n_lines:8d}{0:8d}{'':16}{label:>8}{0:8d}")
    _, _, flag, name = UNITS[unit]
    whole = ("1H,,1H;,5Hmodel,9Hmodel.igs,4Hnone,4Hnone,32,38,6,308,15,5Hmodel,1.," + f"{flag},{len(name)}H{name},1,"
             "0.01,15H20260101.000000,1.E-06,1000.,4Hnone,4Hnone,11,0,15H20260101.000000;")
    start_section = [f"{'exported surfaces':72}S{1:7d}"]
    global_section = [f"{whole[72 * k:72 * k + 72]:72}G{k + 1:7d}" for k in range((len(whole) + 71) // 72)]
    directory = [f"{text}D{k + 1:7d}" for k, text in enumerate(directory)]
    parameters = [f"{text:64}{owner:8d}P{k + 1:7d}" for k, (text, owner) in enumerate(parameters)]
    last = (f"S{len(start_section):7d}G{len(global_section):7d}D{len(directory):7d}P{len(parameters):7d}{'':40}"
            f"T{1:7d}")
    Path(path).write_text("\n".join([*start_section, *global_section, *directory, *parameters, last, ""]),
                          encoding="ascii")


def straight_wing(**keywords):
    return wing("wing", [Section(0, chord=12.8), Section(50, x=28.9, chord=3.2)], **keywords)


def kinked_wing(**keywords):
    sections = [Section(0, chord=10, thickness=0.14), Section(8, x=4, z=0.4, chord=6, twist=1),
                Section(25, x=13, z=2, chord=2, thickness=0.1, twist=-2)]
    return wing("wing", sections, **keywords)


def fuselage(tail=0.0):
    return body("fuselage", [Station(0, 0), Station(2, 2.5, 2.2), Station(8, 3.8, 4), Station(22, 3.8, 4),
                             Station(32, tail, tail, z=0.8)])


def main(folder):
    folder.mkdir(parents=True, exist_ok=True)
    for te in ("sharp", "blunt"):
        for cap in ("flat", "round", "none"):
            for layout in ("patches", "skins", "whole", "single"):
                for strips in ((False, True) if te == "sharp" else (True,)):
                    component = kinked_wing(te=te, tip=cap, root="flat" if cap != "none" else "none", strips=strips)
                    name = f"wing_{te}_{cap}_{layout}{'_strips' if strips and te == 'sharp' else ''}"
                    write_step(folder / (name + ".stp"), [component], layout)
                    write_iges(folder / (name + ".igs"), [component], layout)
                    print(name, *(f"{x:.8g}" for x in component.measures()))


if __name__ == "__main__":
    main(Path(sys.argv[1]))
