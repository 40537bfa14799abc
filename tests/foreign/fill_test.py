"""What st-check passes as closed, TetGen and Gmsh fill: six models of the corpus, coarse, one of them to a far field.

usage: fill_test.py
environment: ST_BIN; ST_CORPUS: real CAD files, default ../shared/corpus beside the project
"""
import argparse
import os
import shutil
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
import fill_table  # noqa: E402

BIN = Path(os.environ["ST_BIN"])
CORPUS = Path(os.environ.get("ST_CORPUS") or ROOT / "../shared/corpus").resolve()
SECONDS = 120
MODELS = {"aero_d150_wing_body_half.brep": "box:5", "aero_tigl_simplewing.brep": "none",
          "aero_psas_rocket_fin_frame.igs": "none", "mech_esp_piston.brep": "none", "mech_netgen_screw.step": "none",
          "nasty_pygem_pipe_deformed.iges": "none"}


class Fill(unittest.TestCase):
    def test_closed_meshes_are_filled(self):
        for name, farfield in MODELS.items():
            with self.subTest(name), tempfile.TemporaryDirectory() as folder:
                options = argparse.Namespace(farfield=farfield, join=False, max_aspect="1", preset=None, coarse=True)
                _, verdict = fill_table.make_mesh(BIN, CORPUS / name, Path(folder), options)
                self.assertEqual(verdict, "passes")
                for filler in (fill_table.tetgen, fill_table.gmsh):
                    self.assertRegex(filler(Path(folder), SECONDS), r"^[\d,]+ tetrahedra$")


if __name__ == "__main__":
    if not CORPUS.is_dir():
        print(f"SKIPPED: corpus not found at {CORPUS}; set ST_CORPUS", flush=True)
        sys.exit(77)
    if missing := [program for program in ("tetgen", "gmsh") if not shutil.which(program)]:
        print(f"SKIPPED: {', '.join(missing)} not found", flush=True)
        sys.exit(77)
    unittest.main()
