"""What sources and background meshes of a sizing ask for: as lib/sizing/source.h and background.h."""
import numpy

POINT, LINE, TRIANGLE, BOX, CYLINDER, SPHERE, DISC = range(7)
PLACES, SECTIONS, GOLDEN = 8, 32, 0.6180339887498949  # of the search for the least over a segment


def _grown(spacing, slope, distance):
    """FLITE's growth; spacing: lengths, radii, doublings, each a number or an array like distance."""
    length, radius, doubling = (numpy.broadcast_to(s, distance.shape) for s in spacing)
    t = numpy.maximum(distance - radius, 0)
    width = (doubling - radius) / numpy.log(2)
    is_slow = (width > 0) & (length < slope * width)
    safe = numpy.where(is_slow, width, 1)
    steep = safe * numpy.log(numpy.where(is_slow, slope * safe / length, 1))
    slow = numpy.where(t <= steep, length * numpy.exp(numpy.minimum(t, steep) / safe), slope * (safe + t - steep))
    return numpy.where(is_slow, slow, length + slope * t)


def _to_segment(x, a, b):
    d = b - a
    t = numpy.clip((x - a) @ d / max(d @ d, 1e-300), 0, 1)
    return numpy.linalg.norm(x - a - t[:, None] * d, axis=1)


def _to_triangle(x, p):
    a, b, r = p[1] - p[0], p[2] - p[0], x - p[0]
    n = numpy.cross(a, b)
    wb, wc = numpy.cross(r, b) @ n, numpy.cross(a, r) @ n
    sides = numpy.minimum.reduce([_to_segment(x, p[k], p[(k + 1) % 3]) for k in range(3)])
    return numpy.where((wb >= 0) & (wc >= 0) & (wb + wc <= n @ n), abs(r @ n) / numpy.linalg.norm(n), sides)


def _to_cylinder(x, a, axis, height, radius):
    along = (x - a) @ axis
    across = numpy.linalg.norm(x - a - along[:, None] * axis, axis=1)
    return numpy.hypot(numpy.maximum(numpy.maximum(-along, along - height), 0), numpy.maximum(across - radius, 0))


def _least(f):
    """The least of f over [0, 1], f of an array of numbers."""
    values = numpy.array([f(numpy.float64(i / PLACES)) for i in range(PLACES + 1)])
    at = values.argmin(axis=0)
    lo, hi = numpy.maximum(at - 1, 0) / PLACES, numpy.minimum(at + 1, PLACES) / PLACES
    for _ in range(SECTIONS):
        a, b = hi - GOLDEN * (hi - lo), lo + GOLDEN * (hi - lo)
        is_low = f(a) < f(b)
        lo, hi = numpy.where(is_low, lo, a), numpy.where(is_low, b, hi)
    return numpy.minimum(values.min(axis=0), f(0.5 * (lo + hi)))


def _on_segment(x, ends, spacings, slope):
    """ends, spacings: (2, n or 1, 3)."""
    def at(t):
        t = numpy.reshape(t, (-1, 1))
        place, spacing = (v[0] + t * (v[1] - v[0]) for v in (ends, spacings))
        return _grown(spacing.T, slope, numpy.linalg.norm(x - place, axis=1))
    return _least(at)


def _on_triangle(x, p, spacing, slope):
    def at(t):
        t = numpy.reshape(t, (-1, 1))
        return _on_segment(x, *((v[0] + t * (v[1] - v[0]), v[0] + t * (v[2] - v[0])) for v in (p, spacing)), slope)
    return _least(at)


def _plain_segment(x, p, h, slope):
    """The least of lengths h at the ends p that grow by the slope from all points between."""
    d, rise = p[1] - p[0], h[1] - h[0]
    size = numpy.linalg.norm(d)
    t = numpy.full(len(x), 1.0 if rise < 0 else 0.0)
    if abs(rise) < slope * size:
        foot, m = (x - p[0]) @ d / size**2, rise / (slope * size)
        height = numpy.linalg.norm(x - p[0] - foot[:, None] * d, axis=1)
        t = numpy.clip(foot - m * height / (numpy.sqrt(1 - m * m) * size), 0, 1)
    return h[0] + t * rise + slope * numpy.linalg.norm(x - p[0] - t[:, None] * d, axis=1)


def _plain_triangle(x, p, h, slope):
    least = numpy.minimum.reduce([_plain_segment(x, p[[k, k - 2]], h[[k, k - 2]], slope) for k in range(3)])
    a, b = p[1] - p[0], p[2] - p[0]
    n = numpy.cross(a, b)
    n2 = n @ n
    gradient = ((h[1] - h[0]) * numpy.cross(b, n) + (h[2] - h[0]) * numpy.cross(n, a)) / max(n2, 1e-300)
    m2 = gradient @ gradient / slope**2
    if n2 == 0 or m2 >= 1:
        return least
    height = abs((x - p[0]) @ n) / numpy.sqrt(n2)
    r = x - p[0] - (height / (slope * numpy.sqrt(1 - m2)))[:, None] * gradient
    wb, wc = numpy.cross(r, b) @ n / n2, numpy.cross(a, r) @ n / n2
    inside = h[0] + wb * (h[1] - h[0]) + wc * (h[2] - h[0]) + slope * height / numpy.sqrt(1 - m2)
    return numpy.where((wb >= 0) & (wc >= 0) & (wb + wc <= 1), inside, least)


def _length(x, kind, row, slope):
    """Of one source: points, half axes, spacings, extent, aspect and direction are the 32 numbers of `row`."""
    p, half, spacing = row[:27].reshape(3, 3, 3)
    n = {LINE: 2, TRIANGLE: 3}.get(kind, 1)
    if (spacing[:n] != spacing[0]).any():
        if not spacing[:n, 1].any() and (spacing[:n, 2] <= 0).all():
            return (_plain_segment if kind == LINE else _plain_triangle)(x, p[:n], spacing[:n, 0], slope)
        return (_on_segment if kind == LINE else _on_triangle)(x, p[:n, None], spacing[:n, None], slope)
    if kind == LINE:
        distance = _to_segment(x, p[0], p[1])
    elif kind == TRIANGLE:
        distance = _to_triangle(x, p)
    elif kind == BOX:
        size = numpy.linalg.norm(half, axis=1)
        distance = numpy.linalg.norm(numpy.maximum(abs((x - p[0]) @ half.T) / size - size, 0), axis=1)
    elif kind == CYLINDER:
        height = numpy.linalg.norm(p[1] - p[0])
        distance = _to_cylinder(x, p[0], (p[1] - p[0]) / height, height, row[27])
    elif kind == DISC:
        distance = _to_cylinder(x, p[0], half[0] / numpy.linalg.norm(half[0]), 0, row[27])
    else:  # POINT has no extent
        distance = numpy.linalg.norm(x - p[0], axis=1) - row[27]
    return _grown(spacing[0], slope, distance)


class Sources:
    """All of a sizing, in the octree's own frame and before scale."""

    def __init__(self, artifact):
        self._kinds, self._rows = artifact.get("/st/source/kind", []), artifact.get("/st/source/numbers", [])
        self._slope = artifact._groups.get("st/sizing", {}).get("source_slope")
        self._tets = artifact.get("/st/background/tet")
        if self._tets is not None:
            self._nodes = artifact["/st/background/node"]
            self._sizes = artifact["/st/background/size"][:, 0]
            faces = numpy.sort(self._tets[:, [[1, 2, 3], [2, 3, 0], [3, 0, 1], [0, 1, 2]]].reshape(-1, 3), axis=1)
            faces, count = numpy.unique(faces, axis=0, return_counts=True)
            self._border = faces[count == 1]

    def lower(self, points, length):
        """`length` at each point becomes no more than what is asked for there."""
        for kind, row in zip(self._kinds, self._rows):
            numpy.minimum(length, _length(points, kind, row, self._slope), out=length)
        if self._tets is not None:
            self._lower_in_tets(points, length)
            self._lower_from_border(points, length)

    def _lower_in_tets(self, points, length):
        order = numpy.argsort(points[:, 0], kind="stable")
        for tet in self._tets:
            p, h = self._nodes[tet], self._sizes[tet]
            edges = (p[1:] - p[0]).T
            if abs(numpy.linalg.det(edges)) <= 1e-12 * abs(edges).max() ** 3:
                continue
            lo, hi = numpy.searchsorted(points[order, 0], [p[:, 0].min() - 1e-9, p[:, 0].max() + 1e-9])
            near = order[lo:hi]
            at = numpy.linalg.solve(edges, (points[near] - p[0]).T).T
            inside = (at >= -1e-9).all(axis=1) & (at.sum(axis=1) <= 1 + 1e-9)
            near, at = near[inside], at[inside]
            length[near] = numpy.minimum(length[near], h[0] + at @ (h[1:] - h[0]))

    def _lower_from_border(self, points, length):
        for face in self._border:
            p, h = self._nodes[face], self._sizes[face]
            near = numpy.flatnonzero(length > h.min())
            if len(near):
                length[near] = numpy.minimum(length[near], _plain_triangle(points[near], p, h, self._slope))
