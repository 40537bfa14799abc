#!/usr/bin/python3
"""TetGen's result for mesh.smesh (mesh.1.node, .ele, .face) as Gmsh's format 2.2, with the names of the groups.

usage: tetgen_to_msh.py mesh.smesh filled.msh
Names come from the comments that st-export writes: "# marker 2: WING"; other markers are called group_<number>.
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


def main(surface, filled):
    base = Path(surface).with_suffix(".1")
    names = dict(re.findall(r"^# marker (\d+): (.+)$", Path(surface).read_text(encoding="utf-8"), re.M))
    nodes = table(f"{base}.node", 4)
    faces = table(f"{base}.face", 5).astype(int)
    tetrahedra = table(f"{base}.ele", 5).astype(int)
    groups = sorted(set(faces[:, 4]))
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
        numpy.savetxt(out, elements(4, len(faces) + 1, inside, tetrahedra[:, 1:5]), fmt="%d")
        out.write("$EndElements\n")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
