"""Lifting surfaces of wings, blades and sails of many kinds, counted and measured by hand, and machine parts that look
like wings and have none. Nothing is missed in silence: what is not found is warned of, with its edges."""
import os
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
from chain import ToolTest, must  # noqa: E402

WING_MODELS = os.environ["ST_WING_MODELS"]

# Lengths of the trailing edges of each lifting surface, in the model's unit, from the numbers in wing_models.cpp.
SPANS = {
    "blunt_1": [5],
    "blunt_3": [5],
    "blunt_40": [5],
    "blunt_200": [5],
    "base_in_halves": [5],
    "ring_wing": [9.42],  # circumference at radius 1.5
    "ducted_fan": [6.91, 0.71, 0.71, 0.71, 0.71, 0.71],  # duct of radius 1.1, blades from hub to tip
    "impeller": 12 * [0.3],  # six blades, six splitters, above the disc
    "hydrofoil": [4, 1.99],
    "hydrofoil_joined": [6],  # foil and strut meet at a vertex of their trailing edges
    "t_tail": [4.0, 3.15],
    "box_wing": [7.45],
    "rudder": [1.99],
    "two_elements": [4, 4],
    "diamond_wing": [4],
    "winglet": [5.68],
    "nacelle": [5.03],  # circumference at radius 0.8
    "nacelle_c": [4.19],  # 300 degrees of it
    "kinked_wing": [4.21],
    "elliptic_wing": [6.21],
    "aircraft": [4.59, 4.59, 2.4, 1.79, 1.76, 1.76, 0.43],  # wings, nacelle, fin, tails, pylon
    "wing_with_fairing": [4],  # from the fuselage of radius 1 to y = 5
    "blade_of_four": [1.01],
    "blade_of_two": [1.01],
    "blade_of_one": [1.01],  # one closed face, its seam on the upper side, at the tail, and at the nose
    "blade_of_one_at_tail": [1.01],
    "blade_of_one_at_nose": [1.01],
    "blade_of_halves": [1.01],
    "blade_of_splines": [1.01],  # two that meet smoothly at tail and nose
    "round_hydrofoil": [4.12],  # 4 along the span, swept by 0.25 to either side
    "round_propeller": [0.82, 0.82, 0.82],
    "round_rudder": [1.96],
    "round_strut": [2],
    "round_ring": [9.42],
    "vanes": [1, 1, 1],
    "rocket_fins": 4 * [0.4],
    "flying_wing": [8.75],
    "canard_and_delta": [2.5, 2.5, 1.51, 1, 1],  # deltas, fin, canards
    "delta": [2],
    "delta_with_edge": [2],
    "serrated_wing": [4.66],  # 24 flanks of 0.194
    "serrated_by_cuts": [5.12],  # 12 teeth: 0.167 along the span, two flanks of 0.13
    "serrated_shallow": [4.16],
    "wavy_wing": [4.21],
    "dogtooth_wing": [4.03],
    "notched_wing": [3.64],  # 4 without three notches of 0.12
    "gurney_wing": [4],
    "vortex_generators": [4] + 10 * [0.0158],
    "small_propeller": [4.59, 4.59, 2.4, 1.79, 1.76, 1.76, 0.43, 0.129, 0.129],
    "small_round_propeller": [4.59, 4.59, 2.4, 1.79, 1.76, 1.76, 0.43, 0.098, 0.098, 0.098],
    "hull_with_screw": [0.129, 0.129],
    "split_winglet": [3.99, 0.85],
    "wedge_wing": [1.2],
    "inner_slot": [4],
    "tip_slot": [4],
    "open_slot": [3.97],  # 4 without two slots of 0.015
    "three_elements": [4, 4, 4],
    "sawtooth_wing": [4],
    "pierced_wing": [4],
    "spoiler_wing": [4],
    "stepped_wing": [4],
    "wing_with_pod": [4, 0.16],  # and the pylon
    "cranked_canard": [1.48, 1.48],
    "split_nose": [4.02],
    "cove_wing": [4],
    "joined_wing": [3.57, 3.27],
    "gull_wing": [3.1],
    "canards_and_v_tail": [1.31, 1.31, 1.03, 1.03],
    "keel_with_bulb": [1.85],
    "swept_tip_rotor": [0.86, 0.86],
    "engine_with_core": [4, 2.19, 0.45],  # wing, nacelle without what the pylon takes of it, pylon
    "flap_tracks": [3.92],
    "h_rotor": [2, 2, 2, 0.99, 0.99, 0.99, 0.99, 0.92, 0.92],  # blades, struts
    "fenced_wing": [1.39, 1.39, 1.2],
    "tunnel_wing": [4],
    "c_wing": [4.6],
    "scimitar_tips": [2.98, 0.73, 0.39],
    "random_base": [4],
    "braced_wing": [3.56, 3.56, 1.52, 1.52],
    "shaft_brackets": [1.02, 1.02],
    "far_wing": [3002],
    "strip_wing": [4.02],
    "wing_with_rods": [3.96],
    "grid_fin": [8],  # eight webs of 1
    "morphing_wing": [4.03],
    "flat_back_blade": [9.05],
    "foil_with_bulb": [1.41, 1.13, 1.13],  # strut, foils
    "winged_keel": [1.32, 0.65, 0.65],
    "catamaran": [1.04, 1.04],
    "helical_turbine": [2.15, 2.15, 2.15],
    "splitter_impeller": 12 * [0.25],
    "cell_wing": [4.45],
    "chamfer_winglet": [3.89],  # 3 along the wing, 0.22 and 0.67
    "channel_wing": [4.48],  # two straight pieces of 1.3, half a circle of radius 0.6
    "chined_body": [1.4, 1.4],
    "board_with_fins": [1, 1, 1],
    "torpedo": [3.14, 0.37, 0.37, 0.37, 0.37],  # ring, fins
    "cusped_wing": [4],
    "egg_beater": [2.7, 2.7],
    "wide_runner": 4 * [0.62],
    "race_wing": [2, 2],
    "all_moving_tail": [3.42, 3.42, 1.45, 1.45],
    "biplane": [6, 6, 1.15, 1.15],
    "iced_wing": [4],  # horns of ice are at its nose
    "rimed_wing": [4.08],
    "canards_and_y_tail": [1.18, 1.18, 1.14, 1.14, 0.65],  # fins, canards, keel, from the body on
    "foil_with_pods": [0.91, 0.91, 0.91, 0.91],
    "drooped_foil": [1.41, 1.41, 1.09],
    "loop_propeller": [1.95, 1.95],
    "forward_swept_wing": [3.38],  # its base has a kink
    "root_strip_wing": [4],
    "ogive_strake": [1.9, 1.9],  # from the body on
    "bowed_vane_air": [0.45],  # leans, and turns by 20 degrees, within 0.4
    "curved_cut_wing": [4],
    "paddle_blade": [0.85],
    "forward_with_extension": [2.65, 2.65],  # from the body on, with the crank
    "foil_with_bulb_and_tips": [0.98, 0.72, 0.72],  # strut, foils
    "shrouded_stator": 7 * [0.45],
    "kayak_paddle": [0.46, 0.46],
    "blade_with_tabs": [4.51],
    "curved_board": [2.89],
    "rotor_in_fin": [3.03, 0.38, 0.38, 0.38, 0.38, 0.38],
    "bevelled_fins": 4 * [0.41],  # noses have bases, too, which are wider
    "slat_with_cove": [3.1, 2.53],  # and a sliver of the slat, 1.09 long, that is none
    "wing_with_small_ones": [3, 2.4, 1.2, 0.3],  # none of them a sliver
}
# Noses are missing at slanted cuts of the CAD, and at a strut, a little each time; that is said.
WITH_SHORT_STRETCHES = ("split_winglet", "hydrofoil_joined", "h_rotor")
# Noses before slots and flaps, where the trailing edge is another part's or none.
NOSES_ALONE = {"inner_slot": 2, "tip_slot": 2, "open_slot": 0.03, "notched_wing": 0.36, "gapped_aileron": 1.3,
               "fixed_slat": 2.4, "two_elements": 0, "kinked_wing": 0}
PARTS = ("bracket", "plate", "chisel", "louvre", "heat_sink", "thread", "gear", "spoon", "lens", "cover", "rib",
         "seal", "oval_bar", "saw", "door_stop", "snap_hook", "plow", "hole_plate", "cam", "lever", "dovetail",
         "funnel", "shim", "pulley", "fan_disc", "leaf_spring", "drill", "bezel", "axe", "turbine_disc",
         "louvre_grille", "cooling_fins", "knife", "wing_nut", "propeller_nut", "shovel", "comb", "lip_profile",
         "circular_saw", "door_handle", "scissors", "disc_spring")


class WingShapes(ToolTest):
    def raster(self, name, preset, *options):
        model, geometry = self.folder / f"{name}.brep", self.folder / "geometry.hdf"
        if not geometry.exists():
            subprocess.run([WING_MODELS, name, model], check=True, capture_output=True, timeout=100)
            must("st-import", model, "-o", geometry)
        return must("st-raster", geometry, "-o", self.folder / "raster.hdf", "--no-surface", "--json", "--preset",
                    preset, *options)

    def check_wing(self, name, spans):
        for preset in ("rans", "euler"):
            done = self.raster(name, preset)
            found = sorted((wing["span"] for wing in done.json()["lifting_surfaces"]), reverse=True)
            self.assertEqual(len(found), len(spans), f"{name}: {done}")
            for got, asked in zip(found, spans):
                self.assertLess(abs(got - asked), 0.05 * asked + 0.02, f"{name}: {done}")
            if name in WITH_SHORT_STRETCHES:
                self.assertRegex(done.err, "warning: no nose is seen before .* short stretches, the longest at edge")
            else:
                self.assertNotIn("warning", done.err, f"{name}: {done}")

    def check_part(self, name):
        self.assertEqual(self.raster(name, "euler").json()["lifting_surfaces"], [])

    def test_noses_go_on_before_slots_and_flaps(self):
        for name, length in NOSES_ALONE.items():
            (self.folder / "geometry.hdf").unlink(missing_ok=True)
            wings = self.raster(name, "rans").json()["lifting_surfaces"]
            # at both ends they begin at stations, which are 0.17 apart
            self.assertAlmostEqual(sum(wing["noses_alone"] for wing in wings), length, delta=0.34 if length else 0,
                                   msg=name)

    def test_noses_reach_the_tips_to_a_length_at_the_nose(self):
        for name in ("fixed_slat", "braced_wing"):
            (self.folder / "geometry.hdf").unlink(missing_ok=True)
            wing = max(self.raster(name, "rans").json()["lifting_surfaces"], key=lambda wing: wing["span"])
            at = max(abs(station["nose"][1]) for station in wing["stations"])  # of 4
            self.assertGreater(at, 4 - 1e-3 * wing["chord"][1], name)

    def test_chords_of_random_wings_are_along_the_flow(self):
        for number in range(7, 40):  # OpenCASCADE loses the wing of 6 where it joins its body
            model, geometry = self.folder / "random.brep", self.folder / "geometry.hdf"
            subprocess.run([WING_MODELS, "random_wing", str(number), model], check=True, capture_output=True,
                           timeout=100)
            must("st-import", model, "-o", geometry)
            wings = self.raster("random", "rans").json()["lifting_surfaces"]
            self.assertGreater(len(wings), 0, number)
            for wing in wings:  # chords are 1, but where twisted
                self.assertGreater(wing["chord"][0], 0.85, f"{number}: {wing}")
                self.assertLess(wing["chord"][2], 1.15, f"{number}: {wing}")

    def test_noses_of_a_swept_tip_are_not_on_the_tip(self):
        (wing,) = self.raster("c_wing", "euler").json()["lifting_surfaces"]
        self.assertGreater(wing["chord"][0], 0.95 * 0.3)  # of its tip

    def test_noses_alone_end_with_their_face(self):
        small = min(self.raster("split_winglet", "rans").json()["lifting_surfaces"], key=lambda wing: wing["span"])
        self.assertLess(small["noses_alone"], 0.02)  # on into the wing it is 0.037

    def test_planes_along_a_wing_are_no_profiles_of_its_winglet(self):
        (wing,) = self.raster("chamfer_winglet", "rans").json()["lifting_surfaces"]
        self.assertLess(wing["chord"][2], 1.001)  # at the root

    def test_eight_lengths_are_across_a_slot_of_a_quarter_per_cent_of_the_model(self):
        self.raster("gapped_aileron", "rans")
        must("st-prolong", self.folder / "raster.hdf", "--preset", "rans", "-o", self.folder / "sizing.hdf")
        for place in ("0.75,2,0", "0.76,2,0", "0.85,1.5,0", "0.85,1.51,0"):  # on the walls of slots of 0.01
            said = must("st-info", self.folder / "sizing.hdf", "--at", place).out
            self.assertAlmostEqual(float(said.split("length ")[1].split()[0]), 0.01 / 8, delta=2e-5)

    def test_lengths_of_a_vane_grow_through_the_air_of_its_passage(self):
        model, geometry = self.folder / "tunnel_wing.brep", self.folder / "geometry.hdf"
        subprocess.run([WING_MODELS, "tunnel_wing", model], check=True, capture_output=True, timeout=100)
        must("st-import", model, "-o", geometry)
        must("st-raster", geometry, "-o", self.folder / "raster.hdf", "--preset", "euler")
        must("st-prolong", self.folder / "raster.hdf", "--preset", "euler", "-o", self.folder / "sizing.hdf")
        said = must("st-info", self.folder / "sizing.hdf", "--at", "0.99,2,0.00144").out  # 1 % of the chord before it
        self.assertLess(float(said.split("length ")[1].split()[0]), 0.0052)  # 0.003 at the edge, slope 0.2

    def test_edges_of_coves_and_slats_are_warned_of(self):
        for name, spans, edges in (("gapped_aileron", [2.7, 1.28], "3, 8"), ("fixed_slat", [4], "4")):
            (self.folder / "geometry.hdf").unlink(missing_ok=True)
            done = self.raster(name, "rans")
            found = [wing["span"] for wing in done.json()["lifting_surfaces"]]
            self.assertEqual([round(span, 2) for span in found], spans, name)
            self.assertRegex(done.err, rf"warning: .* edges = \[{edges}\], trailing_edge = true", name)

    def test_a_sliver_that_runs_out_to_a_point_gets_no_lengths_by_its_chord_unless_declared(self):
        said = self.raster("slat_with_cove", "rans").json()
        self.assertGreater(said["lmin"], 1e-4)  # of 0.1 % of its chord it was 2.6e-7
        reasons = {edge: rest["reason"] for rest in said["unused_trailing"] for edge in rest["edges"]}
        for edge in (4, 6):  # on both sides of it
            self.assertIn("a sliver that runs out to a point", reasons[edge])
        rules = self.folder / "sizes.toml"
        rules.write_text("size = [{ edges = [6], trailing_edge = true }]\n")
        declared = self.raster("slat_with_cove", "euler", "--sizes", rules).json()["lifting_surfaces"]
        self.assertIn([6], [wing["trailing_edges"] for wing in declared])

    def test_a_fork_and_a_mast_that_is_cut_off_are_warned_of(self):
        done = self.raster("forked_tip", "rans")  # roots of the winglets lie in each other
        found = sorted(wing["span"] for wing in done.json()["lifting_surfaces"])
        for got, asked in zip(found, (0.46, 0.96, 3.01), strict=True):
            self.assertAlmostEqual(got, asked, delta=0.01)
        self.assertRegex(done.err, "warning: no nose is seen before [0-9.]+ % of the span at edge")
        (self.folder / "geometry.hdf").unlink()
        done = self.raster("wing_mast", "rans")
        self.assertRegex(done.err, r"warning: 2 trailing edges, 8.001 long, .* trailing_edge = true")

    def test_a_wing_without_its_tail_is_warned_of(self):
        done = self.raster("cut_tail", "rans")  # its base is 6.6 % of the chord
        self.assertRegex(done.err, r"warning: 2 trailing edges, 8 long, .* edges = \[1, 3\], trailing_edge = true")

    def test_elements_of_one_span_have_their_own_chords(self):
        wings = self.raster("three_elements", "rans").json()["lifting_surfaces"]
        for chord, asked in zip(sorted(wing["chord"][1] for wing in wings), (0.16, 0.3, 1)):
            self.assertAlmostEqual(chord, asked, delta=0.001)

    def test_fillets_are_no_finer_than_the_nose_needs(self):
        def n_samples(edge_size):
            return must("st-raster", self.folder / "geometry.hdf", "-o", self.folder / "raster.hdf", "--no-surface",
                        "--json", "--edge-size", edge_size).json()["samples"]
        self.raster("rudder", "euler")
        fine, usual, coarse = (n_samples(size) for size in ("none", "0.3%chord", "10%chord"))
        self.assertLess(usual, 0.85 * fine, "with all lengths at nose and edge")
        self.assertGreater(coarse, 0.5 * fine, "a coarse nose coarsens nothing else")

    def test_noses_lie_on_the_leading_edge_where_facets_are_coarse(self):
        tail = max(self.raster("t_tail", "euler").json()["lifting_surfaces"], key=lambda wing: wing["span"])
        for station in tail["stations"]:
            self.assertAlmostEqual(station["nose"][2], 3, 5, "the tail is at z = 3")

    def test_noses_lie_on_the_leading_edge_or_on_ice_before_it(self):
        def nose_of_canard(station):  # of chord 0.8 to 0.4 within 1.5
            return 1.5 + 0.4 * abs(station["nose"][1]) / 1.5

        def nose_of_iced_wing(station):
            return -0.025 if 0.5 < station["nose"][1] < 3.5 else 0

        for name, span, nose in (("canards_and_v_tail", 1.03, nose_of_canard), ("iced_wing", 4, nose_of_iced_wing)):
            (self.folder / "geometry.hdf").unlink(missing_ok=True)
            wings = [wing for wing in self.raster(name, "euler").json()["lifting_surfaces"]
                     if abs(wing["span"] - span) < 0.02]
            self.assertTrue(wings, name)
            for wing in wings:
                for station in wing["stations"]:
                    self.assertAlmostEqual(station["nose"][0], nose(station), delta=0.003, msg=name)

    def test_a_round_tail_that_is_taken_out_is_not_found_from_another_edge(self):
        rules = self.folder / "sizes.toml"
        for name in ("blade_of_splines", "blade_of_halves"):
            (self.folder / "geometry.hdf").unlink(missing_ok=True)
            (wing,) = self.raster(name, "euler").json()["lifting_surfaces"]
            edges = wing["trailing_edges"] + wing.get("inside_along", [])
            rules.write_text(f"size = [{{ edges = {edges}, trailing_edge = false }}]\n")
            self.assertEqual(self.raster(name, "euler", "--sizes", rules).json()["lifting_surfaces"], [], name)

    def test_what_is_said_of_short_trailing_edges_counts(self):
        rules = self.folder / "sizes.toml"
        wings = self.raster("vortex_generators", "euler").json()["lifting_surfaces"]
        small = min(wings, key=lambda wing: wing["span"])
        for word, n in (("false", len(wings) - 1), ("true", len(wings))):
            rules.write_text(f"size = [{{ edges = {small['trailing_edges']}, trailing_edge = {word} }}]\n")
            got = self.raster("vortex_generators", "euler", "--sizes", rules).json()["lifting_surfaces"]
            self.assertEqual(len(got), n, word)

    def test_edges_away_from_their_vertices_are_said_at_import(self):
        model = self.folder / "model.brep"
        subprocess.run([WING_MODELS, "wing_with_fairing", model], check=True, capture_output=True, timeout=100)
        done = must("st-import", model, "-o", self.folder / "geometry.hdf")
        self.assertRegex(done.err, "warning: .*edges end away from their vertex, by up to 0.0625")

    def test_arcs_and_ends_of_fillets_get_their_vertices(self):
        for name, times in (("rudder", r" \(26 times\)"), ("round_rudder", ";")):
            model = self.folder / f"{name}.brep"
            subprocess.run([WING_MODELS, name, model], check=True, capture_output=True, timeout=100)
            done = must("st-import", model, "-o", self.folder / "geometry.hdf")
            self.assertRegex(done.err, "vertex that stood for both ends of an edge, split" + times)
            self.assertNotIn("edges end away", done.err)

    def test_a_base_lies_behind_a_sharp_nose(self):
        (wing,) = self.raster("wedge_wing", "euler").json()["lifting_surfaces"]
        self.assertTrue(wing["is_blunt"])
        self.assertEqual(len(wing["trailing_edges"]), 2)
        for station in wing["stations"]:
            self.assertLess(station["nose"][0], station["trailing"][0])

    def test_vanes_in_a_passage_are_lifting_surfaces(self):
        done = self.raster("vane_passage", "rans")
        (vane,) = done.json()["lifting_surfaces"]
        self.assertAlmostEqual(vane["span"], 0.4, delta=0.01)
        self.assertIn("taken for the air in a passage", done.err)

    def test_a_cambered_plate_is_found_or_said(self):
        for name in ("plate_sail", "thick_plate_sail"):
            (self.folder / "geometry.hdf").unlink(missing_ok=True)
            for preset in ("euler", "rans", "fine"):
                done = self.raster(name, preset)
                found = [wing["span"] for wing in done.json()["lifting_surfaces"]]
                if not found:
                    self.assertRegex(done.err, r"warning: .* edges? .* trailing_edge = true", name)
                for span in found:
                    self.assertAlmostEqual(span, 3.01, delta=0.02, msg=name)

    def test_of_a_passage_only_the_vane_is_suggested_as_wing(self):
        model, groups = self.folder / "vane_passage.brep", self.folder / "groups.toml"
        subprocess.run([WING_MODELS, "vane_passage", model], check=True, capture_output=True, timeout=100)
        done = must("st-import", model, "-o", self.folder / "geometry.hdf", "--suggest-groups", groups)
        # its skin is one face, its base another; the passage has six
        self.assertRegex(done.err, "wing 2 faces; 6 of 8 faces are in none")

    def test_without_an_edge_at_its_trailing_edge_is_warned_of(self):
        self.assertRegex(self.raster("sail", "rans").err, "warning: .*sheets.* free edges 1, 2, 3, 4;")
        (self.folder / "geometry.hdf").unlink()
        self.assertRegex(self.raster("oval_blade", "rans").err, "warning: .* at edge [0-9]+ looks like a blade")


for model_name, model_spans in SPANS.items():
    setattr(WingShapes, f"test_{model_name}",
            lambda self, name=model_name, spans=model_spans: self.check_wing(name, spans))
for part_name in PARTS:
    setattr(WingShapes, f"test_part_{part_name}", lambda self, name=f"part_{part_name}": self.check_part(name))

if __name__ == "__main__":
    unittest.main()
