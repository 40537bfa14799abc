#!/usr/bin/python3
"""How many lengths are across the slots of a mesh: a table in docs/dev/wings.md.

usage: scripts/slot_table.py REACH MESH.hdf... [--every N]      needs python3-vtk9

From the middle of each N-th triangle a ray goes along its normal, out of the material. What it meets within REACH
(model unit), with normals opposed by more than 135 degrees, is across. The lengths across are that distance over the
mean of the triangle's edges; those `around` over the mean of the edges of all triangles that touch it, in shares of its
corners, as single triangles scatter.
"""
import argparse

import numpy
import vtk
from render_common import read
from vtk.util.numpy_support import vtk_to_numpy

FACING = -0.71  # cosine between normals, as st-raster has it


def lengths_across(path, reach, every):
    """Of each place: over the lengths of the triangle, and over those around it."""
    grid = read(path)
    points = vtk_to_numpy(grid.GetPoints().GetData())
    triangles = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 3)
    corners = points[triangles]
    normal = numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normal /= numpy.linalg.norm(normal, axis=1)[:, None]
    middle = corners.mean(axis=1)
    length = numpy.linalg.norm(corners - numpy.roll(corners, 1, axis=1), axis=2).mean(axis=1)
    at_node = numpy.bincount(triangles.ravel(), numpy.repeat(length, 3), len(points))
    at_node /= numpy.maximum(numpy.bincount(triangles.ravel(), minlength=len(points)), 1)
    around = at_node[triangles].mean(axis=1)
    locator = vtk.vtkStaticCellLocator()
    locator.SetDataSet(grid)
    locator.BuildLocator()
    share, place, local, sub, cell = vtk.mutable(0.0), [0.0] * 3, [0.0] * 3, vtk.mutable(0), vtk.mutable(0)
    found = []
    for i in range(0, len(middle), every):
        x, n, own = middle[i], normal[i], length[i]
        if not locator.IntersectWithLine(x + 1e-3 * own * n, x + reach * n, 1e-12, share, place, local, sub, cell):
            continue
        if numpy.dot(n, normal[cell.get()]) < FACING:
            width = numpy.linalg.norm(numpy.array(place) - x)
            found.append((width / own, width / around[i]))
    return numpy.array(found).T


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("reach", type=float)
    parser.add_argument("meshes", nargs="+")
    parser.add_argument("--every", type=int, default=1)
    arguments = parser.parse_args()
    print("| mesh | triangles at slots | least | 1 % | 5 % | below 7.2, % | around below 7.2, % |\n"
          "|---|--:|--:|--:|--:|--:|--:|")
    for path in arguments.meshes:
        across, around = lengths_across(path, arguments.reach, arguments.every)
        low, few = numpy.percentile(across, [1, 5])
        print(f"| {path} | {len(across):,} | {across.min():.1f} | {low:.1f} | {few:.1f} "
              f"| {100 * (across < 7.2).mean():.1f} | {100 * (around < 7.2).mean():.1f} |", flush=True)


if __name__ == "__main__":
    main()
