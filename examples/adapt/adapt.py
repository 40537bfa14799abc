#!/usr/bin/python3
"""A mesh that follows its flow: mesh, volume, potential flow, sizes from the pressure, remesh, and again.

usage: adapt.py MODEL FOLDER [--cycles 4] [--compare] [--bin BIN_DIR] [--farfield CUBOID:SIZE]

MODEL is a CAD file of the fluid, or of bodies with --farfield and --symmetry as for st-import. FOLDER is a new folder.
Each cycle prints a line: triangles on the walls, tetrahedra, the error estimate of the pressure coefficient there, the
drag of the pressure (without viscosity it is 0, so what is left is error), seconds, and ST's share of the processor
time. The table is also FOLDER/cycles.csv. Needs what examples/openfoam needs; a cycle without change of the mesh ends
the run.
--compare then makes a mesh of the first lengths, all scaled by one factor to as many triangles, and a reference: half
of the smaller length of both. It tells how far the pressure of both is from the reference's.
Exit codes: 2 usage; 5 a step failed, its output is above and in FOLDER.
"""
import argparse
import csv
import os
import re
import resource
import subprocess
import sys
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
from wall_pressure import Walls  # noqa: E402

NORM = "1"  # of the error that st-metric makes small
GROWTH = 1.25  # of the number of nodes, from cycle to cycle
SLOPE = "0.3"  # few triangles beside what the flow asks for
COLUMNS = ("cycle", "triangles", "tetrahedra", "error", "drag", "seconds", "share_st")


def now():
    """Seconds by the clock, and of processors in this process and those that it ran."""
    own, others = (resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    return time.monotonic(), own.ru_utime + own.ru_stime + others.ru_utime + others.ru_stime


class Steps:
    """Runs commands and adds up their time; output goes to FOLDER/steps.log, the time of each to FOLDER/steps.csv."""

    def __init__(self, folder, tools):
        self.folder, self.tools = folder, tools
        self.seconds = self.processor = self.processor_st = 0.0
        (folder / "steps.csv").write_text("step,seconds,processor\n", encoding="utf-8")

    def run(self, command):
        begin = now()
        with open(self.folder / "steps.log", "a", encoding="utf-8") as log:
            print("$", *command, file=log, flush=True)
            done = subprocess.run([str(c) for c in command], stdout=log, stderr=subprocess.STDOUT, check=False)
        self.add(Path(command[0]).name, begin)
        if done.returncode != 0:
            print(*(self.folder / "steps.log").read_text(errors="replace").split("\n")[-8:], sep="\n", file=sys.stderr)
            print(f"adapt: error: '{command[0]}' ended with exit code {done.returncode}, see "
                  f"{self.folder / 'steps.log'}", file=sys.stderr)
            sys.exit(5)

    def add(self, step, begin):
        """The time since `begin` counts for this step."""
        seconds, processor = (after - before for after, before in zip(now(), begin))
        self.seconds += seconds
        self.processor += processor
        with open(self.folder / "steps.csv", "a", encoding="utf-8") as log:
            print(f"{step},{seconds:.3f},{processor:.3f}", file=log)

    def st(self, tool, *arguments):
        before = self.processor
        self.run([self.tools / tool if self.tools else tool, *arguments])
        self.processor_st += self.processor - before


def set_stream(case, stream):
    """Writes the flow far away into the case's potential, which is minus OpenFOAM's."""
    file = case / "0/Phi"
    x, y, z = stream
    text, n = re.subn(r'valueExpr "[^"]*"', f'valueExpr "-({x:g}*pos().x() + {y:g}*pos().y() + {z:g}*pos().z())"',
                      file.read_text(encoding="utf-8"))
    if n != 1:
        sys.exit(f"adapt: error: {file} has {n} lines with valueExpr instead of 1")
    file.write_text(text, encoding="utf-8")


def number_of_cells(case):
    return int(re.search(r"^ +cells: +(\d+)", (case / "log.checkMesh").read_text(), re.M)[1])


def mesh_hash(steps, mesh):
    tool = steps.tools / "st-info" if steps.tools else "st-info"
    return subprocess.run([str(tool), str(mesh), "--hash"], capture_output=True, text=True, check=True).stdout


def mesh_by(steps, sizing, name):
    """FOLDER/mesh<NAME>.hdf, made anew."""
    f = steps.folder
    steps.st("st-mesh", f / "geometry.hdf", sizing, "-o", f / "patches.hdf")
    steps.st("st-merge", f / "patches.hdf", "-o", f / f"mesh{name}.hdf")


def first_mesh(steps, options):
    """Geometry, raster and the first mesh, of the shape alone."""
    f = steps.folder
    more = [word for name in ("farfield", "symmetry") if getattr(options, name)
            for word in (f"--{name}", getattr(options, name))]
    steps.st("st-import", options.model, "-o", f / "geometry.hdf", *more)
    raster = ("st-raster", f / "geometry.hdf", *options.raster.split())
    steps.st(*raster, "-o", f / "raster.hdf")
    # the bounds of the flow's lengths: --max-aspect would stretch the first mesh as well, and lmin make it finer
    steps.st(*raster, "-o", f / "bounds.hdf", *options.bounds.split(), "--max-aspect", options.max_aspect)
    steps.st("st-prolong", f / "raster.hdf", "-o", f / "sizing1.hdf", "--slope", SLOPE)
    mesh_by(steps, f / "sizing1.hdf", 1)


def flow(steps, name, options):
    """The flow around mesh NAME: its walls, number of cells; flowNAME.vtu has the pressure on the walls."""
    f = steps.folder
    case, surface = f / f"case{name}", f / f"mesh{name}.{'smesh' if options.volume == 'tetgen' else 'msh'}"
    steps.st("st-export", f / f"mesh{name}.hdf", "-o", surface)
    steps.run([HERE.parent / "openfoam/volume.sh", surface, case])
    set_stream(case, options.stream)
    if options.solver == "potentialFoam":
        steps.run([HERE.parent / "openfoam/flow.sh", case])
    else:
        steps.run([HERE / "simple.sh", case, *options.stream])
    begin = now()
    walls = Walls(case, options.solver)
    walls.write(f / f"flow{name}.vtu")
    steps.add("wall_pressure", begin)
    return walls, number_of_cells(case)


def follow(steps, cycle, options):
    """Mesh CYCLE+1 from the flow around mesh CYCLE. False: nothing changed."""
    f, new = steps.folder, cycle + 1
    nodes = options.nodes * GROWTH**(new - options.cycles)
    metric(steps, cycle, f"sizes{new}", nodes, options)
    steps.st("st-prolong", f / "bounds.hdf", "--only", "--background", f / f"sizes{new}.solb", "--slope", SLOPE,
             "-o", f / f"sizing{new}.hdf")
    steps.st("st-remesh", f / f"mesh{cycle}.hdf", f / "geometry.hdf", f / f"sizing{new}.hdf", "--merged",
             f / f"mesh{new}.hdf")
    return mesh_hash(steps, f / f"mesh{cycle}.hdf") != mesh_hash(steps, f / f"mesh{new}.hdf")


def metric(steps, cycle, name, nodes, options):
    f = steps.folder
    steps.st("st-metric", f"{f / f'flow{cycle}.vtu'}:cp", "-o", f / f"{name}.solb", "--norm", NORM, "--max-aspect",
             options.max_aspect, "--nodes", f"{nodes:.0f}")


def even_mesh(steps, first, wanted, options):
    """The first lengths times a factor, for the wanted triangles on the walls or 1 % fewer: factor, walls, cells."""
    f, scale = steps.folder, 0.99 * (len(first.triangle) / wanted)**0.5
    for attempt in range(1, 4):
        steps.st("st-prolong", f / "raster.hdf", "-o", f / "sizing_even.hdf", "--slope", SLOPE, "--scale", scale)
        name = f"_even{attempt}"
        mesh_by(steps, f / "sizing_even.hdf", name)
        walls, cells = flow(steps, name, options)
        if len(walls.triangle) >= 0.99 * wanted:
            break
        scale *= 0.99 * (len(walls.triangle) / wanted)**0.5
    return scale, walls, cells


def compare(steps, cycle, first, last, options):
    """Distances of the pressure of the last mesh and of an evenly scaled one from a reference; prints a line.

    The reference's lengths are at each place, in all directions, half of the smallest of both. st-metric is asked for
    lengths divided by the even mesh's factor, so that one factor then fits both.
    """
    f = steps.folder
    scale, even, cells = even_mesh(steps, first, len(last.triangle), options)
    metric(steps, cycle, "sizes_reference", options.nodes * scale**2, options)
    steps.st("st-prolong", f / "raster.hdf", "--background", f / "sizes_reference.solb", "--slope", SLOPE,
             "--scale", 0.5 * scale, "-o", f / "sizing_reference.hdf")
    mesh_by(steps, f / "sizing_reference.hdf", "_reference")
    reference, reference_cells = flow(steps, "_reference", options)
    own, other = last.distances(reference), even.distances(reference)
    print(f"evenly scaled by {scale:.3f}: triangles {len(even.triangle)}  tetrahedra {cells}; reference: triangles "
          f"{len(reference.triangle)}  tetrahedra {reference_cells}")
    for kind, a, b in zip(("mean", "root mean square"), own, other):
        print(f"distance, {kind}: {a:.4g}, evenly scaled {b:.4g}, ratio {a / b:.3f}", flush=True)
    for name, walls in (("even", even), ("reference", reference), ("adapted", last)):
        walls.write(f / f"{name}.vtu")


def parse():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("model")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--cycles", type=int, default=4)
    parser.add_argument("--compare", action="store_true", help="with an evenly scaled mesh and a finer one")
    parser.add_argument("--bin", type=Path, help="where the tools are; else they are found by PATH")
    parser.add_argument("--volume", choices=("tetgen", "gmsh"), default="tetgen")
    parser.add_argument("--solver", choices=("potentialFoam", "simpleFoam"), default="potentialFoam")
    parser.add_argument("--stream", default="1 0 0", help="direction of the flow far away, 'X Y Z'")
    parser.add_argument("--farfield", help="for st-import")
    parser.add_argument("--symmetry", help="for st-import")
    parser.add_argument("--raster", default="--alpha 40 --lmax 8% --edge-size none",
                        help="options of st-raster: lengths of the first mesh, and the largest of all")
    parser.add_argument("--bounds", default="--lmin 0.02%", help="further options of st-raster for the later meshes")
    parser.add_argument("--max-aspect", default="2", help="longest over shortest length of the later meshes")
    parser.add_argument("--nodes", type=int, default=8000, help="on the walls that the last sizes ask for")
    options = parser.parse_args()
    if options.folder.exists():
        parser.error(f"'{options.folder}' exists: remove it or choose another name")
    try:
        stream = [float(v) for v in options.stream.split()]
        length = sum(v * v for v in stream)**0.5
        options.stream = [v / length for v in stream]
    except (ValueError, ZeroDivisionError):
        parser.error(f"--stream '{options.stream}': takes three numbers, not all 0")
    if len(options.stream) != 3:
        parser.error(f"--stream takes three numbers, not {len(options.stream)}")
    return options


def main():
    options = parse()
    options.folder.mkdir(parents=True)
    steps = Steps(options.folder.resolve(), options.bin and options.bin.resolve())
    first_mesh(steps, options)
    first = None
    with open(options.folder / "cycles.csv", "w", encoding="utf-8", newline="") as file:
        table = csv.writer(file)
        table.writerow(COLUMNS)
        for cycle in range(1, options.cycles + 1):
            walls, cells = flow(steps, cycle, options)
            first = first or walls
            row = (cycle, len(walls.triangle), cells, f"{walls.error():.4g}", f"{walls.drag(options.stream):.4g}",
                   f"{steps.seconds:.0f}", f"{steps.processor_st / steps.processor:.3f}")
            table.writerow(row)
            file.flush()
            print("  ".join(f"{name} {value}" for name, value in zip(COLUMNS, row)), flush=True)
            if cycle < options.cycles and not follow(steps, cycle, options):
                print("the mesh no longer changes")
                break
    if options.compare:
        compare(steps, cycle, first, walls, options)


if __name__ == "__main__":
    os.environ.setdefault("WM_PROJECT_DIR", "/usr/share/openfoam")
    main()
