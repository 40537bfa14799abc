#!/usr/bin/env python3
"""A CAD model and the same as an STL file: sizes, distances, features; the table in docs/dev/bench.md.

usage: scripts/facets_table.py BUILD_DIR MODEL... [--deflections 1e-3 1e-4] [--worst FILE.csv]

BUILD_DIR holds bin/ and tests/support/write_facets; needs VTK. Deflections are shares of the diagonal. Both models go
through the chain with the same options. Both size fields are asked at the nodes of the CAD's mesh. Distances of both
meshes, and of the file's facets, are to facets of the CAD ten times as fine. A side of the CAD's mesh along which it
turns by 40 degrees is kept where one at which the other mesh turns by 20 is within half its length.
"""
import argparse
import csv
import json
import tempfile
from pathlib import Path

import vtk
from table_common import run

SHARP, KEPT = 40, 20  # degrees


class Chain:
    """Sizes and mesh of one file."""

    def __init__(self, bin_dir, file, folder):
        self.bin, self.folder = bin_dir, folder
        folder.mkdir()
        geometry, raster, sizing = (folder / f"{n}.hdf" for n in ("g", "r", "s"))
        said = json.loads(run(bin_dir / "st-import", file, "--unit", "m", "-o", geometry, "--json"))
        self.n_faces = said["faces"]
        run(bin_dir / "st-raster", geometry, "-o", raster, "-q")
        run(bin_dir / "st-prolong", raster, "-o", sizing, "-q")
        run(bin_dir / "st-mesh", geometry, sizing, "-o", folder / "p.hdf", "-q")
        merged = run(bin_dir / "st-merge", folder / "p.hdf", "-o", folder / "m.hdf", "--allow-incomplete", "--json")
        self.n_triangles = json.loads(merged)["triangles"]
        run(bin_dir / "st-export", folder / "m.hdf", "-o", folder / "m.ply", "-q")
        self.mesh = read(folder / "m.ply")

    def sizes(self, points):
        run(self.bin / "st-prolong", self.folder / "r.hdf", "-o", self.folder / "s.hdf", "-q", "--sample", points,
            "--sample-output", self.folder / "o.csv")
        with open(self.folder / "o.csv", newline="") as rows:
            return [float(row["length"]) for row in csv.DictReader(rows)]


def read(file):
    reader = vtk.vtkSTLReader() if file.suffix == ".stl" else vtk.vtkPLYReader()
    reader.SetFileName(str(file))
    reader.Update()
    return reader.GetOutput()


def points_of(mesh):
    return [mesh.GetPoint(i) for i in range(mesh.GetNumberOfPoints())]


def middles_of(mesh):
    """Of triangles and their sides: where facets are farthest from what they stand for."""
    for i in range(mesh.GetNumberOfCells()):
        a, b, c = (mesh.GetPoint(mesh.GetCell(i).GetPointId(k)) for k in range(3))
        for u, v, w in ((a, b, c), (a, a, b), (b, b, c), (c, c, a)):
            yield [(p + q + r) / 3 for p, q, r in zip(u, v, w)]
            yield [(p + r) / 2 for p, r in zip(u, w)]


class Distance:
    """To the nearest cell of a mesh."""

    def __init__(self, mesh):
        self.locator = vtk.vtkStaticCellLocator()
        self.locator.SetDataSet(mesh)
        self.locator.BuildLocator()

    def __call__(self, x):
        nearest, cell, part, distance2 = [0, 0, 0], vtk.reference(0), vtk.reference(0), vtk.reference(0.0)
        self.locator.FindClosestPoint(x, nearest, cell, part, distance2)
        return distance2.get() ** 0.5


def sharp_sides(mesh, angle):
    sides = vtk.vtkFeatureEdges()
    sides.SetInputData(mesh)
    sides.BoundaryEdgesOff()
    sides.NonManifoldEdgesOff()
    sides.ManifoldEdgesOff()
    sides.SetFeatureAngle(angle)
    sides.Update()
    return sides.GetOutput()


def share_kept(cad, facets):
    """Of the length of the CAD's sharp sides, in per cent."""
    sides, others = sharp_sides(cad, SHARP), sharp_sides(facets, KEPT)
    if not sides.GetNumberOfCells() or not others.GetNumberOfCells():
        return 100.0 if not sides.GetNumberOfCells() else 0.0
    distance, kept, total = Distance(others), 0, 0
    for i in range(sides.GetNumberOfCells()):
        a, b = (sides.GetPoint(sides.GetCell(i).GetPointId(k)) for k in range(2))
        length = sum((p - q) ** 2 for p, q in zip(a, b)) ** 0.5
        total += length
        if distance([(p + q) / 2 for p, q in zip(a, b)]) < length / 2:
            kept += length
    return 100 * kept / total


def write_points(points, file):
    file.write_text("\n".join(["x,y,z"] + [",".join(map(repr, x)) for x in points]) + "\n")


def write_worst(points, ratios, file):
    with open(file, "w", encoding="utf-8") as out:
        out.write("x,y,z,length,ratio\n")
        for x, (length, ratio) in zip(points, ratios):
            out.write(",".join(map(repr, [*x, length, ratio])) + "\n")


def compare(build_dir, model, deflection, worst):
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        write = build_dir / "tests/support/write_facets"
        run(write, model, deflection / 10, folder / "fine.stl", folder / "m.brep")
        run(write, model, deflection, folder / "m.stl", folder / "m.brep")
        cad = Chain(build_dir / "bin", folder / "m.brep", folder / "cad")
        facets = Chain(build_dir / "bin", folder / "m.stl", folder / "facets")
        points = points_of(cad.mesh)
        write_points(points, folder / "points.csv")
        before, after = cad.sizes(folder / "points.csv"), facets.sizes(folder / "points.csv")
        ratios = [b / a for a, b in zip(before, after)]
        if worst:
            write_worst(points, list(zip(before, ratios)), worst)
        to_cad = Distance(read(folder / "fine.stl"))
        stl = read(folder / "m.stl")
        within = 100 * sum(abs(r - 1) <= 0.15 for r in ratios) / len(ratios)
        farthest = max(map(to_cad, points_of(facets.mesh))), max(map(to_cad, middles_of(stl)))
        return (stl.GetNumberOfCells(), cad.n_faces, facets.n_faces, within, *farthest,
                share_kept(cad.mesh, facets.mesh), cad.n_triangles, facets.n_triangles)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build_dir", type=Path)
    parser.add_argument("models", type=Path, nargs="+")
    parser.add_argument("--deflections", type=float, nargs="+", default=[1e-3, 1e-4])
    parser.add_argument("--worst", type=Path, help="writes nodes, the CAD's lengths there, and the facets' over these")
    arguments = parser.parse_args()
    print("| model | deflection | facets | faces; of facets | within 15 % | mesh off the CAD; facets off "
          "| sharp sides kept | triangles; of facets |")
    print("|---|--:|--:|--:|--:|--:|--:|--:|")
    for model in arguments.models:
        for deflection in arguments.deflections:
            found = compare(arguments.build_dir, model, deflection, arguments.worst)
            print("| {} | {:g} | {:,} | {}; {} | {:.1f} % | {:.3g}; {:.3g} | {:.1f} % | {:,}; {:,} |".format(
                model.name, deflection, *found), flush=True)


if __name__ == "__main__":
    main()
