"""Values and gradients at nodes of a mesh from values of its cells, by a quadric fitted to the cells around each node.

After Zhang and Naga, A new finite element gradient recovery method: superconvergence property, SIAM Journal on
Scientific Computing 26 (2005), with centres of cells in place of nodes.
"""
import numpy

AT_ONCE = 2000  # nodes whose quadrics are fitted together: some 100 MB
NEAREST = 0.2  # of the mean distance: cells that are nearer count as these, others by one over their distance


class Cells:
    """Cells by their corners: corner [all corners] node numbers, first [cells + 1] into them, points [nodes, 3]."""

    def __init__(self, points, corner, first):
        self.points, self.corner, self.first = points, corner, first
        count = numpy.diff(first)
        owner = numpy.repeat(numpy.arange(len(count)), count)
        self.centre = numpy.stack([numpy.bincount(owner, points[corner, k], len(count)) for k in range(3)],
                                  axis=1) / count[:, None]
        order = numpy.argsort(corner, kind="stable")
        self.cell_of = owner[order]  # of the nodes, one after the other
        self.begin = numpy.searchsorted(corner[order], numpy.arange(len(points) + 1))

    def around(self, nodes):
        """Cells that have a node of a cell of each node: place in `nodes` and cell, each pair once, ascending."""
        k, cell = expand(numpy.arange(len(nodes)), nodes, self.begin, self.cell_of)
        k, node = expand(k, cell, self.first, self.corner)
        k, node = pairs_once(k, node, len(self.points))
        k, cell = expand(k, node, self.begin, self.cell_of)
        return pairs_once(k, cell, len(self.centre))


def expand(key, row, begin, values):
    """For each row its values[begin[row]:begin[row + 1]], with the row's key."""
    count = begin[row + 1] - begin[row]
    place = numpy.arange(count.sum()) - numpy.repeat(numpy.cumsum(count) - count, count)
    return numpy.repeat(key, count), values[numpy.repeat(begin[row], count) + place]


def pairs_once(a, b, n_b):
    both = numpy.unique(a * n_b + b)
    return both // n_b, both % n_b


def fit(offset, value, is_there):
    """At the origin of quadrics through value [n, m] at offset [n, m, 3], where is_there [n, m]: [n] and [n, 3]."""
    count = is_there.sum(axis=1)
    size = numpy.sqrt((offset**2).sum(axis=(1, 2)) / count)
    x, y, z = numpy.moveaxis(offset / size[:, None, None], 2, 0)
    weight = is_there / numpy.maximum(numpy.sqrt(x * x + y * y + z * z), NEAREST)
    terms = numpy.stack([numpy.ones_like(x), x, y, z, x * x, y * y, z * z, x * y, y * z, x * z], axis=2)
    terms *= weight[:, :, None]
    normal = numpy.matmul(terms.transpose(0, 2, 1), terms)
    right = numpy.matmul(terms.transpose(0, 2, 1), (value * weight)[:, :, None])
    trace = numpy.trace(normal, axis1=1, axis2=2)
    normal += 1e-10 * trace[:, None, None] * numpy.eye(10)  # few cells: the flattest of the quadrics
    all_terms = numpy.linalg.solve(normal, right)[:, :, 0]
    return all_terms[:, 0], all_terms[:, 1:4] / size[:, None]


def at_nodes(cells, value, nodes):
    """Of value [cells]: its values at nodes [nodes], and gradients there [nodes, 3]."""
    values, gradients = numpy.empty(len(nodes)), numpy.empty((len(nodes), 3))
    for first in range(0, len(nodes), AT_ONCE):
        some = nodes[first:first + AT_ONCE]
        k, cell = cells.around(some)
        count = numpy.bincount(k, minlength=len(some))
        is_there = numpy.arange(count.max()) < count[:, None]
        offset, known = numpy.zeros((*is_there.shape, 3)), numpy.zeros(is_there.shape)
        offset[is_there] = cells.centre[cell] - cells.points[some][k]
        known[is_there] = value[cell]
        values[first:first + AT_ONCE], gradients[first:first + AT_ONCE] = fit(offset, known, is_there)
    return values, gradients
