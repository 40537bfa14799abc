#!/usr/bin/python3
"""How many lengths are across the slots of a mesh: a table in docs/dev/wings.md.

usage: scripts/slot_table.py REACH MESH.hdf...       needs python3-vtk9

From the middle of each triangle a ray goes along its normal, out of the material. What it meets within REACH (model
unit), with normals opposed by more than 135 degrees, is across. The lengths across are that distance over the mean of
the triangle's edges.
"""
import sys

import numpy
import vtk
from render_common import read
from vtk.util.numpy_support import vtk_to_numpy

FACING = -0.71  # cosine between normals, as st-raster has it


def lengths_across(path, reach):
    grid = read(path)
    points = vtk_to_numpy(grid.GetPoints().GetData())
    corners = points[vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 3)]
    normal = numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normal /= numpy.linalg.norm(normal, axis=1)[:, None]
    middle = corners.mean(axis=1)
    length = numpy.linalg.norm(corners - numpy.roll(corners, 1, axis=1), axis=2).mean(axis=1)
    locator = vtk.vtkStaticCellLocator()
    locator.SetDataSet(grid)
    locator.BuildLocator()
    share, place, local, sub, cell = vtk.mutable(0.0), [0.0] * 3, [0.0] * 3, vtk.mutable(0), vtk.mutable(0)
    found = []
    for x, n, own in zip(middle, normal, length):
        if not locator.IntersectWithLine(x + 1e-3 * own * n, x + reach * n, 1e-12, share, place, local, sub, cell):
            continue
        if numpy.dot(n, normal[cell.get()]) < FACING:
            found.append(numpy.linalg.norm(numpy.array(place) - x) / own)
    return numpy.array(found)


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    print("| mesh | triangles at slots | least | 1 % | 5 % | below 7.2, % |\n|---|--:|--:|--:|--:|--:|")
    for path in sys.argv[2:]:
        across = lengths_across(path, float(sys.argv[1]))
        low, few = numpy.percentile(across, [1, 5])
        print(f"| {path} | {len(across):,} | {across.min():.1f} | {low:.1f} | {few:.1f} "
              f"| {100 * (across < 7.2).mean():.1f} |")


if __name__ == "__main__":
    main()
