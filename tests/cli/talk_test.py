"""How the tools talk: progress on terminals and in logs, failures first, findings where they are asked for."""
import os
import pty
import re
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
from chain import BIN, INCOMPLETE, MODELS, Run, ToolTest, artifacts_of, must  # noqa: E402

REDRAWN = "\r\033[K"


def on_terminal(tool, *arguments):
    """What a tool writes to stderr when that is a terminal."""
    master, slave = pty.openpty()
    process = subprocess.Popen([str(BIN / tool), *map(str, arguments)], stdin=subprocess.DEVNULL,
                               stdout=subprocess.DEVNULL, stderr=slave)
    os.close(slave)
    text = b""
    while True:
        try:
            part = os.read(master, 65536)
        except OSError:  # its last writer is gone
            break
        if not part:
            break
        text += part
    os.close(master)
    if process.wait(timeout=120) != 0:
        raise AssertionError(text.decode())
    return text.decode()


class ProgressOnTerminals(ToolTest):
    def mesh(self, *options):
        made = artifacts_of("sphere")
        return on_terminal("st-mesh", made / "geometry.hdf", made / "sizing.hdf", "-o", self.folder / "p.hdf", *options)

    def test_the_line_is_redrawn_and_cleared_at_every_number_of_ranks(self):
        for options in ([], ["--np", 2]):
            said = self.mesh(*options)
            self.assertRegex(said, re.escape(REDRAWN) + r"joining: crossing facets \d+ %", options)
            self.assertTrue(said.rstrip("\r\n").endswith(REDRAWN.rstrip("\r\n")), (options, said))
            left = [line.split(REDRAWN)[-1] for line in said.replace("\r\n", "\n").split("\n")]
            self.assertEqual([line for line in left if "%" in line], [], "progress stays on the screen")

    def test_quiet_runs_show_none(self):
        for options in (["-q"], ["-q", "--np", 2]):
            self.assertEqual(self.mesh(*options), "", options)

    def test_every_stage_shows_its_steps(self):
        made = artifacts_of("sphere")
        for tool, arguments, label in (
                ("st-raster", [made / "geometry.hdf", "-o", self.folder / "r.hdf"], "joining: crossing facets"),
                ("st-prolong", [made / "raster.hdf", "-o", self.folder / "s.hdf"], "prolonging: blanking"),
                ("st-merge", [made / "patches.hdf", "-o", self.folder / "m.hdf"], "merging: nodes"),
                ("st-check", [made / "mesh.hdf", "--geometry", made / "geometry.hdf"], "checking: measuring"),
                ("st-import", [MODELS / "sphere.brep", "-o", self.folder / "g.hdf"], "importing: reading"),
                ("st-export", [made / "mesh.hdf", "-o", self.folder / "m.vtu"], "exporting: measuring"),
                ("st-report", [made / "mesh.hdf", "-o", self.folder / "r.html"], "writing the report: reading")):
            self.assertIn(REDRAWN + label, on_terminal(tool, *arguments))


class InLogs(ToolTest):
    def test_short_work_leaves_no_progress_and_verbose_tells_its_time(self):
        made = artifacts_of("sphere")
        arguments = [made / "geometry.hdf", made / "sizing.hdf", "-o", self.folder / "p.hdf"]
        self.assertNotIn("%", must("st-mesh", *arguments).err)
        self.assertRegex(must("st-mesh", *arguments, "-v").err, r"(?m)^  joining: \d+\.\d\d s$")


class Check(ToolTest):
    def test_failures_stand_first_and_the_verdict_last(self):
        made = artifacts_of("box")
        run = Run("st-check", made / "mesh.hdf", "--min-quality", 1)
        self.assertEqual(run.code, INCOMPLETE, run)
        lines = run.out.rstrip("\n").split("\n")
        self.assertRegex(lines[0], r"^  min-quality +FAILS \d+ triangles of quality below 1, first at \(")
        self.assertEqual([line for line in lines[1:-1] if "FAILS" in line], [])
        self.assertIn("FAILS", lines[-1])

    def test_it_says_six_figures_and_verbose_all_checks(self):
        made = artifacts_of("assembly")
        words = [made / "mesh.hdf", "--geometry", made / "geometry.hdf", "--sizing", made / "sizing.hdf"]
        brief, whole = (must("st-check", *words, *more).out.rstrip("\n").split("\n") for more in ([], ["-v"]))
        names = [line.split()[0] for line in brief[:-1]]
        self.assertEqual([n for n in names if n != "notes"], ["quality", "angles", "growth", "sizes", "deviation"])
        self.assertRegex(brief[4], r"deviation +\S+ mm off the CAD at most")
        self.assertRegex(brief[-1], r"mesh.hdf: passes; \d+ triangles, \d+ nodes")
        self.assertGreater(len(whole), 20)
        self.assertIn("folds", [line.split()[0] for line in whole])
        text = "\n".join(whole)
        self.assertRegex(text, r"(?m)^  volume +ok  \S+ mm\^3$")
        self.assertRegex(text, r"(?m)^  on-surface +ok  largest distance \S+ mm \(CAD tolerance there \S+ mm\)$")
        self.assertNotRegex(text, r"\bfree(?! \()")
        self.assertTrue(any(re.match("  group .* off the surface, mm", line) for line in whole), whole)

    def test_the_deviation_is_that_of_the_body(self):
        words = ["st-run", MODELS / "sphere.brep", "--farfield", "sphere:3", "-o", self.folder / "mesh.hdf"]
        said, brief = must(*words, "--json").json()["stages"]["st-check"], must(*words).out
        farthest = float(re.search(r"(?m)^  deviation +(\S+) off the CAD at most in face 1$", brief).group(1))
        self.assertLess(farthest, 0.5 * said["deviation"]["max"], "the far field's is larger")

    def test_groups_have_a_line_each(self):
        made = artifacts_of("assembly")
        groups = must("st-check", made / "mesh.hdf", "--json").json()["groups"]
        out = must("st-check", made / "mesh.hdf", "--geometry", made / "geometry.hdf", "-v").out
        self.assertRegex(out, r"(?m)^  group +triangles +mean quality")
        for group in groups:
            self.assertRegex(out, rf"(?m)^  {re.escape(group['name'])} +{group['quality']['triangles']} ")


class ImportCheck(ToolTest):
    def test_it_lists_its_findings_without_being_verbose(self):
        run = must("st-import", MODELS / "plate_with_hole.brep", "--check")
        self.assertEqual(len(re.findall(r"(?m)^  free edge: edge \d+.* at \(", run.err)), 5, run)
        silent = must("st-import", MODELS / "plate_with_hole.brep", "--check", "-q")
        self.assertEqual(silent.err, "")
        other = must("st-import", MODELS / "plate_with_hole.brep", "-o", self.folder / "g.hdf")
        self.assertNotIn("  free edge", other.err)


class Groups(ToolTest):
    def test_a_groups_file_says_what_it_matched(self):
        (self.folder / "groups.toml").write_text('[[group]]\nname = "top"\nfaces = ["2-3"]\nrole = "inlet"\n')
        run = must("st-import", MODELS / "box.step", "--groups", "groups.toml", cwd=self.folder)
        self.assertRegex(run.err, r"(?m)^  groups.toml: .*\btop 2 faces \(inlet\)")


class GmshFiles(ToolTest):
    def test_a_mesh_for_gmsh_says_which_file_gmsh_fills(self):
        mesh = artifacts_of("box") / "mesh.hdf"
        self.assertIn("; gmsh -3 takes a.geo, ", must("st-export", mesh, "-o", "a.msh", cwd=self.folder).out)
        again = must("st-export", mesh, "-o", "a.geo", cwd=self.folder).out  # replaces a.msh, which is ST's own
        self.assertNotIn("gmsh -3", again)
        (self.folder / "b.msh").write_text("somebody else's")
        self.assertNotEqual(Run("st-export", mesh, "-o", "b.geo", cwd=self.folder).code, 0)


class Misspelt(ToolTest):
    def test_names_of_groups_parts_presets_and_suffixes_are_guessed(self):
        made = artifacts_of("assembly")
        geometry, raster = made / "geometry.hdf", made / "raster.hdf"
        (self.folder / "sizes.toml").write_text('[[size]]\ngroups = "pin_mantel"\nlmax = 1\n')
        (self.folder / "groups.toml").write_text('[[group]]\nname = "x"\ngroups = "pin_mantel"\n')
        for meant, tool, *arguments in (
                ("pin_mantle", "st-raster", geometry, "--sizes", "sizes.toml"),
                ("pin_mantle", "st-prolong", raster, "--slope-of", "pin_mantel=0.1"),
                ("pin_mantle", "st-mesh", geometry, made / "sizing.hdf", "--group", "pin_mantel"),
                ("pin_mantle", "st-import", MODELS / "assembly.step", "--groups", "groups.toml"),
                ("preview", "st-raster", geometry, "--preset", "prevew"),
                (".vtu", "st-export", made / "mesh.hdf", "-o", "mesh.vtx")):
            run = Run(tool, *arguments, cwd=self.folder)
            self.assertNotEqual(run.code, 0, run)
            self.assertIn(f", did you mean '{meant}'", run.err)


class Sizes(ToolTest):
    def range_of(self, tool, *arguments):
        low, high = re.search(r", lengths (\S+) to (\S+)(?: mm)? on the faces", must(tool, *arguments).out).groups()
        return float(low), float(high)

    def test_ranges_of_raster_and_sizing_mean_the_lengths_on_the_faces(self):
        made = artifacts_of("sphere")
        raster = self.range_of("st-raster", made / "geometry.hdf", "-o", self.folder / "r.hdf")
        sizing = self.range_of("st-prolong", self.folder / "r.hdf", "-o", self.folder / "s.hdf")
        for low, high in (raster, sizing):
            self.assertLessEqual(low, high)
        self.assertAlmostEqual(raster[0], sizing[0], delta=0.02 * raster[0])
        doubled = self.range_of("st-prolong", self.folder / "r.hdf", "-o", self.folder / "s.hdf", "--scale", 2)
        self.assertAlmostEqual(doubled[0], 2 * sizing[0], delta=1e-3 * doubled[0])
        self.assertAlmostEqual(doubled[1], 2 * sizing[1], delta=1e-3 * doubled[1])

    def test_lengths_of_an_artifact_have_their_unit(self):
        made = artifacts_of("assembly")
        for name in ("raster.hdf", "sizing.hdf"):
            said = must("st-info", made / name).out
            for what in ("diagonal", "min_length", "max_length"):
                self.assertRegex(said, rf"(?m)^  {what} +[\d.e-]+ mm$")
            self.assertRegex(said, r"(?m)^  alpha_deg +\d+$")

    def test_one_group_has_its_name_in_the_table_and_in_questions(self):
        made = artifacts_of("sphere")
        err = must("st-prolong", made / "raster.hdf", "-o", self.folder / "s.hdf").err
        name = err.split("\n")[1].split()[0]
        must("st-info", self.folder / "s.hdf", "--why", name, "--raster", made / "raster.hdf")

    def test_settings_without_effect_are_said(self):
        made = artifacts_of("sphere")
        prolong = [made / "raster.hdf", "-o", self.folder / "s.hdf"]
        self.assertIn("warning: --transform has no effect", must("st-prolong", *prolong, "--transform", "scale 2").err)
        self.assertIn("warning: --blank-side has no effect", must("st-prolong", *prolong, "--blank-side", "inside").err)
        raster = [made / "geometry.hdf", "-o", self.folder / "r.hdf"]
        self.assertIn("without effect are --base-cells", must("st-raster", *raster, "--base-cells", 3).err)
        self.assertNotIn("effect", must("st-raster", *raster).err)


if __name__ == "__main__":
    unittest.main()
