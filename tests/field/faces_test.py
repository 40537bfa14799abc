#!/usr/bin/env python3
"""Faces whose loops or curves are wrong in the file: repaired and said, or left out and named, whole chains."""
import math
import os
import shutil
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from chain import GEOMETRY, MODELS, OK, Run, ToolTest, make_chain  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]
FIELD = Path(os.environ.get("ST_CORPUS", ROOT.parent / "shared" / "corpus")).parent / "field"


class Faces(ToolTest):
    def chain(self, model, **options):
        """What st-check finds of the mesh, which passes."""
        at = make_chain(model, self.folder / Path(model).stem, **options)
        run = Run("st-check", at / "mesh.hdf", "--geometry", at / "geometry.hdf", "--sizing", at / "sizing.hdf",
                  "--json")
        self.assertEqual(run.code, OK, run)
        return run.json()

    def imported(self, model):
        run = Run("st-import", model, "-o", self.folder / "g.hdf", "--json")
        self.assertEqual(run.code, OK, run)
        return run, [f["what"] for f in run.json()["findings"]]

    def from_field(self, name):
        if not (FIELD / name).exists():
            self.skipTest(f"{FIELD / name} is not there")
        return FIELD / name

    def test_a_hole_in_another_period_is_a_hole(self):
        sound = self.chain(MODELS / "rod_hole.brep")
        for name in ("rod_hole_p1", "rod_hole_closed", "rod_hole_nearly_closed", "rod_hole_no_seam_p1"):
            moved = self.chain(MODELS / f"{name}.brep")
            if name == "rod_hole_p1":
                self.assertEqual(moved["triangles"], sound["triangles"])
            self.assertAlmostEqual(moved["area"] / sound["area"], 1, delta=1e-3, msg=name)

    def test_a_hole_beside_its_face_is_left_out(self):
        for name, area in (("stray_hole", 30 * 1.5 * 100), ("box_stray_hole", 8800),
                           ("box_stray_tube", 8800 + 2 * math.pi * 5 * 30)):
            run, _ = self.imported(MODELS / f"{name}.brep")
            self.assertIn("hole outside its face, left out", run.err)
            self.assertAlmostEqual(run.json()["area"] / area, 1, 5, name)
            self.assertEqual("open there: face 7" in run.err, name == "box_stray_tube", run.err)
            self.assertAlmostEqual(self.chain(MODELS / f"{name}.brep")["area"] / area, 1, delta=0.01, msg=name)

    def test_an_edge_without_a_curve_in_space_is_no_straight_line(self):
        found = self.chain(MODELS / "no_curve_ring.brep", raster_options=["--lmax", "5%"])
        self.assertAlmostEqual(found["area"] / (2 * math.pi * 30 * 130), 1, delta=0.01)
        self.assertAlmostEqual(found["volume"] / (math.pi * 900 * 100), 1, delta=0.01)
        run, _ = self.imported(MODELS / "no_curve_ring.brep")
        self.assertIn("edge without a curve in space (2 times)", run.err)

    def test_a_twisted_band_keeps_its_area(self):
        run, _ = self.imported(MODELS / "twisted_band.brep")
        self.assertIn("repair taken back: sewn, it would have an area of 0 instead of 248.9", run.err)
        self.assertAlmostEqual(self.chain(MODELS / "twisted_band.brep")["area"] / 248.9, 1, delta=0.01)

    def test_a_seam_that_leaves_its_surface_is_made_again(self):
        found = self.chain(MODELS / "bumped_seam.brep")
        self.assertAlmostEqual(found["area"] / (400 * math.pi), 1, delta=0.01)
        self.assertLess(found["deviation"]["max"], 0.1)

    def test_faces_without_loops_that_can_be_made_are_left_out_and_named(self):
        run, _ = self.imported(MODELS / "no_curve_lost.brep")
        self.assertIn("face 1: face left out: an edge of it has no trimming curve", run.err)
        self.assertIn("face 2: face left out", run.err)
        self.chain(MODELS / "no_curve_lost.brep")
        self.expect_error(GEOMETRY, "st-import", self.from_field("red_sat46_face1.brep"), "-o", self.folder / "s.hdf",
                          says="face 1 cannot be meshed")

    def test_an_offset_that_folds_over_itself_is_named(self):
        for model in (MODELS / "folded_offset.brep", self.from_field("b27_offset_near_fold.brep")):
            run, _ = self.imported(model)
            self.assertIn("face 1 itself, in a fold", run.err)

    def test_an_assembly_names_the_files_that_are_missing(self):
        self.expect_error(GEOMETRY, "st-import", self.from_field("stepcode_s1c5.stp"), "-o", self.folder / "s.hdf",
                          says=["missing: FOOT.stp, HEAD.stp, MAINBODY.stp, TAIL.stp", "put them beside it"])

    def test_an_assembly_of_which_a_part_is_there_warns_of_the_others(self):
        shutil.copy(self.from_field("stepcode_s1c5.stp"), self.folder / "s.stp")
        shutil.copy(MODELS / "box.step", self.folder / "FOOT.stp")
        run, found = self.imported(self.folder / "s.stp")
        for name in ("HEAD", "MAINBODY", "TAIL"):
            self.assertIn(f"parts in another file, which is missing: {name}.stp", run.err)
        self.assertNotIn("FOOT", run.err)
        self.assertEqual(len(found), 3)

    def test_field_files_are_right(self):
        rod = self.chain(self.from_field("red_rod_hole_other_period.brep"))
        sound = self.chain(self.from_field("red_rod_hole_ok.brep"))
        self.assertEqual(rod["triangles"], sound["triangles"])
        sphere = self.chain(self.from_field("sphere_tolerance_raised.brep"))
        self.assertAlmostEqual(sphere["area"] / (4 * math.pi + 0.24), 1, delta=0.01)
        self.assertLess(sphere["deviation"]["max"], 0.02)


if __name__ == "__main__":
    unittest.main()
