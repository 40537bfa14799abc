#!/usr/bin/env python3
"""Models whose smooth faces are cut: lofts, booleans, fillets, imprinted windows, pipes with seams, threads.

usage: composite_models.py FOLDER

Writes 40 BREP files, by gmsh's OpenCASCADE kernel. They are the same each time.
"""
import math
import random
import sys
from pathlib import Path

import gmsh


def loft(stations, radius, n):
    """A body through closed curves of n points at each station."""
    occ, loops = gmsh.model.occ, []
    for x, r, squash in stations:
        points = [occ.addPoint(x, r * radius(2 * math.pi * k / n) * math.cos(2 * math.pi * k / n),
                               squash * r * math.sin(2 * math.pi * k / n)) for k in range(n)]
        loops.append(occ.addCurveLoop([occ.addBSpline(points + points[:1])]))
    return [tag for tag in occ.addThruSections(loops, makeSolid=True) if tag[0] == 3]


def keep_skin(out, own):
    """Of fragments the outer faces of these, alone."""
    occ = gmsh.model.occ
    occ.synchronize()
    occ.remove([v for v in set(out) - set(own) if v[0] == 3], recursive=True)
    occ.synchronize()
    skin = gmsh.model.getBoundary(own, combined=True, oriented=False)
    occ.remove(own)
    occ.synchronize()
    occ.remove([f for f in occ.getEntities(2) if f not in skin])


def pole(t):
    return 1 + 0.15 * math.cos(2 * t)


def make(kind, k):
    occ, rng = gmsh.model.occ, random.Random(1000 * hash_of(kind) + k)
    if kind == "loft":  # ruled and smooth skins through stations
        loft([(x, 0.6 + 0.4 * math.sin(x + k), 0.5 + 0.1 * k) for x in range(4 + k)], pole, 12)
    elif kind == "pipe":  # seams of tubes that meet at angles
        a = occ.addCylinder(0, 0, 0, 4, 0, 0, 0.5)
        b = occ.addCylinder(2, 0, 0, math.cos(0.3 + 0.2 * k), math.sin(0.3 + 0.2 * k), 2, 0.2 + 0.05 * k)
        occ.fuse([(3, a)], [(3, b)])
    elif kind == "fillet":
        a, b = occ.addBox(0, 0, 0, 2, 1, 1), occ.addCylinder(1, 0.5, 0.5, 0, 0, 1.2, 0.15 + 0.04 * k)
        body, _ = occ.fuse([(3, a)], [(3, b)])
        occ.synchronize()
        edges = [t for d, t in gmsh.model.getBoundary(gmsh.model.getBoundary(body), combined=False, oriented=False)]
        occ.fillet([body[0][1]], sorted(set(edges)), [0.02 + 0.01 * k])
    elif kind == "window":  # imprinted on a fuselage
        body = loft([(0, 0.6, 1), (1, 1, 1), (6, 1, 1), (8, 0.4, 0.7)], lambda t: 1, 16)
        tools = [(3, occ.addBox(1.5 + 0.4 * i, -0.1, 0, 0.2 + 0.003 * k, 0.25 + 0.02 * k, 3)) for i in range(4 + k)]
        occ.synchronize()
        out, parts = occ.fragment(body, tools)
        keep_skin(out, parts[0])
    elif kind == "thread":  # a tube along a helix
        turns, n = 1 + 0.5 * k, 16
        points = [occ.addPoint(math.cos(2 * math.pi * i / n), math.sin(2 * math.pi * i / n), 0.5 * i / n)
                  for i in range(int(turns * n) + 1)]
        wire = occ.addWire([occ.addSpline(points)])
        disc = occ.addDisk(1, 0, 0, 0.12, 0.12)
        occ.rotate([(2, disc)], 1, 0, 0, 1, 0, 0, math.pi / 2)
        occ.addPipe([(2, disc)], wire)
        occ.remove([(2, disc)])
    elif kind == "ball":  # spheres with a bore: poles, seams
        a = occ.addSphere(0, 0, 0, 1)
        b = occ.addCylinder(0.2, 0.1 * k, -2, 0.3, 0.1 * k, 4, 0.35 + 0.05 * k)
        occ.cut([(3, a)], [(3, b)])
    elif kind == "slab":  # a smooth skin in many patches, cut at random
        body = loft([(0, 0.8, 0.4), (2, 1, 0.5), (4, 1, 0.5), (6, 0.7, 0.3)], pole, 12)
        occ.synchronize()
        cuts = [(3, occ.addBox(rng.uniform(0, 5), rng.uniform(-1, 1), -2,
                               rng.uniform(0.02, 1), rng.uniform(0.05, 1), 4)) for _ in range(3 + 3 * k)]
        for c in cuts:
            occ.rotate([c], 3, 0, 0, 0, 0, 1, rng.uniform(0, 3))
        out, parts = occ.fragment(body, cuts)
        keep_skin(out, parts[0])
    elif kind == "cone":  # cones and cylinders in line: circles where curvature jumps
        a = occ.addCone(0, 0, 0, 2, 0, 0, 1, 0.98 - 0.02 * k)
        b = occ.addCylinder(2, 0, 0, 2, 0, 0, 0.98 - 0.02 * k)
        c = occ.addSphere(4, 0, 0, 0.98 - 0.02 * k)
        body, _ = occ.fuse([(3, a)], [(3, b), (3, c)])
        occ.fragment(body, [(2, occ.addRectangle(0.3, 0.1 + 0.1 * k, -3, 3, 0.02))])
    occ.synchronize()
    occ.remove([e for e in occ.getEntities(2) if not gmsh.model.getAdjacencies(2, e[1])[0].size and occ.getEntities(3)])
    occ.synchronize()


def hash_of(text):
    return sum(map(ord, text))


def main():
    if len(sys.argv) != 2 or sys.argv[1].startswith("-"):
        print(__doc__)
        return 0 if len(sys.argv) == 2 and sys.argv[1] in ("-h", "--help") else 2
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    for kind in ("loft", "pipe", "fillet", "window", "thread", "ball", "slab", "cone"):
        for k in range(5):
            gmsh.initialize()
            gmsh.option.setNumber("General.Verbosity", 0)
            try:
                make(kind, k)
                gmsh.write(str(folder / f"{kind}_{k}.brep"))
            except Exception as error:  # the kernel refuses some; the others are what is measured
                print(f"{kind}_{k}: {error}", file=sys.stderr)
            gmsh.finalize()
    return 0


if __name__ == "__main__":
    sys.exit(main())
