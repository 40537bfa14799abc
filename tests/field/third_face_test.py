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

    def test_a_sheet_in_a_prism_stays_one(self):
        report, check = self.meshed(FIELD / "prism_with_sheet.step")
        self.assertEqual((report["nonmanifold_edges"], report["free_edges"], report["solids"]), (2, 2, 1))
        self.assertTrue([t for t in self.texts(report) if t.startswith("sheet")], report)
        self.assertLess(abs(check["triangles"] - 4872), 50)


if __name__ == "__main__":
    unittest.main()
