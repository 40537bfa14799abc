#!/usr/bin/env python3
"""Sizes and triangles of models whose faces random planes have cut: the table in docs/dev/bench.md.

usage: scripts/cuts_table.py BUILD_DIR MODEL... [--planes 3] [--seeds 1 2]

BUILD_DIR holds bin/ and tests/support/cut_model. Sizes are compared at 10,000 points of the uncut mesh.
"""
import argparse
import csv
import json
import random
import tempfile
from pathlib import Path

from table_common import run

N_POINTS = 10000


def random_points(obj):
    """Points inside triangles of an OBJ file; the triangle counts, not its area."""
    nodes, triangles = [], []
    for line in obj.read_text().splitlines():
        kind, *rest = line.split() or [""]
        if kind == "v":
            nodes.append([float(x) for x in rest[:3]])
        elif kind == "f":
            triangles.append([int(item.split("/")[0]) - 1 for item in rest])
    rng = random.Random(0)
    for _ in range(N_POINTS):
        a, b, c = (nodes[n] for n in rng.choice(triangles))
        s, t = sorted((rng.random(), rng.random()))
        yield [s * p + (t - s) * q + (1 - t) * r for p, q, r in zip(a, b, c)]


class Chain:
    """A model's size field and mesh."""

    def __init__(self, bin_dir, brep, folder, points=None):
        self.bin, self.folder, self.points = bin_dir, folder, points
        geometry, raster, sizing = (folder / f"{n}.hdf" for n in ("g", "r", "s"))
        said = json.loads(run(bin_dir / "st-import", brep, "-o", geometry, "--json"))
        self.n_faces = said["faces"]
        run(bin_dir / "st-raster", geometry, "-o", raster, "-q")
        sampling = ["--sample", points, "--sample-output", folder / "o.csv"] if points else []
        run(bin_dir / "st-prolong", raster, "-o", sizing, "-q", *sampling)
        run(bin_dir / "st-mesh", geometry, sizing, "-o", folder / "p.hdf", "-q")
        merged = run(bin_dir / "st-merge", folder / "p.hdf", "-o", folder / "m.hdf", "--allow-incomplete", "--json")
        self.n_triangles = json.loads(merged)["triangles"]

    def make_points(self):
        run(self.bin / "st-export", self.folder / "m.hdf", "-o", self.folder / "m.obj", "-q")
        self.points = self.folder / "points.csv"
        lines = ["x,y,z"] + [",".join(map(repr, x)) for x in random_points(self.folder / "m.obj")]
        self.points.write_text("\n".join(lines) + "\n")
        run(self.bin / "st-prolong", self.folder / "r.hdf", "-o", self.folder / "s.hdf", "-q", "--sample", self.points,
            "--sample-output", self.folder / "o.csv")

    def sizes(self):
        with open(self.folder / "o.csv", newline="") as rows:
            return [float(row["length"]) for row in csv.DictReader(rows)]


def share_within(a, b, bound):
    return 100 * sum(abs(y / x - 1) <= bound for x, y in zip(a, b)) / len(a)


def compare(build_dir, model, planes, seed):
    """Faces before and after, shares of points within 5 and 15 %, triangles before and after."""
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        chains = []
        for n in (0, planes):
            own = folder / str(n)
            own.mkdir()
            run(build_dir / "tests/support/cut_model", model, own / "m.brep", seed, n)
            chains.append(Chain(build_dir / "bin", own / "m.brep", own, chains[0].points if chains else None))
            if len(chains) == 1:
                chains[0].make_points()
        before, after = chains
        sizes = before.sizes(), after.sizes()
        return (before.n_faces, after.n_faces, share_within(*sizes, 0.05), share_within(*sizes, 0.15),
                before.n_triangles, after.n_triangles)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build_dir", type=Path)
    parser.add_argument("models", type=Path, nargs="+")
    parser.add_argument("--planes", type=int, default=3)
    parser.add_argument("--seeds", type=int, nargs="+", default=[1])
    arguments = parser.parse_args()
    print("| model | faces | cut | within 5 % | within 15 % | triangles | cut | change |")
    print("|---|--:|--:|--:|--:|--:|--:|--:|")
    for model in arguments.models:
        for seed in arguments.seeds:
            faces, cut, five, fifteen, n, n_cut = compare(arguments.build_dir, model, arguments.planes, seed)
            print(f"| {model.name} | {faces} | {cut} | {five:.1f} % | {fifteen:.1f} % | {n:,} | {n_cut:,} "
                  f"| {100 * (n_cut / n - 1):+.1f} % |", flush=True)


if __name__ == "__main__":
    main()
