#!/usr/bin/python3
"""One frame of the animation: the mesh from above, new triangles coloured; symmetry and far field are left out.

usage: draw_frame.py mesh.hdf frame.png
Needs python3-vtk9 and, without a display, xvfb.
"""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts"))
import render_common as common  # noqa: E402
from render_common import numpy, vtk  # noqa: E402
from vtk.util import numpy_support  # noqa: E402

OUTER = ("symmetry", "farfield")
SIZE = (1280, 720)
KEPT, NEW = (0.78, 0.82, 0.88), (0.93, 0.55, 0.30)


def part(grid, chosen):
    """Surface of the chosen cells."""
    flags = numpy_support.numpy_to_vtk(chosen.astype(numpy.uint8), deep=1)
    flags.SetName("chosen")
    copy = vtk.vtkUnstructuredGrid()
    copy.ShallowCopy(grid)
    copy.GetCellData().AddArray(flags)
    threshold = vtk.vtkThreshold()
    threshold.SetInputData(copy)
    threshold.SetInputArrayToProcess(0, 0, 0, vtk.vtkDataObject.FIELD_ASSOCIATION_CELLS, "chosen")
    threshold.SetLowerThreshold(0.5)
    threshold.SetUpperThreshold(1.5)
    surface = vtk.vtkGeometryFilter()
    surface.SetInputConnection(threshold.GetOutputPort())
    surface.Update()
    return surface.GetOutput()


def main(mesh, frame):
    grid = common.read(mesh)
    names = grid.GetFieldData().GetAbstractArray("group_name")
    outer = [i + 1 for i in range(names.GetNumberOfValues()) if names.GetValue(i).lower().replace(" ", "") in OUTER]
    shown = ~numpy.isin(common.cell_array(grid, "group"), outer)
    is_new = common.cell_array(grid, "previous_id") < 0
    renderer = vtk.vtkRenderer()
    for chosen, colour in ((shown & ~is_new, KEPT), (shown & is_new, NEW)):
        if not chosen.any():
            continue
        actor = common.actor(part(grid, chosen), colour)
        actor.GetProperty().EdgeVisibilityOn()
        actor.GetProperty().SetEdgeColor(0.3, 0.3, 0.35)
        actor.GetProperty().SetLineWidth(0.6)
        renderer.AddActor(actor)
    window = common.window_of(renderer, SIZE)
    bounds = renderer.ComputeVisiblePropBounds()
    centre = [(bounds[2 * i] + bounds[2 * i + 1]) / 2 for i in range(3)]
    half = 0.5 * max(bounds[3] - bounds[2], (bounds[1] - bounds[0]) * SIZE[1] / SIZE[0])
    common.look(renderer, centre, (-0.1, 0.45, 0.9), 1.1 * half)
    common.write_png(window, frame)


if __name__ == "__main__":
    main(*sys.argv[1:3])
