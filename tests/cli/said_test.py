"""What would be wrong with exit 0 is said or refused: inputs from somewhere else, names that nothing has, bodies that
are there twice, long steps."""
import os
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
from chain import BIN, GEOMETRY, MISMATCH, MODELS, USAGE, Run, ToolTest, artifacts_of, must  # noqa: E402

POINT = '[[source]]\nname = "{}"\ntype = "point"\nat = {}\nlength = {}\n'


def run_fast(tool, *arguments, seconds=0.001):
    """A run whose steps are said after so much time instead of 10 s."""
    environment = {**os.environ, "ST_PROGRESS_SECONDS": str(seconds)}
    return subprocess.run([str(BIN / tool), *map(str, arguments)], capture_output=True, text=True, timeout=300,
                          env=environment)


class Sources(ToolTest):
    """The box of the tests is 60 x 40 x 20."""

    def prolong(self, text, *options, name="s.toml"):
        (self.folder / name).write_text(text)
        return Run("st-prolong", artifacts_of("box.step") / "raster.hdf", "-o", self.folder / "s.hdf", "--sources",
                   self.folder / name, *options)

    def test_outside_the_octree_are_named(self):
        run = self.prolong(POINT.format("near", [5, 5, 5], 1) + POINT.format("wake", [64, 20, 10], 1) +
                           POINT.format("lost", [9000, 20, 10], 1))
        self.assertEqual(run.code, 0, run)
        self.assertRegex(run.err,
                         r'warning: source 2 "wake" lies \S+ mm outside the octree.*only its growth reaches in')
        self.assertRegex(run.err, r'warning: source 3 "lost" lies \S+ mm outside the octree.*it has no effect')
        self.assertNotIn("near", run.err)
        self.assertNotIn("warning", self.prolong(POINT.format("lost", [9000, 20, 10], 1), "--transform",
                                                 "translate -8990 0 0").err)

    def test_that_reach_in_by_radius_or_extent_are_not_named(self):
        reach = POINT.format("big", [100, 20, 10], 1) + "radius = 60\n"
        ball = '[[source]]\ntype = "sphere"\nat = [100, 20, 10]\nextent = 60\nlength = 1\n'
        self.assertNotIn("warning", self.prolong(reach + ball).err)

    def test_of_flite_without_length_are_points_and_said(self):
        at = "0.0 0.0 0.0 1.0 0.5 2.0"
        run = self.prolong(f"title\n0 0 0 1 0\npoints\nlines\nwake\n{at}\n{at}\n", name="s.bac")
        self.assertEqual(run.code, 0, run)
        self.assertIn('source 1 "wake": a line without length; it is taken as a point', run.err)

    def test_with_faults_are_usage_errors_like_rules_and_groups(self):
        for text in ("[[source]]\nlength = 1\n", POINT.format("a", [1, 2], 1), POINT.format("a", [1, 2, 3], 0),
                     "[[source]\n", '[[source]]\nname = "wkae"\ndelete = true\n',
                     '[[source]]\ntype = "line"\npoints = [[1, 1, 1], [1, 1, 1]]\nlength = 1\n'):
            self.assertEqual(self.prolong(text).code, USAGE, text)


class Blank(ToolTest):
    def test_a_mesh_from_somewhere_else_is_asked_about(self):
        box, block, sphere = (artifacts_of(name) for name in ("box.step", "block_with_hole", "sphere"))
        meshes = {box / "mesh.hdf": "", sphere / "mesh.hdf": "near the model's faces", self.folder / "cm.stl": "unit?"}
        for name, steps in (("moved", "translate 20 10 5"), ("large", "scale 3")):
            there, mesh = self.folder / "there.hdf", self.folder / f"{name}.hdf"
            must("st-edit", box / "geometry.hdf", "-o", there, "--transform", steps)
            must("st-prolong", box / "raster.hdf", "-o", self.folder / "s.hdf", "--geometry", there)
            must("st-mesh", there, self.folder / "s.hdf", "-o", self.folder / "p.hdf")
            must("st-merge", self.folder / "p.hdf", "-o", mesh)
            meshes[mesh] = "near the model's faces"
        must("st-export", box / "mesh.hdf", "-o", self.folder / "cm.stl", "--unit", "cm")
        for mesh, says in meshes.items():
            run = must("st-prolong", box / "raster.hdf", "-o", self.folder / "b.hdf", "--blank", mesh)
            self.assertEqual("warning" in run.err, says != "", run)
            self.assertIn(says, run.err)
        self.assertNotIn("near", must("st-prolong", block / "raster.hdf", "-o", self.folder / "b.hdf", "--blank",
                                      block / "mesh.hdf").err)


class Units(ToolTest):
    def test_a_length_with_a_unit_is_refused_before_the_work_where_the_model_has_none(self):
        cylinder = artifacts_of("cylinder")  # BREP: no unit
        (self.folder / "r.toml").write_text('[[size]]\nlmax = "4mm"\n')
        (self.folder / "g.toml").write_text('[[group]]\nname = "a"\nfaces = 1\ntolerance = "4mm"\n')
        (self.folder / "b.toml").write_text(
            '[[group]]\nname = "a"\ninside = ["-30mm", -99, -99, 99, 99, 99]\n')
        model = MODELS / "cylinder.brep"
        for tool, *arguments in (
                ("st-raster", cylinder / "geometry.hdf", "--lmax", "4mm"),
                ("st-raster", cylinder / "geometry.hdf", "--edge-size", "4mm"),
                ("st-raster", cylinder / "geometry.hdf", "--sizes", self.folder / "r.toml"),
                ("st-import", model, "--small", "4mm"), ("st-import", model, "--sew", "4mm"),
                ("st-import", model, "--groups", self.folder / "g.toml"),
                ("st-import", model, "--groups", self.folder / "b.toml"),
                ("st-check", cylinder / "mesh.hdf", "--geometry", cylinder / "geometry.hdf", "--max-deviation", "4mm")):
            output = [] if tool == "st-check" else ["-o", self.folder / "o.hdf"]
            self.expect_error(USAGE, tool, *arguments, *output, says="unit")

    def test_a_rule_is_refused_before_anything_is_looked_for(self):
        geometry = artifacts_of("cylinder") / "geometry.hdf"
        for text, says in (('[[size]]\nlmax = "4mm"\n', "has a unit but the model has none"),
                           ('[[size]]\ngroups = "wnig"\nlmax = 1\n', "no group or part matches 'wnig'")):
            (self.folder / "r.toml").write_text(text)
            run = run_fast("st-raster", geometry, "-o", self.folder / "r.hdf", "--sizes", self.folder / "r.toml")
            self.assertEqual(run.returncode, USAGE)
            self.assertIn(says, run.stderr)
            self.assertNotIn("lifting surfaces", run.stderr)
        self.assertIn("lifting surfaces", run_fast("st-raster", geometry, "-o", self.folder / "r.hdf").stderr)

    def test_a_unit_that_makes_a_giant_is_warned_of(self):
        box = MODELS / "box.brep"  # 60 x 40 x 20, no unit
        run = must("st-import", box, "-o", self.folder / "g.hdf", "--unit", "m")
        self.assertIn("the file names no unit, so --unit takes its numbers as m: the model is 60 m long", run.err)
        self.assertNotIn("warning", run.err)
        run = must("st-import", box, "-o", self.folder / "g.hdf", "--unit", "km")
        self.assertRegex(run.err, "warning: .*takes its numbers as km: the model is 6e\\+04 m long; give the unit")
        self.assertNotIn("long", must("st-import", MODELS / "box.step", "-o", self.folder / "g.hdf", "--unit", "m").err)


class Names(ToolTest):
    def test_a_name_that_nothing_has_is_refused_with_the_one_that_was_meant(self):
        made = artifacts_of("wing_with_flap")
        (self.folder / "r.toml").write_text('[[size]]\ngroups = "wnig"\nlmax = 1\n')
        (self.folder / "e.toml").write_text('[[group]]\nof = "edges"\nname = "x"\non = "wnig"\n')
        geometry = made / "geometry.hdf"
        for tool, *arguments in (
                ("st-raster", geometry, "--sizes", self.folder / "r.toml"),
                ("st-mesh", geometry, made / "sizing.hdf", "--group", "wnig"),
                ("st-mesh", geometry, made / "sizing.hdf", "--group", "wnig*"),
                ("st-prolong", made / "raster.hdf", "--slope-of", "wnig=0.1"),
                ("st-remesh", made / "mesh.hdf", geometry, made / "sizing.hdf", "--keep", "wnig"),
                ("st-edit", geometry, "--extract", "wnig"), ("st-edit", geometry, geometry, "--join", "wnig"),
                ("st-import", MODELS / "wing_with_flap.step", "--groups", self.folder / "e.toml")):
            self.expect_error(USAGE, tool, *arguments, "-o", self.folder / "o.hdf", says="did you mean 'wing'")

    def test_a_group_that_only_one_input_has_joins_nothing(self):
        geometry = artifacts_of("wing_with_flap") / "geometry.hdf"
        run = must("st-edit", geometry, artifacts_of("box.step") / "geometry.hdf", "-o", self.folder / "o.hdf",
                   "--join", "wing")
        self.assertIn("warning: --join 'wing': only one input has such a group; nothing is joined", run.err)

    def test_keys_intersect_and_lists_unite_in_rules_as_in_groups(self):
        geometry = artifacts_of("wing_with_flap") / "geometry.hdf"
        both = 'groups = ["wing", "flap"]\nfaces = {}\n'
        (self.folder / "none.toml").write_text("[[size]]\nlmax = 1\n" + 'groups = "flap"\nfaces = 1\n')
        self.expect_error(USAGE, "st-raster", geometry, "-o", self.folder / "o.hdf", "--sizes",
                          self.folder / "none.toml", says="no face meets all keys of its selection")
        hashes = []
        for number, text in enumerate((both.format(1), "faces = 1\n", both.format('"1-2"'), "faces = [1, 2]\n")):
            (self.folder / "r.toml").write_text("[[size]]\nlmax = 0.3\n" + text)
            must("st-raster", geometry, "-o", self.folder / f"{number}.hdf", "--sizes", self.folder / "r.toml", "-q")
            must("st-prolong", self.folder / f"{number}.hdf", "-o", self.folder / "s.hdf", "-q")
            hashes.append(must("st-prolong", self.folder / f"{number}.hdf", "-o", self.folder / "s.hdf",
                               "--json").json()["expected_triangles"])
        self.assertEqual(hashes[0], hashes[1])
        self.assertEqual(hashes[2], hashes[3])
        self.assertNotEqual(hashes[0], hashes[2])

    def test_a_group_may_have_a_long_name(self):
        name = "a\u00e4" * 120
        (self.folder / "g.toml").write_text(f'[[group]]\nname = "{name}"\nfaces = 1\n[[group]]\nname = "{name}b"\n'
                                            "faces = 2\n", encoding="utf-8")
        model = MODELS / "box.step"
        must("st-import", model, "-o", self.folder / "g.hdf", "--groups", self.folder / "g.toml")
        must("st-raster", self.folder / "g.hdf", "-o", self.folder / "r.hdf")
        must("st-prolong", self.folder / "r.hdf", "-o", self.folder / "s.hdf")
        must("st-mesh", self.folder / "g.hdf", self.folder / "s.hdf", "-o", self.folder / "p.hdf")
        must("st-merge", self.folder / "p.hdf", "-o", self.folder / "m.hdf")
        for suffix in ("stl", "vtm", "vtu", "cgns", "msh", "su2", "ascii.stl"):
            must("st-export", self.folder / "m.hdf", "-o", self.folder / f"m.{suffix}")
        must("st-export", self.folder / "m.hdf", "-o", self.folder / "split.stl", "--split-groups")
        self.assertEqual(len(list(self.folder.glob("split_*.stl"))), 3)
        self.assertEqual(len(list((self.folder / "m").glob("*.vtu"))), 3)


class Parts(ToolTest):
    def test_a_body_that_is_there_twice_is_said_and_refused_on_request(self):
        box = artifacts_of("box") / "geometry.hdf"
        run = must("st-edit", box, box, "-o", self.folder / "o.hdf", "--as", "right,left", "--json")
        self.assertRegex(run.err, "warning: .*bodies that are there twice: that of face .* of left is at the place of "
                                  "that of face .* of right")
        self.assertEqual(len(run.json()["same_bodies"]), 1)
        self.assertEqual(len(run.json()["same_faces"]), 6)
        (self.folder / "o.hdf").unlink()
        self.expect_error(GEOMETRY, "st-edit", box, box, "-o", self.folder / "o.hdf", "--require-valid",
                          says="bodies that are there twice")
        self.assertFalse((self.folder / "o.hdf").exists())
        moved = must("st-edit", box, box, "-o", self.folder / "o.hdf", "--as", "a,b", "--of", "b", "--transform",
                     "translate 0 0 99", "--require-valid", "--json")
        self.assertEqual(moved.json()["same_faces"], [])

    def test_faces_on_each_other_are_said(self):
        box = artifacts_of("box") / "geometry.hdf"
        run = must("st-edit", box, box, "-o", self.folder / "o.hdf", "--as", "a,b", "--of", "b", "--transform",
                   "mirror 1 0 0", "--json")
        self.assertEqual((len(run.json()["same_faces"]), run.json()["same_bodies"]), (1, []))
        self.assertIn("faces lie on each other and would be meshed twice: face", run.err)

    def test_all_pairs_that_cross_are_named(self):
        run = must("st-import", MODELS / "concept.step", "-o", self.folder / "g.hdf")
        for pair in ({"body", "wing"}, {"body", "pylon"}, {"wing", "pylon"}):
            self.assertTrue(any(f"{a} and {b} at (" in run.err for a in pair for b in pair - {a}), (pair, run.err))

    def test_all_pairs_of_edited_parts_that_cross_are_named(self):
        box = artifacts_of("box") / "geometry.hdf"
        run = must("st-edit", box, box, box, "-o", self.folder / "o.hdf", "--as", "a,b,c", "--of", "b", "--transform",
                   "translate 30 15 5", "--of", "c", "--transform", "translate -30 15 5")
        for other in "bc":
            self.assertRegex(run.err, rf"face \d+[^;]* of a passes through face \d+[^;]* of {other} at \(")


class Before(ToolTest):
    def test_a_sizing_of_another_model_is_said_before_anything_is_read(self):
        """The B-Rep is damaged: who read it would end with another code."""
        box, sphere = artifacts_of("box"), artifacts_of("sphere")
        data = (box / "geometry.hdf").read_bytes()
        at = data.find(b"Open CASCADE")
        self.assertGreater(at, 0)
        damaged = self.folder / "g.hdf"
        damaged.write_bytes(data[:at] + b"XXXX" + data[at + 4:])
        self.expect_error(MISMATCH, "st-mesh", damaged, sphere / "sizing.hdf", "-o", self.folder / "p.hdf",
                          says="sizing.hdf")
        self.expect_error(MISMATCH, "st-remesh", box / "mesh.hdf", damaged, sphere / "sizing.hdf", "-o",
                          self.folder / "p.hdf", says="sizing.hdf")
        self.expect_error(MISMATCH, "st-check", sphere / "mesh.hdf", "--geometry", damaged, says="mesh.hdf")

    def test_messages_of_numbers_and_suffixes_are_clear(self):
        box = artifacts_of("box")
        self.expect_error(USAGE, "st-export", box / "mesh.hdf", "-o", ".stl", cwd=self.folder,
                          says=".stl: is a suffix without a name; write mesh.stl")
        outputs = ["-o", self.folder / "s.hdf"]
        plain = must("st-prolong", box / "raster.hdf", *outputs, "--target-triangles", 3000, "--json").json()
        self.assertEqual(must("st-prolong", box / "raster.hdf", *outputs, "--target-triangles", "3e3",
                              "--json").json()["scale"], plain["scale"])
        (self.folder / "o.toml").write_text("target-triangles = 3e3\n")
        must("st-prolong", box / "raster.hdf", *outputs, "--options", self.folder / "o.toml")
        self.expect_error(USAGE, "st-prolong", box / "raster.hdf", *outputs, "--target-triangles", "10.5",
                          says="a whole number is needed")
        run = self.expect_error(USAGE, "st-raster", box / "geometry.hdf", *outputs, "--max-cells", 1,
                                says="--max-cells")
        self.assertNotIn("e-0", run.err)


class LongSteps(ToolTest):
    def test_are_said_in_a_log_and_not_when_quiet(self):
        arguments = [MODELS / "concept.step", "-o", self.folder / "g.hdf", "--unite"]
        lines = run_fast("st-import", *arguments, seconds=0.002).stderr
        self.assertRegex(lines, r"(?m)^importing: \S.* \d+ %")
        self.assertRegex(lines, r"(?m)^uniting bodies \d+ %, 0 s so far$")
        self.assertNotIn("%", run_fast("st-import", *arguments, "-q", seconds=0.002).stderr)
        self.assertNotIn("so far", must("st-import", *arguments).err)


if __name__ == "__main__":
    unittest.main()
