"""Half models and far fields: the mesh of the fluid is one closed mesh, with small triangles on the body and large ones
far from it."""
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
from chain import MODELS, ToolTest, make_chain, must  # noqa: E402

DOMAINS = (
    ("sphere.brep", ["--farfield", "box:20"]),
    ("block_with_hole.step", ["--farfield", "sphere:20"]),
    ("torus.brep", ["--symmetry", "y=0", "--farfield", "box:20"]),
    ("sphere.brep", ["--symmetry", "x=0-", "--farfield", "sphere:10"]),
    ("torus.brep", ["--symmetry", "z=0"]),
)


class Half(ToolTest):
    def test_fluid_around_a_model_is_meshed_closed_and_coarse_far_away(self):
        for k, (model, options) in enumerate(DOMAINS):
            with self.subTest(model=model, options=options):
                folder = make_chain(MODELS / model, self.folder / str(k), import_options=options)
                check = must("st-check", folder / "mesh.hdf", "--geometry", folder / "geometry.hdf", "--sizing",
                             folder / "sizing.hdf", "--json")
                self.assertLess(check.json()["triangles"], 60000)


if __name__ == "__main__":
    unittest.main()
