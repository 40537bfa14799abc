#!/usr/bin/env python3
"""Draws the triangles of a plane y = Y before and after a move: kept ones grey, new ones orange.

usage: draw_kept.py OUT Y     reads mesh.obj, moved_mesh.obj and displacements.csv of OUT, writes kept.svg there
"""
import csv
import sys
from pathlib import Path

SCALE, GAP, MARGIN = 30, 1, 0.5  # pixels per unit of length; units between the drawings, and around them


def read_obj(path):
    points, triangles = [], []
    for line in path.read_text(encoding="utf-8").splitlines():
        words = line.split()
        if words[:1] == ["v"]:
            points.append(tuple(map(float, words[1:4])))
        elif words[:1] == ["f"]:
            triangles.append([int(w.split("/")[0]) - 1 for w in words[1:4]])
    return points, triangles


def key(corners):
    return frozenset(tuple(round(x, 6) for x in p) for p in corners)


def main():
    out, y = Path(sys.argv[1]), float(sys.argv[2])
    points, triangles = read_obj(out / "mesh.obj")
    with (out / "displacements.csv").open(encoding="utf-8") as lines:
        rows = [[float(v) for v in row.values()] for row in csv.DictReader(lines)]
    moved = [(r[1] + r[4], r[2] + r[5], r[3] + r[6]) for r in rows]
    kept = {key([moved[n] for n in t]) for t in triangles}
    new_points, new_triangles = read_obj(out / "moved_mesh.obj")
    drawings = [[([points[n] for n in t], True) for t in triangles],
                [(c, key(c) in kept) for c in ([new_points[n] for n in t] for t in new_triangles)]]
    drawings = [[(c, is_kept) for c, is_kept in d if all(abs(p[1] - y) < 1e-6 for p in c)] for d in drawings]
    shapes, left, height = [], MARGIN, 0
    for drawing in drawings:
        xs, zs = ([p[k] for corners, _ in drawing for p in corners] for k in (0, 2))
        top, first = max(zs), min(xs)
        for corners, is_kept in drawing:
            path = " ".join(f"{SCALE * (left + p[0] - first):.1f},{SCALE * (MARGIN + top - p[2]):.1f}" for p in corners)
            shapes.append(f'<polygon points="{path}" fill="{"#e4e4e4" if is_kept else "#f5a142"}"/>')
        left += max(xs) - first + GAP
        height = max(height, top - min(zs))
    width, height = SCALE * (left - GAP + MARGIN), SCALE * (height + 2 * MARGIN)
    (out / "kept.svg").write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:.0f}" height="{height:.0f}">\n'
        '<g stroke="#333" stroke-width="0.6" stroke-linejoin="round">\n' + "\n".join(shapes) + "\n</g>\n</svg>\n",
        encoding="utf-8")


if __name__ == "__main__":
    main()
