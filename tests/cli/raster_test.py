"""Sizes of parts: rules for groups, faces and edges in an option file, the limit of the chord's error."""
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
from chain import MODELS, USAGE, ToolTest, artifacts_of, must  # noqa: E402


class Rules(ToolTest):
    def raster(self, text, *options, name="assembly", by="--sizes", output="r.hdf"):
        (self.folder / "sizes.toml").write_text(text)
        return must("st-raster", artifacts_of(name) / "geometry.hdf", "-o", self.folder / output, by,
                    self.folder / "sizes.toml", *options, "--json", cwd=self.folder).json()

    def refuse(self, text, *says):
        (self.folder / "sizes.toml").write_text(text)
        self.expect_error(USAGE, "st-raster", artifacts_of("assembly") / "geometry.hdf", "-o", self.folder / "r.hdf",
                          "--sizes", "sizes.toml", says=list(says),
                          cwd=self.folder)
        self.expect_nothing_left(self.folder, "sizes.toml")

    def test_an_option_file_holds_options_and_rules(self):
        rule = '[[size]]\nfaces = "pin_mantle"\nlmin = 0.02\nlmax = 0.2\n'
        a = self.raster("alpha = 12\n" + rule + "[[st-raster.size]]\nedges = 1\nlmax = 0.5\n", by="--options")
        self.assertEqual((a["alpha"], a["rules"]), (12, 2))
        self.assertEqual(a["lmin"], 0.02)
        plain = must("st-raster", artifacts_of("assembly") / "geometry.hdf", "-o", self.folder / "p.hdf", "--alpha",
                     "12", "--json").json()
        self.assertGreater(a["samples"], 2 * plain["samples"])

    def test_the_result_does_not_depend_on_the_number_of_ranks(self):
        rule = '[[size]]\nfaces = "pin_*"\nlmax = "0.3%"\nchord = "0.01%"\n[[size]]\nfor = "curves"\nsample = false\n'
        hashes = {self.raster(rule, "--np", n, output=f"r{n}.hdf")["hash"] for n in (1, 2, 3)}
        self.assertEqual(len(hashes), 1)

    def test_a_trace_has_the_tasks_and_changes_nothing(self):
        plain, traced = (self.raster('[[size]]\nlmax = "2%"\n', *options) for options in ((), ("--trace", "trace.csv")))
        self.assertEqual(plain["hash"], traced["hash"])
        rows = (self.folder / "trace.csv").read_text().splitlines()
        self.assertEqual(rows[0].split(",")[:2], ["event", "name"])
        names = {tuple(row.split(",")[:2]) for row in rows}
        self.assertLessEqual({("task", "task"), ("task", "face"), ("serial", "octree"), ("serial", "surface")}, names)

    def test_a_chord_error_makes_lengths_shorter(self):
        geometry = artifacts_of("assembly") / "geometry.hdf"
        counts = [must("st-raster", geometry, "-o", self.folder / "r.hdf", "--lmin", "0.01", *chord,
                       "--json").json()["samples"]
                  for chord in ([], ["--chord", "0.05"], ["--chord", "0.001"])]
        self.assertLess(counts[0] * 1.2, counts[2])
        self.assertLessEqual(counts[1], counts[2])

    def test_a_rule_asks_for_lengths_along_an_edge(self):
        counts = [self.raster(f"[[size]]\nedges = 1\nedge_cells = {n}\n")["samples"] for n in (1, 40)]
        self.assertGreater(counts[1], counts[0] + 10)

    def test_a_far_field_of_200_spans_keeps_its_lengths_and_those_at_the_nose(self):
        geometry, output = self.folder / "g.hdf", self.folder / "r.hdf"
        lengths, sizes = [], []
        for size in (5, 200):
            must("st-import", MODELS / "wing_with_flap.step", "--farfield", f"box:{size}", "-o", geometry)
            run = must("st-raster", geometry, "-o", output, "--edge-size", "0.02%chord", "--json")
            self.assertNotIn("warning", run.err)
            lengths.append(run.json())
            sizes.append(output.stat().st_size)
        self.assertLess(sizes[1], 1.1 * sizes[0])  # the coarse surface is coarse far away, too
        self.assertAlmostEqual(lengths[0]["lmin"] / lengths[1]["lmin"], 1, 3)
        self.assertEqual(lengths[1]["beyond_depth"]["samples"], 0)
        self.assertLess(lengths[1]["beyond_depth"]["smallest_cell"], 1.1 * lengths[0]["beyond_depth"]["smallest_cell"])
        self.assertAlmostEqual(lengths[1]["far_length"] / lengths[0]["far_length"], 40, 3)

    def test_wrong_rules_are_refused_with_file_and_line(self):
        self.refuse("[[size]]\nlmax = 1\nlmxa = 2\n", "sizes.toml:3", "'lmxa'", "allowed are", "lmin")
        self.refuse('[[size]]\nlmax = 1\nalpha = 91\n', "sizes.toml:3", "[0.001, 90]")
        self.refuse('[[size]]\nlmax = "3pt"\n', "sizes.toml:2", "lmax")
        self.refuse('[[size]]\nlmax = -1\n', "sizes.toml:2", "positive")
        self.refuse('[[size]]\nlmax = 1\nfor = "edges"\n', "sizes.toml:3", "curves")
        self.refuse('[[size]]\nlmax = 1\nbetween = ["A"]\n', "sizes.toml:3", "two")
        self.refuse('[[size]]\nlmax = 1\ngroups = []\n', "sizes.toml:3", "empty")
        self.refuse('[[size]]\nlmax = 1\nsample = 1\n', "sizes.toml:3", "true or false")
        self.refuse('[[size]]\ngap_cells = 2.5\n', "sizes.toml:2", "gap_cells", "whole number")
        self.refuse('[[size]]\nedge_cells = 200\n', "sizes.toml:2", "edge_cells")
        self.refuse('[[size]]\ngap_cells = 101\n', "sizes.toml:2", "[1, 100]")
        self.refuse('[[size]]\ngroups = "*"\n', "sizes.toml:1", "sets nothing")
        self.refuse('\n[[size]]\nlmax = 1\ngroups = "NONE*"\n', "sizes.toml:2", "NONE*", "matches")
        self.refuse('[[size]]\nlmax = 1\nfaces = 99999\n', "sizes.toml:1", "99999")
        self.refuse("alpha = 5\n", "sizes.toml", "[[size]]")
        self.refuse("[[size]]\nlmax = \n", "sizes.toml:2")


class EdgeCells(ToolTest):
    def test_edges_get_as_many_lengths_as_asked(self):
        geometry, r, s = artifacts_of("box") / "geometry.hdf", self.folder / "r.hdf", self.folder / "s.hdf"
        length = {}
        for n in (None, 20, 50):
            must("st-raster", geometry, "-o", r, "--lmax", "10%", "--lmin", "0.1%", *(["--edge-cells", n] if n else []))
            must("st-prolong", r, "-o", s)
            length[n] = must("st-info", s, "--at=0,0,0", "--json").json()["length"]
        self.assertGreater(length[None], 1.5 * length[20])
        self.assertAlmostEqual(length[20] / length[50], 2.5, delta=0.1)


class DetectedEdges(ToolTest):
    def test_check_lists_what_st_raster_refines(self):
        plate, r = self.folder / "plate.hdf", self.folder / "r.hdf"
        listed = must("st-import", MODELS / "thin_plate.brep", "--check", "--json").json()["wing_edges"]
        self.assertEqual(len(listed), 8, "the rim of a thin plate")
        for edge in listed:
            self.assertEqual((edge["kind"], round(edge["size"], 6), round(edge["angle"], 3)),
                             ("blunt trailing edge", 0.2, 90))
            self.assertIn(round(edge["length"], 6), (100, 60))
        must("st-import", MODELS / "thin_plate.brep", "-o", plate)
        plain = must("st-raster", plate, "-o", r, "--json").json()
        fine = must("st-raster", plate, "-o", r, "--trailing-edges", "0.1:0.5", "--json").json()
        self.assertEqual((plain["wing_edges"], fine["wing_edges"]), (8, 8))
        self.assertEqual(plain["lifting_surfaces"], [], "a plate is no wing")
        self.assertLess(fine["samples"], 0.95 * plain["samples"],
                        "0.5 at the edges instead of the width of the rim, 0.2")
        (self.folder / "sizes.toml").write_text('[[size]]\ndetected = "trailing"\nlmin = 0.1\nlmax = 0.5\n')
        by_rule = must("st-raster", plate, "-o", r, "--sizes", self.folder / "sizes.toml", "--json").json()
        self.assertEqual(by_rule["samples"], fine["samples"])

    def test_nothing_found_and_wrong_words_are_refused(self):
        geometry = artifacts_of("box") / "geometry.hdf"
        self.assertEqual(must("st-import", MODELS / "box.brep", "--check", "--json").json()["wing_edges"], [])
        self.expect_error(USAGE, "st-raster", geometry, "-o", self.folder / "r.hdf", "--leading-edges", "0.5",
                          says=["--leading-edges", "no leading edge found"])
        (self.folder / "sizes.toml").write_text('[[size]]\nlmax = 1\ndetected = "upper"\n')
        self.expect_error(USAGE, "st-raster", geometry, "-o", self.folder / "r.hdf", "--sizes",
                          self.folder / "sizes.toml",
                          says=["sizes.toml:3", "trailing", "leading"])
        self.expect_nothing_left(self.folder, "sizes.toml")


class LiftingSurfaces(ToolTest):
    """Wing and flap: chords of 60 and 18, both with a blunt edge 0.5 wide."""

    def sizes(self, *options):
        """The raster's summary, and the lengths at trailing edge and nose of the wing, and in the middle of its
        base."""
        g, r, s = (self.folder / name for name in ("g.hdf", "r.hdf", "s.hdf"))
        must("st-import", MODELS / "wing_with_flap.step", "-o", g)
        said = must("st-raster", g, "-o", r, *options, "--json").json()
        must("st-prolong", r, "-o", s)
        return said, [must("st-info", s, f"--at={at}", "--json").json()["length"]
                      for at in ("60,50,0.25", "0,50,0", "30,50,2.26")]

    def test_get_a_share_of_their_chord_by_default(self):
        said, (trailing, nose, middle) = self.sizes("--base-cells", 1)
        self.assertEqual([round(w["chord"][1]) for w in said["lifting_surfaces"]], [60, 18])
        self.assertAlmostEqual(trailing, 0.003 * 60, delta=0.02)
        self.assertAlmostEqual(nose, 0.003 * 60, delta=0.02)
        self.assertLess(middle, 1.1 * 60 / 30)
        self.assertGreater(self.sizes("--edge-size", "none", "--chord-cells", 1)[1][0], 1.5 * trailing)

    def test_options_change_edge_base_and_chord(self):
        default = self.sizes()[1]
        self.assertLess(self.sizes("--edge-size", "0.1%chord")[1][1], 0.5 * default[1])
        self.assertLess(self.sizes("--base-cells", 6)[1][0], 0.6 * default[0])
        self.assertLess(self.sizes("--chord-cells", 100)[1][2], 0.5 * default[2])
        self.assertAlmostEqual(self.sizes("--edge-size", "0.4", "--base-cells", 1)[1][1], 0.4, delta=0.04)

    def test_the_option_for_detected_edges_wins(self):
        self.assertAlmostEqual(self.sizes("--trailing-edges", "0.3:0.3")[1][0], 0.3, delta=0.03)

    def test_lengths_may_be_shares_of_chord_and_span(self):
        self.assertAlmostEqual(self.sizes("--lmin", "2%chord")[1][1], 1.2, delta=0.2)
        (self.folder / "sizes.toml").write_text('[[size]]\nlmax = "1%span"\n')
        self.assertLess(self.sizes("--sizes", self.folder / "sizes.toml")[1][2], 1.05)
        self.expect_error(USAGE, "st-raster", artifacts_of("box") / "geometry.hdf", "-o", self.folder / "r.hdf",
                          "--lmax", "3%chord",
                          says=["--lmax", "no lifting surface"])

    def test_a_smallest_length_that_coarsens_their_edges_is_said(self):
        g = self.folder / "g.hdf"
        must("st-import", MODELS / "wing_with_flap.step", "-o", g)
        warning = "--lmin 0.1 is larger than --edge-size 0.3%chord on 1 of 2 lifting surfaces: 0.1 mm instead of 0.05"
        run = must("st-raster", g, "-o", self.folder / "r.hdf", "--lmin", 0.1)
        self.assertIn(warning, run.err)
        for options in (["--lmin", 0.05], ["--lmin", 0.1, "--edge-size", "1%chord"], []):
            self.assertNotIn("warning", must("st-raster", g, "-o", self.folder / "r.hdf", *options).err)

    def test_the_smallest_length_of_a_rule_holds_as_that_of_the_option_does(self):
        g, rule = self.folder / "g.hdf", self.folder / "rule.toml"
        must("st-import", MODELS / "wing_with_flap.step", "-o", g)
        rule.write_text("[[size]]\nlmin = 0.1\n")
        runs = [must("st-raster", g, "-o", self.folder / "r.hdf", *options, "--json")
                for options in (["--lmin", 0.1], ["--sizes", rule])]
        said = [{key: run.json()[key] for key in ("samples", "cells", "groups", "below_lmin")} for run in runs]
        self.assertEqual(*said)
        self.assertIn("the lmin of a rule is larger than what --edge-size 0.3%chord asks for: 0.1 mm instead of 0.05",
                      runs[1].err)

    def test_a_largest_length_of_a_rule_leaves_those_across_gaps(self):
        g, rule = self.folder / "g.hdf", self.folder / "rule.toml"
        must("st-import", MODELS / "wing_with_flap.step", "-o", g)
        gaps = {}
        for limits in ("lmax = 0.5", "lmin = 0.5\nlmax = 0.5"):  # below the default lmin of the model, 0.8
            rule.write_text(f'[[size]]\nfaces = "1-12"\n{limits}\n')
            gaps[limits] = must("st-raster", g, "-o", self.folder / "r.hdf", "--lmax", "40%", "--gap-cells", 8,
                                "--sizes", rule, "--json").json()["gap_samples"]
        self.assertGreater(gaps.pop("lmax = 0.5"), 100)
        self.assertEqual(list(gaps.values()), [0], "an lmin of a rule stays")

    def test_strips_below_a_smallest_length_are_counted(self):
        g = self.folder / "g.hdf"
        must("st-import", MODELS / "thin_plate.brep", "-o", g)
        run = must("st-raster", g, "-o", self.folder / "r.hdf", "--lmin", 0.3, "--json")
        below = run.json()["below_lmin"]
        self.assertAlmostEqual(below["least"], 1.25 * 0.2, delta=1e-3)  # the sides of the plate are 0.2 wide
        self.assertEqual(len(below["places"]), 3)
        for place in below["places"]:
            self.assertAlmostEqual(place[2], 0.1, delta=1e-3)
        self.assertIn(f"{below['samples']} of {run.json()['samples']} samples are below the lmin given for them",
                      run.err)
        self.assertIsNone(must("st-raster", g, "-o", self.folder / "r.hdf", "--json").json()["below_lmin"])

    def test_do_not_depend_on_the_number_of_ranks(self):
        self.assertEqual(len({self.sizes("--np", n)[0]["hash"] for n in (1, 2, 3)}), 1)


class Gaps(ToolTest):
    def length_in_the_wall(self, *options):
        """On a tube whose wall is 0.4 thick, and the raster's summary."""
        tube = self.folder / "tube.hdf"
        must("st-import", MODELS / "tube_with_rod.brep", "-o", tube)
        said = must("st-raster", tube, "-o", self.folder / "r.hdf", "--lmin", "0.15", *options, "--json").json()
        must("st-prolong", self.folder / "r.hdf", "-o", self.folder / "s.hdf")
        return must("st-info", self.folder / "s.hdf", "--at=-10,0,5", "--json").json()["length"], said

    def test_a_thin_wall_gets_the_lengths_asked_for(self):
        self.assertGreater(self.length_in_the_wall()[0], 0.7)
        for n in (1, 2):
            self.assertAlmostEqual(self.length_in_the_wall("--wall-cells", n)[0], 0.4 / n, delta=0.03 * 0.4 / n)
        self.assertAlmostEqual(self.length_in_the_wall("--wall-cells", 4)[0], 0.15, delta=0.02)  # lmin

    def test_a_rule_asks_for_gaps_of_some_faces_only(self):
        rules = self.folder / "sizes.toml"
        rules.write_text("[[size]]\nwall_cells = 2\n")
        self.assertAlmostEqual(self.length_in_the_wall("--sizes", rules)[0], 0.2, delta=0.006)
        rules.write_text("[[size]]\nfaces = [1, 2, 3, 4, 5, 6]\nwall_cells = 0\n")
        some = self.length_in_the_wall("--wall-cells", 2, "--sizes", rules)[1]
        everywhere = self.length_in_the_wall("--wall-cells", 2)[1]
        self.assertGreater(everywhere["gap_samples"], some["gap_samples"])

    def test_the_result_does_not_depend_on_the_number_of_ranks(self):
        self.assertEqual(len({self.length_in_the_wall("--wall-cells", 1, "--np", n)[1]["hash"] for n in (1, 2, 3)}), 1)


if __name__ == "__main__":
    unittest.main(verbosity=2)
