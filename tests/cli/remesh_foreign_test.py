"""st-remesh on meshes of other programs: they are associated to the geometry, and refused where they do not belong to it."""
import os
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
from chain import *  # noqa: E402,F403
from mesh_formats import Mesh  # noqa: E402

from vtkmodules.util.numpy_support import vtk_to_numpy  # noqa: E402
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader  # noqa: E402

CORPUS = os.environ.get("ST_CORPUS", "")
REAL = {"screw": "mech_netgen_screw.step", "sphere_cube": "basic_refine_sphere_cube.brep", "d150": "aero_d150_wing_body_half.brep"}


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
    result = {"x": vtk_to_numpy(grid.GetPoints().GetData()), "t": vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 3)}
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
            run = must("st-remesh", path, good / "geometry.hdf", good / "sizing.hdf", "--made-for", good / "sizing.hdf", "--merged", merged, "--json")
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


class Options(ToolTest):
    def test_tolerance_decides(self):
        good = artifacts_of("cylinder")
        must("st-export", good / "mesh.hdf", "-o", self.folder / "m.stl")
        inputs = [self.folder / "m.stl", good / "geometry.hdf", good / "sizing.hdf", "--merged", self.folder / "out.hdf"]
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
