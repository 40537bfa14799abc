#!/usr/bin/env python3
"""Edge lengths at the trailing edges of lifting surfaces, by preset: rows of the table in docs/dev/wings.md.

usage: scripts/edge_table.py BIN_DIR MODEL... [--presets euler rans]     run with Debian's python3 (python3-vtk9)
"""
import argparse
import json
import tempfile
from pathlib import Path

import numpy
import vtk
from vtk.util.numpy_support import vtk_to_numpy

from table_common import run


def segments_on(mesh, edges):
    """Lengths of the mesh's segments on the CAD edges (numbers from 1)."""
    points = vtk_to_numpy(mesh.GetPoints().GetData())
    data = mesh.GetPointData()
    dim, entity = vtk_to_numpy(data.GetArray("entity_dim")), vtk_to_numpy(data.GetArray("entity_id"))
    on = (dim == 1) & numpy.isin(entity, edges)
    triangles = vtk_to_numpy(mesh.GetCells().GetConnectivityArray()).reshape(-1, 3)
    sides = numpy.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    same = on[sides[:, 0]] & on[sides[:, 1]] & (entity[sides[:, 0]] == entity[sides[:, 1]])
    sides = numpy.unique(numpy.sort(sides[same], axis=1), axis=0)
    return numpy.linalg.norm(points[sides[:, 0]] - points[sides[:, 1]], axis=1)


def row(bin_dir, model, preset, folder):
    path = {n: folder / f"{n}.hdf" for n in ("geometry", "raster", "sizing", "patches", "mesh")}
    run(bin_dir / "st-import", model, "-o", path["geometry"], "-q")
    sampled = run(bin_dir / "st-raster", path["geometry"], "--preset", preset, "-o", path["raster"], "--json")
    run(bin_dir / "st-prolong", path["raster"], "--preset", preset, "-o", path["sizing"], "-q")
    run(bin_dir / "st-mesh", path["geometry"], path["sizing"], "-o", path["patches"], "-q")
    merged = json.loads(run(bin_dir / "st-merge", path["patches"], "-o", path["mesh"], "--allow-incomplete", "--json"))
    run(bin_dir / "st-export", path["mesh"], "-o", folder / "mesh.vtu", "-q")
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(folder / "mesh.vtu"))
    reader.Update()
    share = []
    for wing in json.loads(sampled)["lifting_surfaces"]:
        lengths = segments_on(reader.GetOutput(), wing["trailing_edges"])
        if len(lengths):
            share.append(100 * lengths.max() / wing["chord"][2])
    longest = f"{max(share):.2f} %" if share else "none found"
    print(f"| {model.name} | {preset} | {merged['triangles']:,} | {len(share)} | {longest} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin_dir", type=Path)
    parser.add_argument("models", type=Path, nargs="+")
    parser.add_argument("--presets", nargs="+", default=["euler", "rans"])
    arguments = parser.parse_args()
    print("| model | preset | triangles | lifting surfaces | longest segment of a trailing edge over chord |")
    print("|---|---|--:|--:|--:|")
    for model in arguments.models:
        for preset in arguments.presets:
            with tempfile.TemporaryDirectory() as folder:
                row(arguments.bin_dir, model, preset, Path(folder))


if __name__ == "__main__":
    main()
