"""What makes CAD files hard, one small file of each kind, through the whole chain at three sizes."""
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
from chain import INCOMPLETE, MODELS, USAGE, Run, ToolTest, make_chain, must  # noqa: E402

SIZES = {"defaults": (), "coarse": ("--lmax", "10%", "--lmin", "0.5%", "--alpha", "20"),
         "fine": ("--lmax", "1%", "--lmin", "0.02%")}


class Classes(ToolTest):
    def chains(self, name, *import_options):
        """(sizes, what st-check says, what st-import says) of a model that has to pass."""
        for sizes, raster_options in SIZES.items():
            with self.subTest(name, sizes=sizes):
                folder = make_chain(MODELS / f"{name}.brep", self.folder / f"{name}_{sizes}",
                                    import_options=import_options, raster_options=raster_options)
                said = must("st-import", MODELS / f"{name}.brep", "-o", self.folder / "again.hdf", "--json",
                            *import_options)
                check = must("st-check", folder / "mesh.hdf", "--geometry", folder / "geometry.hdf", "--sizing",
                             folder / "sizing.hdf", "--json")
                yield sizes, check.json(), said

    def test_a_loop_that_passes_a_vertex_twice_is_whole(self):
        for _, check, _ in self.chains("hourglass"):
            self.assertAlmostEqual(check["area"], 200, delta=1e-6)

    def test_a_sharp_nose_that_is_turned_about_itself_has_no_folds(self):
        for _, check, _ in self.chains("fan"):
            self.assertEqual((check["folds"], check["crossings"]), (0, 0))

    def test_walls_closer_than_the_chords_do_not_cross(self):
        for _, check, _ in self.chains("thin_pipe"):
            self.assertEqual(check["crossings"], 0)
            self.assertTrue(check["closed"])

    def test_bodies_that_touch_are_said_and_joined_where_asked(self):
        for _, check, said in self.chains("touching_boxes"):
            self.assertIn("--join", said.err)
            self.assertGreater(check["checks"]["contacts"]["count"], 0)
        for _, check, _ in self.chains("touching_boxes", "--join"):
            self.assertEqual(check["checks"]["contacts"]["count"], 0)
            self.assertEqual(check["components"], 1)

    def test_bodies_that_touch_or_overlap_become_one_where_a_far_field_is_made(self):
        for name, says in (("touching_boxes", "bodies that touch joined"), ("wing_in_body", "that overlap united")):
            for plane in ((), ("--symmetry", "z=0.1")):
                options = ("--farfield", "box:3", *plane)
                f = make_chain(MODELS / f"{name}.brep", self.folder / "far", import_options=options)
                said = must("st-import", MODELS / f"{name}.brep", "-o", self.folder / "again.hdf", *options)
                self.assertIn(says, said.err)
                check = must("st-check", f / "mesh.hdf", "--geometry", f / "geometry.hdf", "--json").json()
                self.assertEqual((check["checks"]["contacts"]["count"], check["components"]), (0, 1 if plane else 2))

    def test_a_domain_of_the_file_is_no_body_to_be_united(self):
        self.expect_error(USAGE, "st-import", MODELS / "capsule_in_sphere_50.brep", "-o", self.folder / "g.hdf",
                          "--farfield", "box:3", says="the file has its own air")

    def test_bodies_that_touch_in_a_far_field_of_the_file_fail_the_check_with_the_cad_and_without(self):
        groups = self.folder / "far.toml"
        groups.write_text('[[group]]\nname = "far"\nrole = "farfield"\nfaces = "1"\n')
        f = make_chain(MODELS / "touching_boxes.brep", self.folder / "own", import_options=("--groups", groups))
        for geometry in ((), ("--geometry", f / "geometry.hdf")):
            check = Run("st-check", f / "mesh.hdf", *geometry, "--json")
            self.assertEqual(check.code, INCOMPLETE)
            self.assertGreater(check.json()["checks"]["contacts"]["count"], 0)
            self.assertFalse(check.json()["checks"]["contacts"]["passes"])

    def test_a_body_that_is_there_twice_is_meshed_once(self):
        for _, check, said in self.chains("box_twice"):
            self.assertIn("there twice", said.err)
            self.assertEqual(check["components"], 1)
            self.assertAlmostEqual(check["volume"], 1000, delta=1e-6)

    def test_parts_that_overlap_are_said_and_united_where_asked(self):
        said = must("st-import", MODELS / "wing_in_body.brep", "-o", self.folder / "apart.hdf")
        self.assertIn("--unite", said.err)
        for _, check, _ in self.chains("wing_in_body", "--unite"):
            self.assertEqual((check["components"], check["crossings"]), (1, 0))

    def test_a_body_in_a_flow_domain_is_found(self):
        for name in ("pod_in_c_50_half", "capsule_in_sphere_50"):
            for _, check, _ in self.chains(name):
                self.assertTrue(check["closed"])
            said = must("st-import", MODELS / f"{name}.brep", "-o", self.folder / "g.hdf").err
            self.assertIn("the file has its own air", said)

    def test_an_edge_far_from_its_faces_changes_no_area(self):
        for _, check, _ in self.chains("far_circle"):
            self.assertTrue(check["closed"])
            self.assertLess(max(f["area_error"] for f in check["faces"]), 0.05)

    def test_more_triangles_than_asked_for_are_said_before_meshing(self):
        folder = make_chain(MODELS / "far_circle.brep", self.folder / "many")
        run = Run("st-prolong", folder / "raster.hdf", "-o", self.folder / "s.hdf", "--max-triangles", 100)
        self.assertEqual(run.code, USAGE, run)
        self.assertIn("face 1", run.err)
        self.assertFalse((self.folder / "s.hdf").exists())


if __name__ == "__main__":
    unittest.main(verbosity=2)
