"""Sizes from the fields of a solution, and a size field of a background alone."""
import math
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
from chain import INPUT, USAGE, ToolTest, artifacts_of, must  # noqa: E402


class Metric(ToolTest):
    def setUp(self):
        super().setUp()
        self.box = artifacts_of("box")
        must("st-export", self.box / "mesh.hdf", "-o", self.folder / "flow.mesh")
        lines = (self.folder / "flow.mesh").read_text().split("\n")
        at = lines.index("Vertices") + 2
        self.points = [tuple(map(float, line.split()[:3])) for line in lines[at:at + int(lines[at - 1])]]

    def write(self, name, field):
        (self.folder / name).with_suffix(".mesh").write_bytes((self.folder / "flow.mesh").read_bytes())
        values = [str(field(*p)) for p in self.points]
        (self.folder / name).write_text("\n".join(["MeshVersionFormatted 2", "Dimension 3", "SolAtVertices",
                                                   str(len(values)), "1 1"] + values + ["End", ""]))
        return self.folder / name

    def metric(self, *arguments):
        return must("st-metric", *arguments, "-o", self.folder / "sizes.solb", "--json").json()

    def prolong(self, *options):
        return must("st-prolong", self.box / "raster.hdf", "-o", self.folder / "s.hdf", "--background",
                    self.folder / "sizes.solb", *options, "--json").json()

    @staticmethod
    def layer(x, y, z):
        return math.exp(-x / 6)

    def lengths_at(self, *places):
        return [must("st-info", self.folder / "s.hdf", "--at", p, "--json").json()["length"] for p in places]

    def test_sizes_follow_the_field_and_ask_for_the_nodes_that_are_wanted(self):
        field = self.write("flow.sol", self.layer)
        self.assertAlmostEqual(self.metric(field, "--nodes", 3000)["expected_nodes"], 3000, delta=1)
        only = self.prolong("--only")
        # more than asked for: lengths grow by the slope at most, and stay below the raster's lmax
        self.assertGreater(only["expected_triangles"], 0.9 * 6000)
        self.assertLess(only["expected_triangles"], 2 * 6000)
        near, far = self.lengths_at("2,20,0", "40,20,0")
        self.assertLess(near, 0.5 * far)

    def test_only_keeps_to_the_bounds_of_the_raster(self):
        self.metric(self.write("flow.sol", self.layer), "--nodes", 10_000_000)
        must("st-raster", self.box / "geometry.hdf", "-o", self.folder / "r.hdf", "--lmin", "0.5", "--lmax", "3")
        run = must("st-prolong", self.folder / "r.hdf", "-o", self.folder / "s.hdf", "--only", "--background",
                   self.folder / "sizes.solb", "--max-triangles", 10**9)
        self.assertIn("ask for less than the raster's lmin, 0.5", run.err)
        for length in self.lengths_at("2,20,0", "40,20,0"):
            self.assertGreaterEqual(length, 0.5)
            self.assertLessEqual(length, 3)
        for options, says in ((["--only"], "--only takes the lengths of --background alone"),
                              (["--only", "--background", self.folder / "sizes.solb", "--slope-of", "a=0.1"],
                               "leave out --blank and --slope-of")):
            self.expect_error(USAGE, "st-prolong", self.box / "raster.hdf", *options, says=says)
        self.prolong("--only")
        self.expect_error(USAGE, "st-prolong", self.folder / "s.hdf", "--only", "--background",
                          self.folder / "sizes.solb", says="give the raster")

    def test_bounds_and_box_hold(self):
        field = self.write("flow.sol", self.layer)
        said = self.metric(field, "--lmin", 1, "--lmax", 2)
        self.assertGreaterEqual(said["lmin"], 1 - 1e-9)
        self.assertLessEqual(said["lmax"], 2 + 1e-9)
        whole = self.metric(field)["nodes"]
        part = self.metric(field, "--box", "-1 -1 -1 10 41 21")["nodes"]
        self.assertLess(part, whole)
        self.assertGreater(part, sum(p[0] <= 10 for p in self.points) - 1)

    def test_several_fields_are_heeded_together(self):
        a = self.write("a.sol", self.layer)
        b = self.write("b.sol", lambda x, y, z: math.exp((x - 60) / 6))
        self.metric(a, b, "--nodes", 3000)
        self.prolong("--only")
        left, middle, right = self.lengths_at("2,20,0", "30,20,0", "58,20,0")
        self.assertLess(max(left, right), 0.7 * middle)

    def test_values_at_cells_count(self):
        mesh = self.folder / "mesh.hdf"
        mesh.write_bytes((self.box / "mesh.hdf").read_bytes())
        self.assertGreater(self.metric(f"{mesh}:face")["nodes"], 0)

    def test_same_bytes_for_every_number_of_threads(self):
        field = self.write("flow.sol", self.layer)
        files = []
        for threads in (1, 3):
            self.metric(field, "--threads", threads, "--max-aspect", 10)
            files.append([(self.folder / f"sizes.{s}").read_bytes() for s in ("solb", "meshb")])
        self.assertEqual(*files)

    def test_what_tells_no_sizes_is_refused_by_name(self):
        field, out = self.write("flow.sol", self.layer), self.folder / "out.solb"
        flat = self.write("flat.sol", lambda x, y, z: 5)
        bad = self.write("bad.sol", lambda x, y, z: "nan" if x > 50 else 1)
        (self.folder / "one.mesh").write_text("MeshVersionFormatted 2\nDimension 3\nVertices\n3\n0 0 0 0\n1 0 0 0\n"
                                              "0 1 0 0\nTriangles\n1\n1 2 3 0\nEnd\n")
        (self.folder / "one.sol").write_text("MeshVersionFormatted 2\nDimension 3\nSolAtVertices\n3\n1 1\n1\n2\n4\n"
                                             "End\n")
        for code, arguments, says in (
                (INPUT, [flat], "no field curves anywhere"),
                (INPUT, [bad], "have no number, the first is node"),
                (INPUT, [field, self.folder / "one.sol"], "is on another mesh than"),
                (INPUT, [f"{self.box / 'mesh.hdf'}:none"], "has no array 'none'"),
                (USAGE, [field, "--lmin", 2, "--lmax", 1], "--lmin 2 is not below --lmax 1"),
                (USAGE, [field, "--lmin", 500], "is above the diagonal of the mesh"),
                (USAGE, [field, "--box", "1 2 3"], "takes two corners"),
                (USAGE, [field, "--box", "100 0 0 200 1 1"], "no node of the mesh is in it")):
            n_lines = 2 if arguments == [flat] else 1
            self.expect_error(code, "st-metric", *arguments, "-o", out, says=says, n_lines=n_lines)
        self.expect_error(USAGE, "st-metric", field, "-o", self.folder / "out.vtu", says="sizes are written as .solb")
        self.assertFalse(out.exists())


if __name__ == "__main__":
    unittest.main(verbosity=2)
