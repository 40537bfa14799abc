#!/usr/bin/env python3
"""How smoothly lengths change over meshes: the table in docs/dev/wings.md.

usage: scripts/smoothness_table.py BIN_DIR MODEL... [--preset rans]

`nodes`: share of nodes whose longest or shortest edge differs by more than 1.25 from the mean of its neighbours'.
`sides`: of places at 5 to 95 % of the chord, the share where upper and lower side have lengths within 1.2.
"""
import argparse
import tempfile
from pathlib import Path

import h5py
import numpy as np

from preset_table import check_mesh

NODE_FACTOR, SIDE_FACTOR = 1.25, 1.2
PLACES = (0.05, 0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 0.9, 0.95)  # of the chord
BAND = 0.03  # of the chord, around a station along the span


def read_mesh(path):
    """Places of nodes, nodes of triangles, and the face of each, from 0."""
    with h5py.File(path) as file:
        data = file["VTKHDF"]
        return data["Points"][:], data["Connectivity"][:].reshape(-1, 3), data["CellData/face"][:] - 1


def uneven_nodes(xyz, triangles):
    """Share of nodes with a longest or shortest edge unlike its neighbours'."""
    edges = np.unique(np.sort(np.vstack([triangles[:, [a, b]] for a, b in ((0, 1), (1, 2), (2, 0))]), axis=1), axis=0)
    length = np.linalg.norm(xyz[edges[:, 1]] - xyz[edges[:, 0]], axis=1)
    n = len(xyz)
    longest, shortest = np.zeros(n), np.full(n, np.inf)
    for end in edges.T:
        np.maximum.at(longest, end, length)
        np.minimum.at(shortest, end, length)
    count = np.bincount(edges.ravel(), minlength=n)

    def is_unlike(value):
        mean = sum(np.bincount(edges[:, k], value[edges[:, 1 - k]], n) for k in (0, 1)) / np.maximum(count, 1)
        factor = value / mean
        return np.maximum(factor, 1 / factor) > NODE_FACTOR

    used = count > 0
    return np.mean((is_unlike(longest) | is_unlike(shortest))[used])


def unit(vector):
    return vector / np.linalg.norm(vector)


def station_factors(stations, i, center, normal, size):
    """Lengths of one side over those of the other, at least 1, at each of PLACES."""
    nose, trailing, chord = stations[i, 0:3], stations[i, 3:6], stations[i, 6]
    forward = unit(trailing - nose)
    span = stations[i + 1, 3:6] - stations[i - 1, 3:6]
    span = unit(span - span @ forward * forward)
    up = np.cross(forward, span)
    x, y, z = ((center - nose) @ axis / chord for axis in (forward, span, up))
    near = (abs(y) < BAND) & (abs(z) < 0.3)
    for place in PLACES:
        inside = near & (abs(x - place) < min(BAND, 0.25 * min(place, 1 - place)))
        sides = [size[inside & (normal @ up * sign > 0)] for sign in (1, -1)]
        if all(len(side) > 3 for side in sides):
            factor = sides[0].mean() / sides[1].mean()
            yield max(factor, 1 / factor)


def side_factors(sizing, xyz, triangles, face):
    """Those of the wings, at up to twelve stations of each."""
    corners = xyz[triangles]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    size, center = np.sqrt(np.linalg.norm(normal, axis=1)), corners.mean(axis=1)
    with h5py.File(sizing) as file:
        if "st/wing" not in file:
            return []
        stations, offsets = file["st/wing/station"][:], file["st/wing/station_offset"][:]
        faces = np.split(file["st/wing/face"][:], file["st/wing/face_offset"][1:-1])
    factors = []
    for begin, end, own in zip(offsets, offsets[1:], faces):
        skin = np.isin(face, own)
        for i in range(begin + 1, end - 1, max(1, (end - begin) // 12)):
            factors += station_factors(stations, i, center[skin], normal[skin], size[skin])
    return factors


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin_dir", type=Path)
    parser.add_argument("models", type=Path, nargs="+")
    parser.add_argument("--preset", default="rans")
    arguments = parser.parse_args()
    print("| model | triangles | nodes, % | sides within 1.2, % | sides, median |\n|---|--:|--:|--:|--:|")
    for model in arguments.models:
        with tempfile.TemporaryDirectory() as folder:
            report = check_mesh(arguments.bin_dir, model, arguments.preset, Path(folder), "--max-aspect", "1")
            xyz, triangles, face = read_mesh(Path(folder) / "mesh.hdf")
            factors = np.array(side_factors(Path(folder) / "sizing.hdf", xyz, triangles, face))
        sides = f"{100 * np.mean(factors <= SIDE_FACTOR):.1f} | {np.median(factors):.3f}" if len(factors) else "- | -"
        print(f"| {model.stem} | {report['triangles']:,} | {100 * uneven_nodes(xyz, triangles):.1f} | {sides} |",
              flush=True)


if __name__ == "__main__":
    main()
