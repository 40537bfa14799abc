#!/usr/bin/python3
"""The example's way from TetGen to OpenFOAM's patches: one per group, named by one word, and no fluid inside bodies.

Needs numpy and tetgen; OpenFOAM itself is tried by run_page.py --long.
environment: ST_BIN, the tools; ST_MODELS, the test models
"""
import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

EXAMPLE = Path(__file__).resolve().parents[2] / "examples" / "openfoam"
GROUPS = '[[group]]\nname = "left box"\nfaces = "1-6"\n\n[[group]]\nname = "right"\nfaces = "7-12"\n'


def run(*command, **options):
    return subprocess.run([str(c) for c in command], check=True, capture_output=True, text=True, **options).stdout


def make_mesh(folder):
    """Two boxes in a far field as mesh.smesh; the number of its triangles and the volume of the fluid."""
    tools = Path(os.environ["ST_BIN"])
    (folder / "groups.toml").write_text(GROUPS)
    (folder / "box").symlink_to(Path(os.environ["ST_MODELS"]) / "two_boxes.step")
    for command in ("st-import box --groups groups.toml --farfield box:3", "st-raster geometry.hdf --lmax 20%",
                    "st-prolong raster.hdf --slope 0.5", "st-mesh geometry.hdf sizing.hdf", "st-merge patches.hdf",
                    "st-export mesh.hdf -o mesh.smesh"):
        name, *arguments = command.split()
        run(tools / name, *arguments, "-q", cwd=folder)
    check = run(tools / "st-check", "mesh.hdf", "--json", cwd=folder).splitlines()[-1]
    return json.loads(check)["triangles"], json.loads(check)["volume"]


def read(path):
    """Names of groups, triangles by group, volume of the tetrahedra."""
    part = {}
    for line in path.read_text().splitlines():
        if line.startswith("$"):
            section = part.setdefault(line, [])
        else:
            section.append(line.split())
    names = {int(row[1]): row[2] for row in part["$PhysicalNames"][1:] if row[0] == "2"}
    xyz = {row[0]: numpy.array(row[1:4], float) for row in part["$Nodes"][1:]}
    counts, volume = dict.fromkeys(names.values(), 0), 0.0
    assert int(part["$Elements"][0][0]) == len(part["$Elements"]) - 1, "the number of elements is wrong"
    for row in part["$Elements"][1:]:
        if row[1] == "2":
            counts[names[int(row[3])]] += 1
        else:
            a, b, c, d = (xyz[n] for n in row[5:9])
            volume += abs(numpy.linalg.det([b - a, c - a, d - a])) / 6
    return counts, volume


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        n_triangles, volume = make_mesh(folder)
        run("tetgen", "-pAq1.4/15Y", "mesh.smesh", cwd=folder)
        run(sys.executable, EXAMPLE / "tetgen_to_msh.py", "mesh.smesh", "filled.msh", cwd=folder)
        # what Gmsh adds: a part that has the triangles of a group again
        text = (folder / "filled.msh").read_text().replace("$PhysicalNames\n4\n", '$PhysicalNames\n5\n2 9 "part:a b"\n')
        lines = text.splitlines()
        at = lines.index("$Elements")
        again = [line.replace(" 2 2 1 1 ", " 2 2 9 1 ", 1) for line in lines[at + 2:] if " 2 2 1 1 " in line]
        lines[at + 1] = str(int(lines[at + 1]) + len(again))
        lines[at + 2:at + 2] = again
        assert again and '2 9 "part:a b"' in lines
        (folder / "filled.msh").write_text("\n".join(lines) + "\n")
        patches = run("awk", "-f", EXAMPLE / "patches.awk", "filled.msh", "filled.msh", cwd=folder)
        (folder / "patches.msh").write_text(patches)
        counts, filled = read(folder / "patches.msh")
    print(counts, f"{n_triangles} triangles, volume {volume:.6g}, filled {filled:.6g}")
    assert set(counts) == {'"left_box"', '"right"', '"farfield"'}, "groups are patches of one word"
    assert min(counts.values()) > 0 and sum(counts.values()) == n_triangles, "each triangle is in one patch"
    assert abs(filled - volume) < 1e-6 * volume, "the fluid alone is filled"


if __name__ == "__main__":
    try:
        import numpy
    except ImportError:
        numpy = None
    if numpy is None or not shutil.which("tetgen"):
        print("SKIPPED: no numpy or no tetgen, the way to OpenFOAM was not tried")
        sys.exit(77)
    main()
