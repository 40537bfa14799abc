"""The Python module: every kind of artifact is read, the chain runs, sizes are those of the tools."""
import importlib.util
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

try:
    import numpy
    import st
except ImportError as e:
    print(f"SKIPPED: {e}; install python3-h5py and run with /usr/bin/python3")
    sys.exit(77)

MODELS, WORK = Path(os.environ["ST_MODELS"]), Path(os.environ["ST_WORK"]) / "python"
EXAMPLE = Path(__file__).parents[2] / "examples/python/grid_family.py"


SOURCES = """
source = [
  {type = "point", at = [5, 5, 5], length = 0.2, radius = 1, doubling = 3},
  {type = "line", points = [[0, 0, 0], [20, 5, 0]], length = [0.3, 3]},
  {type = "line", points = [[0, 20, 0], [20, 15, 3]], length = [0.3, 0.9], radius = [0, 2], doubling = [4, 6]},
  {type = "triangle", points = [[0, 0, 10], [20, 0, 10], [0, 20, 10]], length = [0.4, 1, 2]},
  {type = "triangle", points = [[0, 0, 10], [-9, 0, 10], [0, -9, 10]], length = [0.4, 1, 2], radius = [1, 2, 3]},
  {type = "box", lo = [15, 15, 2], hi = [18, 19, 5], length = 0.4, radius = 0.3},
  {type = "cylinder", from = [25, 2, 2], to = [28, 9, 5], extent = 1, length = 0.3},
  {type = "sphere", at = [22, 12, -5], extent = 2, length = 0.5},
  {type = "disc", at = [12, 12, 15], normal = [1, 2, 3], extent = 2, length = 0.5},
]
"""
BACKGROUND = """background of two tetrahedra
5 2 0 0 0
1 20 18 12
1 0 0 0.3
0 1 0 0.3
0 0 1 0.3
2 29 18 12
1 0 0 0.9
0 1 0 0.9
0 0 1 0.9
3 20 27 12
1 0 0 0.5
0 1 0 0.5
0 0 1 0.5
4 22 20 18
1 0 0 0.4
0 1 0 0.4
0 0 1 0.4
5 22 20 4
1 0 0 0.7
0 1 0 0.7
0 0 1 0.7
1 1 2 3 4
2 1 2 3 5
* points
* lines
* triangles
"""


class Module(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(WORK, ignore_errors=True)
        tempfile.tempdir = WORK / "temporary"  # of its own: what other runs leave there for a while would count
        tempfile.tempdir.mkdir(parents=True)
        cls.said = st.mesh(MODELS / "assembly.step", WORK)

    def test_options_of_stages_and_of_all_reach_them(self):
        out = WORK / "options"
        said = st.mesh(MODELS / "box.step", out, preset="preview", max_folds=2, export=[out / "m.stl"],
                       **{"st-raster": {"lmax": "6%", "allow_incomplete": True}})
        options = st.read(out / "raster.hdf").options
        self.assertEqual((options["alpha"], options["base_cells"]), (20, 1))
        points = st.read(out / "mesh.hdf").points
        self.assertAlmostEqual(options["lmax"], 0.06 * numpy.linalg.norm(points.max(axis=0) - points.min(axis=0)))
        self.assertEqual(said["st-check"]["checks"]["folds"]["allowed"], 2)
        self.assertTrue((out / "m.stl").exists())

    def test_without_a_folder_there_is_a_mesh_of_arrays(self):
        lines = []
        mesh = st.mesh(MODELS / "box.step", preset="preview", progress=lines.append)
        self.assertEqual((mesh.points.shape[1], mesh.triangles.shape[1]), (3, 3))
        self.assertEqual(len(mesh.group), len(mesh.triangles))
        self.assertEqual(len(mesh.size), len(mesh.points))
        self.assertTrue(mesh.said["st-check"]["passes"])
        self.assertEqual(len(mesh["/VTKHDF/Types"]), len(mesh.triangles), "its file is there as long as it is")
        for tool in ("st-import", "st-raster", "st-prolong", "st-mesh", "st-merge"):
            self.assertTrue(any(line.startswith(tool) for line in lines), (tool, lines))
        folder = Path(mesh.path).parent
        del mesh
        self.assertFalse(folder.exists())

    def test_what_a_callback_raises_ends_the_run(self):
        def stop(line):
            raise KeyError(line)
        before = set(Path(tempfile.gettempdir()).glob("st-mesh-*"))
        with self.assertRaises(KeyError):
            st.mesh(MODELS / "box.step", progress=stop)
        with self.assertRaisesRegex(st.ToolError, "no such file"):
            st.mesh("missing.step")
        self.assertEqual(set(Path(tempfile.gettempdir()).glob("st-mesh-*")), before)

    def test_every_kind_is_read_as_what_it_is(self):
        kinds = {"geometry": st.Geometry, "raster": st.Raster, "sizing": st.Sizing, "patches": st.Patches,
                 "mesh": st.Mesh}
        for name, kind in kinds.items():
            artifact = st.read(WORK / f"{name}.hdf")
            self.assertIs(type(artifact), kind)
            self.assertEqual((artifact.schema, artifact.unit, artifact.unit_in_m), (name, "mm", 0.001))
            self.assertEqual(artifact.hash, st.run("st-info", WORK / f"{name}.hdf")["hash"])
            self.assertEqual(artifact.geometry_hash, st.read(WORK / "geometry.hdf").hash)
            for dataset in artifact.names:
                self.assertIsNotNone(artifact[dataset])

    def test_counts_are_those_that_the_tools_said(self):
        geometry, mesh = st.read(WORK / "geometry.hdf"), st.read(WORK / "mesh.hdf")
        self.assertEqual(len(geometry.face_name), self.said["st-import"]["faces"])
        self.assertEqual(len(mesh.triangles), self.said["st-merge"]["triangles"])
        self.assertEqual(st.read(WORK / "patches.hdf").n_triangles, len(mesh.triangles))
        self.assertEqual(st.read(WORK / "patches.hdf").failures, [])
        self.assertEqual(len(geometry.findings), st.run("st-info", WORK / "geometry.hdf")["counts"]["findings"])

    def test_joined_faces_are_those_of_the_mesh(self):
        out = WORK / "joined"
        said = st.mesh(MODELS / "wing_of_8.brep", out, preset="preview", **{"st-import": {"composite": "smooth"}})
        geometry, mesh, joined = st.read(out / "geometry.hdf"), st.read(out / "mesh.hdf"), said["st-import"]["joined"]
        self.assertLess(joined["faces"], said["st-import"]["faces"])
        self.assertEqual(len([faces for faces in geometry.cad_faces if faces]), joined["faces"])
        self.assertEqual(len([edges for edges in geometry.cad_edges if edges]), joined["edges"])
        self.assertEqual(sorted(sum(geometry.cad_faces, [])), list(range(said["st-import"]["faces"])))
        self.assertEqual(len(mesh["/st/face/name"]), said["st-import"]["faces"])
        self.assertEqual(len(set(mesh.cell_data("face").tolist())), joined["faces"])
        for name in geometry.group_name:
            exact = geometry.face_area[geometry.faces_of(name)].sum()
            self.assertAlmostEqual(mesh.area_of(name), exact, delta=0.05 * exact)

    def test_areas_of_groups_are_those_of_their_faces(self):
        geometry, mesh = st.read(WORK / "geometry.hdf"), st.read(WORK / "mesh.hdf")
        self.assertEqual(mesh.group_name, geometry.group_name)
        for name in mesh.group_name:
            exact = geometry.face_area[geometry.faces_of(name)].sum()
            self.assertAlmostEqual(mesh.area_of(name), exact, delta=0.01 * exact)
        self.assertTrue(0.3 < mesh.quality().min() <= mesh.quality().max() <= 1 + 1e-12)

    def test_cells_fill_the_root(self):
        for name in ("raster", "sizing"):
            octree = st.read(WORK / f"{name}.hdf")
            centre, edge = octree.cells()
            self.assertAlmostEqual((edge**3).sum() / octree.root[3] ** 3, 1, places=12)
            self.assertTrue((numpy.abs(centre - octree.root[:3] - octree.root[3] / 2) < octree.root[3] / 2).all())

    def check_sizes(self, sizing, mesh):
        """Inside faces a mesh stores what the field says."""
        inner = mesh.point_data("entity_dim") == 2
        self.assertGreater(inner.sum(), 100)
        found, stored = sizing.size(mesh.points[inner]), mesh.size[inner]
        self.assertLess(numpy.abs(found / stored - 1).max(), 1e-6)  # stored by single precision

    def test_sizes_are_those_that_the_mesh_was_made_for(self):
        self.check_sizes(st.read(WORK / "sizing.hdf"), st.read(WORK / "mesh.hdf"))

    def test_sizes_on_both_sides_of_a_thin_wall_are_those_of_st_info(self):
        folder = WORK / "blanked"
        st.mesh(MODELS / "tube_with_rod.brep", folder)
        sizing = folder / "blanked.hdf"
        st.run("st-prolong", folder / "raster.hdf", output=sizing, blank=folder / "mesh.hdf")
        field = st.read(sizing)
        leaf, plane = field["/st/split/leaf"], field["/st/split/plane"].astype(float)
        self.assertGreater(len(leaf), 100)
        centre, edge = field.cells()
        # where the two parts ask for the most different lengths
        cell, second = field["/st/octree/cell"][leaf, 0], field["/st/split/cell"][:, 0]
        worst = numpy.argsort(-numpy.abs(numpy.log(cell / second)))[:4]
        sides = []
        for k in worst:
            for way in (-0.45, 0.45):
                x = centre[leaf[k]] + way * edge[leaf[k]] * plane[k, :3] / numpy.abs(plane[k, :3]).max()
                said = st.run("st-info", sizing, at=",".join(map(repr, x.tolist())))["length"]
                sides.append(said)
                self.assertAlmostEqual(field.size(x)[0] / said, 1, places=6)
        self.assertGreater(max(sides[k + 1] / sides[k] for k in range(0, 8, 2)), 1.02, sides)

    def test_sizes_of_sources_and_a_background_are_those_of_st_prolong(self):
        folder = WORK / "sources"
        folder.mkdir()
        (folder / "s.toml").write_text(SOURCES)
        (folder / "b.bac").write_text(BACKGROUND)
        lo, hi = st.read(WORK / "mesh.hdf").points.min(axis=0), st.read(WORK / "mesh.hdf").points.max(axis=0)
        points = lo + (hi - lo) * (numpy.random.default_rng(3).random((2000, 3)) * 1.6 - 0.3)
        numpy.savetxt(folder / "p.csv", points, delimiter=",", fmt="%.17g")
        st.run("st-prolong", WORK / "raster.hdf", output=folder / "sizing.hdf", sources=folder / "s.toml",
               background=folder / "b.bac", sample=folder / "p.csv", sample_output=folder / "o.csv")
        said = numpy.genfromtxt(folder / "o.csv", delimiter=",", names=True, usecols=range(7))["length"]
        causes = {line.rsplit(",", 1)[1] for line in (folder / "o.csv").read_text().splitlines()[1:]}
        self.assertGreater(len(causes & {f'"source {i}"' for i in range(1, 10)}), 7, causes)
        self.assertIn('"the background mesh"', causes)
        self.assertLess(numpy.abs(st.read(folder / "sizing.hdf").size(points) / said - 1).max(), 1e-6)

    def test_sizes_of_a_field_that_was_moved_with_its_geometry(self):
        moved = WORK / "moved"
        moved.mkdir()
        st.run("st-edit", WORK / "geometry.hdf", output=moved / "geometry.hdf",
               transform="rotate 1 2 3 40; mirror 1 0 0; scale 2; translate 5 6 7")
        st.run("st-prolong", WORK / "raster.hdf", geometry=moved / "geometry.hdf", output=moved / "sizing.hdf")
        st.run("st-mesh", moved / "geometry.hdf", moved / "sizing.hdf", output=moved / "patches.hdf")
        st.run("st-merge", moved / "patches.hdf", output=moved / "mesh.hdf")
        self.check_sizes(st.read(moved / "sizing.hdf"), st.read(moved / "mesh.hdf"))

    def test_errors_carry_code_and_message(self):
        with self.assertRaises(st.ToolError) as caught:
            st.run("st-raster", WORK / "mesh.hdf", output=WORK / "x.hdf")
        self.assertEqual(caught.exception.code, 3)
        self.assertIn("mesh.hdf", str(caught.exception))
        self.assertEqual(st.run("st-diff", WORK / "mesh.hdf", WORK / "mesh.hdf")["equal"], True)
        for options, says in (({"st-rastr": {}}, "did you mean 'st-raster'"), ({"st-raster": {"lmx": 3}}, "lmx"),
                              ({"st-raster": {"lmax": "x"}}, "lmax"), ({"lmx": 3}, "--lmx")):
            with self.assertRaises(st.ToolError) as caught:
                st.mesh(MODELS / "box.step", WORK / "x", **options)
            self.assertEqual(caught.exception.code, 2)
            self.assertIn(says, caught.exception.message)
        with self.assertRaisesRegex(TypeError, r"o\.toml.*st-raster"):
            st.mesh(MODELS / "box.step", WORK / "x", options="o.toml", **{"st-raster": {"lmax": "2%"}})
        (WORK / "no.hdf").write_text("no artifact")
        self.assertRaises(OSError, st.read, WORK / "no.hdf")

    def test_the_worked_script_runs(self):
        command = [sys.executable, EXAMPLE, MODELS / "assembly.step", WORK / "family", "2"]
        done = subprocess.run(command, capture_output=True, text=True, check=True)
        rows = [line for line in done.stdout.splitlines() if line.startswith("level")]
        self.assertEqual(len(rows), 2)
        coarse, fine = (int(row.split()[2]) for row in rows)
        self.assertTrue(3.5 < fine / coarse < 4.5, done.stdout)

    @unittest.skipUnless(importlib.util.find_spec("vtk") and shutil.which("xvfb-run"), "no VTK, or no xvfb-run")
    def test_the_script_with_pictures_draws_them(self):
        folder = WORK / "pictures"
        folder.mkdir(parents=True, exist_ok=True)
        done = subprocess.run(["xvfb-run", "-a", sys.executable, EXAMPLE.with_name("with_pictures.py"),
                               MODELS / "assembly.step", folder], capture_output=True, text=True, check=True)
        self.assertRegex(done.stdout, r"(?m)^\d+ triangles, passes$")
        for name in ("quality.png", "size.png"):
            self.assertGreater((folder / name).stat().st_size, 10000, "the picture is empty")


if __name__ == "__main__":
    unittest.main()
