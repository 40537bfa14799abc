#!/usr/bin/env python3
"""Aircraft of bare spline surfaces, as conceptual-design tools write them, become closed bodies of the right area and
volume, whatever the layout of skins and caps."""
import sys
import time
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
import vsp_models as vsp  # noqa: E402
from chain import ToolTest, make_chain, must  # noqa: E402

MOST_SECONDS = 30  # 10 on an idle machine


class Vsp(ToolTest):
    def imported(self, name, components, layout, *options, iges=False):
        path = self.folder / (name + (".igs" if iges else ".stp"))
        (vsp.write_iges if iges else vsp.write_step)(path, components, layout)
        start = time.monotonic()
        report = must("st-import", path, "-o", self.folder / (name + ".hdf"), "--json", *options).json()
        self.assertLess(time.monotonic() - start, MOST_SECONDS, name)
        return report

    def expect_closed(self, report, components, n_solids, label):
        area = sum(c.measures()[0] for c in components)
        volume = sum(c.measures()[1] for c in components)
        self.assertTrue(report["closed"], label)
        self.assertEqual(report["free_edges"], 0, label)
        self.assertEqual(report["solids"], n_solids, label)
        self.assertAlmostEqual(report["area"] / area, 1, 4, label)
        self.assertAlmostEqual(report["volume"] / volume, 1, 4, label)

    def test_wings_close_in_every_layout(self):
        for te, tip, strips in (("sharp", "flat", True), ("sharp", "round", False), ("blunt", "flat", True)):
            wing = vsp.kinked_wing(te=te, tip=tip, strips=strips)
            for layout in ("patches", "skins", "whole", "single"):
                label = f"{te}_{tip}_{layout}"
                self.expect_closed(self.imported(label, [wing], layout), [wing], 1, label)

    def test_open_wings_have_no_faces_without_area(self):
        wing = vsp.kinked_wing(tip="none", root="none", strips=True)
        for layout in ("whole", "single"):
            report = self.imported(layout, [wing], layout)
            self.assertEqual((report["faces"], report["free_edges"]), (2, 2), "upper and lower skin, root and tip")
            self.assertAlmostEqual(report["area"] / wing.measures()[0], 1, 4, layout)

    def test_wings_of_iges_close(self):
        wing = vsp.kinked_wing(tip="round")
        for layout in ("patches", "single"):
            report = self.imported(layout, [wing], layout, iges=True)
            self.expect_closed(report, [wing], 1, layout)

    def test_tips_that_are_points_or_lines_are_left_out_and_named(self):
        tips = {"point": vsp.Section(20, x=5, chord=0), "flat": vsp.Section(20, x=5, chord=2, thickness=0)}
        for kind, last in tips.items():
            wing = vsp.wing("wing", [vsp.Section(0, chord=10), last], tip=kind)
            for layout in ("patches", "whole"):
                report = self.imported(kind + layout, [wing], layout)
                self.expect_closed(report, [wing], 1, kind + layout)
                self.assertTrue([r for r in report["repairs"] if r["what"] == "face without area, left out"], report)

    def test_symmetric_copies_close(self):
        wing = vsp.kinked_wing(root="none")
        both = [wing, wing.mirrored()]
        for layout in ("patches", "whole"):
            self.expect_closed(self.imported("open" + layout, both, layout), both, 1, layout)
        wing = vsp.kinked_wing()
        both = [wing, wing.mirrored()]
        report = self.imported("root", both, "skins")
        self.assertEqual((report["solids"], report["free_edges"]), (2, 0), report)
        report = self.imported("united", both, "skins", "--unite")
        self.assertEqual((report["solids"], report["nonmanifold_edges"]), (1, 0), report)
        self.assertAlmostEqual(report["volume"] / (2 * wing.measures()[1]), 1, 4)

    def test_a_wing_through_a_fuselage_is_united_and_meshed(self):
        wing = vsp.kinked_wing(tip="round").moved((10, 0.8, -0.5))
        parts = [vsp.fuselage(), wing, wing.mirrored()]
        self.expect_closed(self.imported("apart", parts, "skins"), parts, 3, "apart")
        folder = make_chain(self.folder / "apart.stp", self.folder / "chain", import_options=["--unite"],
                            raster_options=["--lmax", "3%"])
        report = must("st-check", folder / "mesh.hdf", "--geometry", folder / "geometry.hdf", "--json").json()
        self.assertTrue(report["passes"], report)

    def test_single_surfaces_are_united_as_their_patches_are(self):
        wing = vsp.kinked_wing(tip="round").moved((10, 0.8, -0.5))
        parts = [vsp.fuselage(), wing, wing.mirrored()]
        single, patches = (self.imported(layout, parts, layout, "--unite") for layout in ("single", "patches"))
        for report in (single, patches):
            self.assertEqual((report["solids"], report["free_edges"]), (1, 0), report)
            self.assertFalse(report["findings"], report["findings"])
        for key in ("area", "volume"):
            self.assertAlmostEqual(single[key] / patches[key], 1, 5, key)

    def test_shaken_points_close_in_every_layout(self):
        for te, tip, strips in (("sharp", "round", False), ("blunt", "flat", True)):
            wing = vsp.shaken(vsp.kinked_wing(te=te, tip=tip, strips=strips), 3e-6)
            for layout in ("patches", "skins", "whole", "single"):
                label = f"shaken_{te}_{tip}_{layout}"
                self.expect_closed(self.imported(label, [wing], layout), [wing], 1, label)

    def test_shaken_points_never_close_to_another_volume(self):
        """Edges shorter than what was shaken find wrong partners: bodies with one side, or edges ten feet apart."""
        layouts = (("straight", "sharp", "flat", "patches", 3e-5, 23), ("kinked", "sharp", "flat", "skins", 3e-5, 62),
                   ("straight", "blunt", "round", "whole", 1e-6, 38), ("kinked", "blunt", "flat", "whole", 1e-5, 3))
        for kind, te, tip, layout, by, seed in layouts:
            sound = getattr(vsp, kind + "_wing")(te=te, tip=tip, strips=te == "blunt")
            label = f"shaken_{kind}_{te}_{tip}_{layout}"
            self.expect_closed(self.imported(label, [vsp.shaken(sound, by, seed)], layout), [sound], 1, label)

    def test_what_sewing_would_twist_stays_open_and_is_named(self):
        wing = vsp.shaken(vsp.straight_wing(te="blunt", strips=True), 1e-5, 65)
        report = self.imported("twisted", [wing], "patches")
        self.assertFalse(report["closed"])
        self.assertEqual(report["volume"], 0)
        self.assertTrue([f for f in report["findings"] if "could not agree which side is outside" in f["what"]])


if __name__ == "__main__":
    unittest.main()
