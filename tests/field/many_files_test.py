#!/usr/bin/env python3
"""scripts/many_files.py: files that are right are not silent, and what is wrong though the check passes is."""
import os
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from chain import BIN, MODELS, ToolTest  # noqa: E402

SCRIPT = Path(__file__).resolve().parents[2] / "scripts" / "many_files.py"
FAR = '{"area_error": -0.02, "face_error": 0.05, "wrong_faces": 1, "unsure_faces": 0, "unpaired_faces": 0, ' \
      '"duplicates": 0, "worst_face": 3, "worst_area": 2.0}'


class ManyFiles(ToolTest):
    def run_script(self, models, *options):
        done = subprocess.run([sys.executable, SCRIPT, BIN, self.folder / "table.tsv", "--jobs", "1", *options],
                              input="".join(f"{MODELS / m}\n" for m in models), capture_output=True, text=True)
        table = (self.folder / "table.tsv").read_text(encoding="utf-8").splitlines()
        return done, [dict(zip(table[0].split("\t"), line.split("\t"))) for line in table[1:]]

    def program(self, says):
        path = self.folder / f"program_{len(list(self.folder.iterdir()))}"
        path.write_text(f"#!/bin/sh\necho '{says}'\n", encoding="utf-8")
        path.chmod(0o755)
        return path

    def test_compares_with_what_opencascade_finds_in_the_file(self):
        models = ["box_inch.step", "torus.brep", "plate_with_hole.brep", "loose_box_and_sphere.brep"]
        done, rows = self.run_script(models)
        self.assertEqual(done.returncode, 0, done)
        self.assertIn("4 files, 0 silent", done.stdout)
        for row in rows:
            self.assertEqual((row["verdict"], row["faces off"]), ("passes", "0"), row)
            self.assertLess(abs(float(row["area %"])), 0.5, row)
            if row["shape"] == "closed":
                self.assertLess(abs(float(row["volume %"])), 1, row)
        self.assertEqual(rows[3]["shape"], "closed")
        self.assertLess(abs(float(rows[3]["volume %"])), 1, "a sphere in no shell counts, too")
        again, _ = self.run_script(models)
        self.assertEqual(again.stdout, done.stdout, "files of the table are passed over")

    def test_says_what_is_wrong_though_the_check_passes(self):
        done, rows = self.run_script(["box.brep"], "--measure", self.program(FAR))
        self.assertEqual(done.returncode, 1, done)
        self.assertEqual(rows[0]["silent"], "area %, face %")
        (self.folder / "table.tsv").unlink()
        done, rows = self.run_script(["box.brep"], "--judge", self.program('{"folds": 2, "self_intersections": 0}'))
        self.assertEqual((done.returncode, rows[0]["silent"]), (1, "folds"), done)

    def test_faces_that_the_import_divides_or_merges_are_compared_as_the_file_has_them(self):
        models = ["kink_notch.brep", "kink_prism.brep", "folded_sliver.brep", "rod_hole_no_seam.brep"]
        done, rows = self.run_script(models)
        self.assertEqual(done.returncode, 0, done)
        rows = {Path(r["file"]).name: r for r in rows}
        self.assertEqual([rows[m]["faces off"] for m in models], ["0", "0", "1", "0"], rows)
        self.assertLess(abs(float(rows["kink_prism.brep"]["area %"])), 0.1, "its faces are not smooth")
        self.assertLess(abs(float(rows["rod_hole_no_seam.brep"]["volume %"])), 0.5, "as OpenCASCADE repairs it")

    def test_folds_of_the_cad_are_none_of_the_mesh(self):
        done, rows = self.run_script(["fan.brep"], "--judge", self.program('{"folds": 1}'))
        self.assertEqual((done.returncode, rows[0]["silent"]), (0, ""), "its surface meets itself at a sharp seam")
        (self.folder / "table.tsv").unlink()
        done, rows = self.run_script(["fan.brep"], "--judge", self.program('{"folds": 1000}'))
        self.assertEqual((done.returncode, rows[0]["silent"]), (1, "folds"), done)

    def test_goes_on_after_a_file_that_cannot_be_meshed(self):
        (self.folder / "empty.step").touch()
        done, rows = self.run_script([os.path.relpath(self.folder / "empty.step", MODELS), "box.brep"])
        self.assertEqual((done.returncode, [r["code"] for r in rows]), (0, ["3", "0"]), done)


if __name__ == "__main__":
    unittest.main()
