"""Every error a user can cause: its exit code, one clear message, and nothing left behind."""
import os
import shutil
import signal
import subprocess
import sys
import time
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
from chain import (  # noqa: E402
    BIN, GEOMETRY, INCOMPLETE, INPUT, MISMATCH, MODELS, OK, OUTPUT, USAGE, Run, ToolTest, artifacts_of, must,
)

ARTIFACTS = ["geometry.hdf", "raster.hdf", "sizing.hdf", "patches.hdf", "mesh.hdf"]
# The artifacts that each tool reads, by position.
READS = {
    "st-edit": ["geometry.hdf", "geometry.hdf"],
    "st-raster": ["geometry.hdf"],
    "st-prolong": ["raster.hdf"],
    "st-mesh": ["geometry.hdf", "sizing.hdf"],
    "st-remesh": ["mesh.hdf", "geometry.hdf", "sizing.hdf"],
    "st-merge": ["patches.hdf"],
    "st-check": ["mesh.hdf"],
    "st-info": ["mesh.hdf"],
    "st-diff": ["mesh.hdf", "mesh.hdf"],
    "st-export": ["mesh.hdf"],
    "st-report": ["mesh.hdf"],
}
WRITES = {"st-edit", "st-raster", "st-prolong", "st-mesh", "st-remesh", "st-merge", "st-export", "st-report"}


def output(tool, folder):
    return ["-o", Path(folder) / ("out.stl" if tool == "st-export"
                                  else "out.hdf")] if tool in WRITES | {"st-import"} else []


class BadInput(ToolTest):
    """Each tool, each of its inputs replaced by something else: always 3, and the message names the file."""

    def setUp(self):
        super().setUp()
        self.good = artifacts_of("box")
        self.out = self.folder / "out"
        self.out.mkdir()

    def each_input(self):
        for tool, names in READS.items():
            for position in range(len(names)):
                yield tool, [self.good / n for n in names], position

    def expect_refused(self, bad, tools=None, says=()):
        for tool, paths, position in self.each_input():
            if tools and tool not in tools:
                continue
            paths[position] = bad
            self.expect_error(INPUT, tool, *paths, *output(tool, self.out), says=[str(bad), *says])
            self.expect_nothing_left(self.out)

    def test_missing_file(self):
        self.expect_refused(self.folder / "none.hdf")
        self.expect_error(INPUT, "st-import", self.folder / "none.step", *output("st-import", self.out),
                          says="none.step")
        self.expect_nothing_left(self.out)

    def test_directory(self):
        self.expect_refused(self.folder)
        self.expect_error(INPUT, "st-import", self.folder, *output("st-import", self.out), says=str(self.folder))

    def test_empty_file(self):
        for name in ("empty.hdf", "empty.step", "empty.igs", "empty.brep"):
            (self.folder / name).touch()
        self.expect_refused(self.folder / "empty.hdf")
        for suffix in ("step", "igs", "brep"):
            self.expect_error(INPUT, "st-import", self.folder / f"empty.{suffix}", *output("st-import", self.out),
                              says=f"empty.{suffix}")
            self.expect_nothing_left(self.out)

    def test_file_of_another_format(self):
        text = self.folder / "text.hdf"
        text.write_text("solid nothing\nendsolid\n" * 100)
        self.expect_refused(text)
        self.expect_error(INPUT, "st-import", text, *output("st-import", self.out), says="text.hdf")
        for suffix in ("step", "igs", "brep"):
            lie = self.folder / f"lie.{suffix}"
            lie.write_text("this is no CAD file\n" * 50)
            self.expect_error(INPUT, "st-import", lie, *output("st-import", self.out), says=lie.name)
        self.expect_error(INPUT, "st-import", self.good / "mesh.hdf", *output("st-import", self.out), says="mesh.hdf")
        self.expect_nothing_left(self.out)

    @unittest.skipIf(os.geteuid() == 0, "SKIPPED: root may read every file")
    def test_unreadable_file(self):
        secret = self.folder / "secret.hdf"
        shutil.copy(self.good / "mesh.hdf", secret)
        secret.chmod(0)
        self.expect_refused(secret)

    def test_artifact_of_the_wrong_kind(self):
        for tool, paths, position in self.each_input():
            if tool in ("st-info", "st-diff", "st-export", "st-report"):  # these take every kind
                continue
            for wrong in set(ARTIFACTS) - {paths[position].name}:
                if (tool, wrong) == ("st-prolong", "sizing.hdf"):  # changes the sources of a finished field
                    continue
                changed = list(paths)
                changed[position] = self.good / wrong
                self.expect_error(INPUT, tool, *changed, *output(tool, self.out),
                                  says=[wrong, wrong.removesuffix(".hdf"), paths[position].name.removesuffix(".hdf")])
        self.expect_error(INPUT, "st-export", self.good / "geometry.hdf", "-o", self.out / "x.stl", says="geometry.hdf")
        for option, wrong in (("--geometry", "sizing.hdf"), ("--sizing", "raster.hdf")):
            self.expect_error(INPUT, "st-check", self.good / "mesh.hdf", option, self.good / wrong, says=wrong)
        self.expect_nothing_left(self.out)

    def test_truncated_artifact(self):
        for tool, paths, position in self.each_input():
            whole = paths[position].read_bytes()
            cut = self.folder / f"cut_{paths[position].name}"
            for part in (0.02, 0.5, 0.99):
                cut.write_bytes(whole[: int(len(whole) * part)])
                changed = list(paths)
                changed[position] = cut
                self.expect_error(INPUT, tool, *changed, *output(tool, self.out), says=cut.name)
        self.expect_nothing_left(self.out)

    def test_truncated_cad_file(self):
        for name in ("box.step", "box.igs", "box.brep"):
            cut = self.folder / name
            whole = (MODELS / name).read_bytes()
            cut.write_bytes(whole[: len(whole) // 2])
            run = Run("st-import", cut, *output("st-import", self.out))
            self.assertIn(run.code, (INPUT, GEOMETRY), run)
            self.assertIn(name, run.err)
            self.expect_nothing_left(self.out)


class BadOutput(ToolTest):
    """Each writing tool: always 6, before anything else is done, and nothing is left."""

    def commands(self):
        good = artifacts_of("box")
        yield "st-import", [MODELS / "box.step"]
        for tool in sorted(WRITES):
            yield tool, [good / n for n in READS[tool]]

    def test_missing_folder(self):
        for tool, inputs in self.commands():
            suffix = "stl" if tool == "st-export" else "hdf"
            self.expect_error(OUTPUT, tool, *inputs, "-o", self.folder / "none" / f"x.{suffix}", says="none")
        self.expect_nothing_left(self.folder)

    def test_output_is_a_folder(self):
        for tool, inputs in self.commands():
            folder = self.folder / ("x.stl" if tool == "st-export" else "x.hdf")
            folder.mkdir(exist_ok=True)
            self.expect_error(OUTPUT, tool, *inputs, "-o", folder, says=folder.name)
        self.expect_nothing_left(self.folder, "x.hdf", "x.stl")

    def test_place_that_takes_no_file(self):
        for tool, inputs in self.commands():
            suffix = "stl" if tool == "st-export" else "hdf"
            self.expect_error(OUTPUT, tool, *inputs, "-o", f"/proc/x.{suffix}", says="/proc/x")

    def test_export_to_a_missing_folder_leaves_no_mesh(self):
        self.expect_error(OUTPUT, "st-merge", artifacts_of("box") / "patches.hdf", "-o", self.folder / "m.hdf",
                          "--export", self.folder / "none" / "m.stl", says="m.stl")
        self.expect_nothing_left(self.folder)

    def test_export_of_an_unknown_suffix_is_2(self):
        self.expect_error(USAGE, "st-merge", artifacts_of("box") / "patches.hdf", "-o", self.folder / "m.hdf",
                          "--export", self.folder / "m.xyz", says=".xyz")
        self.expect_error(USAGE, "st-export", artifacts_of("box") / "mesh.hdf", "-o", self.folder / "m.xyz",
                          says=".xyz")
        self.expect_nothing_left(self.folder)

    def test_merged_mesh_takes_the_place_of_patches(self):
        inputs = [artifacts_of("box") / name for name in READS["st-remesh"]]
        self.expect_error(USAGE, "st-remesh", *inputs, "-o", self.folder / "p.hdf", "--merged", self.folder / "m.hdf",
                          says=["--merged", "--output"])
        self.expect_nothing_left(self.folder)
        must("st-remesh", *inputs, "--merged", "patches.hdf",
             cwd=self.folder)  # the default of -o is not written, so its name is free
        self.assertEqual(must("st-info", self.folder / "patches.hdf", "--json").json()["schema"], "mesh")

    def test_old_output_survives_a_failed_run(self):
        (self.folder / "g.hdf").write_text("the old one")
        (self.folder / "bad.step").write_text("no CAD file")
        self.expect_error(INPUT, "st-import", self.folder / "bad.step", "-o", self.folder / "g.hdf")
        self.assertEqual((self.folder / "g.hdf").read_text(), "the old one")


class Mismatch(ToolTest):
    """Inputs that do not belong together: 7, and the message names both."""

    def setUp(self):
        super().setUp()
        self.a, self.b = artifacts_of("box"), artifacts_of("sphere")

    def test_sizing_of_another_geometry(self):
        out = output("st-mesh", self.folder)
        self.expect_error(MISMATCH, "st-mesh", self.a / "geometry.hdf", self.b / "sizing.hdf", *out,
                          says=[str(self.a / "geometry.hdf"), str(self.b / "sizing.hdf")])
        self.expect_error(MISMATCH, "st-remesh", self.a / "mesh.hdf", self.a / "geometry.hdf", self.b / "sizing.hdf",
                          *out, says="sizing.hdf")
        self.expect_nothing_left(self.folder)

    def test_mesh_of_another_geometry(self):
        self.expect_error(MISMATCH, "st-remesh", self.b / "mesh.hdf", self.a / "geometry.hdf", self.a / "sizing.hdf",
                          *output("st-remesh", self.folder), says="mesh.hdf")
        self.expect_error(MISMATCH, "st-check", self.a / "mesh.hdf", "--geometry", self.b / "geometry.hdf",
                          says="geometry.hdf")
        self.expect_error(MISMATCH, "st-check", self.a / "mesh.hdf", "--sizing", self.b / "sizing.hdf",
                          says="sizing.hdf")
        self.expect_nothing_left(self.folder)

    def test_patches_of_different_geometries(self):
        self.expect_error(MISMATCH, "st-merge", self.a / "patches.hdf", self.b / "patches.hdf",
                          *output("st-merge", self.folder), says="patches.hdf")
        self.expect_nothing_left(self.folder)

    def test_edges_of_another_geometry(self):
        inputs = [self.a / "geometry.hdf", self.a / "sizing.hdf"]
        out = output("st-mesh", self.folder)
        self.expect_error(MISMATCH, "st-mesh", *inputs, "--edges", self.b / "patches.hdf", *out,
                          says=str(self.b / "patches.hdf"))
        self.expect_error(INPUT, "st-mesh", *inputs, "--edges", self.a / "mesh.hdf", *out, says="mesh.hdf")
        self.expect_error(INPUT, "st-mesh", *inputs, "--edges", self.folder / "none.hdf", *out, says="none.hdf")
        self.expect_nothing_left(self.folder)

    def test_artifacts_of_different_kinds_cannot_be_compared(self):
        run = Run("st-diff", self.a / "mesh.hdf", self.a / "patches.hdf")
        self.assertIn(run.code, (INPUT, MISMATCH), run)


class Geometry(ToolTest):
    def test_open_model_is_4_when_it_has_to_be_closed(self):
        open_model = MODELS / "plate_with_hole.brep"
        self.expect_error(GEOMETRY, "st-import", open_model, "--require-closed", *output("st-import", self.folder),
                          says="plate_with_hole.brep")
        self.expect_nothing_left(self.folder)
        self.assertEqual(Run("st-import", open_model, *output("st-import", self.folder)).code, OK)

    def test_closed_models_pass_require_closed(self):
        for name in ("box.step", "box.igs", "sphere.brep", "torus.brep", "cone.brep", "cylinder.brep",
                     "block_with_hole.step", "two_boxes.step", "assembly.step"):
            must("st-import", MODELS / name, "--require-closed", "-o", self.folder / "g.hdf")

    def test_check_writes_nothing(self):
        must("st-import", MODELS / "box.step", "--check", *output("st-import", self.folder))
        self.expect_nothing_left(self.folder)

    def test_length_with_unit_on_a_model_without_one_is_2_and_names_the_remedy(self):
        geometry = artifacts_of("sphere") / "geometry.hdf"
        self.expect_error(USAGE, "st-raster", geometry, "--lmin", "0.25mm", *output("st-raster", self.folder),
                          says=["--lmin", "--unit"])
        self.expect_nothing_left(self.folder)

    def test_ranges_of_faces_that_end_before_they_begin_are_2(self):
        box = artifacts_of("box")
        for faces in ("3-1", "5,3-1"):
            self.expect_error(USAGE, "st-mesh", box / "geometry.hdf", box / "sizing.hdf", "--faces", faces,
                              *output("st-mesh", self.folder), says="'3-1' ends before it begins")

    def test_lmin_above_lmax_is_2(self):
        geometry = artifacts_of("box") / "geometry.hdf"
        self.expect_error(USAGE, "st-raster", geometry, "--lmin", "5", "--lmax", "1", *output("st-raster", self.folder),
                          says="lmin")


class Differences(ToolTest):
    def test_diff_is_0_for_equal_and_5_for_different_meshes(self):
        mesh = artifacts_of("box") / "mesh.hdf"
        self.assertEqual(Run("st-diff", mesh, mesh).code, OK)
        self.assertEqual(Run("st-diff", mesh, artifacts_of("sphere") / "mesh.hdf").code, INCOMPLETE)

    def test_tolerance_is_taken(self):
        a = artifacts_of("sphere")
        must("st-prolong", a / "raster.hdf", "-o", self.folder / "s.hdf", "--scale", "1.0001")
        self.assertEqual(Run("st-diff", a / "sizing.hdf", self.folder / "s.hdf").code, INCOMPLETE)
        self.assertEqual(Run("st-diff", a / "sizing.hdf", self.folder / "s.hdf", "--tolerance", "0.001").code, OK)


class Interrupted(ToolTest):
    """SIGINT and SIGTERM end a run with 128 + signal and take the temporary along."""

    SLOW = ["--lmin", "0.05%", "--lmax", "0.1%"]  # seconds of sampling, then tens of megabytes to write

    def interrupt(self, number, when, *options):
        """Sends the signal to st-raster after 0.3 s of sampling ("computing") or as soon as its temporary appears
        ("writing")."""
        out = self.folder / "out"
        out.mkdir(exist_ok=True)
        command = [BIN / "st-raster", artifacts_of("torus") / "geometry.hdf", *self.SLOW, *options, "-o", out / "x.hdf"]
        process = subprocess.Popen([*map(str, command)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        if when == "computing":
            time.sleep(0.3)
        while when == "writing" and process.poll() is None and not any(out.glob(".x.hdf.tmp.*")):
            time.sleep(0.001)
        process.send_signal(number)
        code = process.wait(timeout=60)
        for _ in range(50):  # ranks of a parallel run may end a little later than mpirun
            if not any(out.glob(".*")):
                break
            time.sleep(0.1)
        # the signal came later than the last bytes were written
        if ("--np" in options or code == OK) and (out / "x.hdf").exists():
            must("st-info", out / "x.hdf")
            (out / "x.hdf").unlink()
        self.expect_nothing_left(out)
        return code

    def test_signal_while_computing_leaves_nothing(self):
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            self.assertEqual(self.interrupt(number, "computing"), 128 + number)

    def test_signal_while_writing_leaves_nothing(self):
        codes = (self.interrupt(signal.SIGTERM, "writing") for _ in range(5))
        self.assertEqual(next((code for code in codes if code != OK), OK), 128 + signal.SIGTERM)

    def test_signal_to_a_parallel_run_leaves_nothing_or_all(self):
        for when in ("computing", "writing"):
            self.assertNotEqual(self.interrupt(signal.SIGTERM, when, "--np", "2"), 0)


if __name__ == "__main__":
    unittest.main(verbosity=2)
