#!/usr/bin/python3
"""A mesh that follows its flow: mesh, volume, potential flow, sizes from the pressure, remesh, and again.

usage: adapt.py MODEL FOLDER [--cycles 4] [--bin BIN_DIR] [--volume tetgen|gmsh] [--farfield CUBOID:SIZE]

MODEL is a CAD file of the fluid, or of bodies with --farfield and --symmetry as for st-import. FOLDER is a new folder.
Each cycle prints a line: triangles on the walls, tetrahedra, the error estimate of the pressure coefficient there, the
drag of the pressure (without viscosity it is 0, so what is left is error), seconds in all and in ST. The table is also
FOLDER/cycles.csv. Needs what examples/openfoam needs; a cycle without change of the mesh ends the run.
Exit codes: 2 usage; 5 a step failed, its output is above and in FOLDER.
"""
import argparse
import csv
import os
import subprocess
import sys
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "openfoam"))
sys.path.insert(0, str(HERE.parents[1] / "scripts"))
import draw_pressure  # noqa: E402
from render_common import numpy, vtk, vtk_to_numpy  # noqa: E402
from vtk.util import numpy_support  # noqa: E402

STREAM = (0.9986, 0.0, 0.0523)  # of speed 1, as case/0/Phi has it
NORM = "2"  # of the error that st-metric makes small
GROWTH = 1.5  # of the number of nodes, from cycle to cycle
SLOPE = "0.3"  # few triangles beside what the flow asks for
COLUMNS = ("cycle", "triangles", "tetrahedra", "error", "drag", "seconds", "seconds_st")


class Steps:
    """Runs commands and adds up their time; output goes to FOLDER/steps.log."""

    def __init__(self, folder, tools):
        self.folder, self.tools = folder, tools
        self.seconds = self.seconds_st = 0.0

    def run(self, command):
        begin = time.monotonic()
        with open(self.folder / "steps.log", "a", encoding="utf-8") as log:
            print("$", *command, file=log, flush=True)
            done = subprocess.run([str(c) for c in command], stdout=log, stderr=subprocess.STDOUT, check=False)
        self.seconds += time.monotonic() - begin
        if done.returncode != 0:
            print(*(self.folder / "steps.log").read_text(errors="replace").split("\n")[-8:], sep="\n", file=sys.stderr)
            print(f"adapt: error: '{command[0]}' ended with exit code {done.returncode}, see "
                  f"{self.folder / 'steps.log'}", file=sys.stderr)
            sys.exit(5)

    def st(self, tool, *arguments):
        before = self.seconds
        self.run([self.tools / tool if self.tools else tool, *arguments])
        self.seconds_st += self.seconds - before


def cells_with_pressure(case, output):
    """Writes the volume's cells with the pressure coefficient `cp` for st-metric; their number."""
    reader = vtk.vtkOpenFOAMReader()
    reader.SetFileName(str(case / "case.foam"))
    reader.UpdateInformation()
    reader.DisableAllPatchArrays()
    reader.SetPatchArrayStatus("internalMesh", 1)
    reader.CreateCellToPointOff()
    reader.Update()
    leaves = reader.GetOutput().NewIterator()
    grid = leaves.GetCurrentDataObject()
    velocity = vtk_to_numpy(grid.GetCellData().GetArray("grad(Phi)")).astype(float)
    cp = numpy_support.numpy_to_vtk(1 - (velocity**2).sum(axis=1), deep=1)
    cp.SetName("cp")
    plain = vtk.vtkUnstructuredGrid()
    plain.CopyStructure(grid)
    plain.GetCellData().AddArray(cp)
    writer = vtk.vtkXMLUnstructuredGridWriter()
    writer.SetFileName(str(output))
    writer.SetInputData(plain)
    writer.SetDataModeToAppended()
    writer.EncodeAppendedDataOff()
    writer.SetCompressorTypeToNone()
    writer.Write()
    return plain.GetNumberOfCells()


def wall_figures(case):
    """Triangles on the walls; error of their pressure coefficient; drag over their area; a box of twice their size.

    The error is the mean, by area, of how far a triangle's value is from the mean of its corners', each of which is
    the mean of the triangles there by area (Zienkiewicz and Zhu, 1987, for values that are constant in each).
    """
    names = [name for name, kind in draw_pressure.patch_types(str(case)).items() if kind == "wall"]
    clean = vtk.vtkCleanPolyData()  # patches share the points of their common edges
    clean.SetInputData(draw_pressure.patches(str(case), names))
    clean.Update()
    walls = clean.GetOutput()
    n = walls.GetNumberOfCells()
    corner = vtk_to_numpy(walls.GetPolys().GetConnectivityArray()).reshape(n, 3)
    x = vtk_to_numpy(walls.GetPoints().GetData()).astype(float)
    velocity = vtk_to_numpy(walls.GetCellData().GetArray("grad(Phi)")).astype(float)
    cp = 1 - (velocity**2).sum(axis=1)
    normal = 0.5 * numpy.cross(x[corner[:, 1]] - x[corner[:, 0]], x[corner[:, 2]] - x[corner[:, 0]])
    area = numpy.linalg.norm(normal, axis=1)
    weight, at_node = numpy.zeros(len(x)), numpy.zeros(len(x))
    for k in range(3):
        numpy.add.at(weight, corner[:, k], area)
        numpy.add.at(at_node, corner[:, k], area * cp)
    at_node /= weight
    apart = cp - at_node[corner].mean(axis=1)
    error = (area * numpy.abs(apart)).sum() / area.sum()
    # OpenFOAM's normals point out of the fluid, into the wall, as the pressure does
    drag = (cp[:, None] * normal).sum(axis=0) @ numpy.array(STREAM) / area.sum()
    lo, hi = x.min(axis=0), x.max(axis=0)
    return n, float(error), float(drag), (*(1.5 * lo - 0.5 * hi), *(1.5 * hi - 0.5 * lo))


def mesh_hash(steps, mesh):
    tool = steps.tools / "st-info" if steps.tools else "st-info"
    return subprocess.run([str(tool), str(mesh), "--hash"], capture_output=True, text=True, check=True).stdout


def first_mesh(steps, options):
    """Geometry, raster and the first mesh, of the shape alone."""
    f = steps.folder
    more = [word for name in ("farfield", "symmetry") if getattr(options, name)
            for word in (f"--{name}", getattr(options, name))]
    steps.st("st-import", options.model, "-o", f / "geometry.hdf", *more)
    steps.st("st-raster", f / "geometry.hdf", "-o", f / "raster.hdf", *options.raster.split())
    steps.st("st-prolong", f / "raster.hdf", "-o", f / "sizing1.hdf", "--slope", SLOPE)
    steps.st("st-mesh", f / "geometry.hdf", f / "sizing1.hdf", "-o", f / "patches.hdf")
    steps.st("st-merge", f / "patches.hdf", "-o", f / "mesh1.hdf")


def flow(steps, cycle, volume):
    """The flow around mesh CYCLE: the figures of its walls and its number of cells; flowCYCLE.vtu has them."""
    f = steps.folder
    case, surface = f / f"case{cycle}", f / f"mesh{cycle}.{'smesh' if volume == 'tetgen' else 'msh'}"
    steps.st("st-export", f / f"mesh{cycle}.hdf", "-o", surface)
    steps.run([HERE.parent / "openfoam/volume.sh", surface, case])
    steps.run([HERE.parent / "openfoam/flow.sh", case])
    (case / "case.foam").touch()
    triangles, error, drag, box = wall_figures(case)
    return triangles, cells_with_pressure(case, f / f"flow{cycle}.vtu"), error, drag, box


def follow(steps, cycle, box, nodes):
    """Mesh CYCLE+1 from the flow around mesh CYCLE. False: nothing changed."""
    f, new = steps.folder, cycle + 1
    steps.st("st-metric", f"{f / f'flow{cycle}.vtu'}:cp", "-o", f / f"sizes{new}.solb", "--norm", NORM,
             "--box", " ".join(f"{c:.6g}" for c in box), "--nodes", f"{nodes:.0f}")
    steps.st("st-prolong", f / "raster.hdf", "--only", "--background", f / f"sizes{new}.solb", "--slope", SLOPE,
             "-o", f / f"sizing{new}.hdf")
    steps.st("st-remesh", f / f"mesh{cycle}.hdf", f / "geometry.hdf", f / f"sizing{new}.hdf", "--merged",
             f / f"mesh{new}.hdf")
    return mesh_hash(steps, f / f"mesh{cycle}.hdf") != mesh_hash(steps, f / f"mesh{new}.hdf")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("model")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--cycles", type=int, default=4)
    parser.add_argument("--bin", type=Path, help="where the tools are; else they are found by PATH")
    parser.add_argument("--volume", choices=("tetgen", "gmsh"), default="tetgen")
    parser.add_argument("--farfield", help="for st-import")
    parser.add_argument("--symmetry", help="for st-import")
    parser.add_argument("--raster", default="--alpha 40 --lmax 8% --edge-size none",
                        help="options of st-raster: lengths of the first mesh, and the bounds of all")
    parser.add_argument("--nodes", type=int, default=30000, help="of the volume near the walls, after the first cycle")
    options = parser.parse_args()
    if options.folder.exists():
        parser.error(f"'{options.folder}' exists: remove it or choose another name")
    options.folder.mkdir(parents=True)
    steps = Steps(options.folder.resolve(), options.bin and options.bin.resolve())
    first_mesh(steps, options)
    with open(options.folder / "cycles.csv", "w", encoding="utf-8", newline="") as file:
        table = csv.writer(file)
        table.writerow(COLUMNS)
        for cycle in range(1, options.cycles + 1):
            triangles, cells, error, drag, box = flow(steps, cycle, options.volume)
            row = (cycle, triangles, cells, f"{error:.4g}", f"{drag:.4g}", f"{steps.seconds:.0f}",
                   f"{steps.seconds_st:.1f}")
            table.writerow(row)
            file.flush()
            print("  ".join(f"{name} {value}" for name, value in zip(COLUMNS, row)), flush=True)
            if cycle < options.cycles and not follow(steps, cycle, box, options.nodes * GROWTH**(cycle - 1)):
                print("the mesh no longer changes")
                break


if __name__ == "__main__":
    os.environ.setdefault("WM_PROJECT_DIR", "/usr/share/openfoam")
    main()
