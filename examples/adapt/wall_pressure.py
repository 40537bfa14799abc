"""The pressure coefficient in an OpenFOAM case: values at the walls, error estimate, drag, distance from a finer one.

Arrays: xyz [nodes, 3] in the model unit; triangle [triangles, 3] node numbers; cp [triangles] or [nodes], no unit.
"""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "openfoam"))
import draw_pressure  # noqa: E402
from render_common import numpy, vtk, vtk_to_numpy  # noqa: E402
from recovery import Cells, at_nodes  # noqa: E402
from vtk.util import numpy_support  # noqa: E402


def volume(case, array):
    """Cells, and the value of `array` in each."""
    reader = vtk.vtkOpenFOAMReader()
    reader.SetFileName(draw_pressure.control_of(str(case)))
    reader.UpdateInformation()
    reader.DisableAllPatchArrays()
    reader.SetPatchArrayStatus("internalMesh", 1)
    reader.CreateCellToPointOff()
    reader.DecomposePolyhedraOff()
    reader.Update()
    grid = reader.GetOutput().NewIterator().GetCurrentDataObject()
    cells = Cells(vtk_to_numpy(grid.GetPoints().GetData()).astype(float),
                  vtk_to_numpy(grid.GetCells().GetConnectivityArray()), vtk_to_numpy(grid.GetCells().GetOffsetsArray()))
    return cells, vtk_to_numpy(grid.GetCellData().GetArray(array)).astype(float)


def same_places(points, among):
    """The row of `among` that each of `points` is, bit for bit: both as VTK read them, in single precision."""
    _, number = numpy.unique(numpy.concatenate([among, points]).astype(numpy.float32), axis=0, return_inverse=True)
    row = numpy.full(number.max() + 1, -1)
    row[number[:len(among)]] = numpy.arange(len(among))
    return row[number[len(among):]]


class Walls:
    """Triangles of the walls of a case, with the pressure coefficient.

    cp [triangles] is that of the cells at them. cp_at_node is that of a quadric fitted to the cells around each corner,
    to their potential or, of another solver than potentialFoam, their pressure. Between corners it is linear.
    """

    def __init__(self, case, solver="potentialFoam"):
        is_potential = solver == "potentialFoam"
        names = [name for name, kind in draw_pressure.patch_types(str(case)).items() if kind == "wall"]
        clean = vtk.vtkCleanPolyData()  # patches share the points of their common edges
        clean.SetInputData(draw_pressure.patches(str(case), names, "grad(Phi)" if is_potential else "p"))
        clean.Update()
        self.surface = clean.GetOutput()
        self.triangle = vtk_to_numpy(self.surface.GetPolys().GetConnectivityArray()).reshape(-1, 3)
        self.xyz = vtk_to_numpy(self.surface.GetPoints().GetData()).astype(float)
        a, b, c = (self.xyz[self.triangle[:, k]] for k in range(3))
        self.normal = 0.5 * numpy.cross(b - a, c - a)  # [triangles, 3], as long as the area; into the wall
        self.area = numpy.linalg.norm(self.normal, axis=1)
        self.centre = (a + b + c) / 3
        cells, value = volume(case, "Phi" if is_potential else "p")
        values, gradients = at_nodes(cells, value, same_places(self.xyz, cells.points))
        if is_potential:
            velocity = vtk_to_numpy(self.surface.GetCellData().GetArray("grad(Phi)")).astype(float)
            self.cp = 1 - (velocity**2).sum(axis=1)
            self.cp_at_node = 1 - (gradients**2).sum(axis=1)
        else:  # speed and density are 1 far away
            self.cp = 2 * vtk_to_numpy(self.surface.GetCellData().GetArray("p")).astype(float)
            self.cp_at_node = 2 * values
        self.cp_at_centre = self.cp_at_node[self.triangle].mean(axis=1)

    def error(self):
        """Mean by area of how far a triangle's value is from its corners' (Zienkiewicz and Zhu, 1987)."""
        return float((self.area * numpy.abs(self.cp - self.cp_at_centre)).sum() / self.area.sum())

    def drag(self, stream):
        """Force of the pressure along the direction `stream`, over the area of the walls."""
        return float((self.cp[:, None] * self.normal).sum(axis=0) @ numpy.array(stream) / self.area.sum())

    def at(self, points):
        """The pressure coefficient at `points` [n, 3], each taken to the nearest triangle: [n]."""
        locator = vtk.vtkStaticCellLocator()
        locator.SetDataSet(self.surface)
        locator.BuildLocator()
        near, nearest = [0.0, 0.0, 0.0], numpy.empty((len(points), 3))
        cell, part, distance2 = vtk.reference(0), vtk.reference(0), vtk.reference(0.0)
        number = numpy.empty(len(points), dtype=int)
        for i, point in enumerate(points):
            locator.FindClosestPoint(point, near, cell, part, distance2)
            number[i], nearest[i] = cell.get(), near
        corner = self.triangle[number]
        a, b, c = (self.xyz[corner[:, k]] for k in range(3))
        normal = numpy.cross(b - a, c - a)
        square = (normal**2).sum(axis=1)
        of_a = (numpy.cross(c - b, nearest - b) * normal).sum(axis=1) / square
        of_b = (numpy.cross(a - c, nearest - c) * normal).sum(axis=1) / square
        weights = numpy.stack([of_a, of_b, 1 - of_a - of_b], axis=1)
        return (self.cp_at_node[corner] * weights).sum(axis=1)

    def apart(self, finer):
        """How far this pressure is from a finer solution's at the centres of its triangles: [triangles of finer]."""
        return numpy.abs(self.at(finer.centre) - finer.cp_at_centre)

    def distances(self, finer):
        """apart() as a mean by area, and as the root of that of its square."""
        apart = self.apart(finer)
        return (float((finer.area * apart).sum() / finer.area.sum()),
                float((finer.area * apart**2).sum() / finer.area.sum())**0.5)

    def write(self, path):
        """The walls with `cp` at their nodes as VTU, for st-metric."""
        plain = vtk.vtkUnstructuredGrid()
        plain.SetPoints(self.surface.GetPoints())
        plain.SetCells(vtk.VTK_TRIANGLE, self.surface.GetPolys())
        cp = numpy_support.numpy_to_vtk(self.cp_at_node, deep=1)
        cp.SetName("cp")
        plain.GetPointData().AddArray(cp)
        writer = vtk.vtkXMLUnstructuredGridWriter()
        writer.SetFileName(str(path))
        writer.SetInputData(plain)
        writer.SetDataModeToAppended()
        writer.EncodeAppendedDataOff()
        writer.SetCompressorTypeToNone()
        writer.Write()
