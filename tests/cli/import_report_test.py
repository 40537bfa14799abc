"""What st-import says: defects, repairs, extent with unit, and what it refuses."""
import sys
import unittest
import zipfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
from chain import MODELS, Run, ToolTest, must  # noqa: E402

KEYS = ["closed", "unit", "solids", "shells", "faces", "edges", "free_edges", "nonmanifold_edges", "repairs",
        "findings", "area", "volume", "box"]


class Report(ToolTest):
    def import_json(self, model, *options):
        return must("st-import", model, "-o", self.folder / "g.hdf", "--json", *options).json()

    def test_json_has_what_others_rely_on(self):
        report = self.import_json(MODELS / "box.step")
        self.assertEqual([k for k in KEYS if k not in report], [])
        self.assertTrue(report["closed"])
        self.assertEqual((report["unit"], report["solids"], report["shells"], report["faces"], report["edges"]),
                         ("mm", 1, 1, 6, 12))
        self.assertEqual((report["free_edges"], report["nonmanifold_edges"], report["repairs"]), (0, 0, []))

    def test_line_shows_box_area_and_volume_with_the_unit(self):
        report = self.import_json(MODELS / "box_inch.step")
        text = must("st-import", MODELS / "box_inch.step", "-o", self.folder / "g.hdf").out
        for part in (" in,", " in^2,", " in^3,", f"area {report['area']:.6g}", f"volume {report['volume']:.6g}"):
            self.assertIn(part, text)

    def test_check_writes_nothing(self):
        text = must("st-import", MODELS / "box.step", "-o", self.folder / "g.hdf", "--check").out
        self.assertIn("closed", text)
        self.assertFalse((self.folder / "g.hdf").exists())

    def test_open_model_is_a_warning_and_an_error_on_request(self):
        model = MODELS / "plate_with_hole.brep"
        report = self.import_json(model)
        self.assertFalse(report["closed"])
        free = [f for f in report["findings"] if f["what"] == "free edge"]
        self.assertEqual((len(free), report["free_edges"]), (5, 5))
        self.assertTrue(all(len(f["xyz"]) == 3 and f["size"] > 0 and f["entity"].startswith("edge") for f in free))
        (self.folder / "g.hdf").unlink()
        self.expect_error(4, "st-import", model, "-o", self.folder / "g.hdf", "--require-closed",
                          says=[str(model), "5 free edges"])
        self.assertFalse((self.folder / "g.hdf").exists())
        must("st-import", MODELS / "box.step", "-o", self.folder / "g.hdf", "--require-closed")

    def test_verbose_shows_ten_findings_and_counts_the_rest(self):
        run = must("st-import", MODELS / "sphere.brep", "-o", self.folder / "g.hdf", "-v", "--small", "1000")
        self.assertNotIn("more: see", run.err)
        run = must("st-import", MODELS / "box.step", "-o", self.folder / "g.hdf", "-v", "--small", "1000")
        self.assertIn("and 8 more: see --json", run.err)  # 12 short edges, 6 narrow faces

    def test_what_cap_left_open_is_not_sent_to_cap_again(self):
        model = MODELS / "twisted_band.brep"
        for option, advice in ((["--cap"], "--cap left openings as they are"), ([], "--cap closes openings in planes")):
            run = Run("st-import", model, *option, "--farfield", "box:3", cwd=self.folder)
            self.assertEqual(run.code, 4, run)
            self.assertIn(advice, run.err.splitlines()[-1])

    def test_cap_closes_openings_in_planes_and_says_so(self):
        model = MODELS / "plate_with_hole.brep"
        run = must("st-import", model, "-o", self.folder / "g.hdf", "--cap")
        self.assertEqual(run.err.count("  cap_1: opening closed: area "), 1)
        self.assertNotIn("repaired", run.err)  # it was asked for
        self.assertIn("--cap closes openings in planes", must("st-import", model, "-o", self.folder / "h.hdf").err)
        report = self.import_json(model, "--cap")
        self.assertEqual((report["faces"], report["free_edges"]), (2, 4))
        self.assertIn("its rim of 4 edges is the outline of a flat face, at (30, 20, 0)", run.err)
        self.assertIn('"cap":true', must("st-info", self.folder / "g.hdf").out)
        self.assertIn("--cap: there is no opening",
                      must("st-import", MODELS / "box.step", "-o", self.folder / "g.hdf", "--cap").err)


class Bodies(ToolTest):
    """Parts that cross or touch."""

    def run_import(self, model, *options):
        run = must("st-import", MODELS / model, "-o", self.folder / "g.hdf", "--json", *options)
        return run.json(), run.err

    def group_names(self, report):
        return {g["name"] for t in report["tables"] for g in t["groups"]}

    def test_parts_that_cross_are_named_with_the_option_that_unites_them(self):
        report, text = self.run_import("concept.step")
        self.assertIn("3 pairs of parts cross", text)
        self.assertIn("wing", text)
        self.assertIn("--unite", text)
        self.assertEqual(report["solids"], 3)

    def test_unite_leaves_one_surface_with_the_names_of_its_parts(self):
        report, text = self.run_import("concept.step", "--unite")
        self.assertNotIn("cross", text)
        self.assertEqual((report["solids"], report["shells"], report["closed"], report["nonmanifold_edges"]),
                         (1, 1, True, 0))
        self.assertEqual(self.group_names(report), {"body", "wing", "pylon"})

    def test_united_parts_mesh_without_crossings(self):
        g, r, s, p, m = (self.folder / f"{n}.hdf" for n in "grspm")
        must("st-import", MODELS / "concept.step", "--unite", "-o", g)
        must("st-raster", g, "-o", r)
        must("st-prolong", r, "-o", s)
        must("st-mesh", g, s, "-o", p)
        must("st-merge", p, "-o", m)
        must("st-check", m, "--geometry", g)

    def test_parts_that_touch_have_a_common_face_where_asked(self):
        report, _ = self.run_import("stacked.step", "--join")
        self.assertEqual(self.group_names(report), {"plate", "block", "interface_block_plate"})
        self.assertEqual(report["faces"], 12)
        for options, says in ((["--join"], True), ([], False)):
            run = must("st-import", MODELS / "stacked.step", "-o", self.folder / "g.hdf", *options)
            self.assertEqual(" (faces between solids once), volume " in run.out, says, run.out)
        report, _ = self.run_import("stacked.step")
        self.assertEqual((report["faces"], self.group_names(report)), (12, {"plate", "block"}))


class Refused(ToolTest):
    def expect_refused(self, path, *says, options=()):
        self.expect_error(3, "st-import", path, "-o", self.folder / "out.hdf", *options, says=[str(path), *says])
        self.assertFalse((self.folder / "out.hdf").exists())

    def test_other_kinds_of_file_are_named(self):
        kinds = {"PNG": b"\x89PNG\r\n\x1a\n" + bytes(200), "web page": b"<!DOCTYPE html><html></html>",
                 "PDF": b"%PDF-1.4\n"}
        for kind, data in kinds.items():
            path = self.folder / "model.step"
            path.write_bytes(data)
            self.expect_refused(path, kind, "not a")
        (self.folder / "model.step").write_bytes(b"solid x\nendsolid\n")
        self.expect_refused(self.folder / "model.step", "no whole triangles", "STL")
        with zipfile.ZipFile(self.folder / "model.step", "w") as archive:
            archive.writestr("model.step", "ISO-10303-21;")
        self.expect_refused(self.folder / "model.step", "zip archive")
        (self.folder / "noise.step").write_bytes(bytes(range(256)) * 20)
        self.expect_refused(self.folder / "noise.step")

    def test_file_that_is_cut_off(self):
        for name in ("box.step", "box.igs", "box.brep"):
            data = (MODELS / name).read_bytes()
            for share in (0.3, 0.6, 0.9, 0.98):
                path = self.folder / name
                path.write_bytes(data[: int(share * len(data))])
                self.expect_refused(path)

    def test_time_limit_ends_the_reading(self):
        self.expect_refused(MODELS / "assembly.step", "--time-limit", options=("--time-limit", "0.002"))


if __name__ == "__main__":
    unittest.main(verbosity=2)
