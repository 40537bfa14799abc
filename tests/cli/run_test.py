"""st-run: one command from CAD to a checked mesh: the bits of the single tools, errors, what is left behind."""
import csv
import fcntl
import json
import os
import resource
import shutil
import signal
import subprocess
import sys
import time
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
from chain import BIN, INCOMPLETE, INPUT, MODELS, OK, OUTPUT, USAGE, Run, ToolTest  # noqa: E402
from chain import WORK, content_hash, make_chain, must  # noqa: E402

MEMORY = Path("/dev/shm")
ARTIFACTS = ("geometry", "raster", "sizing", "patches", "mesh")
STAGES = ["st-check", "st-import", "st-merge", "st-mesh", "st-prolong", "st-raster"]


def one_by_one():
    """What the single tools make of the box, once."""
    folder = WORK / f"one_by_one_{os.getpid()}"
    if not folder.exists():
        make_chain(MODELS / "box.step", folder)
        unittest.addModuleCleanup(shutil.rmtree, folder)
    return folder


def is_held(folder):
    """By a run that works on: each locks its folder."""
    try:
        handle = os.open(folder, os.O_RDONLY)
    except FileNotFoundError:
        return True  # it has just ended
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
        return False
    except BlockingIOError:
        return True
    finally:
        os.close(handle)


def folders_of_runs():
    """Those that nobody holds."""
    return {folder for folder in MEMORY.glob(".st-run.*") if not is_held(folder)}


class RunTest(ToolTest):
    def setUp(self):
        super().setUp()
        self.model = self.folder / "box.step"
        shutil.copy(MODELS / "box.step", self.model)
        self.before = folders_of_runs()

    def expect_only(self, *names):
        """Nothing else in the folder, and no folder of this run in memory."""
        self.expect_nothing_left(self.folder, "box.step", *names)
        self.assertEqual(folders_of_runs() - self.before, set())


class Start(unittest.TestCase):
    def test_only_tools_with_ranks_load_mpi(self):
        loaded = {}
        for tool in sorted(BIN.glob("st-*")):
            listed = subprocess.run([tool], env={**os.environ, "LD_TRACE_LOADED_OBJECTS": "1"}, capture_output=True,
                                    text=True, check=True).stdout
            self.assertIn("libc.so", listed)
            loaded[tool.name] = "libmpi" in listed
        self.assertEqual([name for name, has_mpi in loaded.items() if has_mpi],
                         ["st-check", "st-mesh", "st-raster", "st-remesh"])


class Meshes(RunTest):
    def test_the_mesh_is_that_of_the_single_tools(self):
        must("st-run", self.model, cwd=self.folder)
        self.assertEqual((self.folder / "mesh.hdf").read_bytes(), (one_by_one() / "mesh.hdf").read_bytes())
        self.expect_only("mesh.hdf")

    def test_options_of_stages_reach_them_as_in_the_single_tools(self):
        options = {"st-import": ["--unit", "m"], "st-raster": ["--lmax", "4%", "--preset", "preview"],
                   "st-prolong": ["--slope", "0.15", "--preset", "preview"], "st-mesh": ["--enhance-rounds", "2"]}
        at = self.folder / "single"
        at.mkdir()
        must("st-import", self.model, "-o", at / "geometry.hdf", *options["st-import"])
        must("st-raster", at / "geometry.hdf", "-o", at / "raster.hdf", *options["st-raster"])
        must("st-prolong", at / "raster.hdf", "-o", at / "sizing.hdf", *options["st-prolong"])
        must("st-mesh", at / "geometry.hdf", at / "sizing.hdf", "-o", at / "patches.hdf", *options["st-mesh"])
        must("st-merge", at / "patches.hdf", "-o", at / "mesh.hdf")
        words = [w for tool in ("st-import", "st-raster", "st-mesh") for w in options[tool]]
        must("st-run", "--keep", "kept", *words, "--slope=0.15", self.model, cwd=self.folder)
        for name in ARTIFACTS:
            self.assertEqual(content_hash(self.folder / "kept" / f"{name}.hdf"), content_hash(at / f"{name}.hdf"), name)

    def test_kept_options_give_the_same_in_st_run_and_in_each_tool(self):
        words = ["--lmax", "4%", "--preset", "preview", "--require-closed", "--max-folds", "3"]
        must("st-run", self.model, "--keep", "a", *words, cwd=self.folder)
        options = self.folder / "a" / "st-run.toml"
        text = options.read_text()
        for line in ('lmax = "4%"', 'preset = "preview"', "require-closed = true", "max-folds = 3"):
            self.assertEqual(text.count(line), 2 if "preset" in line else 1, text)
        must("st-run", self.model, "--keep", "b", "--options", options, cwd=self.folder)
        must("st-raster", "a/geometry.hdf", "--options", options, "-o", "c.hdf", cwd=self.folder)
        for a, b in (("a/mesh.hdf", "b/mesh.hdf"), ("a/raster.hdf", "c.hdf")):
            self.assertEqual(content_hash(self.folder / a), content_hash(self.folder / b))
        self.assertEqual((self.folder / "b" / "st-run.toml").read_text().split("[st-import]")[1],
                         text.split("[st-import]")[1])

    def test_an_option_file_has_a_table_for_each_stage_and_the_command_line_wins(self):
        (self.folder / "o.toml").write_text('output = "m.hdf"\nexport = ["m.stl"]\n[st-raster]\nlmax = "4%"\n'
                                            '[st-mesh]\nenhance-rounds = 1\n[st-run]\nreport = "m.html"\n')
        must("st-run", self.model, "--options", "o.toml", "--lmax", "5%", "--keep", "k", cwd=self.folder)
        self.expect_only("o.toml", "m.hdf", "m.stl", "m.html", "k")
        text = (self.folder / "k" / "st-run.toml").read_text()
        self.assertIn('lmax = "5%"', text)
        self.assertIn("enhance-rounds = 1", text)
        (self.folder / "o.toml").write_text("[st-raster]\nlmx = 3\n")
        self.expect_error(USAGE, "st-run", self.model, "--options", "o.toml", cwd=self.folder,
                          says=["o.toml:2", "lmx", "st-raster knows"])
        (self.folder / "o.toml").write_text("lmax = 3\n")
        self.expect_error(USAGE, "st-run", self.model, "--options", "o.toml", cwd=self.folder,
                          says=["o.toml:1", "lmax"])

    def test_a_name_that_several_stages_have_goes_to_all_of_them(self):
        must("st-run", self.model, "--allow-incomplete", "--keep", "k", cwd=self.folder)
        self.assertEqual((self.folder / "k" / "st-run.toml").read_text().count("allow-incomplete = true"), 3)

    def test_ranks_change_nothing(self):
        run = must("st-run", self.model, "--np", "2", "--lmax", "4%", "-o", "a.hdf", cwd=self.folder)
        for tool in ("st-raster", "st-mesh"):
            self.assertRegex(run.err, f"(?m)^{tool} +on 2 ranks, ")
        must("st-run", self.model, "--lmax", "4%", "-o", "b.hdf", cwd=self.folder)
        self.assertEqual((self.folder / "a.hdf").read_bytes(), (self.folder / "b.hdf").read_bytes())
        self.expect_only("a.hdf", "b.hdf")


class Workflow(RunTest):
    def make(self):
        makefile = Path(__file__).resolve().parents[2] / "Makefile.workflow"
        return subprocess.run(["make", "-f", makefile, f"TOOLS={BIN}", "MODEL=box.step", "OUT=k"], cwd=self.folder,
                              capture_output=True, text=True, timeout=120)

    def test_make_goes_on_from_what_is_kept(self):
        must("st-run", "box.step", "--lmax", "4%", "--keep", "k", cwd=self.folder)
        before = {name: (self.folder / "k" / f"{name}.hdf").stat().st_mtime_ns for name in ARTIFACTS}
        for change, ran in (("", ()), ("lmax = 5%", ("raster", "sizing", "patches", "mesh"))):
            if change:
                options = self.folder / "k" / "st-raster.toml"
                options.write_text(options.read_text().replace('lmax = "4%"', 'lmax = "5%"'))
            done = self.make()
            self.assertEqual(done.returncode, OK, done)
            after = {name: (self.folder / "k" / f"{name}.hdf").stat().st_mtime_ns for name in ARTIFACTS}
            self.assertEqual(tuple(name for name in ARTIFACTS if after[name] != before[name]), ran)
        self.expect_error(OUTPUT, "st-run", self.model, "--keep", "k", cwd=self.folder, says="results of make")

    def test_make_begins_anew_where_the_model_was_changed_since(self):
        must("st-run", "box.step", "--keep", "k", cwd=self.folder)
        before = (self.folder / "k" / "geometry.hdf").stat().st_mtime_ns
        self.model.touch()
        self.assertEqual(self.make().returncode, OK)
        self.assertNotEqual((self.folder / "k" / "geometry.hdf").stat().st_mtime_ns, before)


class Talk(RunTest):
    def test_one_line_for_each_stage_and_a_short_summary(self):
        run = must("st-run", self.model, "--report", "r.html", "--export", "m.vtu", cwd=self.folder)
        self.assertEqual([line.split()[0] for line in run.err.splitlines()],
                         ["st-import", "st-raster", "st-prolong", "st-mesh", "st-merge", "st-report"])
        self.assertLessEqual(run.out.count("\n"), 10)
        self.assertRegex(run.out, r"(?m)^mesh.hdf: passes; \d+ triangles")
        self.assertRegex(run.out, r"(?m)^  files +mesh.hdf, m.vtu, r.html$")
        self.assertNotIn(".st-run.", run.out + run.err)

    def test_json_has_what_each_tool_says(self):
        said = must("st-run", self.model, "--json", cwd=self.folder).json()
        self.assertEqual(list(said["stages"]), STAGES)
        self.assertTrue(said["passes"])
        self.assertEqual(said["triangles"], said["stages"]["st-merge"]["triangles"])
        self.assertEqual(said["stages"]["st-import"]["output"], "geometry.hdf")

    def test_a_warning_of_ranks_may_quote_an_error(self):
        for tool in ("st-run", "st-mesh"):
            shutil.copy(BIN / tool, self.folder)
        raster = self.folder / "st-raster"
        raster.write_text(f'#!/bin/sh\necho "st-raster: warning: a: error: b" >&2\nexec {BIN}/st-raster "$@"\n')
        raster.chmod(0o755)
        done = subprocess.run([self.folder / "st-run", self.model, "--np", "2"], cwd=self.folder, capture_output=True,
                              text=True, timeout=60)
        self.assertEqual(done.returncode, OK, done)
        self.assertIn("st-raster: warning: a: error: b\n", done.stderr)

    def test_quiet_says_nothing(self):
        run = must("st-run", self.model, "-q", cwd=self.folder)
        self.assertEqual(run.out + run.err, "")


class Errors(RunTest):
    def test_an_error_names_the_stage(self):
        (self.folder / "bad.step").write_text("no CAD")
        for words, code, says in ((["bad.step"], INPUT, "st-import: bad.step"),
                                  (["none.step"], INPUT, "st-import: none.step"),
                                  ([self.folder], INPUT, "st-import: "),
                                  ([self.model, "--max-triangles", "5"], USAGE, "st-prolong: "),
                                  ([self.model, "--max-cells", "5"], USAGE, "st-raster: ")):
            run = Run("st-run", *words, cwd=self.folder)
            self.assertEqual(run.code, code, run)
            self.assertIn(f"st-run: error: {says}", run.err.splitlines()[-1])
            self.assertNotIn(".st-run.", run.err)
            self.expect_only("bad.step")

    def test_ranks_of_a_launcher_are_refused(self):
        done = subprocess.run([BIN / "st-run", self.model], cwd=self.folder, capture_output=True, text=True, timeout=60,
                              env=os.environ | {"OMPI_COMM_WORLD_SIZE": "2"})
        self.assertEqual(done.returncode, USAGE, done)
        self.assertRegex(done.stderr, "^st-run: error: each of 2 ranks would do the whole run.* by --np\n$")
        self.expect_only()

    def test_what_cannot_be_written_is_found_before_the_work(self):
        for words in (["-o", "no/m.hdf"], ["--export", "no/m.stl"], ["--report", "no/r.html"], ["--keep", "box.step"],
                      ["--keep", "box.step/k"]):
            self.expect_error(OUTPUT, "st-run", self.model, *words, cwd=self.folder)
        self.expect_error(USAGE, "st-run", self.model, "--export", "m.xyz", cwd=self.folder, says="m.xyz")
        self.expect_error(USAGE, "st-run", self.model, "-o", self.model, cwd=self.folder, says="overwritten")
        self.expect_error(USAGE, "st-run", self.model, "--lmax", cwd=self.folder, says="--lmax")
        self.expect_error(USAGE, "st-run", self.model, "--unite=yes", cwd=self.folder, says="--unite")
        self.expect_only()

    def test_a_name_that_says_another_format_is_refused(self):
        for option, name, says in (("-o", "a.stl", "give it to --export"), ("-o", "a.CGNS", "give it to --export"),
                                   ("--report", "a.pdf", "name it .html"), ("--report", "a", "name it .html")):
            self.expect_error(USAGE, "st-run", self.model, option, name, says=says, cwd=self.folder)
        self.expect_error(USAGE, "st-merge", one_by_one() / "patches.hdf", "-o", "a.vtu", says="give it to --export")
        self.expect_only()

    def test_a_folder_is_for_one_run_at_a_time(self):
        command = [BIN / "st-run", self.model, "--lmax", "1%", "--keep", self.folder / "out", "-q"]
        with subprocess.Popen(command) as first:
            while first.poll() is None and not (self.folder / "out" / "geometry.hdf").exists():
                time.sleep(0.01)
            self.expect_error(OUTPUT, "st-run", self.model, "--keep", self.folder / "out", says="another run")
            self.expect_error(OUTPUT, "st-run", self.model, self.model, "--into", self.folder / "out",
                              says="another run")
        self.assertEqual(first.returncode, OK)
        must("st-run", self.model, "--keep", self.folder / "out", "-q")

    def test_a_file_whose_name_begins_with_a_dash_is_named(self):
        shutil.copy(self.model, self.folder / "-x.step")
        self.expect_error(USAGE, "st-run", "-x.step", says="write ./-x.step for the file", cwd=self.folder)
        must("st-run", "./-x.step", "-q", cwd=self.folder)

    def test_names_of_facets_may_be_latin_1(self):
        path = self.folder / "a.obj"
        path.write_bytes("o W\u00fcrfel\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\no b\nf 2 3 4\nf 1 4 3\n"
                         .encode("latin-1"))
        must("st-run", path, "--unit", "mm", "-q", cwd=self.folder)
        self.assertIn("W\u00fcrfel", Run("st-info", self.folder / "mesh.hdf", "--groups").out)

    def test_a_mesh_that_fails_is_5_and_stays(self):
        run = Run("st-run", self.model, "--min-quality", "1", cwd=self.folder)
        self.assertEqual(run.code, INCOMPLETE, run)
        self.assertRegex(run.out, r"(?m)^mesh.hdf: FAILS: ")
        self.expect_only("mesh.hdf")

    def test_the_report_shows_what_the_run_asked_of_the_mesh(self):
        for words, code, verdict in ((["--min-angle", "60"], INCOMPLETE, "does not pass"), ([], OK, "passes")):
            run = Run("st-run", self.model, "--report", "r.html", *words, cwd=self.folder)
            self.assertEqual(run.code, code, run)
            self.assertRegex(run.err, rf"(?m)^st-report +mesh.hdf {verdict},")
            self.assertEqual('"min-angle": {' in (self.folder / "r.html").read_text(), code == INCOMPLETE)

    def test_a_full_disk_is_6_and_leaves_nothing(self):
        def few_bytes():
            resource.setrlimit(resource.RLIMIT_FSIZE, (9000, 9000))

        done = subprocess.run([BIN / "st-run", self.model], cwd=self.folder, capture_output=True, text=True,
                              preexec_fn=few_bytes)
        self.assertEqual(done.returncode, OUTPUT, done)
        self.assertIn("st-import: geometry.hdf: cannot write", done.stderr)
        self.expect_only()


class Campaign(RunTest):
    def run_all(self, *words, code=INCOMPLETE):
        run = Run("st-run", "box.step", "sub/box.step", "bad.step", "--jobs", "2", "--page", "p.html", *words,
                  cwd=self.folder)
        self.assertEqual(run.code, code, run)
        with open(self.folder / "runs" / "results.csv", encoding="utf-8", newline="") as file:
            return run, list(csv.DictReader(file))

    def setUp(self):
        super().setUp()
        (self.folder / "bad.step").write_text("no CAD")
        (self.folder / "sub").mkdir()
        shutil.copy(self.model, self.folder / "sub")

    def test_a_line_for_each_model_and_a_folder_of_its_own(self):
        run, rows = self.run_all()
        self.assertEqual([(r["name"], r["verdict"], r["reason"], r["code"]) for r in rows],
                         [("box", "passes", "", "0"), ("box_2", "passes", "", "0"),
                          ("bad", "error", "st-import: input", "3")])
        self.assertIn("3 models: 2 pass, 1 error (st-import: input); runs/results.csv, p.html", run.out)
        self.assertEqual((self.folder / "runs/box_2/mesh.hdf").read_bytes(),
                         (one_by_one() / "mesh.hdf").read_bytes())
        page = (self.folder / "p.html").read_text()
        self.assertLess(page.index("runs/bad/log.txt"), page.index("runs/box/report.html"))
        self.assertEqual(page.count("data:image/bmp"), 2)
        self.expect_only("bad.step", "sub", "runs", "p.html")
        self.expect_nothing_left(self.folder / "runs" / "box", "mesh.hdf", "report.html", "log.txt", "said.json")

    def browse(self, file, script):
        """In a browser, after this script of the page: the DOM that is seen at last, and what the console says."""
        browser = shutil.which("chromium")
        if not browser:
            self.skipTest("no chromium")
        probed = file.with_name("probed.html")
        probed.write_text(file.read_text(encoding="utf-8") + f"<script>setTimeout(() => {{ {script} }}, 300)</script>",
                          encoding="utf-8")
        done = subprocess.run([browser, "--headless", "--no-sandbox", "--use-angle=swiftshader",
                               "--enable-unsafe-swiftshader", "--virtual-time-budget=5000", "--enable-logging=stderr",
                               f"--user-data-dir={self.folder / 'browser'}", "--dump-dom", f"file://{probed}"],
                              capture_output=True, text=True, timeout=120, check=True)
        return done.stdout, [line for line in done.stderr.splitlines() if "CONSOLE" in line and "GPU stall" not in line]

    def test_the_page_shows_pictures_and_a_click_opens_the_report(self):
        self.run_all()
        page = self.folder / "p.html"
        dom, console = self.browse(page, "document.title = [...document.images].map(i => i.naturalWidth > 50).join()")
        self.assertIn("<title>true,true</title>", dom)
        self.assertEqual(console, [])
        dom, console = self.browse(page, "[...document.links].find(a => a.textContent == 'box_2').click()")
        self.assertIn("This mesh passes all checks", dom)
        self.assertEqual(console, [])
        self.assertEqual(self.browse(page, "console.error('said')")[1] != [], True, "the console is listened to")

    def test_only_what_is_not_done_runs_again(self):
        first = self.run_all()[1]
        before = {name: (self.folder / f"runs/{name}/said.json").stat().st_mtime_ns for name in ("box", "box_2", "bad")}
        shutil.copy(MODELS / "block_with_hole.step", self.folder / "sub" / "box.step")
        run, rows = self.run_all()
        changed = {name: (self.folder / f"runs/{name}/said.json").stat().st_mtime_ns != before[name] for name in before}
        self.assertEqual(changed, {"box": False, "box_2": True, "bad": True}, run)
        self.assertEqual([r["key"] == f["key"] for r, f in zip(rows, first)], [True, False, True])
        self.assertNotEqual(self.run_all("--lmax", "4%")[1][0]["triangles"], rows[0]["triangles"])

    def ran_again(self, *words):
        """Whether the box is meshed by this call."""
        run = Run("st-run", "box.step", "--table", "t.csv", "--page", "p.html", *words, cwd=self.folder)
        self.assertEqual(run.code, OK, run)
        return "1 of 1 models are done already" not in run.err

    def test_what_a_row_stands_for_counts_by_content(self):
        sources = self.folder / "s.toml"
        for text in ("length = 0.5", "length = 0.4"):
            sources.write_text(f'[[source]]\ntype = "point"\nat = [5, 5, 5]\nradius = 1\n{text}\n')
            self.assertTrue(self.ran_again("--sources", sources))
            self.assertFalse(self.ran_again("--sources", sources))
        self.assertTrue(self.ran_again("--sources", sources, "--into", "other"))
        (self.folder / "other/box/mesh.hdf").unlink()
        self.assertTrue(self.ran_again("--sources", sources, "--into", "other"))

    def test_rows_of_other_models_stay_in_the_table(self):
        self.run_all()
        must("st-run", "sub/box.step", "--page", "p.html", cwd=self.folder)
        self.run_all()
        rows = list(csv.DictReader((self.folder / "runs/results.csv").read_text().splitlines()))
        shutil.copy(self.model, self.folder / "new.step")
        must("st-run", "new.step", "--page", "p.html", cwd=self.folder)
        more = list(csv.DictReader((self.folder / "runs/results.csv").read_text().splitlines()))
        self.assertEqual(more[:3], rows)
        self.assertEqual([r["name"] for r in more], ["box", "box_2", "bad", "new"])

    def test_a_number_of_triangles_that_no_scale_meets_is_said(self):
        run = must("st-run", "box.step", "--target-triangles", "4", cwd=self.folder)
        self.assertRegex(run.err, "warning: mesh.hdf: [0-9]+ triangles instead of the 4 asked for")
        run = must("st-run", "box.step", "--target-triangles", "2000", cwd=self.folder)
        self.assertNotIn("instead of", run.err)

    def test_a_folder_for_models_is_used_for_one_too(self):
        must("st-run", "box.step", "--into", "one", cwd=self.folder)
        self.assertTrue((self.folder / "one/box/mesh.hdf").is_file())
        self.assertFalse((self.folder / "mesh.hdf").exists())

    def test_a_mesh_that_cannot_be_read_has_no_picture(self):
        self.ran_again()
        (self.folder / "runs/box/mesh.hdf").write_text("damaged")
        self.assertFalse(self.ran_again())
        self.assertNotIn("data:image", (self.folder / "p.html").read_text())

    def test_a_limit_of_time_is_for_each_model(self):
        rows = self.run_all("--lmax", "0.05%", "--wall-limit", "1")[1]
        self.assertEqual({r["reason"] for r in rows[:2]}, {"st-run: input"})
        self.assertIn("not done within 1 s", rows[0]["message"])

    def test_a_daemon_that_ignores_ends_of_children_changes_nothing(self):
        def ignore():
            signal.signal(signal.SIGCHLD, signal.SIG_IGN)

        for models in (["bad.step"], ["bad.step", "none.step"]):
            done = subprocess.run([BIN / "st-run", *models], cwd=self.folder, capture_output=True, preexec_fn=ignore,
                                  timeout=60)
            self.assertEqual(done.returncode, INPUT if len(models) == 1 else INCOMPLETE, done)

    def test_what_is_for_one_model_is_refused(self):
        for words in (["-o", "m.hdf"], ["--export", "m.stl"], ["--report", "r.html"], ["--keep", "k"]):
            self.expect_error(USAGE, "st-run", "box.step", "bad.step", *words, cwd=self.folder, says="is for one model")
        self.expect_only("bad.step", "sub")

    def test_a_signal_ends_all_of_them(self):
        process = subprocess.Popen([BIN / "st-run", "box.step", "sub/box.step", "--jobs", "2", "--lmax", "0.08%"],
                                   cwd=self.folder, stderr=subprocess.DEVNULL, start_new_session=True)
        time.sleep(1.5)
        process.send_signal(signal.SIGTERM)
        self.assertEqual(process.wait(60), 128 + signal.SIGTERM)
        self.assertEqual(folders_of_runs() - self.before, set())
        for name in ("box", "box_2"):
            self.expect_nothing_left(self.folder / "runs" / name, "log.txt", "said.json")


class Ends(RunTest):
    def worker_of(self, process, number):
        children = Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split()
        os.kill(int(children[0]), number)

    def start(self, *words, until="st-raster"):
        process = subprocess.Popen([BIN / "st-run", self.model, "--lmax", "0.3%", *words], cwd=self.folder,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True)
        for line in process.stderr:
            if line.startswith(until):
                break
        time.sleep(0.1)
        self.assertIsNone(process.poll())
        return process

    def test_a_signal_leaves_nothing(self):
        for number, to_all in ((signal.SIGINT, True), (signal.SIGTERM, False)):
            process = self.start()
            os.killpg(process.pid, number) if to_all else process.send_signal(number)
            process.communicate(timeout=60)
            self.assertEqual(process.returncode, 128 + number)
            self.expect_only()

    def test_what_a_killed_run_left_is_removed_by_the_next_one(self):
        process = self.start()
        os.killpg(process.pid, signal.SIGKILL)
        process.communicate(timeout=60)
        must("st-run", self.model, cwd=self.folder)
        self.expect_only("mesh.hdf")

    def test_a_face_that_crashes_is_left_out_by_another_worker(self):
        process = self.start("--allow-incomplete", "--json", until="st-prolong")
        self.worker_of(process, signal.SIGSEGV)
        out, err = process.communicate(timeout=120)
        self.assertRegex(err, r"st-run: warning: st-mesh: face \d: crashed there")
        self.assertRegex(err, r"(?m)^st-mesh +\d+ triangles on 5 of 6 faces")
        said = json.loads(out)
        self.assertFalse(said["passes"])
        self.assertEqual(list(said["stages"]), STAGES)
        self.assertEqual(process.returncode, INCOMPLETE)
        self.expect_only("mesh.hdf")

    def test_the_wall_limit_leaves_nothing(self):
        run = Run("st-run", self.model, "--lmax", "0.05%", "--wall-limit", "1.5", cwd=self.folder)
        self.assertEqual(run.code, INPUT, run)
        self.assertIn("not done within 1.5 s", run.err)
        self.expect_only()

    def test_a_worker_that_dies_is_named_by_its_stage(self):
        process = self.start()
        self.worker_of(process, signal.SIGKILL)
        err = process.communicate(timeout=60)[1]
        self.assertEqual(process.returncode, 128 + signal.SIGKILL)
        self.assertRegex(err, r"st-run: error: st-(prolong|mesh): was ended by signal 9")
        self.expect_only()


if __name__ == "__main__":
    unittest.main(verbosity=2)
