#!/usr/bin/python3
"""Pictures of a mesh artifact: the whole surface and, where the groups of the bundled example are found, close-ups of
its difficult places.

usage: render_mesh.py mesh.hdf [-o docs/images] [--view NAME ...] [--prefix mesh] [--check]
       [--at NAME=X,Y,Z,HALF_HEIGHT[,DX,DY,DZ] ...]
Needs python3-vtk9 and, without a display, xvfb.
"""

import argparse
import os
import sys

import render_common as common
from render_common import numpy, vtk, vtk_to_numpy
from vtk.util import numpy_support

SIZE = (1280, 800)
OUTER_COLOUR = (0.88, 0.89, 0.91)
OUTER = ("symmetry", "farfield")  # hidden in all views but the one that is named after it


class Mesh:
    """Triangles with their CAD face and group."""

    def __init__(self, path):
        self.grid = common.read(path)
        self.points = vtk_to_numpy(self.grid.GetPoints().GetData())
        self.triangles = vtk_to_numpy(self.grid.GetCells().GetConnectivityArray()).reshape(-1, 3)
        self.face = common.cell_array(self.grid, "face")
        self.group = common.cell_array(self.grid, "group").astype(int) - 1  # the artifact counts from 1
        names = self.grid.GetFieldData().GetAbstractArray("group_name")
        n_groups = int(self.group.max()) + 1
        self.names = [f"group {i}" for i in range(n_groups)]
        if names:
            self.names = [names.GetValue(i) for i in range(names.GetNumberOfValues())]

    def is_outer(self):
        """Per triangle: far field or symmetry plane."""
        flags = numpy.array([any(word in n.lower() for word in OUTER) for n in self.names])
        return flags[self.group]

    def nodes(self, prefix=None):
        """Coordinates of the corners of the groups whose name starts so; None when there is no such group. Without
        prefix: of the walls."""
        selected = ~self.is_outer()
        if prefix is not None:
            selected = numpy.array([n.startswith(prefix) for n in self.names])[self.group]
        return self.points[self.triangles[selected].ravel()] if selected.any() else None

    def box(self, prefix=None):
        """Corners of the bounding box of nodes(prefix), or None."""
        nodes = self.nodes(prefix)
        return None if nodes is None else numpy.array([nodes.min(axis=0), nodes.max(axis=0)])

    def shown(self, selected, focus, direction, half_height, size):
        """Triangles in each part of a picture, hidden ones too."""
        return common.shown(self.points[self.triangles[selected]].mean(axis=1), focus, direction, half_height, size)

    def surface(self, selected):
        """Selected triangles as poly data in the colours of their groups."""
        poly = vtk.vtkPolyData()
        poly.SetPoints(self.grid.GetPoints())
        poly.SetPolys(cell_list(self.triangles[selected]))
        palette = numpy.array([OUTER_COLOUR if any(word in n.lower() for word in OUTER)
                               else common.PALETTE[i % len(common.PALETTE)]
                               for i, n in enumerate(self.names)])
        colours = (255 * palette[self.group[selected]]).astype(numpy.uint8)
        array = numpy_support.numpy_to_vtk(colours, deep=1)
        array.SetName("colour")
        poly.GetCellData().SetScalars(array)
        return poly

    def wire(self, selected):
        """All edges of the selected triangles, each once."""
        t = self.triangles[selected]
        pairs = numpy.sort(numpy.concatenate([t[:, [0, 1]], t[:, [1, 2]], t[:, [2, 0]]]), axis=1)
        keys = numpy.unique(pairs[:, 0].astype(numpy.int64) * len(self.points) + pairs[:, 1])
        poly = vtk.vtkPolyData()
        poly.SetPoints(self.grid.GetPoints())
        poly.SetLines(cell_list(numpy.stack([keys // len(self.points), keys % len(self.points)], axis=1)))
        return poly


def cell_list(nodes):
    """VTK's cells for an array of one row per cell."""
    n_cells, n_corners = nodes.shape
    ids = numpy.hstack([numpy.full((n_cells, 1), n_corners, numpy.int64), nodes.astype(numpy.int64)]).ravel()
    cells = vtk.vtkCellArray()
    cells.SetCells(n_cells, numpy_support.numpy_to_vtkIdTypeArray(ids, deep=1))
    return cells


def scene(mesh, selected, edge_width):
    """Surface in the colours of its groups with the triangle edges on it."""
    # of the cells: without them the renderer differentiates coordinates, which shows as stripes
    normals = vtk.vtkPolyDataNormals()
    normals.SetInputData(mesh.surface(selected))
    normals.ComputeCellNormalsOn()
    normals.ComputePointNormalsOff()
    normals.SplittingOff()
    normals.ConsistencyOff()
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputConnection(normals.GetOutputPort())
    mapper.SetResolveCoincidentTopologyToPolygonOffset()
    surface = vtk.vtkActor()
    surface.SetMapper(mapper)
    surface.GetProperty().SetInterpolationToFlat()
    surface.GetProperty().SetAmbient(0.35)
    surface.GetProperty().SetDiffuse(0.7)
    renderer = vtk.vtkRenderer()
    renderer.AddActor(surface)
    edges = common.actor(mesh.wire(selected), colour=(0.12, 0.14, 0.2), line_width=common.SAMPLES * edge_width)
    edges.GetProperty().LightingOff()
    renderer.AddActor(edges)
    return renderer


def in_picture(mesh, focus, direction, half_height):
    """Per triangle: may it be seen in the picture? Spares the software renderer the rest of a large mesh."""
    result = numpy.ones(len(mesh.triangles), bool)
    for axis, reach in zip(common.axes(direction)[:2], (half_height * SIZE[0] / SIZE[1], half_height)):
        corners = (mesh.points @ axis - numpy.dot(focus, axis))[mesh.triangles]
        result &= (corners.min(axis=1) < reach) & (corners.max(axis=1) > -reach)
    return result


def views(mesh):
    """name -> (focus, direction to the viewer, half height of the picture, triangles, width of their edges in
    pixels)."""
    walls, everything = ~mesh.is_outer(), mesh.box()
    if everything is None:
        sys.exit("render: error: the mesh has far field and symmetry only")
    size = float(numpy.linalg.norm(everything[1] - everything[0]))
    direction = (-0.55, 0.75, 0.45)
    focus, half_height = common.fit(mesh.points[mesh.triangles[walls].ravel()], direction, SIZE)
    result = {"mesh_whole": (focus, direction, half_height, walls, 0.5)}

    def close_up(name, group, where, direction, half_height, edge_width=1.0, selected=walls):
        """Picture around the node of a group that is nearest to a place in its box, given by fractions."""
        nodes = mesh.nodes(group)
        if nodes is None:
            print(f"render: no group '{group}*': view {name} left out", file=sys.stderr)
            return
        low, high = nodes.min(axis=0), nodes.max(axis=0)
        focus = nodes[numpy.argmin(numpy.linalg.norm(nodes - (low + (high - low) * numpy.array(where)), axis=1))]
        result[name] = (focus, direction, half_height * size, selected, edge_width)

    not_far = numpy.array(["farfield" not in n.lower() for n in mesh.names])[mesh.group]
    close_up("mesh_symmetry", "fuselage", (0.5, 0, 0.7), (-0.35, 0.9, 0.3), 0.28, 0.5, not_far)
    close_up("mesh_nose", "fuselage", (0.08, 0.7, 0.5), (-0.75, 0.6, 0.25), 0.05)
    close_up("mesh_wing_root", "belly_fairing", (0.3, 1, 0.6), (-0.55, 0.75, 0.4), 0.06)
    close_up("mesh_wing_tip", "wing_lower", (0.945, 0.965, 0.72), (-0.35, 0.85, 0.35), 0.03)
    close_up("mesh_trailing_edge", "wing_te", (0.6, 0.65, 0.4), (0.9, 0.25, 0.35), 0.003)
    close_up("mesh_nacelle", "nacelle_outer", (0.5, 0.8, 0.85), (-0.6, 0.75, 0.3), 0.048)
    close_up("mesh_nacelle_lip", "nacelle_outer", (0.03, 0.5, 0.95), (-0.75, 0.45, 0.45), 0.011)
    return result


def own_view(mesh, text):
    """NAME=X,Y,Z,HALF_HEIGHT[,DX,DY,DZ] as (name, view): any place, seen from there along the surface's normal when no
    direction is given."""
    name, _, numbers = text.partition("=")
    values = [float(v) for v in numbers.split(",")]
    if len(values) not in (4, 7):
        sys.exit(f"render: error: --at '{text}': write NAME=X,Y,Z,HALF_HEIGHT or NAME=X,Y,Z,HALF_HEIGHT,DX,DY,DZ")
    focus, direction = numpy.array(values[:3]), values[4:]
    corners = mesh.points[mesh.triangles]
    nearest = numpy.argmin(numpy.linalg.norm(corners.mean(axis=1) - focus, axis=1))
    if not direction:
        direction = numpy.cross(corners[nearest, 1] - corners[nearest, 0], corners[nearest, 2] - corners[nearest, 0])
        # not quite along an axis: the picture needs an upright
        direction = direction / numpy.linalg.norm(direction) + 0.05
    # an outer face in front of the place would hide it
    outer = mesh.is_outer()
    selected = ~outer | outer[nearest]
    return name, (focus, direction, values[3], selected, 1.0)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("mesh", help="mesh artifact (.hdf) or its .vtu export with face and group")
    parser.add_argument("-o", "--output", default="docs/images", help="folder for the PNG files (default: %(default)s)")
    parser.add_argument("--view", action="append", help="only this view (may be repeated)")
    parser.add_argument("--at", action="append", default=[], metavar="NAME=X,Y,Z,HALF_HEIGHT[,DX,DY,DZ]",
                        help="a place of your own; only these and --view are made")
    parser.add_argument("--prefix", default="mesh", help="first word of the names of the files (default: %(default)s)")
    parser.add_argument("--check", action="store_true",
                        help="draw nothing; exit code 1 when a picture shows another mesh")
    options = parser.parse_args()
    mesh = Mesh(options.mesh)
    all_views = {} if options.at and not options.view else views(mesh)
    own = dict(own_view(mesh, text) for text in options.at)
    all_views.update(own)
    options.view = (options.view or []) + list(own)
    for name in options.view or []:
        if name not in all_views:
            parser.error(f"unknown view '{name}'; there are: {', '.join(all_views)}")
    os.makedirs(options.output, exist_ok=True)
    stale = False
    for name in options.view or all_views:
        path = os.path.join(options.output, name.replace("mesh", options.prefix, 1) + ".png")
        focus, direction, half_height, selected, edge_width = all_views[name]
        shows = mesh.shown(selected, focus, direction, half_height, SIZE)
        if options.check:
            stale |= not common.is_current(path, shows)
            continue
        renderer = scene(mesh, selected & in_picture(mesh, focus, direction, half_height), edge_width)
        window = common.window_of(renderer, SIZE)
        common.look(renderer, focus, direction, half_height)
        common.write_png(window, path, shows)
    return 1 if stale else 0


if __name__ == "__main__":
    sys.exit(main())
