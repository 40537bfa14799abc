#!/usr/bin/python3
"""Picture of the pressure coefficient on the walls of an OpenFOAM case, from potentialFoam's velocity.

usage: draw_pressure.py CASE pressure.png [--at X,Y,Z,HALF_HEIGHT] [--from DX,DY,DZ]
Needs python3-vtk9, python3-numpy and, without a display, xvfb and xauth.
"""
import argparse
import os
import re
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts"))
import render_common as common  # noqa: E402
from render_common import numpy, vtk, vtk_to_numpy  # noqa: E402
from vtk.util import numpy_support  # noqa: E402

SIZE = (1280, 800)
LOWEST, HIGHEST = -1.0, 1.0  # of the colours; 1: the flow is at rest


def patch_types(case):
    """name -> type of the patches."""
    with open(os.path.join(case, "constant/polyMesh/boundary"), encoding="latin-1") as file:
        return dict(re.findall(r"^ {4}(\S+)\s*\{\s*type\s+(\w+);", file.read(), re.M))


def control_of(case):
    """An empty file in the case: VTK takes the name of one."""
    control = os.path.join(case, "case.foam")
    open(control, "a").close()
    return control


def patches(case, wanted, array="grad(Phi)"):
    """The wanted patches as one surface, with the values of their cells, `array` among them."""
    reader = vtk.vtkOpenFOAMReader()
    reader.SetFileName(control_of(case))
    reader.UpdateInformation()
    reader.DisableAllPatchArrays()
    for name in wanted:
        reader.SetPatchArrayStatus("patch/" + name, 1)
    reader.SetPatchArrayStatus("internalMesh", 0)
    reader.CreateCellToPointOff()
    reader.Update()
    together = vtk.vtkAppendPolyData()
    leaves = reader.GetOutput().NewIterator()
    while not leaves.IsDoneWithTraversal():
        together.AddInputData(leaves.GetCurrentDataObject())
        leaves.GoToNextItem()
    together.Update()
    if together.GetOutput().GetCellData().GetArray(array) is None:
        sys.exit(f"draw_pressure: error: no {array} on {', '.join(wanted)} in '{case}'; run flow.sh first")
    return together.GetOutput()


def coefficient(surface, speed):
    """The surface with the pressure coefficient at its points: Bernoulli's 1 - (speed here / speed far away)²."""
    velocity = vtk_to_numpy(surface.GetCellData().GetArray("grad(Phi)"))
    values = numpy_support.numpy_to_vtk(1 - (velocity**2).sum(axis=1) / speed**2, deep=1)
    values.SetName("pressure coefficient")
    surface.GetCellData().SetScalars(values)
    clean = vtk.vtkCleanPolyData()  # patches share the points of their common edges
    clean.SetInputData(surface)
    smooth = vtk.vtkCellDataToPointData()
    smooth.SetInputConnection(clean.GetOutputPort())
    normals = vtk.vtkPolyDataNormals()
    normals.SetInputConnection(smooth.GetOutputPort())
    normals.SetFeatureAngle(40)
    normals.Update()
    return normals.GetOutput()


def colours():
    table = vtk.vtkColorTransferFunction()
    table.SetColorSpaceToDiverging()
    table.AddRGBPoint(LOWEST, 0.13, 0.30, 0.62)
    table.AddRGBPoint(0.0, 0.93, 0.93, 0.93)
    table.AddRGBPoint(HIGHEST, 0.70, 0.05, 0.15)
    return table


def actor(surface, table):
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputData(surface)
    mapper.SetLookupTable(table)
    mapper.SetScalarModeToUsePointData()
    mapper.InterpolateScalarsBeforeMappingOn()
    result = vtk.vtkActor()
    result.SetMapper(mapper)
    result.GetProperty().SetAmbient(0.5)
    result.GetProperty().SetDiffuse(0.5)
    return result


def legend(table):
    bar = vtk.vtkScalarBarActor()
    bar.SetLookupTable(table)
    bar.SetTitle("pressure coefficient\n")
    bar.SetNumberOfLabels(5)
    bar.SetLabelFormat("%.1f")
    bar.SetOrientationToHorizontal()
    bar.SetPosition(0.03, 0.03)
    bar.SetWidth(0.35)
    bar.SetHeight(0.1)
    bar.UnconstrainedFontSizeOn()
    for text in (bar.GetTitleTextProperty(), bar.GetLabelTextProperty()):
        text.SetColor(0.1, 0.1, 0.1)
        text.SetFontSize(common.SAMPLES * 18)
        text.ItalicOff()
        text.BoldOff()
        text.ShadowOff()
    return bar


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("case")
    parser.add_argument("picture")
    parser.add_argument("--at", help="middle of the picture and half of its height, in the model unit")
    parser.add_argument("--from", dest="direction", default="-0.55,0.75,0.45", help="direction to the viewer")
    options = parser.parse_args()
    types = patch_types(options.case)
    walls = [name for name, kind in types.items() if kind == "wall"]
    outer = [name for name, kind in types.items() if kind == "patch"]
    if not walls or not outer:
        sys.exit(f"draw_pressure: error: '{options.case}' needs patches of type wall and patch; it has {types}")
    far = vtk_to_numpy(patches(options.case, outer).GetCellData().GetArray("grad(Phi)"))
    surface = coefficient(patches(options.case, walls), float(numpy.linalg.norm(far.mean(axis=0))))
    table = colours()
    renderer = vtk.vtkRenderer()
    renderer.AddActor(actor(surface, table))
    renderer.AddActor2D(legend(table))
    window = common.window_of(renderer, SIZE)
    direction = [float(v) for v in options.direction.split(",")]
    if options.at:
        *focus, half = (float(v) for v in options.at.split(","))
    else:
        focus, half = common.fit(vtk_to_numpy(surface.GetPoints().GetData()), direction, SIZE)
    common.look(renderer, focus, direction, half)
    common.write_png(window, options.picture)
    values = vtk_to_numpy(surface.GetPointData().GetScalars())
    print(f"pressure coefficient {values.min():.3f} to {values.max():.3f}")


if __name__ == "__main__":
    main()
