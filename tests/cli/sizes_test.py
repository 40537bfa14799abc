"""What a size specification says of itself: the length at a point and why, lengths at many points, the background
meshes of other programs."""
import csv
import math
import re
import struct
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
from chain import GEOMETRY, INPUT, MISMATCH, MODELS, USAGE, ToolTest, artifacts_of, must  # noqa: E402

SOURCE = '[[source]]\nname = "wake"\ntype = "point"\nat = [25, 20, 5]\nlength = 0.1\nradius = 0.5\n'


class Sizes(ToolTest):
    def with_source(self):
        (self.folder / "wake.toml").write_text(SOURCE)
        run = must("st-prolong", artifacts_of("box") / "raster.hdf", "-o", self.folder / "s.hdf", "--sources",
                   self.folder / "wake.toml", "--json")
        self.n_cells = run.json()["cells"]
        return self.folder / "s.hdf"

    def test_a_point_names_the_source_that_it_obeys(self):
        sizing = self.with_source()
        said = must("st-info", sizing, "--at", "26,20,5").out
        self.assertIn('source 1 "wake"', said)
        at = must("st-info", sizing, "--at", "27,20,5", "--json").json()
        self.assertAlmostEqual(at["length"], 0.1 + 0.2 * 1.5, delta=0.1)
        self.assertLessEqual(0.0999, at["origin"]["length"])
        self.assertLessEqual(at["origin"]["length"], at["length"])
        self.assertEqual(must("st-info", artifacts_of("box") / "sizing.hdf", "--at", "27,20,5",
                              "--json").json()["cause"], "the largest length")

    def test_sources_may_stand_in_the_option_file_beside_files_that_it_names(self):
        (self.folder / "wake.toml").write_text(SOURCE)
        far = SOURCE.replace("25, 20, 5", "1, 1, 1").replace("[[source]]", "[[st-prolong.source]]")
        far = far.replace("wake", "far")
        near = SOURCE.replace("wake", "near").replace("25, 20, 5", "25, 2, 5")
        (self.folder / "o.toml").write_text(f'slope = 0.3\nsources = "{self.folder / "wake.toml"}"\n{near}{far}')
        for more in ([], ["--sources", self.folder / "wake.toml"]):
            sizing = self.folder / f"{len(more)}.hdf"
            raster = artifacts_of("box") / "raster.hdf"
            must("st-prolong", raster, "-o", sizing, "--options", self.folder / "o.toml", *more)
            points = ("25,20,5", "25,2,5", "1,1,1")
            causes = {at: must("st-info", sizing, "--at", at, "--json").json()["cause"] for at in points}
            self.assertEqual(causes["25,20,5"], 'source 1 "wake"')
            for at, source in (("25,2,5", 'source 2 "near"'), ("1,1,1", 'source 3 "far"')):
                (self.assertNotEqual if more else self.assertEqual)(causes[at], source)

    def test_points_of_a_csv_have_the_lengths_of_single_queries(self):
        (self.folder / "p.csv").write_text("x,y,z\n26,20,5\n# far\n1 2 3\n")
        (self.folder / "wake.toml").write_text(SOURCE)
        must("st-prolong", artifacts_of("box") / "raster.hdf", "-o", self.folder / "s.hdf", "--sources",
             self.folder / "wake.toml",
             "--sample", self.folder / "p.csv", "--sample-output", self.folder / "o.csv")
        rows = list(csv.DictReader((self.folder / "o.csv").read_text().splitlines()))
        self.assertEqual([r["cause"] for r in rows][0], 'source 1 "wake"')
        for row, at in zip(rows, ("26,20,5", "1,2,3"), strict=True):
            self.assertAlmostEqual(float(row["length"]), must("st-info", self.folder / "s.hdf", "--at", at,
                                                              "--json").json()["length"], delta=1e-6)

    def test_bad_points_are_refused_and_nothing_is_written(self):
        raster = artifacts_of("box") / "raster.hdf"
        self.expect_error(USAGE, "st-info", artifacts_of("box") / "sizing.hdf", "--at", "1,2", says="--at")
        self.expect_error(INPUT, "st-info", artifacts_of("box") / "mesh.hdf", "--at", "1,2,3", says="mesh.hdf")
        (self.folder / "p.csv").write_text("1,2,3\n1,two,3\n")
        (self.folder / "out").mkdir()
        self.expect_error(INPUT, "st-prolong", raster, "-o", self.folder / "out/s.hdf", "--sample",
                          self.folder / "p.csv",
                          "--sample-output", self.folder / "out/o.csv", says="p.csv:2")
        self.expect_nothing_left(self.folder / "out")

    def test_background_meshes_hold_the_lengths(self):
        sizing = self.with_source()
        must("st-export", sizing, "-o", self.folder / "s.pos")
        text = (self.folder / "s.pos").read_text()
        lengths = [float(v) for cell in re.findall(r"\)\{([^}]*)\}", text) for v in cell.split(",")]
        self.assertEqual(text.count("SH("), text.count("\n") - 2)
        self.assertGreater(text.count("SH("), self.n_cells)  # finer where the source is
        self.assertAlmostEqual(min(lengths), 0.1, delta=1e-3)
        must("st-export", sizing, "-o", self.folder / "s.bac")
        (self.folder / "p.csv").write_text("26,20,5\n25.2,20,5\n10,10,10\n")
        must("st-prolong", artifacts_of("box") / "raster.hdf", "-o", self.folder / "b.hdf", "--background",
             self.folder / "s.bac",
             "--sample", self.folder / "p.csv", "--sample-output", self.folder / "o.csv")
        for row in csv.DictReader((self.folder / "o.csv").read_text().splitlines()):
            at = must("st-info", sizing, "--at", f"{row['x']},{row['y']},{row['z']}", "--json").json()
            self.assertLess(abs(float(row["length"]) / at["length"] - 1), 0.35)


class OfAnotherProgram(ToolTest):
    """Lengths on the nodes of a mesh that a mesh adapter or a solver wrote."""

    def setUp(self):
        super().setUp()
        box = artifacts_of("box")
        self.raster = box / "raster.hdf"
        must("st-export", box / "mesh.hdf", "--sizing", box / "sizing.hdf", "-o", self.folder / "flow.sol")
        must("st-export", box / "mesh.hdf", "-o", self.folder / "flow.mesh")
        head, *lengths = (self.folder / "flow.sol").read_text().split("1 1\n")
        self.lengths = [float(v) for v in lengths[0].split()[:-1]]
        self.head = head + "1 1\n"

    def write(self, values):
        (self.folder / "flow.sol").write_text(self.head + "\n".join(map(str, values)) + "\nEnd\n")

    def prolong(self, background):
        run = must("st-prolong", self.raster, "-o", self.folder / "s.hdf", "--background", self.folder / background,
                   "--json")
        self.assertNotIn("outside", run.err)
        return run.json()["expected_triangles"]

    def test_lengths_of_a_solution_count_on_the_surface_that_they_are_given_on(self):
        self.write([0.25 * h for h in self.lengths])
        fine = self.prolong("flow.sol")
        self.assertEqual(self.prolong("flow.mesh"), fine)  # either of the two names both
        self.write(self.lengths)
        self.assertAlmostEqual(fine / self.prolong("flow.sol"), 16, delta=0.5)

    def test_an_array_of_vtkhdf_counts_by_its_name(self):
        mesh = self.folder / "mesh.hdf"
        mesh.write_bytes((artifacts_of("box") / "mesh.hdf").read_bytes())
        self.assertEqual(self.prolong("mesh.hdf:size"), self.prolong("mesh.hdf"))
        self.expect_error(INPUT, "st-prolong", self.raster, "-o", self.folder / "n.hdf", "--background",
                          f"{mesh}:none", says="has no array 'none'")

    def test_what_cannot_be_read_is_refused_by_name(self):
        for values, says in ((self.lengths[1:], "'End' is no number"),
                             ([-1.0] + self.lengths[1:], "have no length above 0")):
            self.write(values)
            self.expect_error(INPUT, "st-prolong", self.raster, "-o", self.folder / "n.hdf", "--background",
                              self.folder / "flow.sol", says=says)
        (self.folder / "flow.mesh").unlink()
        self.expect_error(INPUT, "st-prolong", self.raster, "-o", self.folder / "n.hdf", "--background",
                          self.folder / "flow.sol", says="no mesh beside it")


class Sources(ToolTest):
    """Sources and backgrounds count exactly, and can be changed in a finished field."""

    SOURCES = """
[[source]]
name = "nose"
type = "point"
at = [10, 10, 5]
length = 0.05
radius = 0.5
[[source]]
type = "line"
points = [[0, 0, 0], [30, 20, 10]]
length = [0.2, 0.9]
[[source]]
type = "sphere"
at = [500, 10, 5]
extent = 2
length = 0.01
"""

    def setUp(self):
        super().setUp()
        self.raster, self.sizing = (artifacts_of("box") / f"{name}.hdf" for name in ("raster", "sizing"))
        self.sources = self.folder / "sources.toml"
        self.sources.write_text(self.SOURCES)

    def prolong(self, artifact, name, *options):
        must("st-prolong", artifact, "-o", self.folder / name, *options)
        return (self.folder / name).read_bytes()

    def lengths_at(self, sizing, places):
        return [must("st-info", sizing, "--at", ",".join(map(str, p)), "--json").json()["length"] for p in places]

    def test_each_place_gets_what_was_asked_for(self):
        self.prolong(self.raster, "s.hdf", "--sources", self.sources)
        places = [(10, 10, 5), (10, 10, 5.9), (0, 0, 0), (15, 10, 5), (500, 10, 7.5), (1000, 10, 5)]
        wanted = [0.05, 0.05 + 0.2 * 0.4, 0.2, None, 0.01 + 0.2 * 0.5, None]
        for place, length, want in zip(places, self.lengths_at(self.folder / "s.hdf", places), wanted):
            if want:
                self.assertAlmostEqual(length, want, delta=1e-9, msg=place)

    def test_a_finished_field_takes_other_sources_as_the_raster_does(self):
        for options in ([], ["--target-triangles", "5000"], ["--scale", "0.5"]):
            plain = self.prolong(self.raster, "plain.hdf", *options)
            fresh = self.prolong(self.raster, "fresh.hdf", *options, "--sources", self.sources)
            self.assertNotEqual(plain, fresh)
            self.assertEqual(self.prolong(self.folder / "plain.hdf", "again.hdf", "--sources", self.sources), fresh)
            self.assertEqual(self.prolong(self.folder / "again.hdf", "none.hdf"), plain)

    def test_several_files_may_follow_one_flag(self):
        (self.folder / "wake.toml").write_text(SOURCE)
        both = [self.sources, self.folder / "wake.toml"]
        apart = self.prolong(self.raster, "apart.hdf", "--sources", both[0], "--sources", both[1])
        self.assertEqual(self.prolong(self.raster, "both.hdf", "--sources", *both), apart)
        must("st-prolong", "--sources", both[0], self.raster, "-o", self.folder / "one.hdf")  # the raster comes last

    def test_what_the_octree_tells_is_not_changed_silently(self):
        for options in (["--slope", "0.1"], ["--no-blank"], ["--slope-of", "side=0.1"]):
            self.expect_error(USAGE, "st-prolong", self.sizing, "-o", self.folder / "s.hdf", *options,
                              says="give the raster")
        self.expect_nothing_left(self.folder, "sources.toml")

    def test_a_background_is_lowered_to_the_slope_and_grows_outside(self):
        nodes = [(0, 0, 0), (20, 0, 0), (0, 20, 0), (0, 0, 20)]
        for steep, says in ((0, None), (40, "lengths of 1 of its 4 nodes are lowered")):
            lengths = [0.1, 0.3 + steep, 0.1, 0.1]
            lines = ["background", "4 1 0 0 0"]
            for i, (node, length) in enumerate(zip(nodes, lengths)):
                lines.append(f"{i + 1} {' '.join(map(str, node))}")
                lines += [f"{' '.join(axis)} {length}" for axis in ("100", "010", "001")]
            lines += ["1 1 2 3 4", "* points", "* lines", "* triangles", ""]
            (self.folder / "b.bac").write_text("\n".join(lines))
            run = must("st-prolong", self.raster, "-o", self.folder / "s.hdf", "--background", self.folder / "b.bac")
            (self.assertIn if says else self.assertNotIn)(says or "lowered", run.err)
            outside = re.search(r"(\S+) % of the model's area lies outside the background mesh, up to ([\d.]+)",
                                run.err)
            self.assertAlmostEqual(float(outside[1]), 100 * (1 - 1600 / 8800), delta=4)
            self.assertAlmostEqual(float(outside[2]), math.hypot(40, 20), delta=4)
            middle, side = self.lengths_at(self.folder / "s.hdf", [(5, 5, 5), (5, 5, -2)])
            self.assertAlmostEqual(middle, 0.1 + 0.25 * (4 if steep else 0.2), delta=1e-9)
            # by the lengths below it, or, where those grow as fast as the slope, by the nearest edge of the border
            wanted = 0.1 + 0.2 * math.sqrt(29) if steep else 0.15 + 2 * math.sqrt(0.04 - 0.01**2)
            self.assertAlmostEqual(side, wanted, delta=1e-9)


class Causes(ToolTest):
    def test_the_table_of_groups_has_a_line_for_each(self):
        folder = artifacts_of("assembly")
        run = must("st-prolong", folder / "raster.hdf", "-o", self.folder / "s.hdf")
        heading = run.err.index("least length")
        for group in must("st-prolong", folder / "raster.hdf", "-o", self.folder / "s.hdf", "--json").json()["groups"]:
            self.assertGreater(run.err.find(group["name"]), heading)

    def test_st_raster_shows_and_lists_the_lengths_of_groups(self):
        folder = artifacts_of("assembly")
        run = must("st-raster", folder / "geometry.hdf", "-o", self.folder / "r.hdf", "--json")
        groups = run.json()["groups"]
        self.assertGreater(len(groups), 1)
        for group in groups:
            self.assertIn(f"  {group['name']} ", run.err)
            self.assertLessEqual(group["least"], group["median"])
            self.assertNotIn("expected_triangles", group)

    def test_the_causes_of_a_group_share_its_triangles(self):
        folder = artifacts_of("assembly")
        groups = must("st-prolong", folder / "raster.hdf", "-o", self.folder / "s.hdf", "--json").json()["groups"]
        self.assertGreater(len(groups), 1)
        for group in groups:
            why = must("st-info", self.folder / "s.hdf", "--why", group["name"], "--raster", folder / "raster.hdf",
                       "--json").json()
            self.assertAlmostEqual(sum(c["share"] for c in why["causes"]), 1, delta=1e-9)
            self.assertAlmostEqual(why["expected_triangles"] / group["expected_triangles"], 1, delta=1e-9)
            self.assertAlmostEqual(sum(c["expected_triangles"] for c in why["causes"]) / why["expected_triangles"], 1,
                                   delta=1e-9)
            self.assertEqual(why["causes"][0]["cause"], group["cause"])
            self.assertLessEqual(why["least"], why["median"])
            self.assertEqual(min(c["least"] for c in why["causes"]), why["least"])
            triangles = [c["expected_triangles"] for c in why["causes"]]
            self.assertEqual(triangles, sorted(triangles, reverse=True))

    def test_the_raster_is_found_in_the_folder_of_the_sizing(self):
        sizing = artifacts_of("assembly") / "sizing.hdf"
        lines = must("st-info", sizing, "--why", "pin_mantle").out.splitlines()
        self.assertRegex(lines[0], r'"pin_mantle": 2 faces, about \d+ triangles, least length ')
        self.assertRegex(lines[1], r"cause +triangles +share +least length")
        self.assertTrue(3 <= len(lines) <= 13, lines)

    def test_a_face_is_found_by_its_name_where_no_group_has_it(self):
        (self.folder / "g.toml").write_text('[[group]]\nname = "PINS"\nfaces = "7-12"\n')
        must("st-import", next(MODELS.glob("assembly.*")), "--groups", self.folder / "g.toml", "-o",
             self.folder / "g.hdf")
        must("st-raster", self.folder / "g.hdf", "-o", self.folder / "raster.hdf")
        must("st-prolong", self.folder / "raster.hdf", "-o", self.folder / "s.hdf")
        face, group = (must("st-info", self.folder / "s.hdf", "--why", name, "--json").json()
                       for name in ("pin_mantle", "PINS"))
        self.assertEqual((face["faces"], group["faces"]), (2, 6))
        self.assertLess(face["expected_triangles"], group["expected_triangles"])

    def test_lengths_grow_with_a_geometry_that_moved_and_triangles_stay(self):
        box = artifacts_of("box")
        must("st-edit", box / "geometry.hdf", "--transform", "scale 3", "-o", self.folder / "g.hdf")
        must("st-prolong", box / "raster.hdf", "--geometry", self.folder / "g.hdf", "-o", self.folder / "s.hdf")
        here, there = (must("st-info", s, "--why", "*", "--raster", box / "raster.hdf", "--json").json()
                       for s in (box / "sizing.hdf", self.folder / "s.hdf"))
        for key, factor in (("expected_triangles", 1), ("least", 3), ("median", 3)):
            self.assertAlmostEqual(there[key] / here[key], factor, delta=1e-6)

    def test_a_source_is_a_cause(self):
        (self.folder / "near.toml").write_text(SOURCE.replace("25, 20, 5", "1, 1, 1"))
        box = artifacts_of("box")
        must("st-prolong", box / "raster.hdf", "-o", self.folder / "s.hdf", "--sources", self.folder / "near.toml")
        why = must("st-info", self.folder / "s.hdf", "--why", "default", "--raster", box / "raster.hdf",
                   "--json").json()
        self.assertIn('source 1 "wake"', [c["cause"] for c in why["causes"]])

    def test_unknown_names_and_other_rasters_are_refused(self):
        box, assembly = artifacts_of("box"), artifacts_of("assembly")
        self.expect_error(USAGE, "st-info", assembly / "sizing.hdf", "--why", "WING",
                          says=["--why", "WING", "--groups"])
        self.expect_error(USAGE, "st-info", assembly / "sizing.hdf", "--raster", assembly / "raster.hdf", says="--why")
        self.expect_error(MISMATCH, "st-info", assembly / "sizing.hdf", "--why", "x", "--raster", box / "raster.hdf",
                          says="--raster")
        self.expect_error(INPUT, "st-info", assembly / "mesh.hdf", "--why", "x", says="mesh.hdf")
        must("st-prolong", box / "raster.hdf", "-o", self.folder / "s.hdf")
        self.expect_error(INPUT, "st-info", self.folder / "s.hdf", "--why", "default", says=["raster.hdf", "--raster"])


class Slopes(ToolTest):
    def test_a_named_part_has_its_own_slope(self):
        folder = artifacts_of("assembly")
        (self.folder / "p.csv").write_text("".join(f"{x},{y},{z}\n" for x in range(0, 160, 4) for y in range(0, 45, 4)
                                                   for z in range(0, 21, 4)))
        lengths = {}
        for slope in ("", "pin_mantle=0.02"):
            must("st-prolong", folder / "raster.hdf", "-o", self.folder / "s.hdf", "--slope-of", slope, "--sample",
                 self.folder / "p.csv",
                 "--sample-output", self.folder / "o.csv")
            lengths[slope] = [float(r["length"])
                              for r in csv.DictReader((self.folder / "o.csv").read_text().splitlines())]
        self.assertTrue(all(b <= a * 1.1 for a, b in zip(*lengths.values(), strict=True)))
        self.assertTrue(any(b < 0.8 * a for a, b in zip(*lengths.values(), strict=True)))

    def test_a_name_that_no_face_has_is_refused(self):
        self.expect_error(USAGE, "st-prolong", artifacts_of("box") / "raster.hdf", "-o", self.folder / "s.hdf",
                          "--slope-of", "WING=0.1", says="WING")


class Blanking(ToolTest):
    def test_a_mesh_blanks_its_inside_or_its_outside(self):
        box = artifacts_of("box")
        said = {}
        for side in ("inside", "auto", "outside"):
            run = must("st-prolong", box / "raster.hdf", "-o", self.folder / "s.hdf", "--blank", box / "mesh.hdf",
                       "--blank-side", side, "--json")
            said[side] = run.json()
        self.assertGreater(said["inside"]["cut_cells"], 0)
        self.assertEqual(said["auto"]["blanked_cells"], said["inside"]["blanked_cells"])
        self.assertEqual(said["inside"]["blanked_cells"] + said["outside"]["blanked_cells"] +
                         said["inside"]["cut_cells"], said["inside"]["cells"])
        must("st-export", self.folder / "s.hdf", "-o", self.folder / "s.vtu")
        self.assertIn(b'Name="colour"', (self.folder / "s.vtu").read_bytes())

    def test_a_mesh_in_another_unit_is_asked_about(self):
        block = artifacts_of("block_with_hole")
        must("st-export", block / "mesh.hdf", "-o", self.folder / "m.stl", "--unit", "m")
        for mesh, is_odd in ((self.folder / "m.stl", True), (block / "mesh.hdf", False)):
            run = must("st-prolong", block / "raster.hdf", "-o", self.folder / "s.hdf", "--blank", mesh)
            self.assertEqual("is it in the model's unit?" in run.err, is_odd, run.err)

    def test_an_stl_blanks_like_the_mesh_it_was_exported_from(self):
        tube = artifacts_of("tube_with_rod")
        must("st-export", tube / "mesh.hdf", "-o", self.folder / "m.stl")
        triangles = (self.folder / "m.stl").read_bytes()[84:]
        text = ["solid tube"]
        for i in range(0, len(triangles), 50):
            xyz = struct.unpack("<12f", triangles[i : i + 48])
            text += ["facet normal 0 0 0", "outer loop",
                     *(f"vertex {xyz[k]!r} {xyz[k + 1]!r} {xyz[k + 2]!r}" for k in (3, 9, 6)), "endloop", "endfacet"]
        (self.folder / "ascii.stl").write_text("\n".join([*text, "endsolid tube"]))  # inside out
        said = {}
        for mesh in (tube / "mesh.hdf", self.folder / "m.stl", self.folder / "ascii.stl"):
            said[mesh] = must("st-prolong", tube / "raster.hdf", "-o", self.folder / "s.hdf", "--blank", mesh,
                              "--json").json()
            self.assertGreater(said[mesh]["blanked_cells"], 0)
        counts = [(s["blanked_cells"], s["cut_cells"]) for s in said.values()]
        self.assertEqual(counts[1], counts[2])
        self.assertLess(abs(counts[0][0] - counts[1][0]), 5)
        (self.folder / "bad.stl").write_text("solid x\nvertex 1 2 three\n")
        self.expect_error(INPUT, "st-prolong", tube / "raster.hdf", "-o", self.folder / "t.hdf", "--blank",
                          self.folder / "bad.stl", says="three")

    def test_an_open_mesh_is_refused_with_the_places_of_its_edges(self):
        (self.folder / "out").mkdir()
        plate = artifacts_of("plate_with_hole")
        self.expect_error(GEOMETRY, "st-prolong", plate / "raster.hdf", "-o", self.folder / "out/s.hdf", "--blank",
                          plate / "mesh.hdf",
                          says=["mesh.hdf", "open", "only one triangle, at ("])
        self.expect_error(INPUT, "st-prolong", plate / "raster.hdf", "-o", self.folder / "out/s.hdf", "--blank",
                          plate / "raster.hdf", says="raster.hdf")
        self.expect_nothing_left(self.folder / "out")


if __name__ == "__main__":
    unittest.main(verbosity=2)
