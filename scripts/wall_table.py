#!/usr/bin/python3
"""Sizes on the far side of thin walls, fine on the near side: the table in docs/dev/bench.md.

usage: scripts/wall_table.py BIN_DIR          needs python3-h5py

Turned plates of thickness 0.02 and 0.005 in cells of 0.5, turned tubes of wall 0.03 and 0.005 that are fine inside at
0.01, with 24 and 360 facets, and the nacelle of the bundled aircraft, fine inside. Compared are the nodes of the far
side with the same model without the fine sizes: how many are within 5 %, without blanking, in one pass, and in two.
Nodes that the way around a rim reaches are left out; it may lead through the wall's end, within a cell. A narrow rim
asks for lengths of its own, and tells those around it in both models. Some minutes.
"""
import argparse
import csv
import math
import struct
import tempfile
from pathlib import Path

import h5py
import numpy

from table_common import run

SLOPE, WITHIN, N_NODES = 0.2, 0.05, 4000
CELL = 4  # lengths, see st-raster --cell-per-length
AXIS, ANGLE = numpy.array([1, 0.4, 0.2]) / math.sqrt(1.2), 0.6


def turned(points):
    """Points turned about AXIS by ANGLE."""
    x = numpy.asarray(points, float)
    return (x * math.cos(ANGLE) + numpy.cross(AXIS, x) * math.sin(ANGLE)
            + numpy.outer(x @ AXIS, AXIS) * (1 - math.cos(ANGLE)))


def write_stl(path, quads):
    """Two triangles of each quad, turned."""
    triangles = [corners for q in quads for corners in ((q[0], q[1], q[2]), (q[0], q[2], q[3]))]
    text = b"".join(struct.pack("<12fH", 0, 0, 0, *turned(t).ravel(), 0) for t in triangles)
    path.write_bytes(bytes(80) + struct.pack("<I", len(triangles)) + text)


def plate(thickness):
    """10 by 10."""
    a, b, c, d = ([x, y, -0.5 * thickness] for x, y in ((-5, -5), (5, -5), (5, 5), (-5, 5)))
    e, f, g, h = ([x, y, 0.5 * thickness] for x, y, _ in (a, b, c, d))
    return [(a, d, c, b), (e, f, g, h), (a, b, f, e), (b, c, g, f), (c, d, h, g), (d, a, e, h)]


def tube(wall, n):
    """Radius 1, length 2, of n facets."""
    def at(r, k, z):
        return [r * math.cos(2 * math.pi * k / n), r * math.sin(2 * math.pi * k / n), z]
    inner = 1 - wall
    quads = []
    for k in range(n):
        quads.append((at(1, k, -1), at(1, k + 1, -1), at(1, k + 1, 1), at(1, k, 1)))
        quads.append((at(inner, k, -1), at(inner, k, 1), at(inner, k + 1, 1), at(inner, k + 1, -1)))
        for z in (-1, 1):
            ring = (at(inner, k, z), at(1, k, z), at(1, k + 1, z), at(inner, k + 1, z))
            quads.append(ring if z > 0 else ring[::-1])
    return quads


class Wall:
    """A model, in a folder of its own. `near`, `far`: of a mesh, which of its triangles lie on these sides."""

    def __init__(self, bin_dir, folder, fine, lmax, sides):
        self.bin, self.folder, self.fine, self.lmax, self.sides = bin_dir, folder, fine, lmax, sides

    def at(self, name):
        return self.folder / f"{name}.hdf"

    def raster(self, name, *options):
        run(self.bin / "st-raster", self.at("geometry"), "-o", self.at(name), "--lmax", self.lmax, "-q", *options)

    def mesh(self, sizing, name):
        run(self.bin / "st-mesh", self.at("geometry"), self.at(sizing), "-o", self.at("patches"), "-q")
        run(self.bin / "st-merge", self.at("patches"), "-o", self.at(name), "-q")

    def sizes(self, raster, *options):
        run(self.bin / "st-prolong", self.at(raster), "-o", self.at("sampled"), "-q", *options, "--slope", SLOPE,
            "--sample", self.folder / "nodes.csv", "--sample-output", self.folder / "sizes.csv")
        with open(self.folder / "sizes.csv", newline="") as rows:
            return numpy.array([float(row["length"]) for row in csv.DictReader(rows)])

    def choose_nodes(self):
        """Of the far side, with their distances from the rim of the near one."""
        with h5py.File(self.at("open_mesh")) as file:
            mesh = file["VTKHDF"]
            points, corners = mesh["Points"][:], mesh["Connectivity"][:].reshape(-1, 3)
            near, far = self.sides(file, points[corners])
            self.near_faces = numpy.unique(mesh["CellData/face"][:][near])
        of_near = numpy.unique(corners[near])
        rim = points[numpy.intersect1d(of_near, corners[~near])]
        nodes = numpy.setdiff1d(corners[far], corners[~far])
        nodes = points[numpy.random.default_rng(4).permutation(nodes)[:N_NODES]]
        (self.folder / "nodes.csv").write_text("".join(f"{x!r},{y!r},{z!r}\n" for x, y, z in nodes.tolist()))
        return numpy.array([numpy.sqrt(((rim - x) ** 2).sum(axis=1).min()) for x in nodes])

    def row(self, name):
        self.raster("plain")
        run(self.bin / "st-prolong", self.at("plain"), "-o", self.at("open"), "--no-blank", "-q")
        self.mesh("open", "open_mesh")
        from_rim = self.choose_nodes()
        faces = ", ".join(map(str, self.near_faces))
        (self.folder / "fine.toml").write_text(f"[[size]]\nfaces = [{faces}]\nlmin = {self.fine}\nlmax = {self.fine}\n")
        self.raster("fine", "--sizes", self.folder / "fine.toml")
        plain = self.sizes("plain")
        counts = self.fine + SLOPE * numpy.maximum(from_rim - CELL * self.fine, 0) > plain
        run(self.bin / "st-prolong", self.at("fine"), "-o", self.at("open"), "--no-blank", "-q")
        self.mesh("open", "fine_mesh")
        shares = []
        for options in (["--no-blank"], [], ["--blank", self.at("fine_mesh")]):
            ratio = self.sizes("fine", *options)[counts] / plain[counts]
            shares.append(f"{100 * numpy.mean(abs(ratio - 1) < WITHIN):.2f} %")
        print(f"| {name} | {counts.sum():,} of {len(plain):,} | {' | '.join(shares)} |", flush=True)


def normals(corners):
    """Unit normals of triangles."""
    n = numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return n / numpy.linalg.norm(n, axis=1)[:, None]


def plate_sides(_, corners):
    along = normals(corners) @ turned([[0, 0, 1]])[0]
    return along < -0.5, along > 0.5


def tube_sides(_, corners):
    axis, x = turned([[0, 0, 1]])[0], corners.mean(axis=1)
    from_axis = x - numpy.outer(x @ axis, axis)
    along = (normals(corners) * from_axis).sum(axis=1) / numpy.linalg.norm(from_axis, axis=1)
    return along < -0.5, along > 0.5


def nacelle_sides(file, _):
    names = [n.decode() for n in file["st/group/name"][:]]
    group = file["VTKHDF/CellData/group"][:]
    return group == names.index("nacelle_inner"), group == names.index("nacelle_outer")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin_dir", type=Path)
    bin_dir = parser.parse_args().bin_dir
    print("| wall | nodes | without blanking | one pass | two |")
    print("|---|--:|--:|--:|--:|")
    for name, quads, fine, lmax, sides in (
            ("turned plate, 0.02", plate(0.02), 0.05, 0.125, plate_sides),
            ("turned plate, 0.005", plate(0.005), 0.05, 0.125, plate_sides),
            ("turned tube, 24 facets, 0.03", tube(0.03, 24), 0.01, 0.1, tube_sides),
            ("turned tube, 360 facets, 0.03", tube(0.03, 360), 0.01, 0.1, tube_sides),
            ("turned tube, 360 facets, 0.005", tube(0.005, 360), 0.01, 0.1, tube_sides),
            ("nacelle", None, 0.02, "2.5%", nacelle_sides)):
        with tempfile.TemporaryDirectory() as folder:
            wall = Wall(bin_dir, Path(folder), fine, lmax, sides)
            model = wall.folder / ("model.stl" if quads else "aircraft.step")
            if quads:
                write_stl(model, quads)
            else:
                run(bin_dir / "make_aircraft", model)
            run(bin_dir / "st-import", model, "-o", wall.at("geometry"), "-q", *(["--unit", "m"] if quads else []))
            wall.row(name)


if __name__ == "__main__":
    main()
