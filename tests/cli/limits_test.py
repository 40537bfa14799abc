"""Limits are said: cells, triangles and samples that would pass them are refused at the start, by all ranks at once."""
import sys
import time
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
from chain import USAGE, ToolTest, artifacts_of, must  # noqa: E402

RANKS = ([], ["--np", 3])


class Limits(ToolTest):
    def geometry(self, name="assembly"):
        return artifacts_of(name) / "geometry.hdf"

    def test_tiny_lengths_are_refused_with_cells_memory_and_what_to_do(self):
        for ranks in RANKS:
            start = time.monotonic()
            self.expect_error(USAGE, "st-raster", self.geometry(), "-o", self.folder / "r.hdf", "--lmin", "1e-9",
                              "--lmax", "1e-9", *ranks,
                              says=["cells (", "GB", "--max-cells", "larger lengths"])
            self.assertLess(time.monotonic() - start, 10)
            self.expect_nothing_left(self.folder)

    def test_max_cells_is_exact_at_any_number_of_ranks_and_no_part_of_the_content(self):
        n = must("st-raster", self.geometry(), "-o", self.folder / "r.hdf", "--json").json()["cells"]
        expected = (self.folder / "r.hdf").read_bytes()
        for ranks in RANKS:
            must("st-raster", self.geometry(), "-o", self.folder / "r.hdf", "--max-cells", n, *ranks)
            self.assertEqual((self.folder / "r.hdf").read_bytes(), expected)
            (self.folder / "r.hdf").unlink()
            self.expect_error(USAGE, "st-raster", self.geometry(), "-o", self.folder / "r.hdf", "--max-cells", n - 1,
                              *ranks, says="cells")
            self.expect_nothing_left(self.folder)
            must("st-raster", self.geometry(), "-o", self.folder / "r.hdf")

    def test_samples_that_grow_without_bound_are_stopped(self):
        for ranks in RANKS:
            self.expect_error(USAGE, "st-raster", self.geometry("sphere"), "-o", self.folder / "r.hdf", "--lmin",
                              "1e-9", "--alpha", "0.01",
                              "--max-cells", 100000, *ranks, says=["samples", "--max-cells"])
            self.expect_nothing_left(self.folder)

    def test_more_triangles_than_can_be_numbered_are_refused_before_meshing(self):
        sizing = self.folder / "sizing.hdf"
        prolong = must("st-prolong", artifacts_of("assembly") / "raster.hdf", "-o", sizing, "--scale", "1e-6", "--json")
        self.assertGreater(prolong.json()["expected_triangles"], 1e12)
        self.assertRegex(prolong.err, "warning: .* these sizes need about .* % on face .*--target-triangles")
        for ranks in RANKS:
            start = time.monotonic()
            self.expect_error(USAGE, "st-mesh", self.geometry(), sizing, "-o", self.folder / "p.hdf", *ranks,
                              says=["sizing.hdf: these sizes need about", "triangles", "on face",
                                    "a mesh can have at most", "larger lengths"])
            self.assertLess(time.monotonic() - start, 10)
        mesh = artifacts_of("assembly") / "mesh.hdf"
        self.expect_error(USAGE, "st-remesh", mesh, self.geometry(), sizing, "-o", self.folder / "p.hdf",
                          says="sizing.hdf: these sizes need about")
        self.expect_nothing_left(self.folder, "sizing.hdf")

    def test_an_expectation_beyond_whole_numbers_is_still_a_number(self):
        run = must("st-prolong", artifacts_of("assembly") / "raster.hdf", "-o", self.folder / "s.hdf", "--scale",
                   "1e-12", "--json")
        self.assertGreater(run.json()["expected_triangles"], 1e24)

    def test_what_cannot_be_counted_is_refused(self):
        self.expect_error(USAGE, "st-prolong", artifacts_of("assembly") / "raster.hdf", "-o", self.folder / "s.hdf",
                          "--scale", "1e-300", says="more triangles than can be counted")


if __name__ == "__main__":
    unittest.main(verbosity=2)
