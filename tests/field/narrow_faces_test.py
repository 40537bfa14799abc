"""Faces narrower than the CAD is exact, and faces that lie on each other: merged or named, and never refined without
end."""
import os
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
from chain import INCOMPLETE, MODELS, OK, Run, ToolTest, make_chain, must  # noqa: E402

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
FIELD = Path(os.environ.get("ST_CORPUS", ROOT.parent / "shared" / "corpus")).parent / "field"


class NarrowFaces(ToolTest):
    def expected(self, folder):
        """Triangles by the sizes alone."""
        done = must("st-prolong", folder / "raster.hdf", "-o", folder / "again.hdf", "--json")
        return done.json()["expected_triangles"]

    def check(self, folder):
        return Run("st-check", folder / "mesh.hdf", "--geometry", folder / "geometry.hdf", "--sizing",
                   folder / "sizing.hdf")

    def test_rings_whose_edges_cross_within_their_tolerance_are_merged(self):
        for name in ("narrow_ring", "narrow_band"):
            with self.subTest(name):
                folder = make_chain(HERE / f"{name}.brep", self.folder / name)
                check = self.check(folder)
                self.assertEqual(check.code, OK, check)
                mesh = must("st-mesh", folder / "geometry.hdf", folder / "sizing.hdf", "-o", folder / "again.hdf",
                            "--json").json()
                self.assertEqual(mesh["rounds"], 1)
                self.assertEqual(len(mesh["merged"]["strips"]), 1)
                self.assertLess(mesh["triangles"], 1.2 * self.expected(folder))

    def test_a_sliver_folded_back_onto_its_neighbour_is_merged_into_it(self):
        model = MODELS / "folded_sliver.brep"
        imported = must("st-import", model, "-o", self.folder / "geometry.hdf", "--json")
        self.assertIn("face 2: face folded back onto its neighbour, merged into face 1", imported.err)
        self.assertAlmostEqual(imported.json()["area"], 40 - 4.75, places=5)
        folder = make_chain(model, self.folder / "sliver")
        check = self.check(folder)
        self.assertEqual(check.code, OK, check)

    def test_edges_of_a_sliver_that_run_back_beside_the_neighbours_become_one(self):
        folder = make_chain(MODELS / "wall_twice.brep", self.folder / "wall")
        check = Run("st-check", folder / "mesh.hdf", "--geometry", folder / "geometry.hdf", "--sizing",
                    folder / "sizing.hdf", "--json")
        self.assertEqual(check.code, OK, check)
        self.assertAlmostEqual(check.json()["volume"], 30, delta=0.003)
        self.assertAlmostEqual(check.json()["area"], 140, delta=0.01)
        self.assertEqual(check.json()["boundary_edges"], 0)

    def test_narrow_blends_whose_loops_cross_within_their_tolerance_are_sound(self):
        for name, volume in (("blend_curves", 7999.968), ("blend_tip", 7999.9893), ("blend_edges", 7999.968),
                             ("blend_round", 7999.985)):
            with self.subTest(name):
                folder = make_chain(MODELS / f"{name}.brep", self.folder / name)
                check = Run("st-check", folder / "mesh.hdf", "--geometry", folder / "geometry.hdf", "--sizing",
                            folder / "sizing.hdf", "--json")
                self.assertEqual(check.code, OK, check)
                found = check.json()
                self.assertEqual((found["boundary_edges"], found["folds"], found["crossings"]), (0, 0, 0))
                self.assertAlmostEqual(found["volume"], volume, delta=1)
                self.assertLess(found["triangles"], 1.2 * self.expected(folder))
                mesh = must("st-mesh", folder / "geometry.hdf", folder / "sizing.hdf", "-o", folder / "again.hdf",
                            "--json").json()
                self.assertEqual(mesh["rounds"], 1)

    def test_a_blend_whose_edges_cross_beyond_their_tolerance_fails_within_four_times_its_triangles(self):
        folder = make_chain(MODELS / "blend_beyond.brep", self.folder / "beyond")
        check = self.check(folder)
        self.assertEqual(check.code, INCOMPLETE, check)
        mesh = must("st-mesh", folder / "geometry.hdf", folder / "sizing.hdf", "-o", folder / "again.hdf",
                    "--json").json()
        self.assertLess(mesh["triangles"], 4 * self.expected(folder))

    def test_the_edge_of_a_tail_is_covered_once(self):
        model = FIELD / "red_tail_2_3.brep"
        if not model.exists():
            self.skipTest(f"{model} is not there")
        folder = make_chain(model, self.folder / "tail")
        check = self.check(folder)
        self.assertEqual(check.code, OK, check)
        self.assertIn("merged into face 1", must("st-import", model, "-o", self.folder / "tail.hdf").err)

    def test_a_face_folded_back_onto_its_neighbour_is_named_and_not_refined_without_end(self):
        model = MODELS / "folded_flap.brep"
        imported = must("st-import", model, "-o", self.folder / "geometry.hdf")
        self.assertIn("face 1 and face 2, which lie on each other", imported.err)
        folder = make_chain(model, self.folder / "flap")
        check = self.check(folder)
        self.assertEqual(check.code, INCOMPLETE, check)
        self.assertIn("crossing", check.out)
        mesh = must("st-mesh", folder / "geometry.hdf", folder / "sizing.hdf", "-o", folder / "again.hdf",
                    "--json").json()
        self.assertLess(mesh["triangles"], 4 * self.expected(folder))


if __name__ == "__main__":
    unittest.main(verbosity=2)
