"""st-remesh on meshes of other programs: they are associated to the geometry, and refused where they do not belong to
it."""
import os
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

try:
    import numpy as np
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
except ImportError as error:
    print(f"SKIPPED, nothing about foreign meshes is tested: {error}; install python3-vtk9 (scripts/setup.sh)")
    sys.exit(77)

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
from chain import (  # noqa: E402
    INCOMPLETE, INPUT, MISMATCH, MODELS, USAGE, WORK, Run, ToolTest, artifacts_of, make_chain, must,
)
from mesh_formats import Mesh  # noqa: E402

CORPUS = os.environ.get("ST_CORPUS", "")
REAL = {"screw": "mech_netgen_screw.step", "sphere_cube": "basic_refine_sphere_cube.brep",
        "d150": "aero_d150_wing_body_half.brep"}


def corpus_chain(name):
    """The chain of a corpus model, made once."""
    folder = WORK / "artifacts" / f"foreign_{name}"
    if not (folder / "done").exists():
        make_chain(Path(CORPUS) / REAL[name], folder, raster_options=["--lmax", "5%"] if name == "d150" else ())
        (folder / "done").touch()
    return folder


def arrays(mesh, folder):
    """Points, connectivity and all arrays of a mesh artifact."""
    vtu = folder / (Path(mesh).stem + "_arrays.vtu")
    must("st-export", mesh, "-o", vtu)
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(vtu))
    reader.Update()
    grid = reader.GetOutput()
    result = {"x": vtk_to_numpy(grid.GetPoints().GetData()),
              "t": vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 3)}
    for data in (grid.GetPointData(), grid.GetCellData()):
        for i in range(data.GetNumberOfArrays()):
            result[data.GetArrayName(i)] = vtk_to_numpy(data.GetArray(i))
    return result


def write_formats(mesh, folder):
    """The mesh in every format: name of the file by suffix."""
    must("st-export", mesh, "-o", folder / "m.vtu")
    must("st-export", mesh, "-o", folder / "m.stl")
    foreign = Mesh(folder / "m.vtu")
    foreign.write_fro(folder / "m.fro")
    foreign.write_msh(folder / "m.msh")
    return {suffix: folder / f"m.{suffix}" for suffix in ("vtu", "stl", "fro", "msh")}


class RoundTrip(ToolTest):
    """A mesh of ours, exported and read back, lies on the same entities."""

    def expect_same(self, good):
        old = arrays(good / "mesh.hdf", self.folder)
        for suffix, path in write_formats(good / "mesh.hdf", self.folder).items():
            merged = self.folder / f"{suffix}.hdf"
            run = must("st-remesh", path, good / "geometry.hdf", good / "sizing.hdf", "--made-for", good / "sizing.hdf",
                       "--merged", merged, "--json")
            self.assertEqual(run.json()["triangles_redone"], 0, run)
            new = arrays(merged, self.folder)
            for name in ("entity_dim", "entity_id", "face"):
                self.assertTrue((new[name] == old[name]).all(), f"{suffix}: {name}")
            if suffix == "stl":  # nodes inside faces in the order of the file, single precision
                size = abs(old["x"]).max()
                self.assertTrue((abs(new["x"] - old["x"])[old["entity_dim"] < 2] < 1e-6 * size).all(), suffix)
            else:
                self.assertTrue((new["x"] == old["x"]).all() and (new["t"] == old["t"]).all(), suffix)
            must("st-check", merged, "--geometry", good / "geometry.hdf", "--sizing", good / "sizing.hdf")

    def test_of_shapes_with_seams_poles_and_holes(self):
        for name in ("box", "sphere", "cylinder", "cone", "torus", "plate_with_hole"):
            with self.subTest(name):
                self.expect_same(artifacts_of(name))

    def test_of_real_models(self):
        if not (Path(CORPUS) / REAL["d150"]).exists():
            self.skipTest("ST_CORPUS names no folder: the round trips of real models are NOT tested")
        for name in REAL:
            with self.subTest(name):
                self.expect_same(corpus_chain(name))


def triangles_of(x, t):
    """Triangles [n] as the bytes of their coordinates, from the corner that comes first on: equal ones are equal to the
    bit."""
    x = x.astype(float) + 0.0  # no negative zeros
    order = np.unique(x, axis=0, return_inverse=True)[1].reshape(-1)
    first = order[t].argmin(axis=1)[:, None]
    turned = np.take_along_axis(t, (first + np.arange(3)) % 3, axis=1)
    return np.ascontiguousarray(x[turned].reshape(-1, 9)).view("V72")[:, 0]


def read_binary_stl(path):
    rows = np.frombuffer(path.read_bytes()[84:], dtype=np.dtype([("f", "<f4", (4, 3)), ("a", "<u2")]))
    return rows["f"][:, 1:].astype(float)


class PointSource(ToolTest):
    """A finer place: the rest of the file stays to the bit."""

    def expect_local(self, good, at, length, reach):
        (self.folder / "s.toml").write_text(f'[[source]]\ntype = "point"\nat = {list(at)}\nlength = {length}\nradius = '
                                            f'{reach / 10}\n')
        finer = self.folder / "finer.hdf"
        must("st-prolong", good / "raster.hdf", "-o", finer, "--sources", self.folder / "s.toml")
        for suffix, path in write_formats(good / "mesh.hdf", self.folder).items():
            merged = self.folder / f"{suffix}.hdf"
            run = must("st-remesh", path, good / "geometry.hdf", finer, "--made-for", good / "sizing.hdf", "--merged",
                       merged, "--json").json()
            self.assertGreater(run["triangles"], run["triangles_before"], suffix)
            self.assertLess(run["triangles_redone"], run["triangles_before"] / 2, suffix)
            must("st-check", merged, "--geometry", good / "geometry.hdf", "--sizing", finer)
            new = arrays(merged, self.folder)
            kept = triangles_of(new["x"], new["t"])
            if suffix == "stl":
                x, t = read_binary_stl(path).reshape(-1, 3), np.arange(3 * run["triangles_before"]).reshape(-1, 3)
            else:
                x, t = Mesh(self.folder / "m.vtu").x, Mesh(self.folder / "m.vtu").triangles
            far = np.linalg.norm(x[t].mean(axis=1) - np.array(at), axis=1) > reach
            self.assertGreater(far.sum(), len(t) / 3)
            self.assertTrue(np.isin(triangles_of(x, t[far]), kept).all(), suffix)
            self.assertGreaterEqual(len(np.intersect1d(kept, triangles_of(x, t))),
                                    run["triangles_before"] - run["triangles_redone"], suffix)

    def test_on_a_seam(self):
        self.expect_local(artifacts_of("cylinder"), (10, 0, 15), 0.2, 8)

    @unittest.skipUnless((Path(CORPUS) / REAL["d150"]).exists(),
                         "ST_CORPUS names no corpus: the source on a real aircraft is NOT tested")
    def test_on_an_aircraft(self):
        self.expect_local(corpus_chain("d150"), (16, 6, -1), 0.05, 5)


class Refused(ToolTest):
    """What does not belong together ends with exit code 7, says why and where, and leaves nothing."""

    def setUp(self):
        super().setUp()
        self.good = artifacts_of("cylinder")
        must("st-export", self.good / "mesh.hdf", "-o", self.folder / "m.vtu")
        self.mesh = Mesh(self.folder / "m.vtu")
        self.out = self.folder / "out"
        self.out.mkdir()

    def expect(self, says, code=MISMATCH, good=None, options=()):
        self.mesh.write_fro(self.folder / "foreign.fro")
        good = good or self.good
        for target in (["--merged", self.out / "m.hdf"], ["-o", self.out / "p.hdf"]):
            self.expect_error(code, "st-remesh", self.folder / "foreign.fro", good / "geometry.hdf",
                              good / "sizing.hdf", *target, *options, says=["foreign.fro", *says])
            self.expect_nothing_left(self.out)

    def test_mesh_in_another_unit(self):
        x = self.mesh.x
        self.mesh.x = 1000 * x
        self.expect(["1000 times as large", "mm for m", "scale the mesh by 0.001"])
        self.mesh.x = x / 25.4
        self.expect(["25.4 times as small", "inches for mm", "25.4"])

    def test_mesh_of_no_unit(self):
        self.mesh.x = 7 * self.mesh.x
        self.expect(["7 times as large", "no unit explains"])

    def test_mesh_elsewhere(self):
        self.mesh.x = self.mesh.x + [0, 0, 10]
        self.expect(["at another place"])

    def test_mesh_of_another_model(self):
        self.expect(["of another geometry"], good=artifacts_of("cone"))

    def test_mesh_that_is_a_little_off(self):
        self.mesh.x = self.mesh.x + [0.3, 0, 0]
        self.expect(["CAD vertices have no node", "0.3 away", "at (10, "])

    def test_bump_off_the_surface(self):
        inner = np.argmin(np.linalg.norm(self.mesh.x - [-10, 0, 15], axis=1))
        self.mesh.x[inner] *= [1.1, 1.1, 1]
        self.expect(["1 nodes of the mesh lie on no face", "--tolerance"])

    def test_hole_in_a_face(self):
        at = np.argmin(np.linalg.norm(self.mesh.x[self.mesh.triangles].mean(axis=1) - [-10, 0, 15], axis=1))
        self.mesh.triangles = np.delete(self.mesh.triangles, at, axis=0)
        self.mesh.surface = np.delete(self.mesh.surface, at)
        self.expect(["holes where the geometry has none", "3 of its edges lack a triangle"])

    def test_inner_wall(self):
        self.mesh.triangles = np.vstack([self.mesh.triangles, self.mesh.triangles[:1]])
        self.mesh.surface = np.append(self.mesh.surface, 1)
        self.expect(["more triangles than the geometry has faces"])

    def test_missing_face(self):
        lid = self.mesh.surface == self.mesh.surface[np.argmax(self.mesh.x[self.mesh.triangles].mean(axis=1)[:, 2])]
        self.mesh.triangles, self.mesh.surface = self.mesh.triangles[~lid], self.mesh.surface[~lid]
        self.expect(["lack a triangle"])

    def test_edge_that_the_mesh_crosses(self):
        x, y, z = self.mesh.x.T
        rim = np.flatnonzero((abs(z - 30) < 1e-9) & (np.hypot(x, y) > 9.99) & (x < 0))
        self.mesh.x[rim[0], 2] -= 0.5
        self.expect(["no chain of mesh edges follows 1 of 3 CAD edges"])

    def test_coordinates_and_lengths_that_are_no_numbers(self):
        self.mesh.x[3, 1] = float("nan")
        self.expect(["node 4", "not finite"], code=INPUT)

    def test_lengths_in_the_file_that_are_no_numbers(self):
        sizes = np.ones(len(self.mesh.x))
        sizes[7] = float("nan")
        self.mesh.write_vtu(self.folder / "sizes.vtu", sizes)
        self.expect_error(INPUT, "st-remesh", self.folder / "sizes.vtu", self.good / "geometry.hdf",
                          self.good / "sizing.hdf", "--merged", self.out / "m.hdf",
                          says=["sizes.vtu", "'size'", "node 8"])
        self.expect_nothing_left(self.out)

    def test_sizing_of_another_geometry(self):
        self.mesh.write_fro(self.folder / "foreign.fro")
        other = artifacts_of("cone")
        self.expect_error(MISMATCH, "st-remesh", self.folder / "foreign.fro", self.good / "geometry.hdf",
                          other / "sizing.hdf", "--merged", self.out / "m.hdf", says="sizing.hdf")
        self.expect_error(MISMATCH, "st-remesh", self.folder / "foreign.fro", self.good / "geometry.hdf",
                          self.good / "sizing.hdf", "--made-for", other / "sizing.hdf", "--merged", self.out / "m.hdf",
                          says="sizing.hdf")
        self.expect_nothing_left(self.out)

    def test_moved_geometry(self):
        self.expect(["--moved"], code=USAGE, options=["--moved"])


class Turned(ToolTest):
    def test_triangles_that_disagree_are_turned(self):
        good = artifacts_of("cylinder")
        must("st-export", good / "mesh.hdf", "-o", self.folder / "m.vtu")
        mesh = Mesh(self.folder / "m.vtu")
        mesh.triangles[::5] = mesh.triangles[::5, ::-1]
        mesh.write_stl(self.folder / "m.stl")
        run = must("st-remesh", self.folder / "m.stl", good / "geometry.hdf", good / "sizing.hdf", "--made-for",
                   good / "sizing.hdf", "--merged", self.folder / "out.hdf", "--json").json()
        self.assertEqual(run["association"]["triangles_turned"], len(mesh.triangles[::5]))
        must("st-check", self.folder / "out.hdf", "--geometry", good / "geometry.hdf", "--sizing", good / "sizing.hdf")


class Checked(ToolTest):
    """st-check takes meshes of other programs as well."""

    def test_as_the_mesh_it_was_exported_from(self):
        good = artifacts_of("cylinder")
        cad = ["--geometry", good / "geometry.hdf", "--sizing", good / "sizing.hdf", "--json"]
        ours = must("st-check", good / "mesh.hdf", *cad).json()
        for suffix, path in write_formats(good / "mesh.hdf", self.folder).items():
            theirs = must("st-check", path, *cad).json()
            for key in ("triangles", "nodes", "failed"):
                self.assertEqual(theirs[key], ours[key], suffix)
            self.assertAlmostEqual(theirs["deviation"]["max"], ours["deviation"]["max"], 5)

    def test_area_tolerance_decides(self):
        good = artifacts_of("box")
        must("st-export", good / "mesh.hdf", "-o", self.folder / "m.vtu")
        mesh = Mesh(self.folder / "m.vtu")
        top = np.flatnonzero(mesh.x[:, 2] > mesh.x[:, 2].max() - 1e-6)
        middle = mesh.x[top].mean(axis=0)
        node = top[np.argmin(np.linalg.norm(mesh.x[top] - middle, axis=1))]
        mesh.x[node, 2] += 0.01  # the face grows by about a millionth
        mesh.write_stl(self.folder / "m.stl")
        for tolerance, fails in ((0.01, False), (1e-9, True)):
            run = Run("st-check", self.folder / "m.stl", "--geometry", good / "geometry.hdf", "--json",
                      "--area-tolerance", tolerance)
            self.assertEqual("areas" in run.json()["failed"], fails, run)

    def test_without_a_geometry(self):
        good = artifacts_of("cylinder")
        must("st-export", good / "mesh.hdf", "-o", self.folder / "m.vtu")
        mesh = Mesh(self.folder / "m.vtu")
        mesh.triangles, mesh.surface = mesh.triangles[1:], mesh.surface[1:]
        mesh.write_fro(self.folder / "open.fro")
        run = Run("st-check", self.folder / "open.fro", "--json")
        self.assertEqual((run.code, run.json()["failed"]), (INCOMPLETE, ["closed"]))
        self.expect_error(USAGE, "st-check", self.folder / "open.fro", "--sizing", good / "sizing.hdf",
                          says="--geometry")
        self.expect_error(MISMATCH, "st-check", self.folder / "open.fro", "--geometry", good / "geometry.hdf",
                          says="holes")


class InsideOut(ToolTest):
    def test_mesh_is_turned_outward(self):
        good = artifacts_of("plate_with_hole")
        must("st-export", good / "mesh.hdf", "-o", self.folder / "m.vtu")
        mesh = Mesh(self.folder / "m.vtu")
        mesh.triangles = mesh.triangles[:, ::-1]
        mesh.write_fro(self.folder / "m.fro")
        must("st-remesh", self.folder / "m.fro", good / "geometry.hdf", good / "sizing.hdf", "--made-for",
             good / "sizing.hdf", "--merged", self.folder / "out.hdf")
        must("st-check", self.folder / "out.hdf", "--geometry", good / "geometry.hdf", "--sizing", good / "sizing.hdf")


@unittest.skipUnless(shutil.which("gmsh"), "there is no gmsh: its meshes are NOT tested")
class Gmsh(ToolTest):
    """Meshes that gmsh made, of its own formats."""

    def expect_remeshed(self, model, good, form):
        msh = self.folder / "gmsh.msh"
        subprocess.run(["gmsh", "-2", model, "-o", msh, "-clcurv", "15", "-v", "0", *form], check=True,
                       capture_output=True)
        merged = self.folder / "m.hdf"
        run = must("st-remesh", msh, good / "geometry.hdf", good / "sizing.hdf", "--merged", merged, "--json").json()
        self.assertEqual(sum(run["association"]["triangles_per_face"]), run["triangles_before"])
        self.assertLess(run["association"]["farthest"], 1e-6)
        must("st-check", merged, "--geometry", good / "geometry.hdf", "--sizing", good / "sizing.hdf")

    def test_of_shapes_in_all_its_formats(self):
        for name, form in [("box", "msh22"), ("cylinder", "msh41"), ("plate_with_hole", "msh22"), ("torus", "msh41")]:
            for binary in ([], ["-bin"]):
                with self.subTest(name=name, form=form, binary=binary):
                    self.expect_remeshed(MODELS / f"{name}.{'step' if name == 'box' else 'brep'}", artifacts_of(name),
                                         ["-format", form, *binary])


class Options(ToolTest):
    def test_tolerance_decides(self):
        good = artifacts_of("cylinder")
        must("st-export", good / "mesh.hdf", "-o", self.folder / "m.stl")
        inputs = [self.folder / "m.stl", good / "geometry.hdf", good / "sizing.hdf", "--merged",
                  self.folder / "out.hdf"]
        self.expect_error(MISMATCH, "st-remesh", *inputs, "--tolerance", "1e-12", says=["m.stl", "--tolerance"])
        must("st-remesh", *inputs, "--tolerance", "1e-3")

    def test_options_of_foreign_meshes_are_refused_with_our_own(self):
        good = artifacts_of("cylinder")
        inputs = [good / "mesh.hdf", good / "geometry.hdf", good / "sizing.hdf", "--merged", self.folder / "out.hdf"]
        self.expect_error(USAGE, "st-remesh", *inputs, "--tolerance", "1e-3", says="--tolerance")
        self.expect_error(USAGE, "st-remesh", *inputs, "--made-for", good / "sizing.hdf", says="--made-for")
        self.expect_nothing_left(self.folder)


if __name__ == "__main__":
    unittest.main(verbosity=2)
