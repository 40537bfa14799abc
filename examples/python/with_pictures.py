#!/usr/bin/env python3
"""A first look at a model from Python, in cells (# %%) as of a notebook: mesh, figures, two pictures.

usage: with_pictures.py MODEL [FOLDER] [PRESET]     needs st in PYTHONPATH or from the wheel, and python3-vtk9
Without a display: xvfb-run -a python3 with_pictures.py wing.step
"""
import sys
from pathlib import Path

import numpy
import st
import vtk
from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray

model = sys.argv[1] if len(sys.argv) > 1 else sys.exit(__doc__)
folder = Path(sys.argv[2] if len(sys.argv) > 2 else ".")
preset = sys.argv[3] if len(sys.argv) > 3 else "preview"

# %% The mesh: numpy arrays of points (n, 3) and triangles (m, 3), counted from 0. Lines come while the tools work.
mesh = st.mesh(model, preset=preset, progress=print)
check = mesh.said["st-check"]
print(f"{len(mesh.triangles)} triangles, {'passes' if check['passes'] else 'fails: ' + ', '.join(check['failed'])}")

# %% Figures by group.
quality = mesh.quality()
for name in mesh.group_name:
    own = mesh.of_group(name)
    print(f"{name:20} {len(own):8} triangles, quality {quality[own].min():.2f} at least, area {mesh.area_of(name):.4g}")

# %% To VTK without copies of points. meshio takes the same arrays: Mesh(mesh.points, [("triangle", mesh.triangles)])
cells = numpy.insert(mesh.triangles.astype(numpy.int64), 0, 3, axis=1)
polygons, points, surface = vtk.vtkCellArray(), vtk.vtkPoints(), vtk.vtkPolyData()
polygons.SetCells(len(cells), numpy_to_vtkIdTypeArray(cells.ravel()))
points.SetData(numpy_to_vtk(mesh.points))
surface.SetPoints(points)
surface.SetPolys(polygons)


# %% Pictures: values of triangles, or of nodes, as colour.
def draw(values, title, path):
    data, shown = numpy_to_vtk(values.astype(float)), vtk.vtkPolyData()
    shown.ShallowCopy(surface)
    (shown.GetCellData() if len(values) == len(mesh.triangles) else shown.GetPointData()).SetScalars(data)
    mapper, actor, bar, renderer = (vtk.vtkPolyDataMapper(), vtk.vtkActor(), vtk.vtkScalarBarActor(),
                                    vtk.vtkRenderer())
    mapper.SetInputData(shown)
    mapper.SetScalarRange(values.min(), values.max())
    actor.SetMapper(mapper)
    actor.GetProperty().EdgeVisibilityOn()
    bar.SetLookupTable(mapper.GetLookupTable())
    bar.SetTitle(title)
    bar.UnconstrainedFontSizeOn()
    bar.SetVerticalTitleSeparation(12)
    for text in (bar.GetTitleTextProperty(), bar.GetLabelTextProperty()):
        text.SetColor(0, 0, 0)
        text.SetFontSize(18)
    for part in (actor, bar):
        renderer.AddActor(part)
    renderer.SetBackground(1, 1, 1)
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetSize(1000, 700)
    window.AddRenderer(renderer)
    renderer.ResetCamera()
    renderer.GetActiveCamera().Azimuth(35)
    renderer.GetActiveCamera().Elevation(25)
    renderer.ResetCamera()
    window.Render()
    picture, writer = vtk.vtkWindowToImageFilter(), vtk.vtkPNGWriter()
    picture.SetInput(window)
    writer.SetInputConnection(picture.GetOutputPort())
    writer.SetFileName(str(path))
    writer.Write()
    print(path)


draw(quality, "quality", folder / "quality.png")
draw(mesh.size, f"size, {mesh.unit or 'model unit'}", folder / "size.png")
