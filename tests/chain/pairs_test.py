"""Periodic faces through the tools: the same nodes on both sides, whatever meshes them; ranks and threads."""
import math
import re
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
from chain import BIN, MODELS, ToolTest, content_hash, must  # noqa: E402

HOWS = ((), ("--threads", 1), ("--threads", 3), ("--np", 2), ("--np", 3))
EXAMPLE = Path(__file__).resolve().parents[2] / "examples/pairs"
ROUNDING = 1e-12  # of the diagonal


class Pairs(ToolTest):
    def sized(self, model, *raster_options):
        f = self.folder
        must("st-import", model, "-o", f / "geometry.hdf")
        must("st-raster", f / "geometry.hdf", "-o", f / "raster.hdf", *raster_options)
        must("st-prolong", f / "raster.hdf", "-o", f / "sizing.hdf")

    def meshed(self, *options):
        f = self.folder
        must("st-mesh", f / "geometry.hdf", f / "sizing.hdf", "-o", f / "patches.hdf", "--pairs", "auto", *options)
        must("st-merge", f / "patches.hdf", "-o", f / "mesh.hdf")
        return f / "mesh.hdf"

    def cascade(self):
        must("make_model", "cascade", self.folder / "cascade.step")
        return self.folder / "cascade.step"

    def apart(self, mesh):
        """Of each pair of faces in Gmsh's $Periodic: its nodes, and how far the images are, over the diagonal."""
        path = self.folder / "pairs.msh2"
        must("st-export", mesh, "-o", path)
        text = path.read_text()
        rows = re.search(r"\$Nodes\n\d+\n(.*?)\$EndNodes", text, re.S)[1].split("\n")[:-1]
        nodes = {int(row.split()[0]): [float(v) for v in row.split()[1:]] for row in rows}
        diagonal = math.dist(*([f(x[k] for x in nodes.values()) for k in range(3)] for f in (min, max)))
        on_face = {}
        for row in re.search(r"\$Elements\n\d+\n(.*?)\$EndElements", text, re.S)[1].split("\n")[:-1]:
            number, kind, _, _, face, *corners = map(int, row.split())
            if kind == 2:
                on_face.setdefault(face, set()).update(corners)
        found = []
        lines = iter(re.search(r"\$Periodic\n\d+\n(.*?)\$EndPeriodic", text, re.S)[1].split("\n"))
        for line in lines:
            if not re.match(r"[012] \d+ \d+$", line):
                continue
            dim, slave, master = map(int, line.split())
            m = [float(v) for v in next(lines).split()[1:]]
            pairs = [tuple(map(int, next(lines).split())) for _ in range(int(next(lines)))]
            most = 0
            for b, a in pairs:
                image = [sum(m[4 * i + k] * nodes[a][k] for k in range(3)) + m[4 * i + 3] for i in range(3)]
                most = max(most, math.dist(image, nodes[b]) / diagonal)
            if dim == 2:
                self.assertEqual({b for b, _ in pairs}, on_face[slave])
                self.assertEqual({a for _, a in pairs}, on_face[master])
                found.append((len(pairs), most))
        return found

    def expect_images(self, mesh, n_pairs, least_nodes):
        found = self.apart(mesh)
        self.assertEqual(len(found), n_pairs)
        for n, most in found:
            self.assertGreater(n, least_nodes)
            self.assertLess(most, ROUNDING)
        checks = must("st-check", mesh, "--geometry", self.folder / "geometry.hdf", "--json").json()["checks"]
        self.assertEqual(checks["pairs"]["count"], 0)

    def expect_one_hash(self, make):
        self.assertEqual(len({content_hash(make(*how)) for how in HOWS}), 1)

    def test_a_passage_stretched_and_not_has_one_mesh_over_ranks_and_threads(self):
        for options in ((), ("--preset", "rans", "--max-aspect", 20)):
            with self.subTest(options):
                self.sized(self.cascade(), *options)
                self.expect_one_hash(self.meshed)
                self.expect_images(self.folder / "mesh.hdf", 2, 100)

    def test_faces_cut_into_tiles_have_one_mesh_over_ranks_and_threads(self):
        self.sized(MODELS / "box.step", "--lmax", "0.55")
        self.expect_one_hash(lambda *how: self.meshed("--tile", 8000, *how))
        self.expect_images(self.folder / "mesh.hdf", 3, 1000)
        largest = max(n for n, _ in self.apart(self.folder / "mesh.hdf"))
        self.assertGreater(2 * largest, 1.5 * 8000, "no face is cut")

    def remeshed(self, mesh, sizing, *how):
        f = self.folder
        self.redone = must("st-remesh", mesh, f / "geometry.hdf", sizing, "--merged", f / "redone.hdf", "--json",
                           *how).json()
        return f / "redone.hdf"

    def expect_remeshed(self, mesh, sizing, n_pairs):
        """The same bits on all ranks and threads, and the images follow the sizes as a new mesh's do."""
        self.expect_one_hash(lambda *how: self.remeshed(mesh, sizing, *how))
        self.assertGreater(self.redone["triangles_redone"], 1000)
        self.expect_images(self.folder / "redone.hdf", n_pairs, 40)
        f, redone = self.folder, self.apart(self.folder / "redone.hdf")
        must("st-mesh", f / "geometry.hdf", sizing, "-o", f / "new_patches.hdf", "--pairs", "auto")
        must("st-merge", f / "new_patches.hdf", "-o", f / "new.hdf")
        for (n, _), (n_new, _) in zip(redone, self.apart(f / "new.hdf")):
            self.assertLess(abs(n - n_new), 0.1 * n_new, (redone, self.redone))

    def test_they_follow_other_sizes_in_st_remesh(self):
        for options in ((), ("--preset", "rans", "--max-aspect", 20)):
            self.sized(self.cascade(), *options)
            mesh, f = self.meshed(), self.folder
            for factor in (0.6, 1.7):
                with self.subTest(options=options, factor=factor):
                    must("st-prolong", f / "sizing.hdf", "-o", f / "other.hdf", "--scale", factor)
                    self.expect_remeshed(mesh, f / "other.hdf", 2)

    def test_they_follow_sizes_that_change_on_one_side_alone(self):
        self.sized(MODELS / "box.step", "--lmax", "3")
        f, mesh = self.folder, self.meshed()
        before = [n for n, _ in self.apart(mesh)]
        (f / "sources.toml").write_text('[[source]]\ntype = "point"\nat = [0, 8, 6]\nlength = 0.5\n')
        must("st-prolong", f / "raster.hdf", "-o", f / "other.hdf", "--sources", f / "sources.toml")
        self.expect_remeshed(mesh, f / "other.hdf", 3)
        grown = [n - m for (n, _), m in zip(self.apart(f / "redone.hdf"), before)]
        self.assertGreater(max(grown), 50, grown)

    def test_they_follow_sizes_through_tiles(self):
        self.sized(MODELS / "box.step", "--lmax", "1")
        f, mesh = self.folder, self.meshed()
        must("st-prolong", f / "sizing.hdf", "-o", f / "other.hdf", "--scale", 0.25)
        self.expect_remeshed(mesh, f / "other.hdf", 3)
        largest = max(n for n, _ in self.apart(f / "redone.hdf"))
        self.assertGreater(2 * largest, 1.5 * 25000, "no face is cut")

    def test_a_kept_one_keeps_its_partner(self):
        self.sized(self.cascade())
        f, mesh = self.folder, self.meshed()
        before = [n for n, _ in self.apart(mesh)]
        must("st-prolong", f / "sizing.hdf", "-o", f / "finer.hdf", "--scale", 0.7)
        redone = self.remeshed(mesh, f / "finer.hdf", "--keep", "periodic_low")
        self.expect_images(redone, 2, 100)
        after = [n for n, _ in self.apart(redone)]
        self.assertEqual(sum(n == m for n, m in zip(before, after)), 1, (before, after))

    def test_the_example_draws_both_sides_of_a_passage(self):
        done = subprocess.run([EXAMPLE / "pairs.sh", self.folder, BIN], capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual((self.folder / "pair.svg").read_text(), (EXAMPLE / "pair.svg").read_text())
        self.assertIn("MARKER_PERIODIC= ( periodic_low", (self.folder / "passage.su2").read_text())
        for name, n_pairs in (("passage", 1), ("cube", 3)):
            found = self.apart(self.folder / f"{name}_mesh.hdf")
            self.assertEqual(len(found), n_pairs)
            self.assertLess(max(most for _, most in found), ROUNDING)


if __name__ == "__main__":
    unittest.main(verbosity=2)
