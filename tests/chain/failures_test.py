"""A face that nobody can mesh: named, shown in an artifact of its own, whatever the number of ranks; the others are
meshed."""
import math
import re
import signal
import struct
import subprocess
import sys
import time
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
from chain import BIN, INCOMPLETE, MODELS, OK, Run, ToolTest, content_hash, must  # noqa: E402


VTK_LINE = 3
CODES = {"Int32": "i", "Int64": "q", "UInt8": "B", "Float64": "d"}


def vtu_arrays(path):
    """The arrays of a .vtu with raw appended data, by name."""
    head, _, block = path.read_bytes().partition(b'encoding="raw">\n_')
    arrays = {}
    for kind, name, offset in re.findall(r'type="(\w+)" Name="(\w+)" .*?offset="(\d+)"', head.decode()):
        (n_bytes,) = struct.unpack_from("<Q", block, int(offset))
        arrays[name] = struct.unpack_from(f"<{n_bytes // struct.calcsize(CODES[kind])}{CODES[kind]}", block,
                                          int(offset) + 8)
    return arrays


class Failures(ToolTest):
    def sizes_of(self, model):
        must("st-import", MODELS / model, "-o", self.folder / "geometry.hdf")
        must("st-raster", self.folder / "geometry.hdf", "-o", self.folder / "raster.hdf")
        must("st-prolong", self.folder / "raster.hdf", "-o", self.folder / "sizing.hdf")

    def mesh(self, name="patches.hdf", n_ranks=1, *options):
        ranks = ["--np", n_ranks] if n_ranks > 1 else []
        return Run("st-mesh", self.folder / "geometry.hdf", self.folder / "sizing.hdf", "-o", self.folder / name,
                   "--json", *ranks, *options)

    def test_a_crossed_loop_is_named_with_cause_remedy_and_place_and_the_job_goes_on(self):
        self.sizes_of("crossed_loop.brep")
        run = self.mesh()
        self.assertEqual(run.code, INCOMPLETE, run)
        summary = run.json()
        self.assertEqual((summary["faces_meshed"], summary["faces_failed"]), (2, 1))
        failure = summary["failures"][0]
        self.assertEqual(failure["face"], 2)
        self.assertIn("cross", failure["cause"])
        self.assertIn("CAD", failure["remedy"])
        for k, value in enumerate([5, -5, 0]):
            self.assertAlmostEqual(failure["xyz"][k], value, delta=0.1)
        self.assertTrue(failure["is_closed"])
        self.assertIn("face 2 closed from its edges alone", run.err)
        self.assertIn("patches.failures.hdf", run.err)
        self.assertEqual(summary["failures_file"], str(self.folder / "patches.failures.hdf"))

    def test_the_failures_artifact_is_the_same_at_np_1_and_3(self):
        self.sizes_of("crossed_loop.brep")
        for n_ranks in (1, 3):
            self.assertEqual(self.mesh(f"{n_ranks}.hdf", n_ranks).code, INCOMPLETE)
        a, b = (self.folder / f"{n}.failures.hdf" for n in (1, 3))
        self.assertEqual(a.read_bytes(), b.read_bytes())
        self.assertEqual(content_hash(self.folder / "1.hdf"), content_hash(self.folder / "3.hdf"))
        info = must("st-info", a, "--json").json()
        self.assertEqual(info["counts"]["failures"], 1)
        self.assertGreater(info["counts"]["cells"], 4)

    def test_the_boundary_is_shown_in_space_and_exported(self):
        self.sizes_of("crossed_loop.brep")
        self.mesh()
        must("st-export", self.folder / "patches.failures.hdf", "-o", self.folder / "f.vtu")
        grid = vtu_arrays(self.folder / "f.vtu")
        points, nodes, ends = grid["Points"], grid["connectivity"], grid["offsets"]
        edges, length = set(), 0
        for cell, (first, end) in enumerate(zip((0, *ends), ends)):
            if grid["types"][cell] != VTK_LINE:
                continue
            edges.add(grid["edge"][cell])
            length += math.dist(*(points[3 * n:3 * n + 3] for n in nodes[first:end]))
        self.assertEqual(len(edges), 4, "four CAD edges")
        self.assertAlmostEqual(length, 20 + 20 * 2 ** 0.5, places=6)

    def test_a_run_without_failures_leaves_no_such_file_and_removes_an_old_one(self):
        self.sizes_of("crossed_loop.brep")
        self.mesh()
        self.assertTrue((self.folder / "patches.failures.hdf").exists())
        self.sizes_of("box.brep")
        self.assertEqual(self.mesh().code, OK)
        self.expect_nothing_left(self.folder, "geometry.hdf", "raster.hdf", "sizing.hdf", "patches.hdf")


class Crash(ToolTest):
    """A crash is planted by its signal, while the main thread is at a face."""

    def setUp(self):
        super().setUp()
        self.chain = self.folder / "chain"
        self.chain.mkdir()
        must("st-import", MODELS / "assembly.step", "-o", self.chain / "g.hdf")
        self.out = self.folder / "out"
        self.out.mkdir()

    def crash(self, *words):
        """Exit code and stderr of a run that was at a face, not at an edge."""
        error = ""
        for attempt in range(40):
            run = subprocess.Popen(words, stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True)
            time.sleep(0.1 + 0.05 * (attempt % 10))
            run.send_signal(signal.SIGSEGV)
            error = run.communicate(timeout=120)[1]
            if re.search(r"face \d+: crashed there", error):
                break
        self.assertRegex(error, r"face \d+: crashed there")
        return run.returncode, error

    def test_of_the_mesher_leaves_out_the_face_and_reports_it(self):
        must("st-raster", self.chain / "g.hdf", "-o", self.chain / "r.hdf", "--lmax", "0.15%", "--lmin", "0.1%")
        must("st-prolong", self.chain / "r.hdf", "-o", self.chain / "s.hdf")
        patches = self.out / "p.hdf"
        code, error = self.crash(BIN / "st-mesh", self.chain / "g.hdf", self.chain / "s.hdf", "-o", patches)
        face = int(re.search(r"st-mesh: warning: face (\d+): crashed there", error)[1])
        self.assertEqual(code, INCOMPLETE, error)
        info = must("st-info", patches, "--json").json()
        self.assertEqual((info["counts"]["failures"], info["properties"]["is_complete"]), (1, False))
        self.assertRegex(error, rf"face {face} not meshed: the mesher crashed")
        must("st-merge", patches, "-o", self.out / "m.hdf", "--allow-incomplete")

    def test_a_face_that_takes_too_long_is_left_out_and_reported(self):
        must("st-import", MODELS / "plate_with_hole.brep", "-o", self.chain / "g.hdf")
        (self.chain / "size.toml").write_text('[[size]]\nlmax = "5%"\n[[size]]\nfaces = 1\nlmax = "0.12%"\n')
        must("st-raster", self.chain / "g.hdf", "-o", self.chain / "r.hdf", "--sizes", self.chain / "size.toml")
        must("st-prolong", self.chain / "r.hdf", "-o", self.chain / "s.hdf", "--slope", "2")
        inputs = [self.chain / "g.hdf", self.chain / "s.hdf", "-o", self.out / "p.hdf", "--tile", "0"]
        run = Run("st-mesh", *inputs, "--time-limit", "0.1")
        self.assertEqual(run.code, INCOMPLETE, run)
        self.assertIn("st-mesh: warning: face 1: takes too long", run.err)
        self.assertEqual(must("st-info", self.out / "p.hdf", "--json").json()["counts"]["failures"], 1)
        run = Run("st-mesh", *inputs, "--time-limit", "0.1", "--np", "2")
        self.assertEqual(run.code, INCOMPLETE, run)
        self.assertIn("st-mesh: error: face 1: takes too long", run.err)
        self.assertIn("face 1 not meshed: the mesher did not end here", run.err)
        self.expect_nothing_left(self.out, "p.hdf", "p.failures.hdf")

    def test_of_another_stage_names_the_face_and_leaves_nothing(self):
        code, error = self.crash(BIN / "st-raster", self.chain / "g.hdf", "-o", self.out / "r.hdf", "--lmax", "0.05%",
                                 "--max-cells", "1000000000")
        self.assertEqual(code, -signal.SIGSEGV, error)
        self.assertRegex(error, r"st-raster: error: face \d+: crashed there")
        self.assertEqual(list(self.out.iterdir()), [])


if __name__ == "__main__":
    unittest.main(verbosity=2)
