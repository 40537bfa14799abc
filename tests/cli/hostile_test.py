"""What strangers and accidents do to the tools: each ends with a documented code, a message, nothing destroyed."""
import os
import resource
import signal
import subprocess
import sys
import time
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
from chain import BIN, INCOMPLETE, INPUT, MODELS, OK, OUTPUT, USAGE, Run, ToolTest, artifacts_of, must  # noqa: E402


class Hostile(ToolTest):
    def setUp(self):
        super().setUp()
        self.good = artifacts_of("box")

    def writers(self):
        """Each tool that writes, its inputs, and the suffix of its output."""
        good = {n: self.good / f"{n}.hdf" for n in ("geometry", "raster", "sizing", "patches", "mesh")}
        yield "st-import", [MODELS / "box.step"], "hdf"
        yield "st-raster", [good["geometry"]], "hdf"
        yield "st-prolong", [good["raster"]], "hdf"
        yield "st-mesh", [good["geometry"], good["sizing"]], "hdf"
        yield "st-merge", [good["patches"]], "hdf"
        yield "st-remesh", [good["mesh"], good["geometry"], good["sizing"]], "hdf"
        yield "st-export", [good["mesh"]], "stl"

    def pipe(self, name):
        os.mkfifo(self.folder / name)
        return self.folder / name


class Outputs(Hostile):
    def test_a_pipe_or_a_device_is_never_replaced(self):
        for tool, inputs, suffix in self.writers():
            pipe = self.pipe(f"{tool}.{suffix}")
            self.expect_error(OUTPUT, tool, *inputs, "-o", pipe, says=[pipe.name, "would be replaced"])
            self.assertTrue(pipe.is_fifo(), tool)
        report = self.pipe("report.json")
        self.expect_error(OUTPUT, "st-check", self.good / "mesh.hdf", "--report", report, says="would be replaced")
        self.assertTrue(report.is_fifo())

    def test_an_input_is_never_overwritten(self):
        names = {"--options": "alpha = 12\n", "--sizes": "", "--groups": ""}
        for tool, inputs, suffix in self.writers():
            more = {"st-import": "--groups", "st-raster": "--sizes"}
            options = {"--options"} | {more[tool]} if tool in more else {"--options"}
            for option in sorted(options):
                file = self.folder / f"mine.{suffix}"
                file.write_text(names[option] if tool == "st-raster" else "")
                self.expect_error(USAGE, tool, *inputs, option, file, "-o", file,
                        says="is an input and would be overwritten")
                self.assertEqual(file.read_text(), names[option] if tool == "st-raster" else "", tool)
        mesh = self.folder / "m.hdf"
        mesh.write_bytes((self.good / "mesh.hdf").read_bytes())
        self.expect_error(USAGE, "st-remesh", self.good / "mesh.hdf", self.good / "geometry.hdf",
                self.good / "sizing.hdf",
                          "--sizes-on-nodes", f"{mesh}:size", "-o", mesh, says="would be overwritten")
        self.assertEqual(mesh.read_bytes(), (self.good / "mesh.hdf").read_bytes())

    def test_a_full_disk_is_6_with_one_message_and_nothing_left(self):
        def few_bytes():
            resource.setrlimit(resource.RLIMIT_FSIZE, (9000, 9000))

        for tool, inputs, suffix in self.writers():
            if tool == "st-export":
                continue
            done = subprocess.run([BIN / tool, *inputs, "-o", self.folder / "x.hdf"], capture_output=True,
                    text=True, preexec_fn=few_bytes)
            self.assertEqual(done.returncode, OUTPUT, (tool, done))
            self.assertIn("x.hdf: cannot write", done.stderr)
            self.expect_nothing_left(self.folder)

    def test_a_link_laid_where_temporaries_were_once_expected_is_not_followed(self):
        victim = self.folder / "victim"
        victim.write_text("mine")
        code = f"import os, sys\nos.chdir({str(self.folder)!r})\n" \
               "for name in ('.x.hdf.tmp.%d.0', '.st.probe.%d'):\n  os.symlink('victim', name % os.getpid())\n" \
               "os.execv(sys.argv[1], sys.argv[1:])\n"
        subprocess.run([sys.executable, "-c", code, BIN / "st-prolong", self.good / "raster.hdf", "-o", "x.hdf",
                "-q"], check=True)
        self.assertEqual(victim.read_text(), "mine")

    def test_a_stage_that_cannot_print_its_summary_has_done_its_work(self):
        with open("/dev/full", "w") as full:
            for arguments, code in (([], OK), (["--json"], OUTPUT)):
                done = subprocess.run([BIN / "st-merge", self.good / "patches.hdf", "-o", self.folder / "x.hdf",
                        *arguments],
                                      stdout=full, stderr=subprocess.PIPE, text=True)
                self.assertEqual((done.returncode, "stdout" in done.stderr), (code, True), done)
                (self.folder / "x.hdf").unlink()
            self.assertEqual(subprocess.run([BIN / "st-mesh", "--help"], stdout=full,
                    stderr=subprocess.DEVNULL).returncode, OUTPUT)

    def test_closed_streams_do_not_become_outputs(self):
        command = f"exec {BIN / 'st-merge'} {self.good / 'patches.hdf'} -o {self.folder / 'x.hdf'} <&- >&- 2>&-"
        self.assertEqual(subprocess.run(["sh", "-c", command]).returncode, OK)
        self.assertEqual((self.folder / "x.hdf").read_bytes(), (self.good / "mesh.hdf").read_bytes())


class Inputs(Hostile):
    def test_a_sizing_that_is_cut_while_it_is_used_is_an_input_error(self):
        fine, cut = self.folder / "fine.hdf", self.folder / "cut.hdf"
        sphere = artifacts_of("sphere")
        must("st-prolong", sphere / "raster.hdf", "-o", fine, "--scale", ".01")
        for n_ranks in (1, 2):
            ranks = ["--np", str(n_ranks)] if n_ranks > 1 else []
            cut.write_bytes(fine.read_bytes())
            process = subprocess.Popen([BIN / "st-mesh", sphere / "geometry.hdf", cut,
                                        "-o", self.folder / "p.hdf", *ranks],
                                       stderr=subprocess.PIPE, text=True)
            self.wait_until_mapped(process, cut, n_ranks)
            os.truncate(cut, 4096)
            err = process.communicate(timeout=60)[1]
            self.assertEqual(process.returncode, INPUT, err)
            self.assertIn("cut.hdf: got shorter or unreadable while it was used", err)
            self.expect_nothing_left(self.folder, "fine.hdf", "cut.hdf")

    def wait_until_mapped(self, process, path, n_ranks):
        """Until all ranks have used the file for some time: one that opens it later finds a file that was cut."""
        def is_mapped(maps):
            try:
                return "st-mesh" in (maps.parent / "comm").read_text() and str(path) in maps.read_text()
            except OSError:
                return False
        while process.poll() is None:
            if sum(map(is_mapped, Path("/proc").glob("[0-9]*/maps"))) == n_ranks:
                time.sleep(0.3)
                return
        self.fail("the file was never mapped")

    def test_a_pipe_as_an_input_is_refused_at_once(self):
        pipe = self.pipe("pipe.brep")
        out = self.folder / "out"
        out.mkdir()
        says = ["pipe.brep", "might never end"]
        self.expect_error(INPUT, "st-import", pipe, "-o", out / "x.hdf", says=says, timeout=20)
        self.expect_error(INPUT, "st-import", MODELS / "box.step", "--groups", pipe, "-o", out / "x.hdf",
                says=says, timeout=20)
        self.expect_error(USAGE, "st-raster", self.good / "geometry.hdf", "--options", pipe, "-o", out / "x.hdf",
                says=says, timeout=20)
        self.expect_error(INPUT, "st-prolong", self.good / "raster.hdf", "--background", "/dev/zero", "-o",
                out / "x.hdf", says="might never end", timeout=20)
        self.expect_nothing_left(out)

    def test_a_name_that_is_not_utf8_is_a_name(self):
        model = os.fsencode(self.folder) + b"/bad\xff.step"
        with open(model, "wb") as file:
            file.write((MODELS / "box.step").read_bytes())
        for arguments in ([], ["--json"]):
            done = subprocess.run([BIN / "st-import", model, "-o", self.folder / "x.hdf", *arguments],
                    capture_output=True)
            self.assertEqual(done.returncode, OK, done)
        self.assertEqual(must("st-info", self.folder / "x.hdf", "--json").json()["inputs"][0]["name"], "bad\ufffd.step")

    def test_control_characters_and_long_arguments_stay_out_of_messages(self):
        done = Run("st-info", "\x1b[2J\x07evil\nname.hdf")
        self.assertEqual((done.code, done.err.count("\n")), (INPUT, 1))
        self.assertFalse(set(done.err) & {"\x1b", "\x07"}, done)
        self.assertLess(len(Run("st-info", "x" * 100000).err), 3000)

    def test_a_number_of_ranks_that_no_machine_bears_is_refused(self):
        for tool, inputs, _ in self.writers():
            if tool in ("st-raster", "st-mesh", "st-remesh"):
                self.expect_error(USAGE, tool, *inputs, "-o", self.folder / "x.hdf", "--np", 100000,
                        says=["100000", "processor"], timeout=20)

    def test_a_switch_takes_no_value(self):
        self.expect_error(USAGE, "st-info", self.good / "mesh.hdf", "--quiet=5xx", says="quiet")


class Leftovers(Hostile):
    def test_an_import_that_is_ended_leaves_nothing(self):
        for _ in range(3):
            run = Run("st-import", MODELS / "box.step", "--time-limit", "1e-308", "-o", self.folder / "x.hdf")
            self.assertIn(run.code, (OK, INPUT), run)
            left = [p.name for p in self.folder.iterdir()]
            self.assertIn(left, ([], ["x.hdf"]), run)

    def test_a_temporary_of_a_dead_process_goes_even_before_its_parent_notices(self):
        zombie = subprocess.Popen(["true"])
        os.waitid(os.P_PID, zombie.pid, os.WEXITED | os.WNOWAIT)
        leftover = self.folder / f".x.hdf.tmp.{zombie.pid}.0"
        leftover.touch()
        os.utime(leftover, (0, 0))
        os.kill(zombie.pid, 0)  # it still has its number
        must("st-merge", self.good / "patches.hdf", "-o", self.folder / "x.hdf")
        zombie.send_signal(signal.SIGKILL)
        self.expect_nothing_left(self.folder, "x.hdf")


class TimeLimits(Hostile):
    FINE = ("--lmax", "0.05%", "--max-cells", 1000000000)

    def test_a_run_ends_at_its_limit_and_names_the_input(self):
        for arguments in ([], ["--np", 2]):
            self.expect_error(INPUT, "st-raster", self.good / "geometry.hdf", *self.FINE, "--wall-limit", "0.2",
                    *arguments, "-o", self.folder / "x.hdf",
                    says=["geometry.hdf: not done within 0.2 s", "--wall-limit"], timeout=60)
            self.expect_nothing_left(self.folder)

    def test_faces_that_take_too_long_are_given_up_and_named(self):
        run = Run("st-raster", self.good / "geometry.hdf", *self.FINE, "--no-surface", "--time-limit", "0.1",
                "-o", self.folder / "x.hdf", timeout=60)
        self.assertEqual(run.code, INCOMPLETE, run)
        for face in range(1, 7):
            self.assertRegex(run.err, rf"face {face}.*: not sampled, takes longer than 0.1 s")


if __name__ == "__main__":
    unittest.main(verbosity=2)
