#!/usr/bin/python3
"""What blanking does to the bundled example: the inside of the nacelle is made fine, and the triangles and edge lengths
on its outside are counted without and with blanking.

usage: scripts/blanking_figures.py BIN_DIR aircraft.step|geometry.hdf [--inner LENGTH] [--lmax LENGTH] [--keep DIR]
One pass blanks with the raster's own surface. In two passes the mesh made without blanking blanks the second one; the
geometry is sampled once. Needs python3-vtk9.
About ten seconds.
--keep DIR keeps raster.hdf and mesh.hdf of the first pass: scripts/render_sizes.sh BIN_DIR DIR IMAGE_DIR makes pictures
of them.
"""

import argparse
import os
import subprocess
import tempfile

import numpy
from render_mesh import Mesh

RULE = """[[size]]
groups = "nacelle_inner"
lmin = "{inner}"
lmax = "{inner}"
"""


def run(folder, tool, *arguments):
    subprocess.run([os.path.join(OPTIONS.bin, tool), *map(str, arguments), "-q"], cwd=folder, check=True)


def lengths_of(mesh, group):
    """Number of triangles of a group, and the edge length (of the equilateral triangle as large) that half of its area
    stays below."""
    corners = mesh.points[mesh.triangles[mesh.group == mesh.names.index(group)]].astype(float)
    area = 0.5 * numpy.linalg.norm(numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    order = numpy.argsort(area)
    middle = order[numpy.searchsorted(numpy.cumsum(area[order]), 0.5 * area.sum())]
    return len(corners), float(numpy.sqrt(area[middle] * 4 / numpy.sqrt(3)))


def mesh_of(folder, sizing, name):
    run(folder, "st-mesh", "geometry.hdf", sizing, "-o", "patches.hdf")
    run(folder, "st-merge", "patches.hdf", "-o", name)
    return Mesh(os.path.join(folder, name))


def main():
    folder = OPTIONS.keep or tempfile.mkdtemp()
    os.makedirs(folder, exist_ok=True)
    geometry = os.path.join(folder, "geometry.hdf")
    if OPTIONS.model.endswith(".hdf"):
        geometry = os.path.abspath(OPTIONS.model)
    else:
        run(folder, "st-import", os.path.abspath(OPTIONS.model), "-o", geometry)
    if not os.path.exists(os.path.join(folder, "geometry.hdf")):
        os.symlink(geometry, os.path.join(folder, "geometry.hdf"))
    with open(os.path.join(folder, "sizes.toml"), "w") as rules:
        rules.write(RULE.format(inner=OPTIONS.inner))
    run(folder, "st-raster", "geometry.hdf", "-o", "raster.hdf", "--lmax", OPTIONS.lmax, "--sizes", "sizes.toml")
    run(folder, "st-prolong", "raster.hdf", "-o", "open.hdf", "--no-blank")
    without = mesh_of(folder, "open.hdf", "mesh.hdf")
    run(folder, "st-prolong", "raster.hdf", "--blank", "mesh.hdf", "-o", "blanked.hdf")
    blanked = mesh_of(folder, "blanked.hdf", "mesh_blanked.hdf")
    run(folder, "st-prolong", "raster.hdf", "-o", "one.hdf")
    one = mesh_of(folder, "one.hdf", "mesh_one.hdf")
    print("| group | triangles without | in one pass | in two | edge without | in one pass | in two | factor |\n"
          "|---|---|---|---|---|---|---|---|")
    for group in ("nacelle_inner", "nacelle_outer"):
        (n, a), (k, c), (m, b) = (lengths_of(mesh, group) for mesh in (without, one, blanked))
        print(f"| {group} | {n} | {k} | {m} | {a:.4f} | {c:.4f} | {b:.4f} | {b / a:.2f} |")
    print(f"| all | {len(without.triangles)} | {len(one.triangles)} | {len(blanked.triangles)} | | | | |")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("bin", type=os.path.abspath, help="folder of the tools")
    parser.add_argument("model", help="the bundled aircraft, as STEP file or geometry artifact")
    parser.add_argument("--inner", default="0.02", help="length inside the nacelle (default: %(default)s)")
    parser.add_argument("--lmax", default="2.5%", help="largest length (default: %(default)s)")
    parser.add_argument("--keep", help="folder for what is made")
    OPTIONS = parser.parse_args()
    main()
