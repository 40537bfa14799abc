#!/usr/bin/python3
"""Pictures of a size field: slices through the octree, coloured by requested edge length on a logarithmic scale, by the
cause of the length (each edge, face and source its own colour; white: the largest length), or by what a mesh blanks
(white flow, orange cut, grey blanked).

usage: st-export sizing.hdf -o sizing.vtu && render_sizing.py sizing.vtu [--mesh mesh.hdf] [--by size|cause|colour]
[--suffix TEXT] [--view NAME [--as NAME]] [--check] [-o docs/images]
       [--slice NAME X Y Z HALF]
--field: colours by the length at each point, as the mesher asks for it, with lines at every 1.25 times of it.
--slice: a horizontal slice through a point, HALF high to either side. Else with --mesh the slices lie through the parts
of the bundled example and show the body; without, in the middle of the finest cells.
Needs python3-vtk9 and, without a display, xvfb.
"""

import argparse
import os
import sys

import render_common as common
from render_common import numpy, vtk, vtk_to_numpy
from vtk.util import numpy_support

SIZE = (1280, 800)
EQUAL_LENGTH_STEP = 1.25
LENGTH_NAMES = ("length", "size", "prolonged_length")


def length_name(grid):
    """The cell array that holds the requested edge length."""
    for name in LENGTH_NAMES:
        if grid.GetCellData().GetArray(name) is not None:
            return name
    common.cell_array(grid, LENGTH_NAMES[0])  # ends with the list of what there is


def colours(low, high):
    """Logarithmic scale from fine (dark red) over green to coarse (light blue)."""
    table = vtk.vtkLookupTable()
    table.SetScaleToLog10()
    table.SetTableRange(low, high)
    table.SetHueRange(0.0, 0.62)
    table.SetSaturationRange(0.75, 0.45)
    table.SetValueRange(0.85, 0.97)
    table.SetNumberOfTableValues(24)
    table.Build()
    return table


def cut(data, origin, normal):
    """Cells of a data set that a plane meets, as poly data."""
    plane = vtk.vtkPlane()
    plane.SetOrigin(*origin)
    plane.SetNormal(*normal)
    cutter = vtk.vtkCutter()
    cutter.SetInputData(data)
    cutter.SetCutFunction(plane)
    cutter.GenerateTrianglesOff()
    cutter.Update()
    return cutter.GetOutput()


def categories(grid, by):
    """Adds the cell array "category" and returns the table of its colours."""
    if by == "colour":
        value, palette = common.cell_array(grid, "colour"), [(1, 1, 1), (0.95, 0.70, 0.35), (0.72, 0.72, 0.72)]
    else:
        kind, ident = common.cell_array(grid, "cause_kind").astype(int), common.cell_array(grid, "cause_id").astype(int)
        n = len(common.PALETTE)
        value, palette = numpy.where(kind < 0, 0, 1 + (5 * ident + 3 * kind) % n), [(1, 1, 1)] + list(common.PALETTE)
    array = vtk.vtkIntArray()
    array.SetName("category")
    array.SetNumberOfTuples(len(value))
    vtk_to_numpy(array)[:] = value
    grid.GetCellData().AddArray(array)
    table = vtk.vtkLookupTable()
    table.SetNumberOfTableValues(len(palette))
    table.SetTableRange(0, len(palette) - 1)
    for i, rgb in enumerate(palette):
        table.SetTableValue(i, *rgb, 1)
    return table


def points_on(origin, normal, half_height, step):
    """Structured grid of points that fills the picture, `step` pixels apart."""
    right, up, _ = common.axes(normal)
    n_right, n_up = SIZE[0] // step + 1, SIZE[1] // step + 1
    u = numpy.linspace(-1, 1, n_right) * half_height * SIZE[0] / SIZE[1]
    v = numpy.linspace(-1, 1, n_up) * half_height
    points = numpy.array(origin) + u[None, :, None] * right + v[:, None, None] * up
    grid = vtk.vtkStructuredGrid()
    grid.SetDimensions(n_right, n_up, 1)
    places = vtk.vtkPoints()
    places.SetData(numpy_support.numpy_to_vtk(points.reshape(-1, 3), deep=True))
    grid.SetPoints(places)
    return grid


def field_scene(field, piece, origin, normal, half_height, renderer):
    """The length at each point, lines of equal length, and the edges of the cells; returns the table of colours."""
    plane = points_on(origin, normal, half_height, 2)
    length = field.size(vtk_to_numpy(plane.GetPoints().GetData()))
    scalars = numpy_support.numpy_to_vtk(length, deep=True)
    scalars.SetName("length")
    plane.GetPointData().SetScalars(scalars)
    table = colours(float(length.min()), float(length.max()))
    mapper = vtk.vtkDataSetMapper()
    mapper.SetInputData(plane)
    mapper.SetLookupTable(table)
    mapper.UseLookupTableScalarRangeOn()
    coloured = vtk.vtkActor()
    coloured.SetMapper(mapper)
    coloured.GetProperty().LightingOff()
    renderer.AddActor(coloured)
    lines = vtk.vtkContourFilter()
    lines.SetInputData(plane)
    for i in range(int(numpy.log(length.max() / length.min()) / numpy.log(EQUAL_LENGTH_STEP)) + 1):
        lines.SetValue(i, float(length.min()) * EQUAL_LENGTH_STEP ** i)
    lines.Update()
    edges = vtk.vtkExtractEdges()
    edges.SetInputData(piece)
    edges.Update()
    for data, colour, width, height in ((edges.GetOutput(), (0.62, 0.62, 0.62), 0.5, 0.5e-3),
                                        (lines.GetOutput(), (0.1, 0.1, 0.35), 1.4, 0.7e-3)):
        actor = common.actor(data, colour=colour, line_width=width * common.SAMPLES)
        actor.GetProperty().LightingOff()
        actor.SetPosition(*(height * half_height * numpy.array(normal)))
        renderer.AddActor(actor)
    return table


def slice_scene(grid, name, origin, normal, body, half_height, table=None, field=None):
    """Coloured slice with cell edges, the section of the body and a scale for the lengths that are in the picture."""
    if field is not None:
        renderer = vtk.vtkRenderer()
        table = field_scene(field, cut(grid, origin, normal), origin, normal, half_height, renderer)
        add_body(body, origin, normal, half_height, renderer)
        renderer.AddViewProp(scale_bar(table))
        return renderer
    piece = cut(grid, origin, normal)
    is_category = table is not None
    if not is_category:
        centres = vtk.vtkCellCenters()
        centres.SetInputData(piece)
        centres.Update()
        places = vtk_to_numpy(centres.GetOutput().GetPoints().GetData())
        near = numpy.abs(places - numpy.array(origin)).max(axis=1) < 1.6 * half_height
        lengths = vtk_to_numpy(piece.GetCellData().GetArray(name))[near]
        table = colours(float(lengths.min()), float(lengths.max()))

    piece.GetCellData().SetActiveScalars("category" if is_category else name)
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputData(piece)
    mapper.SetScalarModeToUseCellData()
    mapper.SetLookupTable(table)
    mapper.UseLookupTableScalarRangeOn()
    cells = vtk.vtkActor()
    cells.SetMapper(mapper)
    cells.GetProperty().LightingOff()
    cells.GetProperty().EdgeVisibilityOn()
    cells.GetProperty().SetEdgeColor(0.35, 0.35, 0.35)
    cells.GetProperty().SetLineWidth(0.7 * common.SAMPLES)
    renderer = vtk.vtkRenderer()
    renderer.AddActor(cells)
    add_body(body, origin, normal, half_height, renderer)
    if not is_category:
        renderer.AddViewProp(scale_bar(table))
    return renderer


def add_body(body, origin, normal, half_height, renderer):
    """Its section, in front of the cells; None: nothing."""
    if body is None:
        return
    outline = common.actor(cut(body, origin, normal), colour=(0, 0, 0), line_width=2 * common.SAMPLES)
    outline.GetProperty().LightingOff()
    outline.SetPosition(*(1e-3 * half_height * numpy.array(normal)))
    renderer.AddActor(outline)


def scale_bar(table):
    bar = vtk.vtkScalarBarActor()
    bar.SetLookupTable(table)
    bar.SetTitle("edge length")
    bar.SetNumberOfLabels(5)
    bar.SetLabelFormat("%.3g")
    bar.SetWidth(0.085)
    bar.SetHeight(0.5)
    bar.SetPosition(0.905, 0.03)
    bar.SetTextPad(6 * common.SAMPLES)
    bar.SetVerticalTitleSeparation(10 * common.SAMPLES)
    bar.DrawBackgroundOn()
    bar.GetBackgroundProperty().SetColor(1, 1, 1)
    for text in (bar.GetTitleTextProperty(), bar.GetLabelTextProperty()):
        text.SetColor(0, 0, 0)
        text.ShadowOff()
        text.ItalicOff()
        text.SetFontSize(15 * common.SAMPLES)
    bar.UnconstrainedFontSizeOn()
    return bar


def shown_cells(grid, by, origin, normal, half_height):
    """Cells that the slice meets in each part of the picture; by category, the parts of each category."""
    piece = cut(grid, origin, normal)
    centres = vtk.vtkCellCenters()
    centres.SetInputData(piece)
    centres.Update()
    points = vtk_to_numpy(centres.GetOutput().GetPoints().GetData())
    if by != "colour":
        return common.shown(points, origin, normal, half_height, SIZE)
    category = vtk_to_numpy(piece.GetCellData().GetArray("category"))
    return [n for value in range(3) for n in common.shown(points[category == value], origin, normal, half_height, SIZE)]


def finest_place(grid, name):
    """Centre of the finest cell and the extent of the cells that are at most eight times as long."""
    lengths = common.cell_array(grid, name)
    centres = vtk.vtkCellCenters()
    centres.SetInputData(grid)
    centres.Update()
    points = vtk_to_numpy(centres.GetOutput().GetPoints().GetData())
    fine = points[lengths <= 8 * lengths.min()]
    return points[int(numpy.argmin(lengths))], float(numpy.linalg.norm(fine.max(axis=0) - fine.min(axis=0)))


def slices(grid, name, mesh):
    """name -> (point on the plane and in the middle of the picture, normal towards the viewer, half height)."""
    place, extent = finest_place(grid, name)
    result = {}
    if mesh is not None:
        everything = mesh.box()
        size = float(numpy.linalg.norm(everything[1] - everything[0]))
        nacelle = mesh.box("nacelle_outer")
        if nacelle is not None:
            middle = 0.5 * (nacelle[0] + nacelle[1])
            y = middle[1] + 0.0037 * size  # beside patch boundaries in the middle of the nacelle
            result["sizing_nacelle"] = ((middle[0] + 0.06 * size, y, middle[2] + 0.02 * size), (0, -1, 0), 0.085 * size)
            x = nacelle[0][0] + 0.93 * (nacelle[1][0] - nacelle[0][0])  # meets nacelle, pylon, wing and fuselage
            result["sizing_section"] = ((x, 0.75 * middle[1], middle[2] + 0.03 * size), (-1, 0, 0), 0.08 * size)
    if not result:
        result["sizing_slice"] = (tuple(place), (0, -1, 0), 0.6 * extent)
    return result


def behind_wing(mesh):
    """As slices(), for --field: a section through the wing's trailing edge and the wake behind it."""
    box = mesh.box("wing_te") if mesh else None
    if box is None:
        sys.exit("render: error: --field needs --mesh with a group 'wing_te'")
    y = box[0][1] + 0.4 * (box[1][1] - box[0][1])
    x, z = (box[0] + 0.4 * (box[1] - box[0]))[[0, 2]]
    return (float(x), float(y), float(z)), (0, -1, 0), 0.12 * float(numpy.linalg.norm(box[1] - box[0]))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("sizing", help="octree exported as .vtu")
    parser.add_argument("--mesh", help="mesh artifact: places the slices and shows the body")
    parser.add_argument("--by", choices=("size", "cause", "colour"), default="size",
                        help="what colours show (default: %(default)s)")
    parser.add_argument("--slice", nargs=5, metavar=("NAME", "X", "Y", "Z", "HALF"),
                        help="name of the picture, point in its middle, half its height")
    parser.add_argument("--suffix", default="", help="added to the names of the pictures")
    parser.add_argument("--view", help="only this picture: sizing_nacelle or sizing_section")
    parser.add_argument("--as", dest="name", help="with --view or --slice: name of the file")
    parser.add_argument("--check", action="store_true",
                        help="draw nothing; exit code 1 when a picture shows other sizes")
    parser.add_argument("--field", help="sizing.hdf: colours by the length at each point")
    parser.add_argument("-o", "--output", default="docs/images", help="folder for the PNG files (default: %(default)s)")
    options = parser.parse_args()
    grid = common.read(options.sizing)
    name = length_name(grid)
    mesh = body = None
    if options.mesh:
        from render_mesh import Mesh
        mesh = Mesh(options.mesh)
        body = mesh.surface(~mesh.is_outer())
    field = None
    if options.field:
        sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "python"))
        import st
        field = st.Sizing(options.field)
    table = None if options.by == "size" else categories(grid, options.by)
    os.makedirs(options.output, exist_ok=True)
    wanted = slices(grid, name, mesh)
    if options.slice:
        x, y, z, half = map(float, options.slice[1:])
        wanted = {options.slice[0]: ((x, y, z), (0, 0, 1), half)}
    elif options.field:
        wanted = {"sizing_field": behind_wing(mesh)}
    if options.view:
        wanted = {options.view: wanted[options.view]}
    stale = False
    for picture, (origin, normal, half_height) in wanted.items():
        path = os.path.join(options.output, (options.name or picture) + options.suffix + ".png")
        shows = shown_cells(grid, options.by, origin, normal, half_height)
        if options.check:
            stale |= not common.is_current(path, shows)
            continue
        renderer = slice_scene(grid, name, origin, normal, body, half_height, table, field)
        window = common.window_of(renderer, SIZE)
        common.look(renderer, origin, normal, half_height)
        common.write_png(window, path, shows)
    return 1 if stale else 0


if __name__ == "__main__":
    sys.exit(main())
