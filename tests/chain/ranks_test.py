"""The number of ranks changes nothing: the chain at np 1, 2 and 3 gives the same content, and twice the same bytes."""
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
from chain import BIN, MISMATCH, MODELS, ToolTest, content_hash, make_chain, must  # noqa: E402

ARTIFACTS = ["geometry.hdf", "raster.hdf", "sizing.hdf", "patches.hdf", "mesh.hdf"]


class Ranks(ToolTest):
    def expect_equal_chains(self, model):
        hashes = {}
        for n_ranks in (1, 2, 3):
            folder = make_chain(MODELS / model, self.folder / str(n_ranks), n_ranks)
            hashes[n_ranks] = {name: content_hash(folder / name) for name in ARTIFACTS}
        self.assertEqual(hashes[2], hashes[1], f"{model} at np 2")
        self.assertEqual(hashes[3], hashes[1], f"{model} at np 3")

    def test_block_with_hole_is_equal_at_np_1_2_3(self):
        self.expect_equal_chains("block_with_hole.step")

    def test_assembly_is_equal_at_np_1_2_3(self):
        self.expect_equal_chains("assembly.step")

    def test_torus_with_fewer_faces_than_ranks_is_equal_at_np_1_2_3(self):
        self.expect_equal_chains("torus.brep")

    def test_remesh_is_equal_at_np_1_2_3(self):
        a = make_chain(MODELS / "block_with_hole.step", self.folder / "a")
        must("st-prolong", a / "raster.hdf", "-o", self.folder / "finer.hdf", "--scale", "0.6")
        hashes = set()
        for n_ranks in (1, 2, 3):
            patches, mesh = self.folder / f"p{n_ranks}.hdf", self.folder / f"m{n_ranks}.hdf"
            must("st-remesh", a / "mesh.hdf", a / "geometry.hdf", self.folder / "finer.hdf", "-o", patches, "--np",
                 n_ranks)
            must("st-merge", patches, "-o", mesh)
            must("st-check", mesh, "--geometry", a / "geometry.hdf")
            hashes.add(content_hash(mesh))
        self.assertEqual(len(hashes), 1)
        self.assertNotEqual(hashes.pop(), content_hash(a / "mesh.hdf"))

    def test_an_old_copy_of_an_input_on_another_rank_is_refused(self):
        a, b = (make_chain(MODELS / "box.step", self.folder / name, raster_options=["--lmax", lmax])
                for name, lmax in (("a", "10%"), ("b", "20%")))
        stages = [("st-mesh", ["geometry.hdf", "sizing.hdf"], "sizing.hdf"),
                  ("st-remesh", ["mesh.hdf", "geometry.hdf", "sizing.hdf"], "mesh.hdf")]
        for tool, inputs, differs in stages:
            words = ["mpirun", "--allow-run-as-root", "--oversubscribe"]
            for i, folder in enumerate((a, b)):
                words += [*([":"] if i else []), "-np", "1", BIN / tool, *(folder / name for name in inputs), "-o",
                          self.folder / "p.hdf"]
            done = subprocess.run(words, capture_output=True, text=True, timeout=60)
            self.assertEqual(done.returncode, MISMATCH, done)
            self.assertIn(f"{a / differs}: rank 1 on ", done.stderr)
            self.assertFalse((self.folder / "p.hdf").exists())

    def test_two_runs_give_the_same_bytes(self):
        a, b = (make_chain(MODELS / "cone.brep", self.folder / name) for name in "ab")
        for name in ARTIFACTS:
            self.assertEqual((a / name).read_bytes(), (b / name).read_bytes(), name)


if __name__ == "__main__":
    unittest.main(verbosity=2)
