"""Sizes from the fields of a solution, and a size field of a background alone."""
import math
import re
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts"))
from adapt_table import read_mesh  # noqa: E402
from chain import INPUT, USAGE, ToolTest, artifacts_of, content_hash, must  # noqa: E402


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

    def test_a_group_gets_sizes_alone(self):
        field = self.write("flow.sol", self.layer)
        lines = (self.folder / "flow.mesh").read_text().split("\n")
        at = lines.index("Triangles") + 2
        n_left = 0
        for i in range(at, at + int(lines[at - 1])):
            corners = [int(n) - 1 for n in lines[i].split()[:3]]
            is_left = all(self.points[n][0] < 20 for n in corners)
            lines[i] = " ".join(str(n + 1) for n in corners) + f" {5 if is_left else 1}"
            n_left += is_left
        (self.folder / "flow.mesh").write_text("\n".join(lines))
        whole, left = self.metric(field)["nodes"], self.metric(field, "--group", 5)["nodes"]
        self.assertLess(left, 0.6 * whole)
        self.assertGreater(left, n_left / 2)
        both = self.metric(field, "--group", 5, "--box", "-1 -1 -1 10 41 21")["nodes"]
        self.assertLess(both, 0.8 * left)
        out, mesh = self.folder / "out.solb", self.folder / "mesh.hdf"
        mesh.write_bytes((self.box / "mesh.hdf").read_bytes())
        must("st-export", mesh, "-o", self.folder / "mesh.vtu")
        for of_cells in (f"{mesh}:face", f"{self.folder / 'mesh.vtu'}:face"):
            self.assertEqual(self.metric(of_cells, "--group", "default")["nodes"], len(self.points))
            self.expect_error(USAGE, "st-metric", of_cells, "--group", "defalt", "-o", out,
                              says="did you mean 'default'")
        self.expect_error(USAGE, "st-metric", field, "--group", 7, "-o", out, says="no cell is in it")

    def test_a_background_in_another_unit_is_said(self):
        self.metric(self.write("flow.sol", self.layer), "--lmin", 50, "--lmax", 60)
        run = must("st-prolong", self.box / "raster.hdf", "-o", self.folder / "s.hdf", "--background",
                   self.folder / "sizes.solb")
        self.assertIn("it has no effect; is it in the model's unit", run.err)

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


class Shock(ToolTest):
    """A background of tensors with one short and two long lengths, tilted by 45 degrees to the box's floor."""
    SHORT, LONG, CELLS = 1.0, 6.0, 20
    TRACE = (0.5 / SHORT**2 + 0.5 / LONG**2) ** -0.5  # what the floor and the walls x = const cut

    def setUp(self):
        super().setUp()
        self.box = artifacts_of("box")
        n = self.CELLS
        axes = [[lo + (hi - lo) * i / n for i in range(n + 1)] for lo, hi in ((-5, 65), (-5, 45), (-5, 25))]
        lines = ["MeshVersionFormatted 2", "Dimension 3", "Vertices", str((n + 1) ** 3)]
        lines += [f"{x} {y} {z} 0" for z in axes[2] for y in axes[1] for x in axes[0]]
        lines += ["Hexahedra", str(n**3)]
        row, layer = n + 1, (n + 1) ** 2
        for first in (1 + i + row * j + layer * k for k in range(n) for j in range(n) for i in range(n)):
            bottom = [first, first + 1, first + 1 + row, first + row]
            lines.append(" ".join(str(c) for c in bottom + [c + layer for c in bottom] + [0]))
        (self.folder / "shock.mesh").write_text("\n".join(lines + ["End", ""]))
        self.tilt(45)

    def tilt(self, degrees):
        """The short length lies at this angle to the x axis, towards z."""
        angle, n_nodes = math.radians(degrees), (self.CELLS + 1) ** 3
        self.x, self.z = math.cos(angle), math.sin(angle)
        most, least = self.SHORT**-2, self.LONG**-2
        mean, half = 0.5 * (most + least), 0.5 * (most - least)
        xx, zz, xz = mean + half * math.cos(2 * angle), mean - half * math.cos(2 * angle), half * math.sin(2 * angle)
        tensor = f"{xx} 0 {least} {xz} 0 {zz}"
        (self.folder / "shock.sol").write_text("\n".join(  # xx xy yy xz yz zz
            ["MeshVersionFormatted 2", "Dimension 3", "SolAtVertices", str(n_nodes), "1 3"] + [tensor] * n_nodes
            + ["End", ""]))

    def sizes(self, *raster_options):
        must("st-raster", self.box / "geometry.hdf", "-o", self.folder / "r.hdf", "--lmin", 0.2, "--lmax", 8,
             *raster_options)
        return must("st-prolong", self.folder / "r.hdf", "-o", self.folder / "s.hdf", "--only", "--background",
                    self.folder / "shock.sol")

    def at(self, place):
        told = must("st-info", self.folder / "s.hdf", "--at", place, "--json").json()
        return told["length"], told["along"]

    def mesh(self):
        must("st-mesh", self.box / "geometry.hdf", self.folder / "s.hdf", "-o", self.folder / "p.hdf")
        must("st-merge", self.folder / "p.hdf", "-o", self.folder / "m.hdf")
        return content_hash(self.folder / "m.hdf")

    def test_each_face_has_the_two_lengths_that_it_cuts(self):
        self.sizes("--max-aspect", 16)
        for place, short, axis in (("30,20,0", self.TRACE, 1), ("0,20,10", self.TRACE, 1), ("30,0,10", self.SHORT, 0)):
            length, along = self.at(place)
            self.assertAlmostEqual(length, short, delta=0.05 * short, msg=place)
            self.assertAlmostEqual(along["length"], self.LONG, delta=0.05 * self.LONG, msg=place)
            self.assertGreater(abs(along["direction"][axis]), 0.7, place)

    def test_the_mesh_of_a_face_has_both_lengths(self):
        self.sizes("--max-aspect", 16)
        self.mesh()
        must("st-export", self.folder / "m.hdf", "-o", self.folder / "m.mesh")
        nodes, triangles = read_mesh(self.folder / "m.mesh")
        inside = [10 < x < 50 and 10 < y < 30 and abs(z) < 1e-9 for x, y, z in nodes]
        sides = ((t[k], t[k - 1]) for t in triangles for k in range(3))
        edges = [[abs(nodes[a][k] - nodes[b][k]) for k in range(2)] for a, b in sides if inside[a] and inside[b]]
        flat = 0.3  # of both directions' lengths, so measured: an edge along one of them
        across = [x for x, y in edges if y / self.LONG < flat * x / self.TRACE]
        along = [y for x, y in edges if x / self.TRACE < flat * y / self.LONG]
        self.assertAlmostEqual(sum(across) / len(across), self.TRACE, delta=0.05 * self.TRACE)
        self.assertTrue(0.8 < sum(along) / len(along) / self.LONG < 1.05)  # rows of whole triangles are shorter

    def quality(self, mesh):
        """Mean over the triangles, each in its own plane as the metric sees it."""
        must("st-export", mesh, "-o", self.folder / "judged.mesh")
        nodes, triangles = read_mesh(self.folder / "judged.mesh")
        more, seen = 1 / self.SHORT - 1 / self.LONG, []
        for x, y, z in nodes:
            across = more * (self.x * x + self.z * z)
            seen.append((x / self.LONG + across * self.x, y / self.LONG, z / self.LONG + across * self.z))
        total = 0
        for t in triangles:
            squares = [math.dist(seen[t[k]], seen[t[k - 1]]) ** 2 for k in range(3)]
            area16 = max(0, sum(squares) ** 2 - 2 * sum(q * q for q in squares))
            total += math.sqrt(3 * area16) / sum(squares)
        return total / len(triangles)

    def test_exports_hold_the_whole_metric(self):
        self.tilt(30)
        self.sizes()
        self.mesh()
        f = self.folder
        must("st-export", f / "m.hdf", "-o", f / "m.sol", "--sizing", f / "s.hdf")
        least, more = self.LONG**-2, self.SHORT**-2 - self.LONG**-2
        metric = (least + more * self.x**2, 0, least, more * self.x * self.z, 0, least + more * self.z**2)
        rows = (f / "m.sol").read_text().split("\n1 3\n")[1].split("\n")[:-2]
        for row in rows:
            for told, asked in zip(map(float, row.split()), metric):
                self.assertAlmostEqual(told, asked, delta=1e-6)
        must("st-export", f / "s.hdf", "-o", f / "s.pos")
        xx, xy, yy, xz, yz, zz = metric
        asked, told = (xx, xy, xz, xy, yy, yz, xz, yz, zz), []
        for cell in re.findall(r"TH\([^)]*\){([^}]*)}", (f / "s.pos").read_text()):
            values = [float(v) for v in cell.split(",")]
            told += [values[k:k + 9] for k in range(0, 72, 9)]
        self.assertTrue(any(all(abs(a - b) < 1e-6 for a, b in zip(t, asked)) for t in told), told[:2])
        must("st-export", f / "s.hdf", "-o", f / "s.vtu")
        self.assertIn(b'Name="metric" NumberOfComponents="6"', (f / "s.vtu").read_bytes())

    def remeshed(self, mesh, sizing):
        return must("st-remesh", mesh, self.box / "geometry.hdf", sizing, "--merged", self.folder / "redone.hdf",
                    "--json").json()

    def test_a_remeshed_mesh_is_as_good_as_a_new_one(self):
        self.sizes("--max-aspect", 16)
        self.mesh()
        new = self.quality(self.folder / "m.hdf")
        self.assertGreater(new, 0.84)
        self.remeshed(self.box / "mesh.hdf", self.folder / "s.hdf")
        self.assertGreater(self.quality(self.folder / "redone.hdf"), new - 0.01)

    def test_a_shock_oblique_to_the_edges_gets_no_rows_along_them(self):
        for degrees in (20, 35, 70):
            self.tilt(degrees)
            self.sizes()
            self.mesh()
            new = self.quality(self.folder / "m.hdf")
            self.remeshed(self.box / "mesh.hdf", self.folder / "s.hdf")
            redone = self.quality(self.folder / "redone.hdf")
            self.assertGreater(min(new, redone), 0.8, degrees)
            self.assertLess(abs(new - redone), 0.01, degrees)

    def with_a_source(self):
        f = self.folder
        (f / "sources.toml").write_text('[[source]]\ntype = "point"\nat = [30, 20, 20]\nlength = 0.4\n')
        must("st-prolong", f / "r.hdf", "-o", f / "more.hdf", "--only", "--background", f / "shock.sol", "--sources",
             f / "sources.toml")

    def test_what_fits_the_metrics_stays(self):
        self.sizes()
        self.mesh()
        self.with_a_source()
        f = self.folder
        self.assertEqual(self.remeshed(f / "m.hdf", f / "s.hdf")["triangles_redone"], 0)
        run = self.remeshed(f / "m.hdf", f / "more.hdf")
        self.assertGreater(run["triangles_redone"], 0)
        self.assertLess(run["triangles_redone"], 0.2 * run["triangles_before"])

    def test_same_bits_for_every_number_of_threads_and_ranks(self):
        self.sizes("--max-aspect", 16)
        f, box, hashes = self.folder, self.box, []
        for n in (1, 2, 3):
            must("st-prolong", f / "r.hdf", "-o", f / "s.hdf", "--only", "--background", f / "shock.sol", "--threads",
                 n)
            hashes.append(content_hash(f / "s.hdf"))
        self.with_a_source()
        for how in (("--threads", 1), ("--threads", 3), ("--np", 2), ("--np", 3)):
            must("st-mesh", box / "geometry.hdf", f / "s.hdf", "-o", f / "p.hdf", *how)
            must("st-merge", f / "p.hdf", "-o", f / "m.hdf")
            must("st-remesh", box / "mesh.hdf", box / "geometry.hdf", f / "s.hdf", "--merged", f / "redone.hdf", *how)
            hashes += [content_hash(f / "m.hdf"), content_hash(f / "redone.hdf")]
            must("st-remesh", f / "m.hdf", box / "geometry.hdf", f / "more.hdf", "--merged", f / "part.hdf", *how)
            hashes.append(content_hash(f / "part.hdf"))
        self.assertEqual(len(set(hashes)), 3)  # a mesh that is remeshed as a whole is the new one

    def test_the_aspect_of_the_raster_does_not_matter(self):
        hashes = []
        for options in ((), ("--max-aspect", 16)):
            self.assertNotIn("anisotropic", self.sizes(*options).err)
            hashes.append(self.mesh())
        self.assertEqual(*hashes)
        length, along = self.at("30,20,0")
        self.assertAlmostEqual(length, self.TRACE, delta=0.01)
        self.assertAlmostEqual(along["length"], self.LONG, delta=0.01)


class ShockOnASphere(ToolTest):
    """A background of two tetrahedra's size with one metric: of what it asks for, each plane of a sphere cuts two."""
    SHORT, LONG = 0.4, 1.6

    def write(self, name, values):
        (self.folder / name).write_text("\n".join(["MeshVersionFormatted 2", "Dimension 3", *values, "End", ""]))

    def setUp(self):
        super().setUp()
        self.sphere = artifacts_of("sphere")  # radius 10
        corners = [(x, y, z) for z in (-15, 15) for y in (-15, 15) for x in (-15, 15)]
        self.write("one.mesh", ["Vertices", "8", *(f"{x} {y} {z} 0" for x, y, z in corners), "Hexahedra", "1",
                                "1 2 4 3 5 6 8 7 0"])
        most, least = self.SHORT**-2, self.LONG**-2
        self.write("one.sol", ["SolAtVertices", "8", "1 3", *[f"{most} 0 {least} 0 0 {least}"] * 8])

    def test_edges_have_the_lengths_of_the_metric_in_every_plane(self):
        f, geometry = self.folder, self.sphere / "geometry.hdf"
        must("st-raster", geometry, "-o", f / "r.hdf", "--lmin", 0.2, "--lmax", 4)
        hashes = []
        for how in (("--threads", 1), ("--threads", 2), ("--np", 3)):
            must("st-prolong", f / "r.hdf", "-o", f / "s.hdf", "--only", "--background", f / "one.sol")
            must("st-mesh", geometry, f / "s.hdf", "-o", f / "p.hdf", *how)
            must("st-merge", f / "p.hdf", "-o", f / "m.hdf")
            hashes.append(content_hash(f / "m.hdf"))
        self.assertEqual(len(set(hashes)), 1)
        must("st-export", f / "m.hdf", "-o", f / "m.mesh")
        nodes, triangles = read_mesh(f / "m.mesh")
        # with x in units of SHORT, y and z in units of LONG, all edges are 1
        scaled = [(x / self.SHORT, y / self.LONG, z / self.LONG) for x, y, z in nodes]
        edges = {(min(a, b), max(a, b)) for t in triangles for a, b in zip(t, t[1:] + t[:1])}
        lengths = sorted(math.dist(scaled[a], scaled[b]) for a, b in edges)
        self.assertGreater(sum(0.7 <= length <= 1.42 for length in lengths), 0.9 * len(lengths))
        self.assertAlmostEqual(lengths[len(lengths) // 2], 1, delta=0.05)
        check = must("st-check", f / "m.hdf", "--geometry", geometry, "--sizing", f / "s.hdf", "--json").json()
        self.assertGreater(check["quality"]["mean"], 0.85)


if __name__ == "__main__":
    unittest.main(verbosity=2)
