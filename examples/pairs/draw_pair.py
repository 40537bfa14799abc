#!/usr/bin/env python3
"""Draws the two faces of the first pair of a mesh, seen along z: side a, and side b above it.

usage: draw_pair.py mesh.msh2 pair.svg
"""
import re
import sys
from pathlib import Path

WIDTH, MARGIN = 900, 12  # pixels
COLOURS = ("#e4e4e4", "#cfe0f1")


def section(text, name):
    return re.search(rf"\${name}\n\d+\n(.*?)\n\$End{name}", text, re.S)[1].split("\n")


def main():
    text = Path(sys.argv[1]).read_text(encoding="utf-8")
    nodes = {int(n): (float(x), float(y)) for n, x, y, _ in (line.split() for line in section(text, "Nodes"))}
    b, a = next(map(int, line.split()[1:]) for line in section(text, "Periodic") if re.match(r"2 \d+ \d+$", line))
    rows = [list(map(int, line.split())) for line in section(text, "Elements")]
    sides = [[[nodes[n] for n in row[5:8]] for row in rows if row[1] == 2 and row[4] == face] for face in (a, b)]
    gap = 1.1 * (max(y for t in sides[0] for _, y in t) - min(y for t in sides[0] for _, y in t))
    shapes = [(COLOURS[k], [(x, y + k * gap) for x, y in t]) for k in (0, 1) for t in sides[k]]
    xs, ys = ([p[k] for _, corners in shapes for p in corners] for k in (0, 1))
    scale = (WIDTH - 2 * MARGIN) / (max(xs) - min(xs))
    height = scale * (max(ys) - min(ys)) + 2 * MARGIN
    drawn = []
    for colour, corners in shapes:
        path = " ".join(f"{MARGIN + scale * (x - min(xs)):.1f},{height - MARGIN - scale * (y - min(ys)):.1f}"
                        for x, y in corners)
        drawn.append(f'<polygon points="{path}" fill="{colour}"/>')
    Path(sys.argv[2]).write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{height:.0f}">\n'
        '<g stroke="#333" stroke-width="0.6" stroke-linejoin="round">\n' + "\n".join(drawn) + "\n</g>\n</svg>\n",
        encoding="utf-8")


if __name__ == "__main__":
    main()
