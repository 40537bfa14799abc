"""Blanking on whole models: what one side of a thin wall asks for stays on that side, in the field and in the mesh."""
import csv
import math
import random
import struct
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
from chain import ToolTest, artifacts_of, must  # noqa: E402


def triangles(path):
    """Corners of the triangles of a binary STL file."""
    for x in struct.iter_unpack("<12f2x", path.read_bytes()[84:]):
        yield x[3:6], x[6:9], x[9:12]


def turned(x, y, z, axis=(1, 0.4, 0.2), angle=0.6):
    """Of turned_tube in tests/support/make_models.cpp."""
    size = math.hypot(*axis)
    k = [a / size for a in axis]
    along = (1 - math.cos(angle)) * (k[0] * x + k[1] * y + k[2] * z)
    cross = (k[1] * z - k[2] * y, k[2] * x - k[0] * z, k[0] * y - k[1] * x)
    return [v * math.cos(angle) + c * math.sin(angle) + along * e for v, c, e in zip((x, y, z), cross, k)]


class ThinWall(ToolTest):
    """A tube whose wall is thinner than the cells, fine inside."""

    FINE = 0.02

    def sizes_at(self, name, points, artifact, *options):
        (self.folder / "p.csv").write_text("".join(f"{x!r},{y!r},{z!r}\n" for x, y, z in points))
        must("st-prolong", artifact, "-o", self.folder / f"{name}.hdf", *options, "--sample", self.folder / "p.csv",
             "--sample-output", self.folder / "o.csv")
        return [float(row["length"]) for row in csv.DictReader((self.folder / "o.csv").read_text().splitlines())]

    def setUp(self):
        super().setUp()
        self.geometry, self.fine = artifacts_of("turned_tube") / "geometry.hdf", self.folder / "fine.hdf"
        (self.folder / "fine.toml").write_text(f'[[size]]\nfaces = 4\nlmin = {self.FINE}\nlmax = {self.FINE}\n')
        must("st-raster", self.geometry, "-o", self.folder / "plain.hdf", "--lmax", "0.1")
        must("st-raster", self.geometry, "-o", self.fine, "--lmax", "0.1", "--sizes", self.folder / "fine.toml")
        random.seed(4)
        # the way around a rim gives the outside no more than its own lengths there
        places = [(random.uniform(0, 2 * math.pi), random.uniform(-0.5, 0.5)) for _ in range(20000)]
        self.outside, self.inside = ([turned(r * math.cos(a), r * math.sin(a), z) for a, z in places]
                                     for r in (1.0, 0.97))

    def check_sides(self, *options):
        plain = self.sizes_at("plain_sizes", self.outside, self.folder / "plain.hdf")
        sizes = self.sizes_at("fine_sizes", self.outside + self.inside, self.fine, *options)
        outside, inside = sizes[:len(plain)], sizes[len(plain):]
        n_kept = sum(abs(h / p - 1) < 0.05 for h, p in zip(outside, plain))
        self.assertGreater(n_kept, 0.99 * len(plain))
        self.assertLess(max(inside), 1.1 * self.FINE)

    def test_the_outside_keeps_its_lengths_in_one_pass(self):
        self.check_sides()

    def test_the_outside_keeps_its_lengths_in_two_passes(self):
        must("st-prolong", self.fine, "-o", self.folder / "open.hdf", "--no-blank")
        must("st-mesh", self.geometry, self.folder / "open.hdf", "-o", self.folder / "patches.hdf")
        must("st-merge", self.folder / "patches.hdf", "-o", self.folder / "mesh.hdf")
        self.check_sides("--blank", self.folder / "mesh.hdf")

    def test_without_blanking_the_wall_is_no_barrier(self):
        sizes = self.sizes_at("fine_sizes", self.outside, self.fine, "--no-blank")
        self.assertLess(max(sizes), self.FINE + 0.2 * 0.03 + 0.02)


class Blanking(ToolTest):
    def mesh(self, a, name, *options):
        """Folder of a chain from the raster in `a`."""
        b = self.folder / name
        b.mkdir()
        must("st-prolong", a / "raster.hdf", "-o", b / "sizing.hdf", *options)
        must("st-mesh", a / "geometry.hdf", b / "sizing.hdf", "-o", b / "patches.hdf")
        must("st-merge", b / "patches.hdf", "-o", b / "mesh.hdf")
        must("st-check", b / "mesh.hdf", "--geometry", a / "geometry.hdf", "--sizing", b / "sizing.hdf")
        return b

    def check_both_ways(self, name, check):
        """Calls check(open, blanked): blanked by the raster's own surface, and by a mesh."""
        raster = artifacts_of(name)
        unblanked = self.mesh(raster, "open", "--no-blank")
        for blanked in (raster, self.mesh(raster, "blanked", "--blank", unblanked / "mesh.hdf")):
            with self.subTest(blanked=blanked.name):
                check(unblanked, blanked)

    def count(self, folder, is_there):
        """Triangles with all corners where is_there(x, y, z) says."""
        must("st-export", folder / "mesh.hdf", "-o", self.folder / "m.stl")
        return sum(all(is_there(*corner) for corner in t) for t in triangles(self.folder / "m.stl"))

    def length(self, folder, *xyz):
        return must("st-info", folder / "sizing.hdf", "--at=" + ",".join(map(str, xyz)), "--json").json()["length"]

    def test_the_outside_of_a_thin_nacelle_loses_the_refinement_inside(self):
        self.check_both_ways("tube_with_rod", self.check_nacelle)

    def check_nacelle(self, a, b):
        rod = 0.3 * 3.14159 / 18
        self.assertAlmostEqual(self.length(a, 10, 0, 20), rod + 0.2 * 0.8, delta=0.06)
        largest = self.length(a, -10, 0, 20)
        self.assertGreater(largest, 5 * (rod + 0.2 * 0.8))
        self.assertAlmostEqual(self.length(b, 10, 0, 20), largest, delta=0.05 * largest)
        self.assertAlmostEqual(self.length(b, 9.6, 0, 20), self.length(a, 9.6, 0, 20), delta=0.05)
        outside = lambda x, y, z: x * x + y * y > 9.9**2 and 3 < z < 37  # noqa: E731
        inside = lambda x, y, z: 9**2 < x * x + y * y < 9.7**2 and 3 < z < 37  # noqa: E731
        n_a, n_b = self.count(a, outside), self.count(b, outside)
        self.assertLess(n_b, 0.85 * n_a, "the number of triangles outside falls")
        uniform = 2 * 3.14159 * 10 * 34 / (0.433 * largest**2)
        self.assertAlmostEqual(n_b / uniform, 1, delta=0.15, msg="to what a tube alone would have")
        self.assertAlmostEqual(self.count(b, inside) / self.count(a, inside), 1, delta=0.05, msg="the inside stays")

    def test_a_plate_far_thinner_than_the_cells_blocks(self):
        self.check_both_ways("plate_with_rod", self.check_plate)

    def check_plate(self, a, b):
        largest = self.length(b, 50, 14, -0.001)  # far from the rod and from the rim
        self.assertLess(self.length(a, 50, 30, 0), 0.15 * largest)
        self.assertAlmostEqual(self.length(b, 50, 30, -0.001), largest, delta=0.05 * largest)
        self.assertAlmostEqual(self.length(b, 50, 30, 0.2), self.length(a, 50, 30, 0.2), delta=0.05)
        inner = lambda x, y: 14 < x < 86 and 14 < y < 46  # noqa: E731 (the narrow rim has sizes of its own)
        below, above = (lambda x, y, z: inner(x, y) and z < 0.01), (lambda x, y, z: inner(x, y) and 0.19 < z < 0.21)
        self.assertLess(self.count(b, below), 0.85 * self.count(a, below))
        self.assertAlmostEqual(self.count(b, above) / self.count(a, above), 1, delta=0.05)


if __name__ == "__main__":
    unittest.main(verbosity=2)
