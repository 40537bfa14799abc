#!/usr/bin/python3
"""How far the pressure of two meshes is from a finer solution's: the evenly scaled mesh above, the adapted one below.

usage: draw_error.py FOLDER picture.png [--at X,Y,Z,HALF_HEIGHT] [--from DX,DY,DZ]
FOLDER is that of adapt.py --compare. Needs python3-vtk9, python3-numpy and, without a display, xvfb and xauth.
"""
import argparse
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts"))
import render_common as common  # noqa: E402
from render_common import numpy, vtk, vtk_to_numpy  # noqa: E402
from vtk.util import numpy_support  # noqa: E402

SIZE = (900, 1100)
HIGHEST = 0.05  # of the colours


def with_error(folder, name, reference):
    """The walls of FOLDER/NAME.vtu with |Cp - Cp of the reference| at their nodes, each taken to the nearest place."""
    grid = common.read(str(folder / f"{name}.vtu"))
    points = vtk_to_numpy(grid.GetPoints().GetData())
    locator = vtk.vtkStaticCellLocator()
    locator.SetDataSet(reference)
    locator.BuildLocator()
    values = vtk_to_numpy(reference.GetPointData().GetArray("cp"))
    near, weights, corners = [0.0] * 3, [0.0] * 3, vtk.vtkIdList()
    cell, part, distance2 = vtk.reference(0), vtk.reference(0), vtk.reference(0.0)
    expected = numpy.empty(len(points))
    for i, point in enumerate(points):
        locator.FindClosestPoint(point, near, cell, part, distance2)
        reference.GetCell(cell.get()).EvaluatePosition(near, [0.0] * 3, part, [0.0] * 3, distance2, weights)
        reference.GetCellPoints(cell.get(), corners)
        expected[i] = sum(w * values[corners.GetId(k)] for k, w in enumerate(weights))
    error = numpy.abs(vtk_to_numpy(grid.GetPointData().GetArray("cp")) - expected)
    array = numpy_support.numpy_to_vtk(error, deep=1)
    array.SetName("error")
    grid.GetPointData().SetScalars(array)
    return grid


def actor(grid):
    table = vtk.vtkColorTransferFunction()
    for value, colour in ((0, (1, 1, 1)), (0.3 * HIGHEST, (0.98, 0.80, 0.45)), (HIGHEST, (0.70, 0.05, 0.15))):
        table.AddRGBPoint(value, *colour)
    mapper = vtk.vtkDataSetMapper()
    mapper.SetInputData(grid)
    mapper.SetLookupTable(table)
    result = vtk.vtkActor()
    result.SetMapper(mapper)
    result.GetProperty().SetLighting(False)
    result.GetProperty().EdgeVisibilityOn()
    result.GetProperty().SetEdgeColor(0.45, 0.5, 0.55)
    return result


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("picture")
    parser.add_argument("--at", help="middle of each half of the picture and half of its height, in the model unit")
    parser.add_argument("--from", dest="direction", default="0,0,1", help="direction to the viewer")
    options = parser.parse_args()
    reference = common.read(str(options.folder / "reference.vtu"))
    direction = [float(v) for v in options.direction.split(",")]
    half_size = (SIZE[0], SIZE[1] // 2)
    window = None
    for place, name in ((0.5, "even"), (0, "adapted")):
        grid = with_error(options.folder, name, reference)
        renderer = vtk.vtkRenderer()
        renderer.SetViewport(0, place, 1, place + 0.5)
        renderer.AddActor(actor(grid))
        if window is None:
            window = common.window_of(renderer, SIZE)
        else:
            renderer.SetBackground(1, 1, 1)
            window.AddRenderer(renderer)
        if options.at:
            *focus, half = (float(v) for v in options.at.split(","))
        else:
            focus, half = common.fit(vtk_to_numpy(grid.GetPoints().GetData()), direction, half_size)
        common.look(renderer, focus, direction, half)
    common.write_png(window, options.picture, n_colours=32)


if __name__ == "__main__":
    main()
