"""The chain with no option but the file name, on every test model: a mesh that passes, and invariants that geometry
gives."""
import math
import struct
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
from chain import INCOMPLETE, MODELS, Run, ToolTest, artifacts_of, content_hash, make_chain, must  # noqa: E402

CLOSED = ["box", "box_inch", "sphere", "cylinder", "cone", "torus", "block_with_hole", "thin_plate", "two_boxes",
          "assembly"]


def stl_volume_and_area(path):
    """Enclosed volume (positive when normals point outward) and area of a binary STL file."""
    volume = area = 0.0
    for x in struct.iter_unpack("<12f2x", path.read_bytes()[84:]):
        a, b, c = x[3:6], x[6:9], x[9:12]
        p, q = [b[i] - a[i] for i in range(3)], [c[i] - a[i] for i in range(3)]
        cross = (p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0])
        volume += sum(a[i] * cross[i] for i in range(3)) / 6
        area += math.sqrt(sum(v * v for v in cross)) / 2
    return volume, area


class Models(ToolTest):
    def volume_and_area(self, name):
        stl = self.folder / "m.stl"
        must("st-export", artifacts_of(name) / "mesh.hdf", "-o", stl)
        return stl_volume_and_area(stl)

    def test_every_closed_model_passes_the_check(self):
        for name in CLOSED:
            folder = artifacts_of(name)
            must("st-check", folder / "mesh.hdf", "--geometry", folder / "geometry.hdf", "--sizing",
                 folder / "sizing.hdf")

    def test_open_plate_passes_the_check_with_its_geometry(self):
        folder = artifacts_of("plate_with_hole")
        must("st-check", folder / "mesh.hdf", "--geometry", folder / "geometry.hdf")

    def test_planar_solids_have_exactly_their_volume_and_area(self):
        for name, volume, area in (("box", 48000, 8800), ("thin_plate", 1200, 12064), ("two_boxes", 2000, 1200)):
            v, a = self.volume_and_area(name)
            self.assertAlmostEqual(v / volume, 1, delta=1e-5, msg=name)
            self.assertAlmostEqual(a / area, 1, delta=1e-5, msg=name)

    def test_curved_solids_have_their_volume_within_the_chord_error(self):
        exact = {
            "sphere": 4 / 3 * math.pi * 10**3,
            "cylinder": math.pi * 10**2 * 30,
            "cone": math.pi * 10**2 * 20 / 3,
            "torus": 2 * math.pi**2 * 20 * 6**2,
            "block_with_hole": 48000 - math.pi * 8**2 * 20,
        }
        for name, volume in exact.items():
            v, _ = self.volume_and_area(name)
            self.assertAlmostEqual(v / volume, 1, delta=0.01, msg=name)

    def test_inch_file_is_meshed_in_inches(self):
        v, _ = self.volume_and_area("box_inch")
        self.assertAlmostEqual(v / (48000 / 25.4**3), 1, delta=1e-5)

    def test_unit_asked_for_is_taken(self):
        folder = make_chain(MODELS / "box.step", self.folder / "m", import_options=["--unit", "m"])
        must("st-export", folder / "mesh.hdf", "-o", self.folder / "m.stl")
        v, _ = stl_volume_and_area(self.folder / "m.stl")
        self.assertAlmostEqual(v / 48000e-9, 1, delta=1e-5)


class Options(ToolTest):
    """Every option of a stage shows in what it makes."""

    def n_triangles(self, folder):
        must("st-export", folder / "mesh.hdf", "-o", self.folder / "n.stl")
        return int.from_bytes((self.folder / "n.stl").read_bytes()[80:84], "little")

    def chain(self, **options):
        self.count = getattr(self, "count", 0) + 1
        return make_chain(MODELS / "torus.brep", self.folder / str(self.count), **options)

    def test_smaller_lengths_give_more_triangles(self):
        n = self.n_triangles(artifacts_of("torus"))
        self.assertGreater(self.n_triangles(self.chain(raster_options=["--lmax", "1%"])), 1.5 * n)
        self.assertGreater(self.n_triangles(self.chain(raster_options=["--alpha", "5"])), 1.5 * n)
        self.assertLess(self.n_triangles(self.chain(raster_options=["--lmin", "2.4%"])), n)

    def test_scale_and_slope_are_taken(self):
        n = self.n_triangles(artifacts_of("torus"))
        self.assertGreater(self.n_triangles(self.chain(prolong_options=["--scale", "0.5"])), 2.5 * n)
        a = artifacts_of("block_with_hole")
        must("st-prolong", a / "raster.hdf", "-o", self.folder / "s.hdf", "--slope", "0.05")
        self.assertEqual(Run("st-diff", a / "sizing.hdf", self.folder / "s.hdf").code, INCOMPLETE)

    def test_cell_per_length_gives_another_raster(self):
        a = artifacts_of("torus")
        must("st-raster", a / "geometry.hdf", "-o", self.folder / "r.hdf", "--cell-per-length", "2")
        self.assertEqual(Run("st-diff", a / "raster.hdf", self.folder / "r.hdf").code, INCOMPLETE)

    def test_enhancer_changes_the_mesh_and_none_is_valid(self):
        raw = self.chain(mesh_options=["--enhance-rounds", "0"])
        must("st-check", raw / "mesh.hdf", "--geometry", raw / "geometry.hdf")
        self.assertNotEqual(content_hash(raw / "mesh.hdf"), content_hash(artifacts_of("torus") / "mesh.hdf"))

    def test_turning_along_edges_is_bounded(self):
        coarse = ["--lmin", "20%", "--lmax", "30%", "--alpha", "90"]
        few = make_chain(MODELS / "cylinder.brep", self.folder / "few", raster_options=coarse,
                         mesh_options=["--max-turning", "60"])
        many = make_chain(MODELS / "cylinder.brep", self.folder / "many", raster_options=coarse,
                          mesh_options=["--max-turning", "5"])
        self.assertGreater(self.n_triangles(many), self.n_triangles(few))


if __name__ == "__main__":
    unittest.main(verbosity=2)
