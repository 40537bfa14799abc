"""The command lines of the tools: help, versions, options, option files, summaries."""
import re
import shlex
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
from chain import BIN, INPUT, MODELS, OUTPUT, TOOLS, USAGE, Run, ToolTest, artifacts_of, must  # noqa: E402

N_INPUTS = {"st-import": 1, "st-edit": 1, "st-raster": 1, "st-prolong": 1, "st-mesh": 2, "st-remesh": 3, "st-merge": 1,
            "st-check": 1, "st-info": 1, "st-diff": 2, "st-export": 1, "st-report": 1, "st-metric": 1,
            "st-run": 1}
OUTPUTS = {"st-export": ["-o", "out.stl"], "st-metric": ["-o", "out.solb"]}  # that have no default
# Options of all tools, which the pages describe in words.
COMMON = {"--help", "--help-all", "--version", "--options", "--print-options", "--print-inputs", "--quiet",
          "--verbose", "--json", "--wall-limit", "--replace-own"}
HELP_COLUMN = 34  # where the texts of --help start
# Values that each option with a bounded value refuses.
REFUSED = {
    "st-import": {"--threads": ["0", "x"], "--unit": ["parsec", ""], "--small": ["0", "-1%", "x"],
                  "--sew": ["0", "-1%", "x"], "--smooth": ["0", "-1%", "x"],
                  "--symmetry": ["y", "w=0", "y=x"], "--mirror": ["y", "w=0", "y=x"],
                  "--farfield": ["box", "ball:20", "box:0.5"],
                  "--time-limit": ["0", "-1", "x"], "--feature-angle": ["0", "181", "x"]},
    "st-edit": {"--transform": ["shear 2", "rotate 1 2 3", "hinge 0 0 0 0 0 0 5", "mirror 1 2", "scale 0",
                                "translate 1 2 3 at 0 0 0"], "--of": ["wing"]},
    "st-raster": {
        "--lmin": ["0", "-3", "x", "3pt", "nan"],
        "--lmax": ["0", "1e999"],
        "--alpha": ["0", "90.5", "-1", "nan", "x"],
        "--cell-per-length": ["0.99", "8.1"],
        "--chord": ["0", "x"],
        "--gap-cells": ["0", "101", "1.5"],
        "--wall-cells": ["0", "101", "1.5"],
        "--base-cells": ["0", "101", "1.5"],
        "--chord-cells": ["0", "1001", "1.5"],
        "--edge-size": ["0", "-1", "3pt", "nothing"],
        "--edge-cells": ["0", "101", "1.5"],
        "--max-cells": ["0", "x", "1.5"],
        "--time-limit": ["0", "x"],
        "--max-aspect": ["0.9", "101", "x"],
        "--trailing-edges": ["0.1:", ":1", "1:0.1", "x", "1:2:3", "1pt"],
        "--leading-edges": ["0.1:", ":1", "1:0.1", "x", "1:2:3", "1pt"],
        "--preset": ["ranz"],
        "--np": ["0", "-2", "x"],
        "--threads": ["0", "-1", "1.5", "4097"],
    },
    "st-prolong": {"--threads": ["0", "x"],
                   "--slope": ["0", "1e-300", "2.1", "x"], "--scale": ["0", "-1"], "--family": ["1", "4.1", "x"],
                   "--max-triangles": ["3", "x"],
                   "--target-triangles": ["3", "x"], "--transform": ["shear 2", "rotate 1 2 3"],
                   "--blank-side": ["top"], "--slope-of": ["WING", "=0.1", "WING=1e-9", "WING=2.1", "WING=x"]},
    "st-metric": {"--nodes": ["3", "x"], "--norm": ["0.9", "101"], "--max-aspect": ["0.9", "1001"],
                  "--lmin": ["0", "-1"], "--lmax": ["0", "x"], "--threads": ["0"]},
    "st-mesh": {"--enhance-rounds": ["-1", "11", "1.5"], "--merge-below": ["-0.1", "0.3"], "--max-turning": ["0", "61"],
                "--tile": ["-1", "999", "1e10"], "--np": ["0"], "--threads": ["0", "x"],
                "--time-limit": ["0", "x"], "--journal-after": ["-1", "x"]},
    "st-remesh": {"--too-long": ["1", "x"], "--too-short": ["0", "1"], "--np": ["0"], "--threads": ["0"],
                  "--journal-after": ["-1", "x"]},
    "st-merge": {"--threads": ["0", "x"]},
    "st-check": {
        "--threads": ["0", "x"], "--np": ["0"],
        "--area-tolerance": ["0", "1.1"],
        "--max-folds": ["-1", "1.5"],
        "--max-crossings": ["-1", "x"],
        "--min-quality": ["-0.1", "1.1", "x"],
        "--min-mean-quality": ["-0.1", "1.1"],
        "--min-p1-quality": ["-0.1", "1.1"],
        "--min-angle": ["0", "61"],
        "--max-jump": ["0.9"],
        "--min-size-share": ["-0.1", "1.1"],
        "--max-deviation": ["0", "-1", "x"],
        "--max-normal-deviation": ["0", "181"],
        "--list-below": ["0", "61", "x"],
        "--max-free-sharp": ["-1", "1.5"],
    },
    "st-run": {"--jobs": ["0", "1.5", "x"], "--np": ["0", "x"], "--threads": ["0", "x"], "--lmax": ["0", "x"],
               "--slope": ["0", "2.1"], "--preset": ["ranz"]},
    "st-diff": {"--tolerance": ["-1", "2", "x"]},
    "st-export": {"--tolerance": ["0", "-1%", "x"], "--feature-angle": ["0", "181", "x"], "--unit": ["parsec"]},
}
for tool_name in N_INPUTS:
    REFUSED.setdefault(tool_name, {})["--wall-limit"] = ["0", "-1", "x"]


def inputs(tool):
    return [f"input{i}" for i in range(N_INPUTS[tool])] + OUTPUTS.get(tool, [])


def options_in_help(tool):
    """Option -> (its head, such as "--alpha DEG:(0, 90]=10", its text)."""
    own = must(tool, "--help-all").out.partition("\nOptions of ")[0]  # of st-run: without those of the stages
    lines = own.split("\n")
    options = {}
    for line, following in zip(lines, lines[1:]):
        if line.startswith("  -"):
            head, text = (line, following) if following.startswith(" " * HELP_COLUMN) else (line[:HELP_COLUMN],
                                                                                            line[HELP_COLUMN:])
            options[re.search(r"--[\w-]+", head)[0]] = (re.sub(r" Excludes: \S+", "", head).strip(), text.strip())
    return options


def options_in_page(tool):
    """Option -> cells of its row in the table of options: name and type of the value, default, range."""
    page = Path(__file__).resolve().parents[2] / "docs" / f"{tool}.md"
    rows = [line.split("|") for line in page.read_text().split("\n") if line.startswith("| `-")]
    return {re.search(r"--[\w-]+", row[1])[0]: (row[1].strip(" `"), row[2].strip(), row[3].strip()) for row in rows}


class Help(ToolTest):
    def test_help_exits_0_and_shows_what_all_tools_have(self):
        for tool in TOOLS:
            run = must(tool, "--help")
            self.assertEqual(run.err, "")
            self.assertEqual(must(tool, "-h").out, run.out)
            self.assertLess(COMMON, set(options_in_help(tool)), tool)

    def test_help_shows_at_most_ten_options_and_says_how_many_more_there_are(self):
        for tool in TOOLS:
            first, whole = (re.findall(r"(?m)^  (-\S+)", must(tool, option).out) for option in ("--help", "--help-all"))
            self.assertLessEqual(set(first), set(whole), tool)
            shown = set(first) - {"-h,--help", "--help-all", "-o,--output"}
            self.assertLessEqual(len(shown), 10, tool)
            more = re.search(r"(?m)^(\d+) more options: " + tool + " --help-all$", must(tool, "--help").out)
            self.assertEqual(int(more[1]), len(whole) - len(first), tool)

    def test_page_of_a_tool_has_the_options_defaults_and_ranges_of_help(self):
        for tool in TOOLS:
            shown, documented = options_in_help(tool), options_in_page(tool)
            self.assertEqual(set(documented), set(shown) - COMMON, tool)
            for option, (name, default, interval) in documented.items():
                head, text = shown[option]
                said = re.search("; default: (.*)$", text)  # in words where no value of the option stands for it
                value = "" if said or not default else " REQUIRED" if default == "(required)" else "=" + default
                self.assertEqual(name + (":" + interval if interval else "") + value, head, tool)
                if said:
                    self.assertEqual(default, said[1], f"{tool} {option}")

    def test_every_range_in_help_is_tested_here(self):
        for tool in TOOLS:
            bounded = {option for option, (head, _) in options_in_help(tool).items() if re.search(r":[\[(].*,", head)}
            self.assertLessEqual(bounded, set(REFUSED.get(tool, {})), tool)

    def test_help_ends_with_examples_that_the_tool_takes_and_with_its_page(self):
        root = Path(__file__).resolve().parents[2]
        for tool in TOOLS:
            examples, _, page = must(tool, "--help").out.partition("Examples:\n")[2].partition("\n\n")
            self.assertTrue(examples, tool)
            for line in examples.split("\n"):
                name, *words = shlex.split(line)
                self.assertEqual(name, tool)
                must(tool, *words, "--print-inputs", cwd=self.folder)
            named, installed = re.fullmatch(r"More: (\S+), installed as (\S+)\s*", page).groups()
            self.assertTrue((root / named).is_file(), named)
            self.assertEqual(installed, f"/usr/share/doc/st/{named}")

    def test_version_names_the_tool(self):
        for tool in TOOLS:
            self.assertRegex(must(tool, "--version").out, rf"^{tool} \d+\.\d+\.\d+\n$")

    def loaded(self, tool):
        libraries = subprocess.run(["ldd", BIN / tool], capture_output=True, text=True, check=True).stdout
        self.assertIn("libc.so", libraries)
        return libraries

    def test_tools_load_no_libraries_of_cad_that_they_do_not_use(self):
        for tool in ("st-prolong", "st-merge", "st-info", "st-diff", "st-metric"):
            self.assertNotIn("libTK", self.loaded(tool), tool)
        for part in ("libTKMesh", "libTKTopAlgo"):  # half of the time that a tool takes to start
            self.assertIn(part, self.loaded("st-raster"))
            for tool in ("st-mesh", "st-check"):
                self.assertNotIn(part, self.loaded(tool), tool)

    def test_help_of_a_parallel_run_is_printed_once(self):
        environment_of_mpirun = ["mpirun", "--allow-run-as-root", "--oversubscribe", "-np", "2", str(BIN / "st-mesh"),
                                 "--version"]
        done = subprocess.run(environment_of_mpirun, capture_output=True, text=True, timeout=60)
        self.assertEqual((done.returncode, done.stdout.count("st-mesh")), (0, 1), done)


class Usage(ToolTest):
    def test_missing_argument_is_2(self):
        for tool in TOOLS:
            self.expect_error(USAGE, tool, says=["required", f"{tool} --help"])
            for n in range(1, N_INPUTS[tool]):
                self.expect_error(USAGE, tool, *["x"] * n, says="required")

    def test_missing_output_is_2_where_there_is_no_default(self):
        self.expect_error(USAGE, "st-export", "mesh.hdf", says="--output")

    def test_surplus_argument_is_2(self):
        for tool in set(TOOLS) - {"st-merge", "st-edit", "st-metric", "st-run"}:
            self.expect_error(USAGE, tool, *inputs(tool), "surplus", says="'surplus'", cwd=self.folder)

    def test_unknown_option_is_2(self):
        for tool in TOOLS:
            self.expect_error(USAGE, tool, *inputs(tool), "--no-such-option", says="--no-such-option", cwd=self.folder)

    def test_misspelt_option_names_the_one_that_was_meant(self):
        for tool, wrong, meant in (("st-raster", "--lmn", "--lmin"), ("st-check", "--max_folds", "--max-folds"),
                                   ("st-mesh", "--enhance-round=2", "--enhance-rounds"),
                                   ("st-run", "--lmx", "--lmax"), ("st-import", "--verbos", "--verbose")):
            self.expect_error(USAGE, tool, *inputs(tool), wrong, says=[wrong, f"did you mean '{meant}'"],
                              cwd=self.folder)
        run = Run("st-raster", "g.hdf", "--quite-another")
        self.assertNotIn("did you mean", run.err)

    def test_empty_name_of_a_file_is_2_wherever_one_is_meant(self):
        for tool in TOOLS:
            self.expect_error(USAGE, tool, *[""] * N_INPUTS[tool], *OUTPUTS.get(tool, []), says="is an empty name",
                              cwd=self.folder)
        for tool, option in (("st-raster", "--sizes"), ("st-prolong", "--sources"), ("st-prolong", "--background"),
                             ("st-check", "--geometry"), ("st-check", "--report"), ("st-mesh", "--options"),
                             ("st-run", "--keep"), ("st-run", "--report"), ("st-run", "--groups")):
            self.expect_error(USAGE, tool, *inputs(tool), option, "", says=f"{option}: is an empty name",
                              cwd=self.folder)
        self.expect_nothing_left(self.folder)

    def test_missing_input_is_named(self):
        self.expect_error(USAGE, "st-diff", "a.hdf", says="the input 'b' is required; see st-diff --help")

    def test_output_with_the_name_of_a_cad_file_is_6_and_the_file_stays(self):
        (self.folder / "wing.STP").write_text("mine")
        run = self.expect_error(OUTPUT, "st-run", MODELS / "box.step", "-o", "wing.STP", cwd=self.folder,
                                says="wing.STP: is the name of a CAD file")
        self.assertEqual((self.folder / "wing.STP").read_text(), "mine", run)

    def test_option_that_is_given_twice_is_2_and_said_so(self):
        for tool, option in (("st-raster", ["--lmax", "1%"]), ("st-mesh", ["--threads", "2"]),
                             ("st-import", ["-o", "a.hdf"]), ("st-run", ["--slope", "0.1"])):
            self.expect_error(USAGE, tool, *inputs(tool), *option, *option, says="is given more than once",
                              cwd=self.folder)

    def test_abbreviated_option_is_2(self):
        self.expect_error(USAGE, "st-raster", "g.hdf", "--alph", "5", says="--alph")
        self.expect_error(USAGE, "st-merge", "p.hdf", "--allow", says="--allow")

    def test_value_out_of_range_is_2_and_nothing_is_written(self):
        for tool, options in REFUSED.items():
            for option, values in options.items():
                for value in values:
                    self.expect_error(USAGE, tool, *inputs(tool), option, value, says=option, cwd=self.folder)
        self.expect_nothing_left(self.folder)

    def test_quiet_and_verbose_exclude_each_other(self):
        self.expect_error(USAGE, "st-info", "x", "-q", "-v", says="--verbose")

    def test_output_over_an_input_is_2_and_the_input_stays(self):
        (self.folder / "a.hdf").write_text("precious")
        for tool in ("st-edit", "st-raster", "st-prolong", "st-merge", "st-export", "st-import"):
            self.expect_error(USAGE, tool, "a.hdf", "-o", "./a.hdf", says="overwritten", cwd=self.folder)
        self.expect_error(USAGE, "st-mesh", "g.hdf", "a.hdf", "-o", self.folder / "a.hdf", says="overwritten",
                          cwd=self.folder)
        self.assertEqual((self.folder / "a.hdf").read_text(), "precious")

    def test_two_outputs_of_one_name_are_2(self):
        self.expect_error(USAGE, "st-merge", "p.hdf", "--export", "a.stl", "--export", "./a.stl", says="twice",
                          cwd=self.folder)

    def test_usage_error_with_json_is_an_object(self):
        run = self.expect_error(USAGE, "st-mesh", "--json", says="required")
        self.assertEqual((run.json()["exit_code"], run.json()["tool"]), (2, "st-mesh"))

    def test_error_of_a_parallel_run_is_printed_once(self):
        for arguments, code in ((["missing.hdf", "--np", 3], INPUT), (["g.hdf", "--alpha", "x", "--np", 3], USAGE)):
            self.expect_error(code, "st-raster", *arguments, cwd=self.folder)


class OptionFile(ToolTest):
    """st-raster on a missing file: 3 means that the options were taken, 2 that they were not."""

    def raster(self, text, code, says=(), arguments=()):
        (self.folder / "o.toml").write_text(text)
        return self.expect_error(code, "st-raster", "missing.hdf", "--options", "o.toml", *arguments, says=says,
                                 cwd=self.folder)

    def test_known_options_are_taken(self):
        self.raster('lmin = "0.25mm"\nlmax = 3\nalpha = 7.5\n', INPUT)

    def test_empty_file_and_template_change_nothing(self):
        self.raster("", INPUT)
        for tool in TOOLS:
            (self.folder / "t.toml").write_text(must(tool, "--print-options").out)
            run = Run(tool, *[f"missing{i}" for i in range(N_INPUTS[tool])],
                      *OUTPUTS.get(tool, []), "--options", "t.toml", cwd=self.folder)
            self.assertEqual(run.code, INPUT, run)

    def test_template_names_every_option_of_the_stage(self):
        text = must("st-raster", "--print-options").out
        for line in ("# lmin = ", "# lmax = ", "# alpha = 10", "# cell-per-length = 4"):
            self.assertIn(line, text)

    def test_unknown_key_is_2_with_file_and_line(self):
        self.raster("alpha = 5\nalpa = 5\n", USAGE, says=["o.toml:2", "'alpa'", "did you mean 'alpha'"])

    def test_bad_toml_is_2_with_file_and_line(self):
        self.raster("alpha = 5\nlmin = \n", USAGE, says="o.toml:2")
        self.raster("alpha = 5\nalpha = 6\n", USAGE, says="o.toml:2")

    def test_bad_value_is_2_with_file_and_line(self):
        for value in ('"x"', "91", "true", "[1, 2]", "1979-05-27", "{ a = 1 }"):
            self.raster(f"\nalpha = {value}\n", USAGE, says="o.toml:2")

    def test_slips_of_values_are_said_in_words(self):
        for value in ("2%", "5mm", "0.3%chord  # of the wing"):
            self.raster(f"\nlmax = {value}\n", USAGE, says=["o.toml:2", "stands in quotes"])
        self.raster("\nmax-cells = 2.5\n", USAGE, says=["o.toml:2", "a whole number is needed"])
        self.raster("\nlmax = [1, 2]\n", USAGE, says=["o.toml:2", "is given more than once"])

    def test_option_of_a_stage_at_the_top_is_2_and_names_the_table(self):
        for text, table in (('lmax = "2%"', "[st-raster]"), ('preset = "rans"', "[st-raster], [st-prolong]"),
                            ("[st-run]\nslope = 0.1", "[st-prolong]")):
            (self.folder / "o.toml").write_text(text + "\n")
            self.expect_error(USAGE, "st-run", "missing.step", "--options", "o.toml", cwd=self.folder,
                              says=f"is an option of a stage; write it below {table}")

    def test_table_of_the_tool_overrides_the_top_and_others_are_passed_over(self):
        self.raster("alpha = 500\n[st-raster]\nalpha = 5\n[st-mesh]\nmax-turning = 10\n", INPUT)
        self.raster("alpha = 5\n[st-raster]\nalpha = 500\n", USAGE, says="o.toml:3")
        self.raster("[st-rasta]\nalpha = 5\n", USAGE, says="[st-rasta]")

    def test_command_line_wins(self):
        self.raster("alpha = 500\n", INPUT, arguments=["--alpha", "5"])
        self.raster("alpha = 5\n", USAGE, arguments=["--alpha", "500"])

    def test_options_help_and_version_are_no_keys(self):
        for key in ("options", "help", "help-all", "version", "print-options", "print-inputs"):
            self.raster(f'{key} = "x"\n', USAGE, says=f"'{key}'")

    def inputs_of(self, tool, text):
        (self.folder / "o.toml").write_text(text)
        return must(tool, "--options", "o.toml", "--print-inputs", cwd=self.folder).out.split("\n")[:-1]

    def test_print_inputs_lists_every_file_that_options_name(self):
        many = 'sources = ["s.toml", "t.bac"]\nsample = "p.csv"\n[st-prolong]\nbackground = "b.msh"\nblank = "m.hdf"\n'
        other = 'sizes = "a b.toml"\nnp = 3\n[st-prolong]\nsources = "no.toml"\n'
        array = 'sizes-on-nodes = "n:1.vtu:size"\nmade-for = "s.hdf"\n'
        self.assertEqual(self.inputs_of("st-import", 'unit = "m"\ngroups = "g.toml"\n'), ["g.toml"])
        self.assertEqual(self.inputs_of("st-raster", other), ["a b.toml"])
        self.assertEqual(self.inputs_of("st-prolong", many), ["s.toml", "t.bac", "b.msh", "m.hdf", "p.csv"])
        self.assertEqual(self.inputs_of("st-mesh", 'edges = "e.hdf"\n'), ["e.hdf"])
        self.assertEqual(self.inputs_of("st-remesh", array), ["n:1.vtu", "s.hdf"])
        for tool in TOOLS:
            self.assertEqual(self.inputs_of(tool, ""), [], tool)

    def test_print_inputs_of_a_bad_file_is_2(self):
        (self.folder / "o.toml").write_text("slop = 1\n")
        arguments = ["--options", "o.toml", "--print-inputs"]
        self.expect_error(USAGE, "st-prolong", *arguments, says="o.toml:1", cwd=self.folder)

    def test_tables_in_the_file_make_it_an_input_after_the_files_it_names(self):
        tables = {"st-import": "group", "st-raster": "size", "st-prolong": "source"}
        for tool, table in tables.items():
            for text in (f"[[{table}]]\n", f"[[{tool}.{table}]]\n"):
                self.assertEqual(self.inputs_of(tool, text), ["o.toml"])
            self.assertEqual(self.inputs_of("st-run", f"[[{table}]]\n"), ["o.toml"])
            for other in set(TOOLS) - {tool, "st-run"}:
                self.assertEqual(self.inputs_of(other, f"[[{table}]]\n"), [], other)
        self.assertEqual(self.inputs_of("st-prolong", 'sources = "s.toml"\n[[source]]\n'), ["s.toml", "o.toml"])

    def test_tables_and_a_single_file_of_them_exclude_each_other(self):
        self.raster('sizes = "s.toml"\n[[size]]\nlmax = 1\n', USAGE, says=["o.toml:2", "sizes"])

    def test_a_file_named_on_the_command_line_takes_the_place_of_tables(self):
        (self.folder / "o.toml").write_text("[[source]]\n")
        run = must("st-prolong", "--options", "o.toml", "--sources", "s.toml", "--print-inputs", cwd=self.folder)
        self.assertEqual(run.out, "s.toml\n")

    def test_missing_file_and_directory_are_2(self):
        self.expect_error(USAGE, "st-raster", "g.hdf", "--options", "none.toml", says="none.toml", cwd=self.folder)
        self.expect_error(USAGE, "st-raster", "g.hdf", "--options", self.folder, says="option file")

    def test_output_and_flags_may_stand_in_the_file(self):
        artifacts = artifacts_of("box")
        (self.folder / "o.toml").write_text('output = "m.hdf"\nexport = ["a.stl", "b.obj"]\njson = true\n')
        run = must("st-merge", artifacts / "patches.hdf", "--options", "o.toml", cwd=self.folder)
        self.expect_nothing_left(self.folder, "o.toml", "m.hdf", "a.stl", "b.obj")
        run.json()


class Summary(ToolTest):
    def stages(self):
        a = artifacts_of("box")
        return {
            "st-import": [MODELS / "box.step"],
            "st-edit": [a / "geometry.hdf", "--transform", "translate 1 0 0"],
            "st-raster": [a / "geometry.hdf"],
            "st-prolong": [a / "raster.hdf"],
            "st-mesh": [a / "geometry.hdf", a / "sizing.hdf"],
            "st-remesh": [a / "mesh.hdf", a / "geometry.hdf", a / "sizing.hdf"],
            "st-merge": [a / "patches.hdf"],
            "st-check": [a / "mesh.hdf"],
            "st-info": [a / "mesh.hdf"],
            "st-diff": [a / "mesh.hdf", a / "mesh.hdf"],
            "st-export": [a / "mesh.hdf", "-o", "mesh.stl"],
            "st-run": [MODELS / "box.step"],
        }

    def test_last_line_of_json_is_one_object(self):
        for tool, arguments in self.stages().items():
            run = must(tool, *arguments, "--json", cwd=self.folder)
            self.assertIsInstance(run.json(), dict, tool)

    def test_summary_is_one_line_on_stdout(self):
        for tool, arguments in self.stages().items():
            run = must(tool, *arguments, cwd=self.folder)
            self.assertGreaterEqual(run.out.count("\n"), 1, run)
            if tool not in ("st-info", "st-check", "st-diff", "st-run"):
                self.assertEqual(run.out.count("\n"), 1, run)
            if tool not in ("st-raster", "st-prolong", "st-run"):
                self.assertEqual(run.err, "", run)

    def test_stages_of_sizes_show_their_table_of_groups_on_stderr(self):
        for tool in ("st-raster", "st-prolong"):
            run = must(tool, *self.stages()[tool], cwd=self.folder)
            lines = run.err.splitlines()
            self.assertTrue(any(line.split()[0] == "group" and "least length" in line for line in lines), run)
            self.assertTrue(all(line.startswith("  ") for line in lines), run)

    def test_quiet_stage_says_nothing_and_quiet_report_still_reports(self):
        for tool, arguments in self.stages().items():
            run = must(tool, *arguments, "-q", cwd=self.folder)
            self.assertEqual(run.err, "", run)
            self.assertEqual(bool(run.out), tool in ("st-check", "st-info", "st-diff"), run)

    def test_stdout_that_takes_nothing_is_6(self):
        with open("/dev/full", "w") as full:
            done = subprocess.run([BIN / "st-info", artifacts_of("box") / "mesh.hdf"], stdout=full,
                                  stderr=subprocess.PIPE, text=True)
        self.assertEqual(done.returncode, OUTPUT, done)

    def test_hash_is_alone_on_one_line(self):
        self.assertRegex(must("st-info", artifacts_of("box") / "mesh.hdf", "--hash").out, r"^[0-9a-f]{32}\n$")

    def test_tools_run_from_any_folder_with_relative_and_default_names(self):
        shutil.copy(MODELS / "box.step", self.folder / "wing.step")
        must("st-import", "wing.step", cwd=self.folder)
        must("st-raster", "geometry.hdf", cwd=self.folder)
        must("st-prolong", "raster.hdf", cwd=self.folder)
        must("st-mesh", "geometry.hdf", "sizing.hdf", cwd=self.folder)
        must("st-merge", "patches.hdf", cwd=self.folder)
        must("st-check", "mesh.hdf", "--geometry", "geometry.hdf", "--sizing", "sizing.hdf", cwd=self.folder)
        self.expect_nothing_left(self.folder, "wing.step", "geometry.hdf", "raster.hdf", "sizing.hdf", "patches.hdf",
                                 "mesh.hdf")


if __name__ == "__main__":
    unittest.main(verbosity=2)
