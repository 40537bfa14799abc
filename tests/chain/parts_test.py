"""Parts of a model meshed apart fit: the edge nodes of the first are given to the others, and the merged mesh is that
of one run."""
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
from chain import INCOMPLETE, MODELS, USAGE, Run, ToolTest, content_hash, make_chain, must  # noqa: E402


class Parts(ToolTest):
    def setUp(self):
        super().setUp()
        self.whole = make_chain(MODELS / "block_with_hole.step", self.folder / "whole")
        self.input = [self.whole / "geometry.hdf", self.whole / "sizing.hdf"]

    def test_two_parts_merge_to_the_mesh_of_one_run(self):
        a, b, mesh = self.folder / "a.hdf", self.folder / "b.hdf", self.folder / "mesh.hdf"
        must("st-mesh", *self.input, "-o", a, "--faces", "1-3")
        must("st-mesh", *self.input, "-o", b, "--faces", "4-7", "--edges", a, "--np", 2)
        must("st-merge", a, b, "-o", mesh)
        self.assertEqual(content_hash(mesh), content_hash(self.whole / "mesh.hdf"))

    def test_a_part_alone_is_incomplete(self):
        a = self.folder / "a.hdf"
        must("st-mesh", *self.input, "-o", a, "--faces", "2")
        run = Run("st-merge", a, "-o", self.folder / "mesh.hdf")
        self.assertEqual(run.code, INCOMPLETE, str(run))
        self.assertFalse((self.folder / "mesh.hdf").exists())

    def test_a_face_that_is_none_is_a_usage_error(self):
        for faces in ("0", "99", "1-99", "x", "1,,2"):
            run = Run("st-mesh", *self.input, "-o", self.folder / "a.hdf", "--faces", faces)
            self.assertEqual(run.code, USAGE, str(run))
            self.assertIn("--faces", run.err)

    def test_an_unknown_group_is_a_usage_error(self):
        run = Run("st-mesh", *self.input, "-o", self.folder / "a.hdf", "--group", "no such group")
        self.assertEqual(run.code, USAGE, str(run))
        self.assertIn("no such group", run.err)


if __name__ == "__main__":
    unittest.main()
