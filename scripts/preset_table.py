#!/usr/bin/env python3
"""Edges, bases and triangles by model and preset: the tables in docs/presets.md.

usage: scripts/preset_table.py BIN_DIR MODEL... [--presets euler rans] [--before BIN_DIR]
run with Debian's python3 (python3-vtk9)

Stations lie nearest to 25, 50 and 75 % of the way between the two trailing points furthest apart. The size at a place
is the mean length of the segments at the nearest node. Cells across a base follow from its triangles, area and length.
`--before` adds the meshes of other tools at their defaults, measured at the same places.
"""
import argparse
import json
import tempfile
from pathlib import Path

import numpy
import vtk
from vtk.util.numpy_support import vtk_to_numpy

from table_common import run


class Mesh:
    def __init__(self, path):
        reader = vtk.vtkXMLUnstructuredGridReader()
        reader.SetFileName(str(path))
        reader.Update()
        grid = reader.GetOutput()
        self.x = vtk_to_numpy(grid.GetPoints().GetData()).astype(float)
        self.triangles = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 3)
        self.face = vtk_to_numpy(grid.GetCellData().GetArray("face"))
        t = self.triangles
        sides = numpy.concatenate([t[:, [0, 1]], t[:, [1, 2]], t[:, [2, 0]]])
        self.sides = numpy.unique(numpy.sort(sides, axis=1), axis=0)
        length = numpy.linalg.norm(self.x[self.sides[:, 0]] - self.x[self.sides[:, 1]], axis=1)
        total, count = numpy.zeros(len(self.x)), numpy.zeros(len(self.x))
        for k in (0, 1):
            numpy.add.at(total, self.sides[:, k], length)
            numpy.add.at(count, self.sides[:, k], 1)
        self.size = total / numpy.maximum(count, 1)

    def size_at(self, place):
        return self.size[numpy.argmin(numpy.linalg.norm(self.x - numpy.array(place), axis=1))]

    def triangles_on(self, faces):
        return int(numpy.isin(self.face, faces).sum())

    def area(self, face):
        a, b, c = (self.x[self.triangles[self.face == face][:, k]] for k in range(3))
        return 0.5 * float(numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1).sum())


def stations(wing):
    """Three measured stations along the span."""
    places = numpy.array([s["trailing"] for s in wing["stations"]])
    ends = places[numpy.argmax(numpy.linalg.norm(places - places.mean(axis=0), axis=1))]
    other = places[numpy.argmax(numpy.linalg.norm(places - ends, axis=1))]
    if other[2] + other[1] < ends[2] + ends[1]:  # from root to tip, where both lie on an axis
        ends, other = other, ends
    way = (places - ends) @ (other - ends) / max(float((other - ends) @ (other - ends)), 1e-300)
    return [wing["stations"][int(numpy.argmin(abs(way - share)))] for share in (0.25, 0.5, 0.75)]


def per_cent(values):
    return " / ".join(f"{100 * v:.2g}" for v in values)


def cells_across(mesh, wing, length):
    """Of each base: mean number of cells across its width."""
    found = []
    for base in wing["bases"]:
        n, area = mesh.triangles_on([base]), mesh.area(base)
        if n and area > 0 and length > 0:
            found.append((n, area))
    if not found:
        return "-"
    n, area = (sum(f[k] for f in found) for k in (0, 1))
    return f"{(n * area / length / (2 * length)) ** 0.5:.1f}"


def make_mesh(bin_dir, model, options, folder):
    """The mesh, and what st-raster says; options of st-raster and st-prolong."""
    path = {n: folder / f"{n}.hdf" for n in ("geometry", "raster", "sizing", "patches", "mesh")}
    run(bin_dir / "st-import", model, "-o", path["geometry"], "-q")
    said = run(bin_dir / "st-raster", path["geometry"], *options, "-o", path["raster"], "--json")
    run(bin_dir / "st-prolong", path["raster"], *options, "-o", path["sizing"], "-q")
    run(bin_dir / "st-mesh", path["geometry"], path["sizing"], "-o", path["patches"], "-q")
    run(bin_dir / "st-merge", path["patches"], "-o", path["mesh"], "--allow-incomplete", "-q")
    run(bin_dir / "st-export", path["mesh"], "-o", folder / "mesh.vtu", "-q")
    return Mesh(folder / "mesh.vtu"), json.loads(said)


def groups_of(bin_dir, folder):
    tables = json.loads(run(bin_dir / "st-info", folder / "geometry.hdf", "--groups", "--json"))["tables"]
    return tables[0]["groups"] if tables else []


def wing_rows(name, label, mesh, wings):
    for k, wing in enumerate(sorted(wings, key=lambda w: -w["span"] * w["chord"][1])[:3]):
        three = stations(wing)
        leading = per_cent(mesh.size_at(s["nose"]) / s["chord"] for s in three)
        trailing = per_cent(mesh.size_at(s["trailing"]) / s["chord"] for s in three)
        middle = per_cent(mesh.size_at([0.5 * (a + b) for a, b in zip(s["nose"], s["trailing"])]) / s["chord"]
                          for s in three)
        print(f"| {name} | {label} | {k + 1} | {leading} | {middle} | {trailing} "
              f"| {cells_across(mesh, wing, wing['span'])} |")


def triangle_row(name, label, mesh, wings, groups):
    on_wings = mesh.triangles_on(sorted({f for w in wings for f in w["faces"]}))
    count = {g["name"]: mesh.triangles_on(g["faces"]) for g in groups} if len(groups) > 1 else {}
    largest = sorted(count.items(), key=lambda item: (-item[1], item[0]))[:5]
    by_group = ", ".join(f"{g.split(',')[-1].strip() or g} {n:,}" for g, n in largest)
    return f"| {name} | {label} | {len(mesh.triangles):,} | {on_wings:,} | {by_group or '-'} |"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin_dir", type=Path)
    parser.add_argument("models", type=Path, nargs="+")
    parser.add_argument("--presets", nargs="+", default=["preview", "euler", "rans", "fine"])
    parser.add_argument("--before", type=Path, help="folder of other tools, run without a preset")
    arguments = parser.parse_args()
    print("| model | preset | surface | nose | mid-chord | trailing edge | across base |")
    print("|---|---|--:|--:|--:|--:|--:|")
    last = []
    for model in arguments.models:
        with tempfile.TemporaryDirectory() as folder:
            folder = Path(folder)
            made = []
            for preset in arguments.presets:
                mesh, said = make_mesh(arguments.bin_dir, model, ["--preset", preset], folder)
                made.append((preset, mesh, said["lifting_surfaces"]))
            groups = groups_of(arguments.bin_dir, folder)
            if arguments.before:
                mesh, _ = make_mesh(arguments.before, model, [], folder)
                made.insert(0, ("before", mesh, made[0][2]))
            for label, mesh, wings in made:
                wing_rows(model.stem, label, mesh, wings)
                last.append(triangle_row(model.stem, label, mesh, wings, groups))
        print(end="", flush=True)
    print("\n| model | preset | triangles | on wings | largest groups |\n|---|---|--:|--:|---|")
    print("\n".join(last))


if __name__ == "__main__":
    main()
