"""Artifacts of small models against stored ones, compared by st-diff. Only stages that have settled have goldens; the others have
invariants (tests/chain). A missing golden fails.

usage: golden_test.py             compare (in ctest)
       golden_test.py --update    write the goldens anew: a commit of its own, with the numbers before and after and the reason
"""
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
from chain import *  # noqa: E402,F403

GOLDEN = Path(__file__).resolve().parent
TOLERANCE = "1e-9"  # other processors round sines and cosines differently in the last bit
LIMIT = 50_000  # bytes of stored test data


def make_all(folder):
    """The artifacts that have goldens, in `folder`; returns their names."""
    for model in ("assembly.step", "block_with_hole.step", "box.igs"):
        must("st-import", MODELS / model, "-o", folder / f"{model.split('.')[0]}.geometry.hdf")
    block = folder / "block_with_hole"
    must("st-raster", f"{block}.geometry.hdf", "-o", f"{block}.raster.hdf", "--lmin", "5%", "--lmax", "20%", "--alpha", "20")
    must("st-prolong", f"{block}.raster.hdf", "-o", f"{block}.sizing.hdf")
    return sorted(p.name for p in folder.glob("*.hdf"))


class Golden(ToolTest):
    def test_artifacts_equal_their_goldens(self):
        for name in make_all(self.folder):
            with self.subTest(name):
                self.assertTrue((GOLDEN / name).is_file(), f"golden {name} is missing; {Path(__file__).name} --update writes it")
                self.assertLess((GOLDEN / name).stat().st_size, LIMIT)
                run = Run("st-diff", GOLDEN / name, self.folder / name, "--tolerance", TOLERANCE)
                self.assertEqual(run.code, OK, run)

    def test_every_golden_has_its_artifact(self):
        made = make_all(self.folder)
        self.assertEqual([p.name for p in sorted(GOLDEN.glob("*.hdf"))], made)


if __name__ == "__main__":
    if "--update" in sys.argv:
        print("\n".join(make_all(GOLDEN)))
    else:
        unittest.main(verbosity=2)
