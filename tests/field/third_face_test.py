#!/usr/bin/env python3
"""A third face at an edge, of loose faces, is sewn, named and meshed once."""
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
import vsp_models as vsp  # noqa: E402
from chain import ToolTest, make_chain, must  # noqa: E402

FIELD = Path(__file__).resolve().parent


class ThirdFace(ToolTest):
    def meshed(self, path):
        report = must("st-import", path, "-o", self.folder / "g.hdf", "--json").json()
        folder = make_chain(path, self.folder / "chain")
        check = must("st-check", folder / "mesh.hdf", "--geometry", folder / "geometry.hdf", "--json").json()
        self.assertTrue(check["passes"], check)
        self.assertEqual(check["checks"]["contacts"]["count"], 0, check["checks"]["contacts"])
        return report, check

    def texts(self, report):
        return [finding["what"] for finding in report["findings"]]

    def test_two_rooms_have_one_wall(self):
        vsp.write_step(self.folder / "rooms.stp", [vsp.rooms([10, 10], 8, 6)], "patches")
        report, check = self.meshed(self.folder / "rooms.stp")
        self.assertEqual((report["nonmanifold_edges"], report["free_edges"], report["solids"]), (4, 0, 2))
        self.assertAlmostEqual(report["volume"], 960, 6)
        self.assertIn("wall between two rooms", self.texts(report))
        self.assertLess(abs(check["triangles"] - 5022), 100)

    def test_a_sheet_in_a_prism_whose_ends_have_no_edge_divides_it(self):
        report, check = self.meshed(FIELD / "prism_with_sheet.step")
        self.assertEqual((report["nonmanifold_edges"], report["free_edges"], report["solids"]), (4, 0, 2))
        self.assertAlmostEqual(report["volume"], 50, 6)
        self.assertTrue([t for t in self.texts(report) if t.startswith("wall between")], report)
        self.assertLess(abs(check["triangles"] - 4872), 50)

    def test_sheets_that_meet_at_one_edge_have_it_once(self):
        for n in (3, 4, 5):
            path = self.folder / f"cross{n}.stp"
            vsp.write_step(path, [vsp.leaves(n)], "patches")
            report, check = self.meshed(path)
            self.assertEqual((report["nonmanifold_edges"], report["free_edges"]), (1, 3 * n), n)
            self.assertEqual(check["components"], 1, n)

    def test_ribs_and_spars_end_on_skins(self):
        sections = [vsp.Section(0, chord=10), vsp.Section(20, x=2, chord=6)]
        middle = vsp.Section(10, x=1, chord=8)
        for layout in ("skins", "whole"):
            path = self.folder / f"rib_{layout}.stp"
            vsp.write_step(path, [vsp.wing("wing", sections), vsp.rib("rib", middle)], layout)
            report, check = self.meshed(path)
            self.assertEqual((report["solids"], report["free_edges"]), (2, 0), report)
    
    def test_bodies_of_loose_faces_that_touch_in_part_have_common_walls(self):
        path = self.folder / "steps.stp"
        vsp.write_step(path, [vsp.rooms([10, 10], 8, 6), vsp.rooms([6], 4, 3).moved((2, 2, 6))], "patches")
        report, check = self.meshed(path)
        self.assertEqual((report["solids"], report["free_edges"]), (3, 0), report)
        self.assertAlmostEqual(report["volume"], 960 + 72, 6)
        self.assertAlmostEqual(report["area"], 704 + 108 - 24, 6)
        self.assertEqual(check["components"], 1)


if __name__ == "__main__":
    unittest.main()
