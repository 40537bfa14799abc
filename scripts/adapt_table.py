#!/usr/bin/env python3
"""Interpolation errors of meshes that follow a field, against meshes of the default's sizes with as many nodes: the
table of docs/dev/bench.md. Fields are in units of the shape: |x| <= 1 on it.

usage: scripts/adapt_table.py BIN_DIR SHAPE=MODEL... [--levels 5] [--aspect 1]      SHAPE: sphere, box or m6
"""
import argparse
import math
import tempfile
from pathlib import Path

from table_common import run

# Of each shape: its centre, its half width, and y of its side in units of that.
SHAPES = {"sphere": ((0, 0, 0), 10, -1), "box": ((30, 20, 10), 30, -2 / 3), "m6": ((0.5, 0.6, 0), 0.6, -1)}
FIRST_NODES, CYCLES = 2000, 2


def window(x, y, z):
    """1 on the shape, 0 on a far field."""
    return math.exp(-min(700, ((x * x + y * y + z * z) / 4) ** 4))


def shock(x, y, z, side):
    return math.tanh((x + 0.3 * y - 0.1) / 0.03)


def layer(x, y, z, side):
    return math.exp(min(0, (side - y) / 0.05))


def vortex(x, y, z, side):
    dx, dy, core = x - 0.2, y + 0.1, 0.1
    return dy / core * math.exp(min(700, 0.5 * (1 - (dx * dx + dy * dy) / core**2)))


FIELDS = {"shock": shock, "layer": layer, "vortex": vortex}


def on_shape(field, shape):
    """The field as a function of a point of the model."""
    (cx, cy, cz), half, side = SHAPES[shape]

    def value(p):
        x, y, z = (p[0] - cx) / half, (p[1] - cy) / half, (p[2] - cz) / half
        return window(x, y, z) * field(x, y, z, side)
    return value


def read_mesh(path):
    """Nodes and triangles of a .mesh."""
    words = iter(path.read_text().split("\n"))
    for line in words:
        if line == "Vertices":
            nodes = [tuple(map(float, next(words).split()[:3])) for _ in range(int(next(words)))]
        if line == "Triangles":
            triangles = [tuple(int(n) - 1 for n in next(words).split()[:3]) for _ in range(int(next(words)))]
    return nodes, triangles


# Strang and Fix, of degree 4: weights and barycentric coordinates.
RULE = [(w, tuple(c if k == i else (1 - c) / 2 for k in range(3)))
        for w, c in ((0.109951743655322, 0.816847572980459), (0.223381589678011, 0.108103018168070)) for i in range(3)]


def interpolation_error(nodes, triangles, value):
    """The L2 norm over the triangles of a field less its linear interpolation."""
    at_node = [value(p) for p in nodes]
    total = 0
    for t in triangles:
        a, b, c = (nodes[n] for n in t)
        u, v = [b[k] - a[k] for k in range(3)], [c[k] - a[k] for k in range(3)]
        area = 0.5 * math.hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
        for weight, at in RULE:
            place = [at[0] * a[k] + at[1] * b[k] + at[2] * c[k] for k in range(3)]
            linear = sum(at[k] * at_node[t[k]] for k in range(3))
            total += area * weight * (value(place) - linear) ** 2
    return math.sqrt(total)


class Loop:
    """Meshes of one shape in a folder."""

    def __init__(self, bin_dir, model, folder, aspect=1):
        self.bin, self.folder, self.aspect = Path(bin_dir), Path(folder), aspect
        self.tool("st-import", model, "-o", self.path("geometry.hdf"))
        self.tool("st-raster", self.path("geometry.hdf"), "-o", self.path("raster.hdf"), "--lmin", "0.001%",
                  "--max-aspect", aspect)

    def path(self, name):
        return self.folder / name

    def tool(self, name, *arguments):
        return run(self.bin / name, *arguments, "-q")

    def mesh(self, n_nodes, *sizes):
        """Nodes and triangles of a mesh with these sizes, scaled to a number of nodes."""
        self.tool("st-prolong", self.path("raster.hdf"), "-o", self.path("sizing.hdf"), "--target-triangles",
                  2 * n_nodes, *sizes)
        self.tool("st-mesh", self.path("geometry.hdf"), self.path("sizing.hdf"), "-o", self.path("patches.hdf"))
        self.tool("st-merge", self.path("patches.hdf"), "-o", self.path("mesh.hdf"))
        self.tool("st-export", self.path("mesh.hdf"), "-o", self.path("field.mesh"))
        return read_mesh(self.path("field.mesh"))

    def adapt(self, mesh, value, n_nodes):
        """The mesh that follows a field, of which its values on another mesh are known."""
        nodes, triangles = mesh
        lines = ["MeshVersionFormatted 2", "Dimension 3", "SolAtVertices", str(len(nodes)), "1 1"]
        self.path("field.sol").write_text("\n".join(lines + [repr(value(p)) for p in nodes] + ["End", ""]))
        cells = [f"Triangles\n{len(triangles)}"] + ["%d %d %d 1" % tuple(n + 1 for n in t) for t in triangles]
        points = [f"Vertices\n{len(nodes)}"] + [" ".join(map(repr, p)) + " 0" for p in nodes]
        self.path("field.mesh").write_text("\n".join(lines[:2] + points + cells + ["End", ""]))
        self.tool("st-metric", self.path("field.sol"), "-o", self.path("sizes.solb"), "--nodes", n_nodes,
                  "--max-aspect", self.aspect)
        return self.mesh(n_nodes, "--background", self.path("sizes.solb"), "--only")


def errors_by_level(loop, value, n_levels):
    """Of each level: nodes and errors of the default's sizes and of sizes that follow the field."""
    adapted, rows = None, []
    for level in range(n_levels):
        n_nodes = FIRST_NODES * 2**level
        plain = loop.mesh(n_nodes)
        adapted = adapted or plain
        for _ in range(CYCLES):
            adapted = loop.adapt(adapted, value, n_nodes)
        rows.append(tuple(x for m in (plain, adapted) for x in (len(m[0]), interpolation_error(*m, value))))
    return rows


def order_of(rows):
    """Of the error in the edge length, from the first to the last level."""
    (_, _, n0, e0), (_, _, n1, e1) = rows[0], rows[-1]
    return 2 * math.log(e0 / e1) / math.log(n1 / n0)


def gain_of(row):
    """The error of the default's sizes, brought to as many nodes, over that of adapted ones."""
    n_plain, plain, n_adapted, adapted = row
    return plain * n_plain / n_adapted / adapted


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin_dir", type=Path)
    parser.add_argument("models", nargs="+", metavar="SHAPE=MODEL")
    parser.add_argument("--levels", type=int, default=5)
    parser.add_argument("--aspect", type=float, default=1)
    options = parser.parse_args()
    print("| shape | field | nodes | error, default's sizes | error, st-metric | order | gain |")
    print("|---|---|--:|--:|--:|--:|--:|")
    for shape, model in (m.split("=", 1) for m in options.models):
        with tempfile.TemporaryDirectory() as folder:
            loop = Loop(options.bin_dir, model, folder, options.aspect)
            for name, field in FIELDS.items():
                rows = errors_by_level(loop, on_shape(field, shape), options.levels)
                for i, row in enumerate(rows):
                    order = f"{order_of(rows[i - 1:i + 1]):.2f}" if i else ""
                    print(f"| {shape} | {name} | {row[2]:,} | {row[1]:.2e} | {row[3]:.2e} | {order} | "
                          f"{gain_of(row):.1f} |", flush=True)


if __name__ == "__main__":
    main()
