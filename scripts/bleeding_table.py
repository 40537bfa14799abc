#!/usr/bin/env python3
"""Nodes whose size comes through the solid, by model: rows of the table in docs/dev/bench.md.

usage: scripts/bleeding_table.py BIN_DIR MODEL...     run with Debian's python3 (python3-vtk9)

The size of a node is explained when it grew along the surface, from a node on the face or edge that it goes back to.
It came through the solid when growth along the surface would make it 15 % larger, and the straight way to that node
starts into the solid. Each model is meshed with and without --no-blank.
"""
import argparse
import csv
import heapq
import re
import tempfile
from pathlib import Path

import numpy
import vtk
from vtk.util.numpy_support import vtk_to_numpy

from table_common import run

SLOPE = 0.2
LARGER = 0.85  # a size below this share of what grows along the surface is not explained
INTO = -0.3    # cosine between outer normal and way


class Surface:
    """A mesh with sizes and their causes."""

    def __init__(self, path, causes):
        reader = vtk.vtkXMLUnstructuredGridReader()
        reader.SetFileName(str(path))
        reader.Update()
        grid = reader.GetOutput()
        self.x = vtk_to_numpy(grid.GetPoints().GetData()).astype(float)
        self.triangles = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 3)
        self.size = vtk_to_numpy(grid.GetPointData().GetArray("size"))
        self.face = vtk_to_numpy(grid.GetCellData().GetArray("face"))
        dim = vtk_to_numpy(grid.GetPointData().GetArray("entity_dim"))
        entity = vtk_to_numpy(grid.GetPointData().GetArray("entity_id"))
        self.faces_of = [set() for _ in self.x]
        for t, f in zip(self.triangles, self.face):
            for n in t:
                self.faces_of[n].add(int(f))
        self.cause = causes
        self.on_edge = {}
        for n in numpy.flatnonzero(dim == 1):
            self.on_edge.setdefault(int(entity[n]), set()).update(self.faces_of[n])

    def cause_faces(self, node):
        kind, number = self.cause[node]
        if kind == "face":
            return {number}
        return self.on_edge.get(number, set()) if kind == "edge" else set()

    def normals(self):
        """Unit normals of nodes."""
        a, b, c = (self.x[self.triangles[:, k]] for k in range(3))
        area = numpy.cross(b - a, c - a)
        normal = numpy.zeros_like(self.x)
        for k in range(3):
            numpy.add.at(normal, self.triangles[:, k], area)
        return normal / numpy.maximum(numpy.linalg.norm(normal, axis=1), 1e-300)[:, None]

    def grown(self, seeds):
        """Sizes that grow along the surface from these nodes."""
        sides = numpy.concatenate([self.triangles[:, [0, 1]], self.triangles[:, [1, 2]], self.triangles[:, [2, 0]]])
        sides = numpy.unique(numpy.sort(sides, axis=1), axis=0)
        step = SLOPE * numpy.linalg.norm(self.x[sides[:, 0]] - self.x[sides[:, 1]], axis=1)
        around = [[] for _ in self.x]
        for (a, b), s in zip(sides.tolist(), step.tolist()):
            around[a].append((b, s))
            around[b].append((a, s))
        best = numpy.full(len(self.x), numpy.inf)
        best[seeds] = self.size[seeds]
        queue = [(best[n], int(n)) for n in seeds]
        heapq.heapify(queue)
        while queue:
            h, n = heapq.heappop(queue)
            if h > best[n]:
                continue
            for m, s in around[n]:
                if h + s < best[m]:
                    best[m] = h + s
                    heapq.heappush(queue, (h + s, m))
        return best

    def through_solid(self):
        """Nodes whose size came through the solid."""
        own = numpy.array([bool(self.faces_of[n] & self.cause_faces(n)) for n in range(len(self.x))])
        grown = self.grown(numpy.flatnonzero(own))
        doubtful = numpy.flatnonzero(~own & (self.size < LARGER * grown))
        normal, on_face, found = self.normals(), {}, []
        for n in numpy.flatnonzero(own):
            for f in self.faces_of[n]:
                on_face.setdefault(f, []).append(n)
        for n in doubtful:
            near = numpy.array(sorted({m for f in self.cause_faces(n) for m in on_face.get(f, [])}), int)
            if not len(near):
                continue
            way = self.x[near] - self.x[n]
            length = numpy.linalg.norm(way, axis=1)
            k = numpy.argmin(self.size[near] + SLOPE * length)
            if length[k] > 0 and way[k] @ normal[n] < INTO * length[k]:
                found.append(int(n))
        return found


def read_causes(path):
    """(face or edge, number from 1) of each point."""
    causes = []
    with open(path, newline="") as rows:
        for row in csv.DictReader(rows):
            text = row["cause"]
            number = re.search(r"^(face|edge) (\d+)", text)
            causes.append((number[1], int(number[2])) if number else ("none", 0))
    return causes


def measure(bin_dir, geometry, raster, options, folder):
    path = {n: folder / f"{n}.hdf" for n in ("sizing", "patches", "mesh")}
    run(bin_dir / "st-prolong", raster, "-o", path["sizing"], "-q", *options)
    run(bin_dir / "st-mesh", geometry, path["sizing"], "-o", path["patches"], "-q")
    run(bin_dir / "st-merge", path["patches"], "-o", path["mesh"], "--allow-incomplete", "-q")
    run(bin_dir / "st-export", path["mesh"], "-o", folder / "mesh.vtu", "-q")
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(folder / "mesh.vtu"))
    reader.Update()
    points = vtk_to_numpy(reader.GetOutput().GetPoints().GetData())
    numpy.savetxt(folder / "points.csv", points, delimiter=",", header="x,y,z", comments="", fmt="%.17g")
    sampling = ["--sample", folder / "points.csv", "--sample-output", folder / "sizes.csv"]
    run(bin_dir / "st-prolong", raster, "-o", path["sizing"], "-q", *options, *sampling)
    surface = Surface(folder / "mesh.vtu", read_causes(folder / "sizes.csv"))
    return len(surface.triangles), len(surface.x), len(surface.through_solid())


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin_dir", type=Path)
    parser.add_argument("models", type=Path, nargs="+")
    parser.add_argument("--raster", nargs="*", default=[], metavar="NAME=VALUE", help="of st-raster, without dashes")
    arguments = parser.parse_args()
    print("| model | triangles, open | through the solid | triangles | through the solid |\n|---|--:|--:|--:|--:|")
    for model in arguments.models:
        with tempfile.TemporaryDirectory() as folder:
            folder = Path(folder)
            geometry, raster = folder / "geometry.hdf", folder / "raster.hdf"
            run(arguments.bin_dir / "st-import", model, "-o", geometry, "-q")
            options = [f"--{o}" for o in arguments.raster]
            run(arguments.bin_dir / "st-raster", geometry, "-o", raster, "-q", *options)
            cells = []
            for options in (["--no-blank"], []):
                n_triangles, n_nodes, n_found = measure(arguments.bin_dir, geometry, raster, options, folder)
                cells += [f"{n_triangles:,}", f"{n_found:,} of {n_nodes:,}"]
            print(f"| {model.name} | {' | '.join(cells)} |", flush=True)


if __name__ == "__main__":
    main()
