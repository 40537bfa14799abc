#!/usr/bin/env python3
"""A kink inside a face becomes an edge: whole chains."""
import math
import os
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from chain import MODELS, OK, Run, ToolTest, make_chain, must  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]
FIELD = Path(os.environ.get("ST_CORPUS", ROOT.parent / "shared" / "corpus")).parent / "field"


class Kinks(ToolTest):
    def checked(self, model):
        """What st-import says of a model, and st-check of its mesh, which passes."""
        run = Run("st-import", model, "-o", self.folder / "g.hdf", "--json")
        self.assertEqual(run.code, OK, run)
        at = make_chain(model, self.folder / Path(model).stem, raster_options=["--lmax", "8%"])
        check = Run("st-check", at / "mesh.hdf", "--geometry", at / "geometry.hdf", "--sizing", at / "sizing.hdf",
                    "--json")
        self.assertEqual(check.code, OK, check)
        return run.json(), check.json()

    def expect(self, model, n_faces, area, volume=None, worst_normal=1):
        imported, found = self.checked(model)
        self.assertEqual(imported["faces"], n_faces, model)
        self.assertTrue([f for f in imported["repairs"] if f["what"].startswith("surface divided at its kinks")])
        self.assertAlmostEqual(found["area"] / area, 1, delta=4e-3, msg=model)
        if volume:
            self.assertEqual(imported["free_edges"], 0, model)
            self.assertAlmostEqual(found["volume"] / volume, 1, delta=4e-3, msg=model)
        self.assertLess(found["deviation"]["normal_max_deg"], worst_normal, model)

    def test_prisms_are_boxes(self):
        for name in ("kink_prism", "kink_cubic"):
            self.expect(MODELS / f"{name}.brep", 6, 52, 24)
        self.expect(MODELS / "kink_twice.brep", 12, 104, 48)
        self.expect(MODELS / "kink_tube.brep", 7, 64, 32)

    def test_parts_of_a_face_are_shown_by_its_number_in_the_file(self):
        twice, plain = self.folder / "twice.hdf", self.folder / "plain.hdf"
        imported = must("st-import", MODELS / "kink_twice.brep", "-o", twice, "--json").json()
        must("st-import", MODELS / "no_kink_plate.brep", "-o", plain)
        info = must("st-info", twice, "--json")
        of_file = info.json()["file_faces"]
        self.assertEqual((len(of_file), len(set(of_file))), (12, 8))
        self.assertNotIn("file_faces", must("st-info", plain, "--json").json())
        for face in (f for f in set(of_file) if of_file.count(f) > 1):
            ids = ", ".join(str(k + 1) for k, f in enumerate(of_file) if f == face)
            self.assertIn(f"face {face} of the file is {ids}", must("st-info", twice).out)
            what = [f["what"] for f in imported["repairs"] if f["entity"] == f"face {face} of the file"]
            self.assertEqual(what, [f"surface divided at its kinks: 3 faces: {ids}"])

    def test_a_kink_in_an_edge_of_a_plane_is_a_node(self):
        _, found = self.checked(MODELS / "no_kink_plate.brep")
        self.assertAlmostEqual(found["area"] / 12, 1, delta=1e-4, msg="a node is within 1 % of a length of it")

    def test_cones_of_one_face_meet_in_a_circle(self):
        self.expect(MODELS / "kink_turned.brep", 4, 2 * math.pi * (1 + 8 * math.sqrt(2)), None, 10)

    def test_ridges_are_planes(self):
        self.expect(MODELS / "kink_ridge.brep", 4, 16 * math.sqrt(1.5))
        self.expect(MODELS / "kink_hole.brep", 4, (16 - math.pi) * math.sqrt(1.5))
        self.expect(MODELS / "kink_notch.brep", 4, 13 * math.sqrt(1.5))

    def test_field_files_are_right(self):
        for name in ("b26_c0_kink_spline_extruded", "b26_c0_ridge_face"):
            if not (FIELD / f"{name}.brep").exists():
                self.skipTest(f"{FIELD / name} is not there")
        self.expect(FIELD / "b26_c0_kink_spline_extruded.brep", 6, 43.1668, 18.9003, 15)
        self.expect(FIELD / "b26_c0_ridge_face.brep", 4, 83.346, None, 15)


if __name__ == "__main__":
    unittest.main()
