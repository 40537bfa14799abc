"""st-mesh and st-remesh go on after a sudden end: the same bytes, and nothing that was finished is made again.

ST_MOMENTS: at how many random moments each job is killed (default 2).
"""
import ctypes
import os
import random
import re
import shutil
import signal
import struct
import subprocess
import sys
import time
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
from chain import BIN, INCOMPLETE, MODELS, OK, Run, ToolTest, must  # noqa: E402

MOMENTS = int(os.environ.get("ST_MOMENTS", "2"))
HEAD = struct.Struct("<8siiqQ32s32sQ")  # of a record: magic, kind, signal, face, size, key, digest, sum
BEGUN, DONE = 2, 3
SYS_TGKILL = 234


def records(path):
    """Kind, face and key of the whole records of one file."""
    data, at, found = path.read_bytes(), 0, []
    while at + HEAD.size <= len(data):
        _, kind, _, face, size, key, _, _ = HEAD.unpack_from(data, at)
        at += HEAD.size + size
        if at <= len(data):
            found.append((kind, face, key))
    return found


def finished(folder):
    """Keys of the finished parts in the journal of a run."""
    return {key for path in folder.glob("*") for kind, _, key in records(path) if kind == DONE}


def descendants(pid):
    """Processes below this one that run st-mesh, itself included."""
    found, by_parent = [], {}
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            name, rest = (folder / "stat").read_text().split("(", 1)[1].rsplit(")", 1)
        except OSError:
            continue
        by_parent.setdefault(int(rest.split()[1]), []).append((int(folder.name), name))
    todo = [(pid, "st-mesh")]
    while todo:
        process, name = todo.pop()
        if name == "st-mesh":
            found.append(process)
        todo += by_parent.get(process, [])
    return found


class Resume(ToolTest):
    @classmethod
    def setUpClass(cls):
        cls.random = random.Random(17)

    def setUp(self):
        super().setUp()
        self.inputs = [self.folder / "g.hdf", self.folder / "s.hdf"]
        must("st-import", MODELS / "assembly.step", "-o", self.inputs[0])
        must("st-raster", self.inputs[0], "-o", self.folder / "r.hdf", "--lmax", "0.15%", "--lmin", "0.1%")
        must("st-prolong", self.folder / "r.hdf", "-o", self.inputs[1])
        self.out = self.folder / "out"
        self.out.mkdir()
        self.patches, self.journal = self.out / "p.hdf", self.out / "p.hdf.journal"
        start = time.monotonic()
        whole = self.mesh("--no-resume")
        self.seconds = time.monotonic() - start
        self.n_parts, self.bytes = whole.json()["parts"], self.patches.read_bytes()
        self.assertEqual(whole.json()["parts_resumed"], 0)
        self.patches.unlink()

    def words(self, *options):
        tile = [] if "--tile" in options else ["--tile", "5000"]
        return [str(w) for w in ("st-mesh", *self.inputs, "-o", self.patches, "--journal-after", "0", "--json", *tile,
                                 *options)]

    def mesh(self, *options):
        return Run(*self.words(*options))

    def start(self, *options):
        tool, *arguments = self.words(*options)
        return subprocess.Popen([BIN / tool, *arguments], stderr=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
                                stdin=subprocess.DEVNULL)

    def kill(self, number, *options):
        """A run that is ended at a random moment by SIGKILL to one of its processes, and all of them."""
        run = self.start(*options)
        time.sleep(self.random.uniform(0.05, 1.2) * self.seconds)
        processes = descendants(run.pid)
        for process in processes if number is None else processes[:number]:
            try:
                os.kill(process, signal.SIGKILL)
            except ProcessLookupError:
                pass
        run.communicate(timeout=120)

    def expect_resumed(self, *options):
        deadline = time.monotonic() + 10
        while time.monotonic() < deadline and any(str(self.patches).encode() in (p / "cmdline").read_bytes()
                                                  for p in Path("/proc").glob("[0-9]*") if (p / "cmdline").exists()):
            time.sleep(0.02)  # ranks whose launcher is gone
        n_done = len(finished(self.journal))
        run = self.mesh(*options)
        self.assertEqual(run.code, OK, run)
        self.assertEqual((run.json()["parts"], run.json()["parts_resumed"]), (self.n_parts, n_done), run)
        self.assertEqual("goes on" in run.err, n_done > 0, run)
        self.assertEqual(self.patches.read_bytes(), self.bytes)
        self.expect_nothing_left(self.out, "p.hdf")
        self.patches.unlink()
        return n_done

    def test_a_killed_run_goes_on_to_the_same_bytes(self):
        n_done = []
        for ranks in ([], ["--np", "2"]):
            for _ in range(MOMENTS):
                self.kill(None, *ranks)
                n_done.append(self.expect_resumed(*ranks))
        print(f"parts that were not made again: {n_done} of {self.n_parts}")
        self.assertGreater(max(n_done), 0)

    def test_the_loss_of_a_rank_is_made_good_by_itself(self):
        for _ in range(20):
            run = self.start("--np", "2")
            time.sleep(self.random.uniform(0.3, 0.9) * self.seconds)
            ranks = [p for p in descendants(run.pid) if p != run.pid]
            if len(ranks) == 2:
                os.kill(self.random.choice(ranks), signal.SIGKILL)
            _, err = run.communicate(timeout=120)
            if "going on with what is finished" in err:
                break
            shutil.rmtree(self.journal, ignore_errors=True)
        self.assertEqual(run.returncode, OK, err)
        self.assertIn("was ended by signal 9", err)
        self.assertEqual(self.patches.read_bytes(), self.bytes)
        self.expect_nothing_left(self.out, "p.hdf")

    def test_the_number_of_ranks_may_change(self):
        for before, after in ((["--np", "2"], ["--threads", "1"]), (["--threads", "2"], ["--np", "3"])):
            self.kill(None, *before)
            self.expect_resumed(*after)

    def test_a_run_that_is_asked_to_end_goes_on_too(self):
        run = self.start("--threads", "1")
        time.sleep(0.5 * self.seconds)
        run.terminate()
        run.communicate(timeout=60)
        self.expect_resumed()

    def test_no_resume_and_other_options_begin_anew(self):
        for options in (["--no-resume"], ["--tile", "6000"]):
            self.kill(1)
            run = self.mesh(*options)
            self.assertEqual((run.code, run.json()["parts_resumed"]), (OK, 0), run)
            self.expect_nothing_left(self.out, "p.hdf")
            self.patches.unlink()

    def crash(self, *options):
        """A run of which a computing thread gets SIGSEGV at a face, not at an edge."""
        for _ in range(40):
            run = self.start(*options)
            time.sleep(self.random.uniform(0.1, 0.9) * self.seconds)
            threads = [(t, p) for p in descendants(run.pid) for t in Path(f"/proc/{p}/task").glob("*")
                       if t.name != str(p)]  # main threads of ranks pass messages
            if not threads:
                run.kill()
                run.communicate(timeout=60)
                shutil.rmtree(self.journal, ignore_errors=True)
                self.patches.unlink(missing_ok=True)
                continue
            busy = max(threads, key=lambda t: self.processor_time(t[0] / "stat"))
            ctypes.CDLL(None).syscall(SYS_TGKILL, busy[1], int(busy[0].name), int(signal.SIGSEGV))
            out, err = run.communicate(timeout=120)
            if re.search(r"face \d+: crashed there", err):
                return run.returncode, out, err
            shutil.rmtree(self.journal, ignore_errors=True)
            self.patches.unlink(missing_ok=True)
        self.fail("no thread was at a face")

    @staticmethod
    def processor_time(stat):
        try:
            fields = stat.read_text().rpartition(")")[2].split()
            return int(fields[11]) if fields[0] == "R" else -1
        except OSError:
            return -1

    def test_a_crash_of_any_rank_leaves_out_the_face_and_keeps_what_is_finished(self):
        for ranks in (["--threads", "2"], ["--np", "2"], ["--np", "2", "--no-resume"]):
            code, out, err = self.crash(*ranks)
            self.assertEqual(code, INCOMPLETE, err)
            face = int(re.search(r"face (\d+): crashed there", err)[1])
            self.assertRegex(err, rf'face {face} ("\w+" )?not meshed: the mesher crashed here by signal 11')
            report = Run("st-info", self.patches, "--json").json()
            self.assertEqual(report["counts"]["failures"], 1)
            self.expect_nothing_left(self.out, "p.hdf", "p.failures.hdf")
            for path in self.out.iterdir():
                path.unlink()

    def test_a_face_under_way_at_two_deaths_is_left_out(self):
        tile = ["--tile", "0", "--threads", "1"]
        for _ in range(20):
            for n in (1, 2):
                run = self.start(*tile)
                self.wait_for_records(run, self.journal / f"{n}-0")
                run.kill()
                run.communicate(timeout=60)
            if len(self.suspects()) == 1:  # else a face was finished just then
                break
            shutil.rmtree(self.journal, ignore_errors=True)
            self.patches.unlink(missing_ok=True)
        run = self.mesh(*tile)
        self.assertEqual(run.code, INCOMPLETE, run)
        (failure,) = run.json()["failures"]
        self.assertIn("two runs were ended by signal 9", failure["cause"])
        self.expect_nothing_left(self.out, "p.hdf", "p.failures.hdf")

    def suspects(self):
        """Faces under way when both runs were killed."""
        faces = []
        for path in self.journal.glob("*"):
            kinds = {}
            for kind, face, _ in records(path):
                kinds.setdefault(face, []).append(kind)
            faces.append({face for face, kind in kinds.items() if kind == [BEGUN]})
        return set.intersection(*faces) if len(faces) == 2 else set()

    @staticmethod
    def wait_for_records(run, path):
        """Until work has begun, or the run is over."""
        while run.poll() is None and not (path.exists() and path.stat().st_size > HEAD.size):
            time.sleep(0.001)


class RemeshResume(ToolTest):
    def test_a_killed_remeshing_goes_on_to_the_same_bytes(self):
        folder, out = self.folder, self.folder / "out"
        out.mkdir()
        must("st-import", MODELS / "assembly.step", "-o", folder / "g.hdf")
        must("st-raster", folder / "g.hdf", "-o", folder / "r.hdf", "--lmax", "0.4%", "--lmin", "0.3%")
        must("st-prolong", folder / "r.hdf", "-o", folder / "s.hdf")
        must("st-prolong", folder / "r.hdf", "-o", folder / "fine.hdf", "--scale", "0.3")
        must("st-mesh", folder / "g.hdf", folder / "s.hdf", "-o", folder / "p.hdf")
        must("st-merge", folder / "p.hdf", "-o", folder / "m.hdf")
        words = [str(w) for w in ("st-remesh", folder / "m.hdf", folder / "g.hdf", folder / "fine.hdf", "--merged",
                                  out / "m.hdf", "--threads", "1", "--journal-after", "0", "--json")]
        n_parts = Run(*words).json()["parts"]
        whole = (out / "m.hdf").read_bytes()
        journal = out / "m.hdf.journal"
        (out / "m.hdf").unlink()
        for n_wanted in (1, n_parts // 2):
            for _ in range(20):
                run = subprocess.Popen([BIN / words[0], *words[1:]], stdin=subprocess.DEVNULL,
                                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
                while run.poll() is None and len(finished(journal)) < n_wanted:
                    time.sleep(0.001)
                run.kill()
                run.wait(timeout=60)
                if not (out / "m.hdf").exists():
                    break
                (out / "m.hdf").unlink()  # it was over before it was looked at
            n_done = len(finished(journal))
            self.assertGreaterEqual(n_done, n_wanted)
            again = must(*words).json()
            self.assertEqual((again["parts"], again["parts_resumed"]), (n_parts, n_done))
            self.assertEqual((out / "m.hdf").read_bytes(), whole)
            self.expect_nothing_left(out, "m.hdf")
            (out / "m.hdf").unlink()


if __name__ == "__main__":
    unittest.main(verbosity=2)
