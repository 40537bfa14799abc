"""st-remesh over the chain: a local change is redone locally, at any number of ranks, and what is kept is kept to the bit."""
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
from chain import *  # noqa: E402,F403

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
            hashes.add(content_hash(mesh))
            self.assertGreater(facts["triangles_redone"], 0)
            self.assertLess(facts["triangles_redone"], 0.5 * facts["triangles_before"])
            self.assertGreater(facts["triangles"], facts["triangles_before"])
        self.assertEqual(len(hashes), 1)

    def test_a_second_run_with_the_same_sizes_changes_almost_nothing(self):
        sizing = self.size("source")
        mesh, first = self.remesh(self.chain / "mesh.hdf", sizing, "first")
        _, second = self.remesh(mesh, sizing, "second")
        self.assertLess(second["triangles_redone"], 0.1 * (first["triangles_redone"] + first["triangles"] - first["triangles_before"]))

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
        run = Run("st-remesh", self.chain / "mesh.hdf", self.geometry, self.chain / "sizing.hdf", "--dry-run", "--keep", "no such group")
        self.assertEqual(run.code, USAGE, str(run))
        self.assertIn("no such group", run.err)

    def test_unchanged_sizes_keep_the_hash(self):
        mesh, facts = self.remesh(self.chain / "mesh.hdf", self.chain / "sizing.hdf", "same")
        self.assertEqual(facts["triangles_redone"], 0)
        self.assertEqual(content_hash(mesh), content_hash(self.chain / "mesh.hdf"))


if __name__ == "__main__":
    unittest.main(verbosity=2)
