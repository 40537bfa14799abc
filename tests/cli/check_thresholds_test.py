"""st-check's thresholds and report on the command line and in option files: each option reaches its check."""
import json
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
from chain import INCOMPLETE, OK, OUTPUT, USAGE, Run, ToolTest, artifacts_of, must  # noqa: E402

# Option, a value that any good mesh of a cylinder meets, one that none meets.
DECIDING = [
    ("min-quality", 0.01, 1),
    ("min-mean-quality", 0.5, 1),
    ("min-p1-quality", 0.1, 1),
    ("min-angle", 0.1, 60),
    ("max-jump", 1000, 1),
    ("min-size-share", 0.1, 1),
    ("max-deviation", "5%", "1e-9%"),
    ("max-normal-deviation", 90, 1e-6),
]


class Thresholds(ToolTest):
    def setUp(self):
        super().setUp()
        good = artifacts_of("cylinder")
        self.inputs = [good / "mesh.hdf", "--geometry", good / "geometry.hdf", "--sizing", good / "sizing.hdf"]

    def expect(self, code, failed, *arguments):
        run = Run("st-check", *self.inputs, "--json", *arguments)
        self.assertEqual(run.code, code, run)
        self.assertEqual(run.json()["failed"], failed)
        return run

    def test_every_threshold_decides(self):
        for option, met, missed in DECIDING:
            self.expect(OK, [], f"--{option}", met)
            self.expect(INCOMPLETE, [option], f"--{option}", missed)

    def test_every_threshold_decides_from_an_option_file(self):
        for option, _, missed in DECIDING:
            value = f'"{missed}"' if isinstance(missed, str) else missed
            (self.folder / "o.toml").write_text(f"[st-check]\n{option} = {value}\n")
            self.expect(INCOMPLETE, [option], "--options", self.folder / "o.toml")

    def test_numbers_of_accepted_defects_reach_their_checks(self):
        checks = self.expect(OK, [], "--max-folds", 3, "--max-crossings", 5).json()["checks"]
        self.assertEqual([checks[name]["allowed"] for name in ("folds", "crossings", "overlaps", "closed")],
                         [3, 5, 5, 0])

    def test_free_sharp_triangles_decide_below_the_angle_asked_for(self):
        self.expect(OK, [], "--max-free-sharp", 0)
        run = self.expect(INCOMPLETE, ["max-free-sharp"], "--max-free-sharp", 0, "--list-below", 60)
        free = run.json()["causes"]["sharp"]["free"]
        self.assertEqual(run.json()["checks"]["max-free-sharp"]["count"], free)
        self.expect(OK, [], "--max-free-sharp", free, "--list-below", 60)
        self.assertEqual(run.json()["causes"]["below_deg"], 60)

    def test_threshold_without_its_input_is_2(self):
        mesh = self.inputs[0]
        for option, value, needed in [("max-free-sharp", 0, "--geometry"), ("min-size-share", 0.5, "--sizing"),
                                      ("max-deviation", 1, "--geometry"), ("max-normal-deviation", 9, "--geometry")]:
            self.expect_error(USAGE, "st-check", mesh, f"--{option}", value, says=[f"--{option}", needed])

    def test_deviation_in_a_unit_the_model_does_not_have_is_2(self):
        cylinder = artifacts_of("cylinder")
        self.expect_error(USAGE, "st-check", cylinder / "mesh.hdf", "--geometry", cylinder / "geometry.hdf",
                          "--max-deviation", "1mm", says="--max-deviation")



class Report(ToolTest):
    def test_report_has_model_groups_and_faces_with_histograms(self):
        good = artifacts_of("cylinder")
        path = self.folder / "report.json"
        run = must("st-check", good / "mesh.hdf", "--geometry", good / "geometry.hdf", "--sizing", good / "sizing.hdf",
                   "--report", path, "--json")
        report = json.loads(path.read_text())
        n = report["triangles"]
        self.assertEqual(n, run.json()["triangles"])
        for entries in ([report], report["groups"], report["faces"]):
            self.assertEqual(sum(sum(e["quality"]["histogram"]) for e in entries), n)
            self.assertEqual(sum(sum(e["quality"]["angle_histogram"]) for e in entries), 3 * n)
            self.assertEqual(sum(sum(e["deviation"]["normal_histogram"]) for e in entries), n)
            self.assertEqual(sum(sum(e["jumps"]["histogram"]) for e in entries), report["edges"])
            sizes = [e["sizes"].get("all", e["sizes"]) for e in entries]
            self.assertEqual(sum(sum(s["histogram"]) for s in sizes), report["edges"])
        self.assertEqual(max(f["deviation"]["max"] for f in report["faces"]), report["deviation"]["max"])
        self.assertEqual(sum(p["edges"] for p in report["sizes"]["forced"]), report["sizes"]["forced_edges"])

    def test_unwritable_report_is_6_and_leaves_nothing(self):
        mesh = artifacts_of("cylinder") / "mesh.hdf"
        self.expect_error(OUTPUT, "st-check", mesh, "--report", self.folder / "none" / "report.json",
                          says="report.json")
        self.expect_nothing_left(self.folder)

    def test_report_over_the_mesh_is_2(self):
        mesh = artifacts_of("cylinder") / "mesh.hdf"
        self.expect_error(USAGE, "st-check", mesh, "--report", mesh, says="mesh.hdf")


if __name__ == "__main__":
    unittest.main(verbosity=2)
