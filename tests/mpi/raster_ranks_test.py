"""The octree that all ranks build together does not depend on their number, nor on which of them sampled what."""
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
from chain import MODELS, ToolTest, artifacts_of, must  # noqa: E402


class RasterRanks(ToolTest):
    def hashes(self, model, *options, ranks=(1, 2, 3, 5, 8)):
        geometry = artifacts_of(model) / "geometry.hdf"
        return {must("st-raster", geometry, "-o", self.folder / "r.hdf", "--np", n, *options, "--json").json()["hash"]
                for n in ranks}

    def test_the_raster_is_equal_at_np_1_2_3_5_8(self):
        self.assertEqual(len(self.hashes("assembly")), 1)

    def test_samples_with_places_are_equal_at_np_1_2_3_5_8(self):
        self.assertEqual(len(self.hashes("assembly", "--cell-per-length", 5)), 1)

    def test_a_face_for_one_rank_of_eight_is_enough(self):
        self.assertEqual(len(self.hashes("torus", ranks=(1, 8))), 1)

    def test_a_turned_model_of_many_faces_is_measured_by_all_ranks(self):
        boxes = []
        for i in range(12):  # 72 faces: more than one task of facets
            must("st-import", MODELS / "box.step", "-o", self.folder / "box.hdf")
            boxes.append(self.folder / f"{i}.hdf")
            must("st-edit", self.folder / "box.hdf", "-o", boxes[-1], "--transform", f"translate {i * 70} 0 0")
        must("st-edit", *boxes, "--as", ",".join(f"b{i}" for i in range(12)), "-o", self.folder / "row.hdf")
        must("st-edit", self.folder / "row.hdf", "-o", self.folder / "turned.hdf", "--transform", "rotate 30 1 2 3")
        runs = [must("st-raster", self.folder / name, "-o", self.folder / "r.hdf", "--np", n, "--json").json()
                for name, n in (("row.hdf", 1), ("turned.hdf", 1), ("turned.hdf", 3))]
        self.assertEqual(runs[1]["hash"], runs[2]["hash"])
        self.assertAlmostEqual(runs[1]["lmax"], runs[0]["lmax"], delta=1e-3 * runs[0]["lmax"])

    def test_wings_apart_are_walked_by_all_ranks_and_found_alike(self):
        parts = []
        for i, name in enumerate(("wing_of_8.brep", "wing_of_8.brep", "wing_with_flap.step", "thin_plate.brep")):
            must("st-import", MODELS / name, "--unit", "mm", "-o", self.folder / f"{i}.hdf")
            parts.append(self.folder / f"moved{i}.hdf")
            must("st-edit", self.folder / f"{i}.hdf", "-o", parts[-1], "--transform",
                 f"scale {0.3 if i > 1 else 1}; translate 0 {200 * i} 0")
        must("st-edit", *parts, "--as", "a,b,c,d", "-o", self.folder / "wings.hdf")
        runs = [must("st-raster", self.folder / "wings.hdf", "-o", self.folder / "r.hdf", "--np", ranks, "--threads",
                     threads, "--json").json() for ranks, threads in ((1, 1), (1, 2), (2, 1), (3, 2), (4, 1))]
        self.assertGreater(len(runs[0]["lifting_surfaces"]), 2)
        self.assertEqual({run["hash"] for run in runs}, {runs[0]["hash"]})
        self.assertEqual([run["lifting_surfaces"] for run in runs[1:]], 4 * [runs[0]["lifting_surfaces"]])
        self.assertEqual([run["unused_trailing"] for run in runs[1:]], 4 * [runs[0]["unused_trailing"]])

    def test_large_cells_are_fewer_and_their_lengths_hold(self):
        geometry, counts, triangles = artifacts_of("assembly") / "geometry.hdf", [], []
        for cell_per_length in (2, 4, 8):
            raster, sizing = self.folder / f"r{cell_per_length}.hdf", self.folder / f"s{cell_per_length}.hdf"
            counts.append(must("st-raster", geometry, "-o", raster, "--cell-per-length", cell_per_length,
                               "--json").json()["cells"])
            triangles.append(must("st-prolong", raster, "-o", sizing, "--json").json()["expected_triangles"])
        self.assertLess(counts[1], 0.6 * counts[0])
        self.assertLess(counts[2], 0.6 * counts[1])
        self.assertLess(max(triangles), 1.05 * triangles[0], "lengths must not become too small in large cells")
        self.assertGreater(min(triangles), 0.6 * triangles[0], "nor too large")


if __name__ == "__main__":
    unittest.main(verbosity=2)
