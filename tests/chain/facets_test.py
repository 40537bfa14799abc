"""STL files as geometry through the whole chain: closed meshes near the facets, with sizes by their curvature, the same
for all ranks and threads, and one clear message where facets do not do."""
import math
import struct
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
from chain import (  # noqa: E402
    GEOMETRY, INCOMPLETE, INPUT, USAGE, Run, ToolTest, artifacts_of, content_hash, make_chain, must)


def grid(n_u, n_v, point):
    """Two triangles for each quadrangle of a grid; what is a point or a line there is left out."""
    triangles = []
    for i in range(n_u):
        for j in range(n_v):
            a, b, c, d = point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)
            triangles += [t for t in ((a, b, c), (a, c, d)) if len(set(t)) == 3]
    return triangles


def single(*x):
    return struct.unpack(f"<{len(x)}f", struct.pack(f"<{len(x)}f", *x))


def sphere(n, radius=1.0, x=0.0):
    def point(i, j):
        a, b = math.pi * (i % (2 * n)) / n, math.pi * j / n
        r = radius * math.sin(b) if 0 < j < n else 0.0
        return single(x + r * math.cos(a), r * math.sin(a), -radius * math.cos(b))
    return grid(2 * n, n, point)


def torus(n_u, n_v):
    def point(i, j):
        a, b = 2 * math.pi * (i % n_u) / n_u, 2 * math.pi * (j % n_v) / n_v
        return single((3 + math.cos(b)) * math.cos(a), (3 + math.cos(b)) * math.sin(a), math.sin(b))
    return grid(n_u, n_v, point)


def wing(n, n_span):
    """A symmetric section with a sharp trailing edge, swept, with flat ends."""
    def half(x):
        return 0.6 * (0.2969 * math.sqrt(x) - 0.126 * x - 0.3516 * x**2 + 0.2843 * x**3 - 0.1036 * x**4)
    xs = [0.5 * (1 - math.cos(math.pi * i / n)) for i in range(n + 1)]
    lower, upper = ([(x, sign * half(x) if 0 < x < 1 else 0.0) for x in xs] for sign in (-1, 1))
    loop = lower[::-1] + upper[1:]
    at = lambda p, j: single(p[0] + 0.3 * j / n_span, 4.0 * j / n_span, p[1])  # noqa: E731
    triangles = grid(n_span, len(loop) - 1, lambda j, i: at(loop[i], j))
    for j, order in ((0, 1), (n_span, -1)):
        for i in range(n):
            a, b, c, d = (at(p, j) for p in (lower[i], lower[i + 1], upper[i + 1], upper[i]))
            triangles += [t[::order] for t in ((a, b, c), (a, c, d)) if len(set(t)) == 3]
    return triangles


def write_stl(path, triangles, header=b"solid \xff\x00 no text"):
    with open(path, "wb") as f:
        f.write(header.ljust(80, b"\0") + struct.pack("<I", len(triangles)))
        for t in triangles:
            f.write(struct.pack("<12fH", 0, 0, 0, *(x for p in t for x in p), 0))
    return path


def write_text(path, solids):
    with open(path, "w") as f:
        for name, triangles in solids:
            f.write(f"solid {name}\n")
            for t in triangles:
                vertices = "".join(f"vertex {x!r} {y!r} {z!r}\n" for x, y, z in t)
                f.write(f"facet normal 0 0 0\nouter loop\n{vertices}endloop\nendfacet\n")
            f.write(f"endsolid {name}\n")
    return path


def cube():
    corner = lambda n: (float(n >> 2 & 1), float(n >> 1 & 1), float(n & 1))  # noqa: E731
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return [tuple(corner(q[k]) for k in t) for q in quads for t in ((0, 1, 2), (0, 2, 3))]


class Facets(ToolTest):
    def chain(self, path, **options):
        return make_chain(path, self.folder / path.stem, import_options=["--unit", "m"], **options)

    def report(self, folder):
        run = Run("st-check", folder / "mesh.hdf", "--geometry", folder / "geometry.hdf", "--sizing",
                  folder / "sizing.hdf", "--json")
        self.assertEqual(run.code, 0, run)
        return run.json()

    def test_bodies_get_closed_meshes(self):
        for name, triangles, area in [("cube", cube(), 6), ("sphere", sphere(24), 4 * math.pi),
                                      ("torus", torus(72, 36), 12 * math.pi**2), ("wing", wing(40, 12), 8.3)]:
            with self.subTest(name):
                report = self.report(self.chain(write_stl(self.folder / f"{name}.stl", triangles)))
                self.assertTrue(report["closed"])
                self.assertAlmostEqual(report["area"] / area, 1, delta=0.02)

    def test_sizes_follow_the_curvature_of_the_surface_that_facets_stand_for(self):
        cad = self.report(artifacts_of("torus"))
        folder = self.folder / "facets"
        scaled = [tuple(single(*(k * s for k, s in zip(x, (20 / 3, 20 / 3, 6)))) for x in t) for t in torus(96, 48)]
        make_chain(write_stl(self.folder / "torus.stl", scaled), folder, import_options=["--unit", "mm"])
        self.assertAlmostEqual(self.report(folder)["triangles"] / cad["triangles"], 1, delta=0.2)

    def test_is_the_same_for_all_ranks(self):
        path = write_stl(self.folder / "torus.stl", torus(60, 30))
        one, three = (make_chain(path, self.folder / str(n), n, import_options=["--unit", "m"]) for n in (1, 3))
        for name in ("geometry.hdf", "raster.hdf", "sizing.hdf", "mesh.hdf"):
            self.assertEqual(content_hash(one / name), content_hash(three / name), name)

    def test_half_a_wing_goes_into_its_air(self):
        path = write_stl(self.folder / "wing.stl", wing(40, 12))
        for number, far in enumerate(("box:5", "sphere:20")):
            folder = self.folder / str(number)
            make_chain(path, folder, import_options=["--unit", "m", "--symmetry", "y=1.3", "--farfield", far])
            report = self.report(folder)
            self.assertTrue(report["closed"])
            said = must("st-info", folder / "mesh.hdf", "--groups", "--json").json()
            self.assertEqual({(g["name"], g["role"]) for g in said["tables"][0]["groups"]},
                             {("default", "wall"), ("symmetry", "symmetry"), ("farfield", "farfield")})
        open_box = write_stl(self.folder / "open.stl", cube()[1:])
        self.expect_error(GEOMETRY, "st-import", open_box, "-o", self.folder / "g.hdf", "--unit", "m", "--farfield",
                          "box:5", says="the facets are open: 3 sides")

    def test_solids_name_groups(self):
        triangles = cube()
        path = write_text(self.folder / "named.stl", [("body", triangles[:8]), ("inlet", triangles[8:10]),
                                                      ("outlet 2", triangles[10:])])
        folder = self.chain(path)
        groups = must("st-import", path, "--unit", "m", "--check", "--json").json()["tables"][0]["groups"]
        self.assertEqual([(g["name"], g["faces"]) for g in groups], [("body", 4), ("inlet", 1), ("outlet 2", 1)])
        self.report(folder)

    def test_says_what_is_open_turned_or_there_twice(self):
        triangles = cube()
        run = must("st-import", write_stl(self.folder / "open.stl", triangles[1:]), "--unit", "m", "--check")
        self.assertIn("the model is open: 3 free edges", run.err)
        run = must("st-import", write_stl(self.folder / "messy.stl", [triangles[0][::-1], *triangles, *triangles[3:5]]),
                   "--unit", "m", "--check")
        self.assertIn("duplicated facets, removed", run.err)
        self.assertIn("closed", run.out)

    def test_facets_that_cross_are_named(self):
        run = must("st-import", write_stl(self.folder / "two.stl", sphere(10) + sphere(10, 0.9, 0.7)), "--unit", "m",
                   "--check")
        self.assertIn("facets cross each other", run.err)

    def test_who_reads_the_last_line_alone_learns_that_the_file_crosses_itself(self):
        folded = [tuple((0.4, 0.6, -0.5) if x == (1.0, 1.0, 1.0) else x for x in t) for t in cube()]
        path, mesh = write_stl(self.folder / "folded.stl", folded), self.folder / "folded.hdf"
        run = Run("st-run", path, "--unit", "m", "--preset", "preview", "-o", mesh, "--quiet")
        self.assertEqual(run.code, INCOMPLETE, run)
        self.assertRegex(run.out, r"FAILS: (\d+) of \1 pairs of triangles cross where facets of the file do, so repair")

    def test_refuses_what_facets_do_not_do(self):
        path, out = write_stl(self.folder / "cube.stl", cube()), self.folder / "g.hdf"
        self.expect_error(USAGE, "st-import", path, "-o", out, says="--unit")
        for option in (["--mirror", "y=0"], ["--sew", "1%"], ["--unite"], ["--join"]):
            self.expect_error(USAGE, "st-import", path, "-o", out, "--unit", "m", *option, says=[option[0], "facets"])
        strip = write_stl(self.folder / "strip.stl", [tuple((math.cos(k), math.sin(k), 0.3 * (n % 5)) for n in
                                                            range(i, i + 3) for k in [2 * math.pi * (n % 5) / 5])
                                                      for i in range(5)])
        self.expect_error(GEOMETRY, "st-import", strip, "-o", out, "--unit", "m", says="one side alone")
        open_box = write_stl(self.folder / "open.stl", cube()[1:])
        self.expect_error(GEOMETRY, "st-import", open_box, "-o", out, "--unit", "m", "--require-closed", says="open",
                          n_lines=1)
        must("st-import", path, "-o", out, "--unit", "m")
        self.expect_error(INPUT, "st-edit", out, "--remove", "1", "-o", self.folder / "e.hdf", says="has facets")
        self.expect_error(INPUT, "st-export", out, "-o", self.folder / "e.dat", says="has facets")

    def test_all_other_tools_take_it(self):
        folder = self.chain(write_stl(self.folder / "sphere.stl", sphere(16)))
        must("st-info", folder / "geometry.hdf")
        must("st-export", folder / "geometry.hdf", "-o", folder / "cad.vtu")
        must("st-report", folder / "mesh.hdf", "--geometry", folder / "geometry.hdf", "-o", folder / "report.html")
        must("st-remesh", folder / "mesh.hdf", folder / "geometry.hdf", folder / "sizing.hdf", "--merged",
             folder / "again.hdf")


if __name__ == "__main__":
    unittest.main(verbosity=2)
