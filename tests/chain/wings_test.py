"""How many lifting surfaces st-raster finds on real CAD files (ST_CORPUS, by default ../shared/corpus beside the
repository): counted by hand on pictures."""
import os
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
from chain import CORPUS, ToolTest, main_on_corpus, must  # noqa: E402

CUT_MODEL = Path(os.environ["ST_BIN"]).parent / "tests/support/cut_model"
VARIED_MODELS = CUT_MODEL.parent / "varied_models"
WINGS = {
    "aero_d150_fullspan.brep": 5,
    "aero_d150_half_with_tail.brep": 3,
    "aero_d150_wing.igs": 1,
    "aero_d150_wing_body_half.brep": 1,
    "aero_evtol_bet.brep": 5,  # a boom parts each wing in two
    "aero_onera_m6_sharpte.brep": 1,
    "aero_tigl_simplewing.brep": 1,
    "aero_bladex_propeller_shaft.iges": 5,
    "aero_dealii_wing_igs.iges": 1,
    "aero_iea15mw_rotor_blade.stp": 1,
    "aero_lsdo_simple_wing.stp": 2,
    "aero_d150_fuselage.igs": 0,
    "mech_as1_oc_214.stp": 0,
    "mech_build123d_m6_screw.step": 0,
    "mech_esp_piston.brep": 0,
    "mech_geouned_scdr.stp": 0,
    "mech_geouned_tank.stp": 0,
    "mech_geouned_tester.stp": 0,
    "mech_netgen_frame.step": 0,
    "mech_netgen_screw.step": 0,
    "mech_occt_bottle.brep": 0,
    "mech_occt_linkrods.step": 0,
    "mech_odri_lower_leg_base.step": 0,
    "mech_trimesh_box_sides.step": 0,
    "ship_dtmb5415_bulb.iges": 0,
    "ship_goteborg_hull.iges": 0,
}


# Spans of wings, measured on drawings in the model's unit, and how they are cut: seed, random planes through all faces,
# and edges that get two vertices, a hundred-thousandth of their length apart.
CUT_WINGS = {
    "aero_d150_wing_body_half.brep": ([16.02], ((1, 0, 20), (3, 5, 20), (4, 12, 40))),
    # its domain is cut, too
    "aero_onera_m6_sharpte.brep": ([1.533], ((1, 0, 20), (2, 0, 60), (1, 5), (2, 20), (4, 12, 20, 0.3))),
    "aero_tigl_simplewing.brep": ([2.0], ((1, 0, 20), (2, 0, 60), (3, 5, 20))),
}


class Wings(ToolTest):
    def raster(self, name, *options):
        geometry = self.folder / "geometry.hdf"
        if not geometry.exists():
            must("st-import", CORPUS / name, "-o", geometry)
        return must("st-raster", geometry, "-o", self.folder / "raster.hdf", "--no-surface", "--json", *options)

    def check(self, name, n_wings):
        done = self.raster(name, "--preset", "preview")
        self.assertEqual(len(done.json()["lifting_surfaces"]), n_wings, f"{name}: {done}")

    def test_an_edge_with_profiles_on_half_of_its_length_ends(self):
        """To rounding: it once searched the part that planes cut, which was the whole edge, until the stack ended."""
        subprocess.run([VARIED_MODELS, self.folder, "7389", "7389"], check=True, capture_output=True, timeout=100)
        must("st-import", *self.folder.glob("v7389*"), "-o", self.folder / "geometry.hdf")
        self.assertEqual(self.raster("").json()["lifting_surfaces"], [])

    def test_cut_at_random_places_stay_the_same_wings(self):
        for name, (spans, cuts) in CUT_WINGS.items():
            for cut in cuts:
                with self.subTest(name=name, cut=cut):
                    model, geometry = self.folder / "cut.brep", self.folder / "cut.hdf"
                    subprocess.run([CUT_MODEL, CORPUS / name, model, *map(str, cut)], check=True, capture_output=True,
                                   timeout=100)
                    must("st-import", model, "-o", geometry)
                    done = must("st-raster", geometry, "-o", self.folder / "raster.hdf", "--no-surface", "--json",
                                "--preset", "rans")
                    found = sorted((wing["span"] for wing in done.json()["lifting_surfaces"]), reverse=True)
                    self.assertEqual(len(found), len(spans), done)
                    for got, asked in zip(found, spans):
                        self.assertLess(abs(got - asked), 0.05 * asked, done)

    def test_the_user_has_the_last_word(self):
        other, rules = self.folder / "none.hdf", self.folder / "sizes.toml"
        name = "aero_d150_wing_body_half.brep"
        (wing,) = self.raster(name).json()["lifting_surfaces"]
        rules.write_text(f"size = [{{ edges = {wing['trailing_edges']}, trailing_edge = false }}]\n")
        self.assertEqual(self.raster(name, "--sizes", rules).json()["lifting_surfaces"], [])
        rules.write_text('size = [{ detected = "trailing", trailing_edge = false }]\n')
        self.assertEqual(self.raster(name, "--sizes", rules).json()["lifting_surfaces"], [])
        rules.write_text("size = [{ edges = 1, trailing_edge = true }]\n")
        self.assertIn("without effect", self.raster(name, "--sizes", rules).err)
        for words in (["--end-size", "0.1%span"], ["--sizes", rules]):
            self.expect_error(2, "st-raster", self.folder / "geometry.hdf", "-o", other, "--edge-size", "none", *words,
                              says=["--edge-size none"])
        rules.write_text("size = [{ edges = 99999, trailing_edge = true }]\n")
        self.expect_error(2, "st-raster", self.folder / "geometry.hdf", "-o", other, "--sizes", rules,
                          says=["sizes.toml:1", "99999"])


    def test_a_sharp_edge_that_is_named_stays_as_it_was(self):
        rules = self.folder / "sizes.toml"
        name = "aero_onera_m6_sharpte.brep"  # a narrow strip of the skin ends at its trailing edge
        before = self.raster(name).json()
        (edge,) = before["lifting_surfaces"][0]["trailing_edges"]
        rules.write_text(f"size = [{{ edges = {edge}, trailing_edge = true }}]\n")
        after = self.raster(name, "--sizes", rules).json()
        self.assertEqual(after["samples"], before["samples"])
        self.assertEqual(len(after["lifting_surfaces"]), 1)

    def test_numbers_in_groups_do_not_outlive_the_far_field(self):
        groups = self.folder / "groups.toml"
        groups.write_text('[[group]]\nname = "ff"\nfaces = [1]\nrole = "farfield"\n')
        self.expect_error(2, "st-import", CORPUS / "aero_onera_m6_sharpte.brep", "-o", self.folder / "other.hdf",
                          "--groups", groups, "--replace-farfield", "box:20", says=["groups.toml", "by number"])


if __name__ == "__main__":
    main_on_corpus(Wings, WINGS.items())
