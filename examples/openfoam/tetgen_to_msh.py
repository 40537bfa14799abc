#!/usr/bin/python3
"""TetGen's result for mesh.smesh (mesh.1.node, .ele, .face) as Gmsh's format 2.2, with the names of the groups.

usage: tetgen_to_msh.py mesh.smesh filled.msh
TetGen also fills bodies that touch neither far field nor symmetry plane. With its option A each volume has a number;
only that at the far field stays. Names come from the comments that st-export writes: "# marker 2: WING"; other
markers are called group_<number>.
"""
import re
import sys
from pathlib import Path

import numpy


def table(path, n_columns):
    """The first columns of a file of TetGen, counted from its second line."""
    return numpy.loadtxt(path, skiprows=1, usecols=range(n_columns))


def elements(kind, first, group, nodes):
    """Lines: number, type, two tags, corners."""
    numbers = numpy.arange(first, first + len(nodes))[:, None]
    tags = numpy.broadcast_to(numpy.array([kind, 2]), (len(nodes), 2))
    return numpy.hstack([numbers, tags, group[:, None], group[:, None], nodes])


def fluid_only(tetrahedra, regions, outer):
    """The tetrahedra of the region that has the triangle `outer`."""
    at_outer = numpy.isin(tetrahedra, outer).sum(axis=1) == 3
    return tetrahedra[regions == regions[numpy.argmax(at_outer)]]


def main(surface, filled):
    base = Path(surface).with_suffix(".1")
    names = dict(re.findall(r"^# marker (\d+): (.+)$", Path(surface).read_text(encoding="utf-8"), re.M))
    nodes = table(f"{base}.node", 4)
    faces = table(f"{base}.face", 5).astype(int)
    elements_read = table(f"{base}.ele", 6).astype(int)
    tetrahedra = elements_read[:, 1:5]
    groups = sorted(set(faces[:, 4]))
    far = [g for g in groups if "far" in names.get(str(g), "").lower()]
    if far:
        tetrahedra = fluid_only(tetrahedra, elements_read[:, 5], faces[faces[:, 4] == far[0]][0, 1:4])
        nodes = nodes[numpy.isin(nodes[:, 0].astype(int), tetrahedra)]
    fluid = max(groups) + 1
    with open(filled, "w", encoding="utf-8") as out:
        out.write(f"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n{len(groups) + 1}\n")
        for group in groups:
            out.write(f'2 {group} "{names.get(str(group), f"group_{group}")}"\n')
        out.write(f'3 {fluid} "fluid"\n$EndPhysicalNames\n$Nodes\n{len(nodes)}\n')
        numpy.savetxt(out, nodes, fmt=["%d", "%.17g", "%.17g", "%.17g"])
        out.write(f"$EndNodes\n$Elements\n{len(faces) + len(tetrahedra)}\n")
        numpy.savetxt(out, elements(2, 1, faces[:, 4], faces[:, 1:4]), fmt="%d")
        inside = numpy.full(len(tetrahedra), fluid)
        numpy.savetxt(out, elements(4, len(faces) + 1, inside, tetrahedra), fmt="%d")
        out.write("$EndElements\n")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
