#!/usr/bin/env python3
"""Quality of faces in tiles against the same faces as wholes: the table in docs/dev/scaling.md.

usage: scripts/tile_table.py BIN_DIR MODEL... [--tile 5000] [--least 15000] [--triangles 600000]

Each model is meshed twice with --triangles triangles, in tiles and without. Compared are its faces of --least triangles
or more. q is 4 sqrt(3) area / (sum of squared sides); the totals are over all faces of all models.
"""
import argparse
import json
import tempfile
from pathlib import Path

import h5py
import numpy as np

from table_common import run


def faces_of(path):
    """By face: (q, smallest angle in degrees) of its triangles."""
    with h5py.File(path) as file:
        mesh = file["VTKHDF"]
        points, triangles = mesh["Points"][:], mesh["Connectivity"][:].reshape(-1, 3)
        face = mesh["CellData/face"][:]
    corner = points[triangles]
    side2 = ((corner[:, [1, 2, 0]] - corner[:, [2, 0, 1]]) ** 2).sum(axis=2)  # opposite to each corner
    area = 0.5 * np.linalg.norm(np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]), axis=1)
    others = side2.sum(axis=1, keepdims=True) - 2 * side2
    angle = np.degrees(np.arctan2(4 * area[:, None], others)).min(axis=1)
    q = 4 * np.sqrt(3) * area / side2.sum(axis=1)
    order = np.argsort(face, kind="stable")
    ends = np.flatnonzero(np.diff(face[order])) + 1
    return {face[some[0]]: (q[some], angle[some]) for some in np.split(order, ends)}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin", type=Path)
    parser.add_argument("models", nargs="+", type=Path)
    parser.add_argument("--tile", type=int, default=5000)
    parser.add_argument("--least", type=int, default=15000)
    parser.add_argument("--triangles", type=int, default=600000)
    options = parser.parse_args()
    print("| model | faces | tiles | whole after all | mean q | 1st percentile | below 20 degrees: whole, tiles |")
    print("|---|--:|--:|--:|--:|--:|--:|")
    total, worst, below = 0, 0.0, np.zeros(2, int)
    for model in options.models:
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            at = {n: folder / f"{n}.hdf" for n in ("geometry", "raster", "sizing", "whole", "tiles")}
            run(options.bin / "st-import", model, "-o", at["geometry"], "-q")
            run(options.bin / "st-raster", at["geometry"], "-o", at["raster"], "-q")
            run(options.bin / "st-prolong", at["raster"], "-o", at["sizing"], "-q", "--target-triangles",
                options.triangles)
            faces = {}
            for kind, tile in (("whole", 0), ("tiles", options.tile)):
                run(options.bin / "st-mesh", at["geometry"], at["sizing"], "-o", folder / "p.hdf", "-q", "--tile", tile,
                    "--trace", folder / "trace.csv")
                run(options.bin / "st-merge", folder / "p.hdf", "-o", at[kind], "-q", "--allow-incomplete")
                faces[kind] = faces_of(at[kind])
            tasks = [line.split(",") for line in (folder / "trace.csv").read_text().splitlines()]
        heavy = [f for f, (q, _) in faces["whole"].items() if len(q) >= options.least]
        numbers = {str(f) for f in heavy}
        n_tiles = len({(t[2], t[3]) for t in tasks if t[:2] == ["task", "tile"] and t[2] in numbers})
        n_seams = len({t[2] for t in tasks if t[:2] == ["task", "seams"] and t[2] in numbers})
        n_whole = len({t[2] for t in tasks if t[:2] == ["task", "face"] and t[2] in numbers} &
                      {t[2] for t in tasks if t[:2] == ["task", "seams"]})
        if not heavy or not n_seams:
            continue
        change = [faces["tiles"][f][0].mean() - faces["whole"][f][0].mean() for f in heavy]
        low = [np.percentile(faces["tiles"][f][0], 1) - np.percentile(faces["whole"][f][0], 1) for f in heavy]
        sharp = np.array([sum((faces[k][f][1] < 20).sum() for f in heavy) for k in ("whole", "tiles")])
        print(f"| {model.stem} | {len(heavy)} | {n_tiles} | {n_whole} | {min(change):+.4f} to {max(change):+.4f} | "
              f"{min(low):+.3f} to {max(low):+.3f} | {sharp[0]}, {sharp[1]} |", flush=True)
        total, worst, below = total + len(heavy), min(worst, min(change)), below + sharp
    print(json.dumps({"faces": total, "worst change of mean q": round(worst, 5), "below 20 degrees": below.tolist()}))


if __name__ == "__main__":
    main()
