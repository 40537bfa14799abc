#!/usr/bin/python3
"""Sources and a background mesh on a model: field over what was asked for, worst.

usage: scripts/asked_table.py BIN_DIR MODEL          needs python3-h5py

At 65 nodes of the model's mesh stand point sources of 0.7, 0.5 and 0.25 of the length there. A background of six
tetrahedra around the model, of lengths that change evenly along x, y and z and are below all others, is asked for at
1,000 points. Half a minute on the D150.
"""
import argparse
import csv
import tempfile
from pathlib import Path

import h5py
import numpy

from table_common import run

SLOPE, N_NODES, N_POINTS = 0.2, 65, 1000
TETRAHEDRA = ((0, 1, 3, 7), (0, 1, 5, 7), (0, 2, 3, 7), (0, 2, 6, 7), (0, 4, 5, 7), (0, 4, 6, 7))  # of a box's corners


class Field:
    """A size field of `raster` with other sources each time."""

    def __init__(self, bin_dir, folder):
        self.bin, self.folder = bin_dir, folder

    def at(self, points, *options):
        (self.folder / "p.csv").write_text("".join(f"{x!r},{y!r},{z!r}\n" for x, y, z in points.tolist()))
        run(self.bin / "st-prolong", self.folder / "sizing.hdf", "-o", self.folder / "sampled.hdf", "-q", *options,
            "--sample", self.folder / "p.csv", "--sample-output", self.folder / "o.csv")
        with open(self.folder / "o.csv", newline="") as rows:
            return numpy.array([float(row["length"]) for row in csv.DictReader(rows)])


def mesh_nodes(bin_dir, model, folder):
    path = {n: folder / f"{n}.hdf" for n in ("geometry", "raster", "sizing", "patches", "mesh")}
    run(bin_dir / "st-import", model, "-o", path["geometry"], "-q")
    run(bin_dir / "st-raster", path["geometry"], "-o", path["raster"], "-q")
    run(bin_dir / "st-prolong", path["raster"], "-o", path["sizing"], "-q", "--slope", SLOPE)
    run(bin_dir / "st-mesh", path["geometry"], path["sizing"], "-o", path["patches"], "-q")
    run(bin_dir / "st-merge", path["patches"], "-o", path["mesh"], "-q")
    with h5py.File(path["mesh"]) as file:
        return file["VTKHDF/Points"][:].astype(float)


def report_sources(field, nodes):
    chosen = nodes[numpy.random.default_rng(3).permutation(len(nodes))[:N_NODES]]
    before = field.at(chosen)
    apart = numpy.sqrt(((chosen[:, None] - chosen[None]) ** 2).sum(axis=2))
    for share in (0.7, 0.5, 0.25):
        text = "".join(f'[[source]]\nname = "s{i}"\ntype = "point"\nat = {x.tolist()}\nlength = {share * h!r}\n'
                       for i, (x, h) in enumerate(zip(chosen, before.tolist())))
        (field.folder / "s.toml").write_text(text)
        asked = numpy.minimum(before, (share * before + SLOPE * apart).min(axis=1))
        ratio = field.at(chosen, "--sources", field.folder / "s.toml") / asked
        print(f"sources of {share} of the length: field / asked is 1 within {abs(ratio - 1).max():.1e}")


def report_background(field, nodes):
    low, high = nodes.min(axis=0), nodes.max(axis=0)
    least = field.at(nodes[:: len(nodes) // 20000 + 1]).min()
    slope = 0.4 * least / (high - low)
    corners = numpy.array([[(low, high)[i >> k & 1][k] for k in range(3)] for i in range(8)])
    length = 0.3 * least + (corners - low) @ slope / 3
    lines = ["background", f"8 {len(TETRAHEDRA)} 0 0 0"]
    for i, (x, h) in enumerate(zip(corners.tolist(), length.tolist())):
        lines.append(f"{i + 1} {' '.join(map(repr, x))}")
        lines += [f"{axis} {h!r}" for axis in ("1 0 0", "0 1 0", "0 0 1")]
    lines += [" ".join(str(n + 1) for n in (i, *t)) for i, t in enumerate(TETRAHEDRA)]
    (field.folder / "b.bac").write_text("\n".join([*lines, "* points", "* lines", "* triangles", ""]))
    points = numpy.random.default_rng(5).uniform(low, high, (N_POINTS, 3))
    asked = 0.3 * least + (points - low) @ slope / 3
    ratio = field.at(points, "--background", field.folder / "b.bac") / asked
    print(f"background at {N_POINTS} points: field / asked is 1 within {abs(ratio - 1).max():.1e}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin_dir", type=Path)
    parser.add_argument("model", type=Path)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        nodes = mesh_nodes(arguments.bin_dir, arguments.model, folder)
        field = Field(arguments.bin_dir, folder)
        report_sources(field, nodes)
        report_background(field, nodes)


if __name__ == "__main__":
    main()
