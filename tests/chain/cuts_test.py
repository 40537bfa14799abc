"""Where random planes have cut the faces of a model, sizes and meshes stay nearly as they were."""
import os
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
from cuts_table import compare  # noqa: E402

BUILD = Path(os.environ["ST_BIN"]).parent
CORPUS = Path(os.environ.get("ST_CORPUS") or ROOT / "../shared/corpus")


class Cuts(unittest.TestCase):
    def expect_alike(self, name, within_5, change):
        """At least `within_5` per cent of points agree within 5 %; triangles change by `change` per cent at most."""
        if not (CORPUS / name).exists():
            self.skipTest(f"{CORPUS / name} is missing; set ST_CORPUS")
        faces, cut, five, _, n, n_cut = compare(BUILD, CORPUS / name, planes=3, seed=1)
        self.assertGreater(cut, 1.5 * faces)
        self.assertGreaterEqual(five, within_5)
        self.assertLessEqual(abs(n_cut / n - 1), 0.01 * change)

    def test_hardly_change_a_machine_part(self):
        self.expect_alike("mech_occt_linkrods.step", 93, 2)

    def test_hardly_change_a_wing(self):
        self.expect_alike("aero_tigl_simplewing.brep", 99, 1)

    def test_do_not_make_a_far_field_finer(self):
        self.expect_alike("aero_onera_m6_sharpte.brep", 99, 1)

    def test_do_not_hide_a_wing(self):
        self.expect_alike("aero_tigl_simplewing.brep", 78, 5)


if __name__ == "__main__":
    unittest.main()
