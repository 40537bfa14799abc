#!/usr/bin/env python3
"""Writes a fighter in a box of air as a FLITE file, of a few thousand faces, no two of them alike.

usage: fighter.py OUT.dat GROUPS.toml [--panels 44x32]

The right half of a blended body with a diamond wing, two stores below the wing, a symmetry plane and a far field; in
metres. The skin is divided into panels whose corners are moved about, by a fixed seed: 44 x 32 of them above and as
many below. Each panel is a Ferguson surface, each side of one a Ferguson curve that two panels share. GROUPS.toml names
the groups, for st-import --groups.
"""
import argparse
import math
import random

NOSE, TAIL = 0.3, 16.0
BOX = ((-150.0, 170.0), (0.0, 160.0), (-160.0, 160.0))  # the air
POINTS = 5  # along each side of a panel
MOVED = 0.25  # of a panel: most that a corner is moved


def smooth_max(a, b, width):
    return 0.5 * (a + b + math.hypot(a - b, width))


def smooth_min(a, b, width):
    return -smooth_max(-a, -b, width)


def body_width(x):
    return 0.2 + 0.9 * math.sin(0.5 * math.pi * min(1, x / 9)) - 0.3 * max(0, (x - 9) / 7) ** 2


def half_width(x):
    """Of the outline from above, the wing's tip and edges included."""
    wing = smooth_min(0.75 * (x - 6), 1.3 * (15.2 - x), 0.8)
    return body_width(x) + smooth_max(wing, 0, 0.3)


def height(x, y, side):
    """Of the skin over the middle plane, before it is rounded towards the outline. side: 1 above, -1 below."""
    body = 0.35 + (0.6 if side > 0 else 0.4) * math.sin(math.pi * min(1, (x + 0.5) / 18))
    canopy = 0.45 * math.exp(-((x - 4.5) / 1.3) ** 2) if side > 0 else 0
    wing = 0.12 + 0.02 * side
    return wing + (body + canopy - wing) * math.exp(-(y / (1.1 * body_width(x))) ** 2)


def skin(x, angle, side):
    """angle: 0 in the symmetry plane, 90 degrees on the outline."""
    y = half_width(x) * math.sin(angle)
    return (x, y, side * height(x, y, side) * math.cos(angle))


class Model:
    """Curves and regions of the file, each region a surface of its own; segments have the numbers of their curves."""

    def __init__(self):
        self.curves, self.surfaces, self.loops, self.groups = [], [], [], {}
        self.known = {}

    def curve(self, key, points):
        """The number of the curve with this key, made at its first use."""
        if key not in self.known:
            self.curves.append(points)
            self.known[key] = len(self.curves)
        return self.known[key]

    def face(self, group, rows, loop):
        """rows: points, the first direction within each."""
        self.surfaces.append(rows)
        self.loops.append(loop)
        self.groups.setdefault(group, []).append(len(self.surfaces))

    def plane(self, group, corners, loop):
        a, b, c, d = corners
        self.face(group, [[a, b], [d, c]], loop)

    def sheet(self, name, group, place, corners, is_closed=False):
        """Panels between corners[i][j], places in the parameters of `place`; returns the curve from (i, j) to (k, l).
        is_closed: the last column meets the first."""
        n, m = len(corners) - 1, len(corners[0]) - 1

        def node(i, j):
            return (name, i, j % m if is_closed else j)

        def between(a, b, share):
            return tuple((1 - share) * u + share * v for u, v in zip(a, b))

        def side(i, j, k, l):
            a, b = corners[i][j], corners[k][l]
            return self.curve((node(i, j), node(k, l)),
                              [place(*between(a, b, t / (POINTS - 1))) for t in range(POINTS)])

        for i in range(n):
            for j in range(m):
                rows = []
                for v in range(POINTS):
                    left, right = (between(corners[i][k], corners[i + 1][k], v / (POINTS - 1)) for k in (j, j + 1))
                    rows.append([place(*between(left, right, u / (POINTS - 1))) for u in range(POINTS)])
                self.face(group, rows, [side(i, j, i, j + 1), side(i, j + 1, i + 1, j + 1),
                                        side(i + 1, j, i + 1, j + 1), side(i, j, i + 1, j)])
        return side


def moved_grid(ends, turns, random_numbers):
    """Corners in (x, angle); those on the border stay on it."""
    (x0, x1, n), (a0, a1, m) = ends, turns
    step = ((x1 - x0) / n, (a1 - a0) / m)

    def moved(k, count, size):
        return 0 if k in (0, count) else size * MOVED * random_numbers.uniform(-1, 1)

    return [[(x0 + i * step[0] + moved(i, n, step[0]), a0 + j * step[1] + moved(j, m, step[1]))
             for j in range(m + 1)] for i in range(n + 1)]


def add_airframe(model, n, m, random_numbers):
    """Returns the curves in the symmetry plane."""
    above = moved_grid((NOSE, TAIL, n), (0, math.pi / 2, m), random_numbers)
    below = moved_grid((NOSE, TAIL, n), (0, math.pi / 2, m), random_numbers)
    for i in range(n + 1):
        below[i][m] = above[i][m]  # one outline
    sides = {}
    for name, side, corners in (("above", 1, above), ("below", -1, below)):
        def place(x, angle, side=side):
            x_, y, z = skin(x, angle, side)
            return (x_, 0.0 if angle == 0 else y, 0.0 if angle == math.pi / 2 else z)
        if name == "below":
            for i in range(n):
                model.known[("below", i, m), ("below", i + 1, m)] = model.known[("above", i, m), ("above", i + 1, m)]
        sides[name] = model.sheet(name, "skin_" + name, place, corners)
    in_plane = [sides[name](i, 0, i + 1, 0) for name in sides for i in range(n)]
    for group, i in (("nose", 0), ("exhaust", n)):
        x = NOSE if i == 0 else TAIL
        top, bottom, wide = skin(x, 0, 1), skin(x, 0, -1), half_width(x)
        keel = model.curve((group, "keel"), [top, bottom])
        model.plane(group, [(x, 0, 2 * bottom[2]), (x, 2 * wide, 2 * bottom[2]), (x, 2 * wide, 2 * top[2]),
                            (x, 0, 2 * top[2])],
                    [keel] + [sides[name](i, j, i, j + 1) for name in sides for j in range(m)])
        in_plane.append(keel)
    return in_plane


def add_store(model, name, middle, length, radius, random_numbers):
    n, m = 10, 8
    corners = moved_grid((0.02, 0.98, n), (0, 2 * math.pi, m), random_numbers)
    for row in corners:
        row[m] = (row[0][0], row[0][1] + 2 * math.pi)

    def place(share, angle):
        r = radius * (1 - abs(2 * share - 1) ** 3.5)
        return (middle[0] + length * (share - 0.5), middle[1] + r * math.cos(angle), middle[2] + r * math.sin(angle))

    side = model.sheet(name, name, place, corners, is_closed=True)
    for i in (0, n):
        x, r = place(corners[i][0][0], 0)[0], 2 * radius
        y, z = middle[1:]
        model.plane(name, [(x, y - r, z - r), (x, y + r, z - r), (x, y + r, z + r), (x, y - r, z + r)],
                    [side(i, j, i, j + 1) for j in range(m)])


def add_air(model, in_plane):
    def corner(key):
        return tuple(BOX[k][key[k]] for k in range(3))

    def edge(a, b):
        return model.curve(("air", min(a, b), max(a, b)), [corner(min(a, b)), corner(max(a, b))])

    for axis in range(3):
        for end in (0, 1):
            ring = [(0, 0), (1, 0), (1, 1), (0, 1)]
            keys = [tuple(end if k == axis else r[k - (k > axis)] for k in range(3)) for r in ring]
            is_symmetry = axis == 1 and end == 0
            loop = [edge(a, b) for a, b in zip(keys, keys[1:] + keys[:1])]
            model.plane("symmetry" if is_symmetry else "farfield", [corner(k) for k in keys],
                        loop + (in_plane if is_symmetry else []))


def write(model, path):
    def rows(points):
        return ["".join(f"{x:15.7E}" for x in p) for p in points]

    lines = ["Geometry", f"{len(model.curves):8d}{len(model.surfaces):8d}", "Curves"]
    for i, points in enumerate(model.curves, 1):
        lines += [f"{i:8d}{1:8d}", f"{len(points):8d}", *rows(points)]
    lines.append("Surfaces")
    for i, grid in enumerate(model.surfaces, 1):
        lines += [f"{i:8d}{1:8d}", f"{len(grid[0]):8d}{len(grid):8d}"]
        for row in grid:
            lines += rows(row)
    lines += ["Mesh Generation", f"{len(model.curves):8d}{len(model.surfaces):8d}{0:8d}{0:8d}", "Segment Curves"]
    lines += [f"{i:8d}{i:8d}{1:8d}" for i in range(1, len(model.curves) + 1)]
    lines.append("Surfaces")
    for i, loop in enumerate(model.loops, 1):
        lines += [f"{i:8d}{i:8d}{1:8d}{1:8d}", f"{len(loop):8d}"]
        lines += ["".join(f"{s:8d}" for s in loop[k:k + 8]) for k in range(0, len(loop), 8)]
    with open(path, "w", encoding="ascii") as file:
        file.write("\n".join(lines) + "\n")


def write_groups(model, path):
    with open(path, "w", encoding="ascii") as file:
        for name, faces in model.groups.items():
            role = f'role = "{name}"\n' if name in ("symmetry", "farfield") else ""
            names = ", ".join(f'"region {f}"' for f in faces)
            file.write(f'[[group]]\nname = "{name}"\nfaces = [{names}]\n{role}\n')


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out")
    parser.add_argument("groups")
    parser.add_argument("--panels", default="44x32", help="along and across each side")
    arguments = parser.parse_args()
    n, m = map(int, arguments.panels.split("x"))
    random_numbers = random.Random(1)
    model = Model()
    in_plane = add_airframe(model, n, m, random_numbers)
    add_store(model, "store_inner", (11.5, 2.2, -1.2), 3.0, 0.2, random_numbers)
    add_store(model, "store_outer", (12.0, 3.4, -0.9), 2.4, 0.15, random_numbers)
    add_air(model, in_plane)
    write(model, arguments.out)
    write_groups(model, arguments.groups)


if __name__ == "__main__":
    main()
