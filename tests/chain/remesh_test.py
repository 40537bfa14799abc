"""st-remesh over the chain: a local change remeshes locally, at any number of ranks; the rest stays to the bit."""
import os
import re
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
from chain import BIN, INPUT, MISMATCH, MODELS, OK, USAGE, Run, ToolTest, content_hash, make_chain, must  # noqa: E402

SOURCE = '[[source]]\nname = "p"\ntype = "point"\nat = [{}, {}, {}]\nlength = "{}"\nradius = "{}"\n'


class LocalChange(ToolTest):
    """A point source at a corner of a block; sizes elsewhere stay."""

    def setUp(self):
        super().setUp()
        self.chain = make_chain(MODELS / "block_with_hole.step", self.folder / "chain", raster_options=["--lmax", "3%"])
        self.geometry = self.chain / "geometry.hdf"

    def size(self, name, at=(0, 0, 0), length="0.6%", radius="3%"):
        sources = self.folder / f"{name}.toml"
        sources.write_text(SOURCE.format(*at, length, radius))
        must("st-prolong", self.chain / "raster.hdf", "-o", self.folder / f"{name}.hdf", "--sources", sources)
        return self.folder / f"{name}.hdf"

    def remesh(self, mesh, sizing, name, *options):
        patches, result = self.folder / f"{name}_patches.hdf", self.folder / f"{name}.mesh.hdf"
        run = must("st-remesh", mesh, self.geometry, sizing, "-o", patches, "--json", *options)
        must("st-merge", patches, "-o", result)
        must("st-check", result, "--geometry", self.geometry, "--sizing", sizing)
        return result, run.json()

    def test_a_source_is_redone_locally_and_equally_at_np_1_2_3_5(self):
        sizing, hashes = self.size("source"), set()
        for n_ranks in (1, 2, 3, 5):
            mesh, facts = self.remesh(self.chain / "mesh.hdf", sizing, f"np{n_ranks}", "--np", n_ranks)
            hashes.add((content_hash(mesh), facts["marks_hash"]))
            self.assertGreater(facts["triangles_redone"], 0)
            self.assertLess(facts["triangles_redone"], 0.5 * facts["triangles_before"])
            self.assertGreater(facts["triangles"], facts["triangles_before"])
        self.assertEqual(len(hashes), 1)

    def test_marks_and_mesh_of_a_single_face_are_equal_at_np_1_2_3_5(self):
        sphere = make_chain(MODELS / "sphere.brep", self.folder / "sphere")
        (self.folder / "poles.toml").write_text(SOURCE.format(0, 0, 10, "0.8%", "8%") +
                                                SOURCE.format(10, 0, 0, "0.8%", "8%"))
        must("st-prolong", sphere / "raster.hdf", "-o", self.folder / "poles.hdf", "--sources",
             self.folder / "poles.toml")
        results = set()
        for n_ranks in (1, 2, 3, 5):
            mesh = self.folder / f"sphere{n_ranks}.hdf"
            facts = must("st-remesh", sphere / "mesh.hdf", sphere / "geometry.hdf", self.folder / "poles.hdf",
                         "--merged", mesh, "--np", n_ranks, "--json").json()
            results.add((content_hash(mesh), facts["marks_hash"], facts["triangles_redone"]))
            must("st-check", mesh, "--geometry", sphere / "geometry.hdf", "--sizing", self.folder / "poles.hdf")
        self.assertEqual(len(results), 1)
        self.assertGreater(facts["triangles_redone"], 0)
        self.assertLess(facts["triangles_redone"], facts["triangles_before"])

    def test_a_second_run_with_the_same_sizes_changes_almost_nothing(self):
        sizing = self.size("source")
        mesh, first = self.remesh(self.chain / "mesh.hdf", sizing, "first")
        _, second = self.remesh(mesh, sizing, "second")
        self.assertLess(second["triangles_redone"],
                        0.1 * (first["triangles_redone"] + first["triangles"] - first["triangles_before"]))

    def test_refining_and_taking_back_returns_to_the_number_of_triangles(self):
        mesh, refined = self.remesh(self.chain / "mesh.hdf", self.size("source"), "refined")
        _, restored = self.remesh(mesh, self.chain / "sizing.hdf", "restored")
        n = refined["triangles_before"]
        self.assertGreater(refined["triangles"], 1.05 * n)
        self.assertLess(abs(restored["triangles"] - n), 0.05 * n)

    def test_a_kept_group_keeps_its_triangles(self):
        box = make_chain(MODELS / "box.brep", self.folder / "box")
        must("st-prolong", box / "raster.hdf", "-o", self.folder / "finer.hdf", "--scale", "0.5")
        inputs = [box / "mesh.hdf", box / "geometry.hdf", self.folder / "finer.hdf", "--dry-run", "--json"]
        facts = must("st-remesh", *inputs).json()
        self.assertEqual(facts["triangles_redone"], facts["triangles_before"])
        self.assertEqual(must("st-remesh", *inputs, "--keep", "default").json()["triangles_redone"], 0)

    def test_keeping_a_group_that_is_none_is_a_usage_error(self):
        run = Run("st-remesh", self.chain / "mesh.hdf", self.geometry, self.chain / "sizing.hdf", "--dry-run", "--keep",
                  "no such group")
        self.assertEqual(run.code, USAGE, str(run))
        self.assertIn("no such group", run.err)

    def test_unchanged_sizes_keep_the_hash(self):
        mesh, facts = self.remesh(self.chain / "mesh.hdf", self.chain / "sizing.hdf", "same")
        self.assertEqual(facts["triangles_redone"], 0)
        self.assertEqual(content_hash(mesh), content_hash(self.chain / "mesh.hdf"))

    def test_the_merged_output_is_the_mesh_of_st_merge(self):
        sizing = self.size("source")
        mesh, _ = self.remesh(self.chain / "mesh.hdf", sizing, "by_merge")
        for n_ranks in (1, 2, 3):
            must("st-remesh", self.chain / "mesh.hdf", self.geometry, sizing, "--merged", self.folder / "merged.hdf",
                 "--np", n_ranks)
            self.assertEqual(content_hash(self.folder / "merged.hdf"), content_hash(mesh))

    def test_ten_steps_of_a_moving_source_do_not_drift(self):
        environment = {**os.environ, "FROM": "-1 -1 0", "TO": "60 40 20", "LENGTH": "0.6", "RADIUS": "3", "FRAMES": "0"}
        script = Path(__file__).resolve().parents[2] / "examples" / "moving_source" / "move_source.sh"
        done = subprocess.run([script, self.chain, BIN], env=environment, capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, OK, done.stdout + done.stderr)
        self.assertIn("drift of quality", done.stdout)

    def node_sizes(self, values):
        """A .vtu with these lengths as point data; only that part of it is read."""
        text = "\n".join(str(v) for v in values)
        path = self.folder / "lengths.vtu"
        path.write_text(f'<VTKFile type="UnstructuredGrid"><PointData><DataArray type="Float64" Name="h" '
                        f'format="ascii">{text}</DataArray></PointData></VTKFile>')
        return f"{path}:h"

    def remesh_on_nodes(self, lengths):
        mesh = self.folder / "on_nodes.hdf"
        run = Run("st-remesh", self.chain / "mesh.hdf", self.geometry, self.chain / "sizing.hdf", "--merged", mesh,
                  "--sizes-on-nodes", lengths, "--json")
        return run, mesh

    def test_lengths_on_nodes_refine_and_coarsen(self):
        before = must("st-check", self.chain / "mesh.hdf", "--json").json()
        n_nodes, n = before["nodes"], before["triangles"]
        mean = (before["area"] / n * 4 / 3**0.5) ** 0.5  # side of the mean triangle
        for factor in (0.5, 2):
            run, mesh = self.remesh_on_nodes(self.node_sizes([factor * mean] * n_nodes))
            self.assertEqual(run.code, OK, str(run))
            after = must("st-check", mesh, "--geometry", self.geometry, "--json").json()
            self.assertLess(after["triangles"] * factor**2 / n, 1.6)
            self.assertGreater(after["triangles"] * factor**2 / n, 0.7)

    def test_the_stored_lengths_of_the_mesh_change_nothing(self):
        must("st-export", self.chain / "mesh.hdf", "-o", self.folder / "mesh.vtu")
        for file in (self.folder / "mesh.vtu", self.chain / "mesh.hdf"):
            run, mesh = self.remesh_on_nodes(f"{file}:size")
            self.assertEqual(run.code, OK, str(run))
            self.assertEqual(run.json()["triangles_redone"], 0)

    def test_bad_lengths_on_nodes_are_refused_and_nothing_is_written(self):
        n = must("st-check", self.chain / "mesh.hdf", "--json").json()["nodes"]
        good = [1.0] * n
        for bad, expected in [(good[1:], f"has {n - 1} values"), (["nan"] + good[1:], "is nan at node 0"),
                              (good[1:] + [-1], f"is -1 at node {n - 1}"),
                              (good[1:] + ["inf"], "is inf")]:
            run, mesh = self.remesh_on_nodes(self.node_sizes(bad))
            self.assertEqual(run.code, INPUT, str(run))
            self.assertIn(expected, run.err)
            self.assertFalse(mesh.exists())
        for lengths, code in [("lengths.vtu", USAGE), (f"{self.chain / 'mesh.hdf'}:nothing", INPUT),
                              (f"{self.folder / 'missing.vtu'}:h", INPUT)]:
            run, mesh = self.remesh_on_nodes(lengths)
            self.assertEqual(run.code, code, str(run))
            self.assertFalse(mesh.exists())

    def test_values_at_nodes_are_carried_alike_at_any_number_of_ranks_and_threads(self):
        n = must("st-check", self.chain / "mesh.hdf", "--json").json()["nodes"]
        values, same = " ".join(str(i * 0.1) for i in range(n)), " ".join(["7"] * n)
        (self.folder / "p.vtu").write_text(
            f'<VTKFile type="UnstructuredGrid"><PointData><DataArray type="Float64" Name="p" format="ascii">{values}'
            f'</DataArray><DataArray type="Float64" Name="c" format="ascii">{same}</DataArray></PointData></VTKFile>')
        hashes = set()
        for options in ((), ("--threads", 1), ("--np", 2)):
            mesh = self.folder / "carried.hdf"
            must("st-remesh", self.chain / "mesh.hdf", self.geometry, self.size("source"), "--merged", mesh,
                 "--interpolate", f"{self.folder / 'p.vtu'}:p,c", *options)
            hashes.add(content_hash(mesh))
        self.assertEqual(len(hashes), 1)
        must("st-check", mesh, "--geometry", self.geometry)
        self.expect_error(USAGE, "st-remesh", self.chain / "mesh.hdf", self.geometry, self.chain / "sizing.hdf", "-o",
                          self.folder / "p.hdf", "--interpolate", f"{self.folder / 'p.vtu'}:p", says="--merged")

    def move_end(self, by):
        """The block with its end at x = 60 moved, and a chain of its own."""
        def moved(match):
            x = [float(v) for v in match.group(1).split(",")]
            is_moved = len(x) == 3 and x[0] >= 50
            return f"CARTESIAN_POINT('',({x[0] + by!r},{x[1]!r},{x[2]!r}))" if is_moved else match.group(0)
        model = self.folder / "moved.step"
        model.write_text(re.sub(r"CARTESIAN_POINT\(''\s*,\s*\(([^)]*)\)\)", moved,
                                (MODELS / "block_with_hole.step").read_text()))
        return make_chain(model, self.folder / "moved", raster_options=["--lmax", "3%"])

    def test_a_mesh_follows_its_geometry(self):
        moved = self.move_end(9)
        inputs = [self.chain / "mesh.hdf", moved / "geometry.hdf", moved / "sizing.hdf"]
        run = Run("st-remesh", *inputs, "--merged", self.folder / "m.hdf")
        self.assertEqual(run.code, MISMATCH, str(run))
        facts = must("st-remesh", *inputs, "--moved", "--merged", self.folder / "m.hdf", "--json").json()
        self.assertLess(facts["triangles_redone"], 0.5 * facts["triangles_before"])
        must("st-check", self.folder / "m.hdf", "--geometry", moved / "geometry.hdf", "--sizing", moved / "sizing.hdf",
             "--min-size-share", "0.95")
        self.assertEqual(content_hash(self.remesh_moved(self.geometry, self.chain / "sizing.hdf")),
                         content_hash(self.chain / "mesh.hdf"))

    def remesh_moved(self, geometry, sizing):
        must("st-remesh", self.chain / "mesh.hdf", geometry, sizing, "--moved", "--merged", self.folder / "again.hdf")
        return self.folder / "again.hdf"

    def test_a_geometry_of_other_topology_is_no_moved_one(self):
        for model, expected in (("box.step", "6 faces"), ("plate_with_hole.brep", "1 face")):
            other = make_chain(MODELS / model, self.folder / model)
            run = Run("st-remesh", self.chain / "mesh.hdf", other / "geometry.hdf", other / "sizing.hdf", "--moved",
                      "--merged", self.folder / "m.hdf")
            self.assertEqual(run.code, MISMATCH, str(run))
            self.assertIn(expected, run.err)
            self.assertFalse((self.folder / "m.hdf").exists())


CORPUS = Path(os.environ.get("ST_CORPUS") or Path(__file__).resolve().parents[2] / "../shared/corpus").resolve()
AIRCRAFT = "aero_d150_wing_body_half.brep"
SOURCES = """
[[source]]
name = "nose"
type = "point"
at = [1, 0.5, 0.5]
length = 0.03
radius = 1
[[source]]
name = "wing"
type = "line"
points = [[16, 5, -0.6], [20, 10, -0.2]]
length = 0.05
radius = 0.6
[[source]]
name = "rear"
type = "triangle"
points = [[28, 0, 1], [32, 0, 1.5], [30, 2, 0.5]]
length = 0.06
radius = 0.5
"""


@unittest.skipUnless((CORPUS / AIRCRAFT).exists(), f"SKIPPED: {CORPUS / AIRCRAFT} not found, set ST_CORPUS")
class Aircraft(ToolTest):
    """Three sources on a half aircraft."""

    def verdict(self, mesh, sizing):
        return must("st-check", mesh, "--geometry", self.chain / "geometry.hdf", "--sizing", sizing, "--json").json()

    def test_sources_are_met_and_nothing_else_moves(self):
        self.chain = make_chain(CORPUS / AIRCRAFT, self.folder / "chain")
        (self.folder / "sources.toml").write_text(SOURCES)
        sizing, mesh, fresh = (self.folder / f"{n}.hdf" for n in ("sizing", "mesh", "fresh"))
        must("st-prolong", self.chain / "raster.hdf", "-o", sizing, "--sources", self.folder / "sources.toml")
        facts = must("st-remesh", self.chain / "mesh.hdf", self.chain / "geometry.hdf", sizing, "--merged", mesh,
                     "--json").json()
        self.assertGreater(facts["triangles_redone"], 0.01 * facts["triangles_before"])
        self.assertLess(facts["triangles_redone"], 0.3 * facts["triangles_before"])
        must("st-mesh", self.chain / "geometry.hdf", sizing, "-o", self.folder / "patches.hdf")
        must("st-merge", self.folder / "patches.hdf", "-o", fresh)
        redone, again = self.verdict(mesh, sizing), self.verdict(fresh, sizing)
        self.assertGreater(redone["sizes"]["free"]["share"], 0.95)
        for measure in ("mean", "p1"):
            self.assertLess(abs(redone["quality"][measure] - again["quality"][measure]), 0.01, measure)
        self.check_kept(self.chain / "mesh.hdf", mesh, facts)

    def check_kept(self, before, after, facts):
        """Triangles with a number in the mesh before have its corners, to the bit."""
        try:
            import vtk
            from vtk.util.numpy_support import vtk_to_numpy
        except ImportError:
            print("SKIPPED: python3 has no VTK, coordinates of kept triangles not compared")
            return

        def corners(path):
            reader = vtk.vtkHDFReader()
            reader.SetFileName(str(path))
            reader.Update()
            grid = reader.GetOutput()
            triangles = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 3)
            return vtk_to_numpy(grid.GetPoints().GetData())[triangles], grid.GetCellData()

        old, _ = corners(before)
        new, cells = corners(after)
        previous = vtk_to_numpy(cells.GetArray("previous_id"))
        kept = previous >= 0
        self.assertEqual(kept.sum(), facts["triangles_before"] - facts["triangles_redone"])
        self.assertEqual(new[kept].tobytes(), old[previous[kept]].tobytes())

WING = "aero_onera_m6_sharpte.brep"


@unittest.skipUnless((CORPUS / WING).exists(), f"SKIPPED: {CORPUS / WING} not found, set ST_CORPUS")
class Wing(ToolTest):
    """A mesh without stretch, for sizes with."""

    def test_becomes_as_stretched_as_a_new_mesh_and_then_stays(self):
        plain = make_chain(CORPUS / WING, self.folder / "plain")
        geometry, raster, sizing, patches, new, old = (self.folder / f"{n}.hdf" for n in (
            "geometry", "raster", "sizing", "patches", "new", "old"))
        shutil.copy(plain / "geometry.hdf", geometry)
        must("st-raster", geometry, "-o", raster, "--max-aspect", 16, "--leading-edges", "0.2%")
        must("st-prolong", raster, "-o", sizing)
        must("st-mesh", geometry, sizing, "-o", patches)
        must("st-merge", patches, "-o", new)
        hashes = set()
        for n_ranks in (1, 3):
            must("st-remesh", plain / "mesh.hdf", geometry, sizing, "--merged", old, "--np", n_ranks)
            hashes.add(content_hash(old))
        self.assertEqual(len(hashes), 1)
        made, redone = (must("st-check", m, "--geometry", geometry, "--sizing", sizing, "--json").json()
                        for m in (new, old))
        self.assertGreater(redone["quality"]["mean"], made["quality"]["mean"] - 0.01)
        self.assertAlmostEqual(redone["triangles"] / made["triangles"], 1, delta=0.1)
        again = must("st-remesh", new, geometry, sizing, "--dry-run", "--json").json()
        self.assertEqual((again["triangles_redone"], again["segments_redone"]), (0, 0))


if __name__ == "__main__":
    unittest.main(verbosity=2)
