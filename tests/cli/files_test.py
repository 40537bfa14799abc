"""Which files are replaced: those that the user named, and those that ST wrote; never an input, nor a file of his."""
import os
import resource
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
from chain import BIN, OK, OUTPUT, USAGE, ToolTest, artifacts_of, must  # noqa: E402

MINE = "a file of the user\n"


class Files(ToolTest):
    def setUp(self):
        super().setUp()
        good = artifacts_of("box")
        for name in ("geometry", "raster", "sizing", "patches", "mesh"):
            setattr(self, name, good / f"{name}.hdf")

    def derived(self):
        """Command lines, and a file that each writes under a name of its own."""
        yield ["st-prolong", self.raster, "-o", "k.hdf", "--family", "2"], "k-fine.hdf"
        yield ["st-prolong", self.raster, "-o", "k.hdf", "--family", "2"], "k-coarse.hdf"
        yield ["st-prolong", self.raster, "-o", "k.hdf", "--sample", "points.csv"], "sizes.csv"
        yield ["st-export", self.mesh, "-o", "k.ugrid"], "k.mapbc"
        yield ["st-export", self.mesh, "-o", "k.lb8.ugrid"], "k.mapbc"
        yield ["st-export", self.mesh, "-o", "k.geo"], "k.msh"
        yield ["st-export", self.mesh, "-o", "k.vtm"], "k/k_default.vtu"
        yield ["st-export", self.mesh, "-o", "k.stl", "--split-groups"], "k_default.stl"
        yield ["st-export", self.mesh, "-o", "k.cgns", "--split-groups"], "k_default.cgns"
        yield ["st-export", self.mesh, "-o", "k.ugrid", "--split-groups"], "k_default.mapbc"
        yield ["st-merge", self.patches, "-o", "k.hdf", "--export", "k.ugrid"], "k.mapbc"
        yield ["st-mesh", self.geometry, self.sizing, "-o", "k.hdf"], "k.failures.hdf"
        yield ["st-report", self.geometry], "report.html"
        yield ["st-merge", self.patches], "mesh.hdf"
        yield ["st-raster", self.geometry], "raster.hdf"

    def folder_for(self, name):
        folder = Path(tempfile.mkdtemp(dir=self.folder))
        (folder / "points.csv").write_text("0 0 0\n")
        (folder / name).parent.mkdir(exist_ok=True)
        return folder

    def test_a_file_of_the_user_under_a_name_of_ours_stays_and_nothing_is_written(self):
        for words, name in self.derived():
            folder = self.folder_for(name)
            (folder / name).write_text(MINE)
            before = sorted(folder.rglob("*"))
            self.expect_error(OUTPUT, *words, cwd=folder, says=[name, "ST did not write it", "choose another output"])
            self.assertEqual((folder / name).read_text(), MINE)
            self.assertEqual(sorted(folder.rglob("*")), before, words)

    def test_what_st_wrote_is_replaced_until_somebody_changes_it(self):
        for words, name in self.derived():
            folder = self.folder_for(name)
            must(*words, cwd=folder)
            if not (folder / name).exists():
                self.assertEqual(name, "k.failures.hdf")
                continue
            must(*words, cwd=folder)
            if name.endswith(".hdf"):
                continue
            with open(folder / name, "ab") as file:
                file.write(MINE.encode())
            changed = (folder / name).read_bytes()
            self.expect_error(OUTPUT, *words, cwd=folder, says=[name, "it was changed since"])
            self.assertEqual((folder / name).read_bytes(), changed)

    def test_a_copied_folder_is_still_ours(self):
        must("st-export", self.mesh, "-o", "k.ugrid", cwd=self.folder)
        shutil.copytree(self.folder, self.folder / "copy")
        must("st-export", self.mesh, "-o", "k.ugrid", cwd=self.folder / "copy")

    def test_a_name_that_was_given_is_replaced(self):
        for name in ("k.hdf", "k.stl"):
            (self.folder / name).write_text(MINE)
        must("st-merge", self.patches, "-o", "k.hdf", "--export", "k.stl", cwd=self.folder)
        must("st-merge", self.patches, "-o", "k.hdf", "--export", "k.stl", cwd=self.folder)
        self.assertFalse((self.folder / ".st-written").exists(), "there is nothing to remember")

    def test_only_own_files_are_replaced_when_asked(self):
        for name in ("k.hdf", "k.stl"):
            words = ["st-merge", self.patches, "-o", "k.hdf", "--export", "k.stl", "--replace-own"]
            folder = self.folder_for(name)
            (folder / name).write_text(MINE)
            self.expect_error(OUTPUT, *words, cwd=folder, says=[name, "ST did not write it"])
            (folder / name).unlink()
            must(*words, cwd=folder)
            must(*words, cwd=folder)

    def test_an_input_is_no_output_under_any_name(self):
        here = self.folder
        shutil.copy(self.raster, here / "k-fine.hdf")
        shutil.copy(self.mesh, here / "m.hdf")
        (here / "points.csv").write_text("0 0 0\n")
        (here / "sub").mkdir()
        (here / "sub/there").symlink_to(here)
        os.link(here / "k-fine.hdf", here / "hard.hdf")
        (here / "soft.hdf").symlink_to("m.hdf")
        os.link(here / "points.csv", here / "sizes.csv")
        (here / "k.mapbc").symlink_to("m.hdf")
        before = {p.name: p.read_bytes() for p in here.iterdir() if p.is_file()}
        for words in (["st-prolong", "k-fine.hdf", "-o", "k.hdf", "--family", "2"],
                      ["st-prolong", "sub/there/k-fine.hdf", "-o", "k.hdf", "--family", "2"],
                      ["st-prolong", "hard.hdf", "-o", "k-fine.hdf"],
                      ["st-prolong", "k-fine.hdf", "-o", "new.hdf", "--sample", "points.csv"],
                      ["st-export", "m.hdf", "-o", "soft.hdf"],
                      ["st-export", "m.hdf", "-o", "k.ugrid"],
                      ["st-check", "m.hdf", "--report", "soft.hdf"]):
            self.expect_error(USAGE, *words, cwd=here, says="is an input and would be overwritten")
        self.assertEqual({p.name: p.read_bytes() for p in here.iterdir() if p.is_file()}, before)

    def test_no_file_is_written_twice(self):
        (self.folder / "points.csv").write_text("0 0 0\n")
        for words in (["st-prolong", self.raster, "-o", "k.hdf", "--family", "2", "--sample", "points.csv",
                       "--sample-output", "k-fine.hdf"],
                      ["st-merge", self.patches, "-o", "k.mapbc", "--export", "k.ugrid"]):
            self.expect_error(USAGE, *words, cwd=self.folder, says="given twice as an output")
            self.expect_nothing_left(self.folder, "points.csv")


class Ranks(ToolTest):
    """What mpirun lacks is said at once."""

    def mesh(self, prepare=None, environment=()):
        good = artifacts_of("box")
        done = subprocess.run([BIN / "st-mesh", good / "geometry.hdf", good / "sizing.hdf", "-o", self.folder / "p.hdf",
                               "--np", "2"], capture_output=True, text=True, timeout=60, preexec_fn=prepare,
                              env={**os.environ, **dict(environment)}, stdin=subprocess.DEVNULL)
        return done.returncode, done.stderr

    def test_a_folder_for_temporaries_that_is_none(self):
        (self.folder / "file").write_text("")
        for folder in (self.folder / "file", self.folder / "nowhere"):
            code, said = self.mesh(environment={"TMPDIR": str(folder)})
            self.assertEqual(code, OUTPUT, said)
            self.assertEqual(said.count("\n"), 1)
            self.assertIn(f"{folder}: mpirun cannot keep its files there", said)
        self.assertFalse((self.folder / "nowhere").exists())

    def test_few_open_files(self):
        for most, is_hard in ((24, True), (32, True), (24, False)):
            hard = most if is_hard else resource.getrlimit(resource.RLIMIT_NOFILE)[1]
            code, said = self.mesh(lambda: resource.setrlimit(resource.RLIMIT_NOFILE, (most, hard)))
            self.assertEqual(code, USAGE if is_hard else OK, said)
            self.assertEqual("needs 40 open files for 2 ranks" in said, is_hard, said)

    def test_a_small_dev_shm(self):
        small = ["unshare", "--mount", "sh", "-c", 'mount -t tmpfs -o size=64k tmpfs /dev/shm && exec "$@"', "sh"]
        if subprocess.run([*small, "true"], capture_output=True).returncode != 0:
            self.skipTest("no mounts of one's own here")
        here = Path(tempfile.mkdtemp(dir="/tmp"))  # other folders may lie in /dev/shm
        self.addCleanup(shutil.rmtree, here)
        for name in ("geometry", "sizing"):
            shutil.copy(artifacts_of("box") / f"{name}.hdf", here)
        done = subprocess.run([*small, BIN / "st-mesh", "geometry.hdf", "sizing.hdf", "--np", "2"], cwd=here,
                              capture_output=True, text=True, timeout=60, env={**os.environ, "TMPDIR": "/tmp"})
        self.assertEqual(done.returncode, OK, done.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
