"""Meshes that follow a field: st-metric, st-prolong --background --only, st-mesh, and again. The loop of adapt.py."""
import csv
import os
import re
import shutil
import subprocess
import sys
import types
import unittest
from pathlib import Path
from unittest import mock

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
sys.path.insert(0, str(ROOT / "tests/support"))
from adapt_table import FIELDS, Loop, errors_by_level, gain_of, on_shape, order_of  # noqa: E402
from chain import BIN, CORPUS, MODELS, ToolTest, must  # noqa: E402

try:
    os.environ.setdefault("DISPLAY", "none")  # nothing is drawn
    sys.path.insert(0, str(ROOT / "examples/adapt"))
    import numpy
    import adapt
    import wall_pressure
    from render_common import read, vtk, vtk_to_numpy
    from vtk.util import numpy_support
    WHY_NOT = ""
except ImportError as e:
    WHY_NOT = f"{e}: the loop of examples/adapt is not tested; install python3-vtk9 and run with /usr/bin/python3"
    print(f"SKIPPED: {WHY_NOT}", flush=True)
NEEDED = ("tetgen", "potentialFoam", "simpleFoam", "gmshToFoam")
NO_FLOW = WHY_NOT or ", ".join(f"no {tool}" for tool in NEEDED if not shutil.which(tool))
if NO_FLOW and not WHY_NOT:
    print(f"SKIPPED: {NO_FLOW}: the loop of examples/adapt is tested without its flow; run scripts/setup.sh adapt",
          flush=True)

M6 = CORPUS / "aero_onera_m6_sharpte.brep"
RESIDUAL = "GAMG:  Solving for p, Initial residual = 1e-06, Final residual = 1e-8, No Iterations 2\nExecutionTime = 1 s"
SHOCK = 2.0  # the plane x at which the pressure of the test jumps, on a sphere of radius 10


def flow_with_a_shock(steps, name, _options):
    """In place of adapt.flow(): a pressure that jumps at a plane, at the nodes of mesh NAME."""
    surface = steps.folder / f"surface{name}.vtu"
    must("st-export", steps.folder / f"mesh{name}.hdf", "-o", surface)
    grid = read(str(surface))
    x = vtk_to_numpy(grid.GetPoints().GetData())[:, 0]
    cp = numpy_support.numpy_to_vtk(numpy.tanh((x - SHOCK) / 0.5), deep=1)
    cp.SetName("cp")
    grid.GetPointData().AddArray(cp)
    writer = vtk.vtkXMLUnstructuredGridWriter()
    writer.SetFileName(str(steps.folder / f"flow{name}.vtu"))
    writer.SetInputData(grid)
    writer.Write()
    return types.SimpleNamespace(triangle=range(grid.GetNumberOfCells()), error=lambda: 0, drag=lambda _stream: 0), 0


def edges_at(path, plane):
    """Median length of the sides of triangles that the plane x cuts."""
    grid = read(str(path))
    xyz = vtk_to_numpy(grid.GetPoints().GetData()).astype(float)
    triangles = xyz[vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 3)]
    x = triangles[:, :, 0] - plane
    cut = triangles[(x.min(axis=1) < 0) & (x.max(axis=1) > 0)]
    return float(numpy.median(numpy.linalg.norm(cut - numpy.roll(cut, 1, axis=1), axis=2)))


def must_run(*command):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, timeout=300, check=False)
    if done.returncode != 0:
        raise AssertionError(done.stdout + done.stderr)


class Adapt(ToolTest):
    def test_the_error_of_interpolation_falls_with_second_order_and_is_a_quarter(self):
        models = {shape: next(MODELS.glob(f"{shape}.*")) for shape in ("sphere", "box")}
        if M6.exists():
            models["m6"] = M6
        for shape, model in models.items():
            (self.folder / shape).mkdir()
            loop = Loop(BIN, model, self.folder / shape)
            for name, field in FIELDS.items():
                rows = errors_by_level(loop, on_shape(field, shape), 2)
                self.assertGreater(order_of(rows), 1.8, f"{shape} {name}: {rows}")
                self.assertGreater(gain_of(rows[-1]), 4, f"{shape} {name}: {rows}")

    def loop(self, model, *options):
        """Runs adapt.py in this process: its folder, and the rows of its table."""
        folder = self.folder / "loop"
        with mock.patch.object(sys, "argv", ["adapt.py", str(model), str(folder), "--bin", str(BIN), *options]):
            adapt.main()
        with open(folder / "cycles.csv", encoding="utf-8", newline="") as file:
            return folder, list(csv.DictReader(file))

    @unittest.skipIf(WHY_NOT, WHY_NOT)
    def test_the_loop_remeshes_where_the_pressure_jumps(self):
        with mock.patch.object(adapt, "flow", flow_with_a_shock):
            folder, rows = self.loop(MODELS / "sphere.brep", "--cycles", "3", "--nodes", "2000")
        self.assertEqual(len(rows), 3)
        first, last = (edges_at(folder / f"surface{c}.vtu", SHOCK) for c in (1, 3))
        self.assertLess(last, first / 4, "the sizes of the pressure are not those of the mesh")
        self.assertLess(last, edges_at(folder / "surface3.vtu", -6) / 2, "lengths are small where nothing asks for it")
        log = (folder / "steps.log").read_text(encoding="utf-8")
        self.assertEqual(len(re.findall(r"^\$ \S*st-mesh ", log, re.M)), 1, "only the first mesh is made anew")
        remeshed = re.findall(r"(\d+) of (\d+) triangles remeshed", log)
        self.assertEqual(len(remeshed), 2)
        self.assertTrue(all(0 < int(n) for n, _ in remeshed), remeshed)

    @unittest.skipIf(NO_FLOW, NO_FLOW)
    def test_the_loop_with_its_flow_finds_the_pressure_of_a_sphere(self):
        folder, rows = self.loop(MODELS / "sphere.brep", "--farfield", "box:5", "--cycles", "2", "--nodes", "1500",
                                 "--raster", "--alpha 30 --lmax 20% --edge-size none")
        self.assertEqual(len(rows), 2)
        walls = wall_pressure.Walls(folder / "case2")
        cosine = walls.xyz[:, 0] / numpy.linalg.norm(walls.xyz, axis=1)
        error = numpy.abs(walls.cp_at_node - (1 - 2.25 * (1 - cosine**2)))
        self.assertLess(float(error.mean()), 0.05)

    def test_a_steady_flow_has_the_viscosity_of_the_shortest_lengths(self):
        """Without, cells that no flow passes have no velocity: the M6 diverged in its third cycle."""
        case, tools = self.folder / "case", self.folder / "tools"
        case.mkdir()
        tools.mkdir()
        for name, prints in (("potentialFoam", ""), ("foamListTimes", "7"), ("simpleFoam", RESIDUAL)):
            (tools / name).write_text(f"#!/bin/bash\nmkdir -p 7\necho '{prints}'\n")
            (tools / name).chmod(0o755)
        (case / "log.checkMesh").write_text("    Minimum face area = 4e-08. Maximum face area = 432.1.  OK.\n")
        must_run("env", f"PATH={tools}:{os.environ['PATH']}", ROOT / "examples/adapt/simple.sh", case, 1, 0, 0)
        self.assertEqual((case / "stream").read_text().split(), ["stream", "(1", "0", "0);", "viscosity", "2e-06;"])
        self.assertIn("nu              $viscosity;", (case / "constant/transportProperties").read_text())

    @unittest.skipIf(NO_FLOW or not M6.exists(), NO_FLOW or f"no {M6}: set ST_CORPUS")
    def test_a_steady_solver_gives_a_wing_the_pressure_of_potential_flow(self):
        folder, rows = self.loop(M6, "--cycles", "1", "--solver", "simpleFoam")
        self.assertTrue(0 < float(rows[0]["share_st"]) < 1, rows)
        case = folder / "case1"
        steady = wall_pressure.Walls(case, "simpleFoam")
        shutil.rmtree(case / "0")
        for part in ("0", "system"):
            shutil.copytree(ROOT / "examples/openfoam/case" / part, case / part, dirs_exist_ok=True)
        adapt.set_stream(case, (1, 0, 0))
        must_run(ROOT / "examples/openfoam/flow.sh", case)
        potential = wall_pressure.Walls(case)
        self.assertLess(steady.distances(potential)[0], 0.02)


if __name__ == "__main__":
    unittest.main(verbosity=2)
