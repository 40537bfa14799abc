#!/usr/bin/env python3
"""Scans of CAD models, made of meshes by noise, with and without --smooth; table in docs/dev/bench.md.

usage: scripts/scan_table.py BUILD_DIR MODEL... [--noise 0.02 0.05 0.1]

BUILD_DIR holds bin/. A model is meshed with sides of 0.3 to 0.6 % of its diagonal, and each node moves at random, by
the share of a median side as standard deviation along each axis. Each scan is an STL file in metres. Needs numpy and
h5py.
"""
import argparse
import json
import tempfile
from pathlib import Path

import h5py
import numpy
from table_common import run

DEVIATIONS = 4  # of the noise: how far --smooth may move nodes


def write_stl(file, nodes, triangles):
    facets = numpy.zeros(len(triangles), dtype=[("normal", "<f4", 3), ("nodes", "<f4", (3, 3)), ("bytes", "<u2")])
    facets["nodes"] = nodes[triangles]
    file.write_bytes(bytes(80) + numpy.uint32(len(facets)).tobytes() + facets.tobytes())


def make_mesh(bin_dir, folder, *sizes):
    """m.hdf of the folder, of its g.hdf."""
    run(bin_dir / "st-raster", folder / "g.hdf", "-o", folder / "r.hdf", "-q", *sizes)
    run(bin_dir / "st-prolong", folder / "r.hdf", "-o", folder / "s.hdf", "-q")
    run(bin_dir / "st-mesh", folder / "g.hdf", folder / "s.hdf", "-o", folder / "p.hdf", "-q")
    run(bin_dir / "st-merge", folder / "p.hdf", "-o", folder / "m.hdf", "-q")


def mesh_of(bin_dir, model, folder, *sizes):
    run(bin_dir / "st-import", model, "-o", folder / "g.hdf", "-q")
    make_mesh(bin_dir, folder, *sizes)
    with h5py.File(folder / "m.hdf") as file:
        return file["VTKHDF/Points"][:], file["VTKHDF/Connectivity"][:].reshape(-1, 3)


def measured(bin_dir, scan, folder, *options):
    """Faces, triangles and whether the mesh passes."""
    said = json.loads(run(bin_dir / "st-import", scan, "--unit", "m", "-o", folder / "g.hdf", "--json", *options))
    make_mesh(bin_dir, folder)
    check = json.loads(run(bin_dir / "st-check", folder / "m.hdf", "--geometry", folder / "g.hdf", "--json"))
    return f"{said['faces']} | {check['quality']['triangles']:,} {check['verdict']}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=Path)
    parser.add_argument("models", type=Path, nargs="+")
    parser.add_argument("--noise", type=float, nargs="+", default=[0.02, 0.05, 0.1])
    args = parser.parse_args()
    bin_dir = args.build / "bin"
    print("| model | noise, of a side | faces | triangles | faces, smooth | triangles |\n|---|--:|--:|--:|--:|--:|")
    for model in args.models:
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            nodes, triangles = mesh_of(bin_dir, model, folder, "--lmax", "0.6%", "--lmin", "0.3%")
            side = numpy.median(numpy.linalg.norm(nodes[triangles[:, 0]] - nodes[triangles[:, 1]], axis=1))
            for noise in [0, *args.noise]:
                scan = folder / "scan.stl"
                moved = nodes + numpy.random.default_rng(3).normal(0, noise * side, nodes.shape)
                write_stl(scan, moved, triangles)
                rough = measured(bin_dir, scan, folder)
                smooth = measured(bin_dir, scan, folder, "--smooth", DEVIATIONS * noise * side) if noise else "- | -"
                print(f"| {model.name} | {noise} | {rough} | {smooth} |", flush=True)


if __name__ == "__main__":
    main()
