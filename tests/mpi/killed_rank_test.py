"""A rank that a signal ends: its number, host and signal are said once, the job ends with 128 + signal, and nothing is
left half-written."""
import json
import os
import re
import signal
import socket
import subprocess
import sys
import time
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
from chain import BIN, ToolTest, artifacts_of  # noqa: E402

SLOW = ["--lmin", "0.05%", "--lmax", "0.1%"]  # seconds of sampling, then tens of megabytes to write


def ancestors(pid):
    while pid > 1:
        try:
            pid = int(Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[1])
        except OSError:
            return
        yield pid


def ranks_of(launcher):
    """Process ids of the ranks below this process, by rank."""
    ranks = {}
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            environment = (folder / "environ").read_bytes().split(b"\0")
        except OSError:
            continue
        rank = [v for v in environment if v.startswith(b"OMPI_COMM_WORLD_RANK=")]
        if rank and launcher in ancestors(int(folder.name)):
            ranks[int(rank[0].split(b"=")[1])] = int(folder.name)
    return ranks


class KilledRank(ToolTest):
    def start(self, *options, environment=None):
        self.out = self.folder / "out"
        self.out.mkdir(exist_ok=True)
        command = [BIN / "st-raster", artifacts_of("torus") / "geometry.hdf", *SLOW, "--np", 3, *options, "-o",
                   self.out / "x.hdf"]
        return subprocess.Popen([*map(str, command)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                env=os.environ | (environment or {}))

    def find_ranks(self, process):
        for _ in range(1000):
            ranks = ranks_of(process.pid)
            if len(ranks) == 3 or process.poll() is not None:
                return ranks
            time.sleep(0.01)
        self.fail("the ranks do not start")

    def kill(self, rank, number, when="computing", *options):
        """Exit code, stdout and stderr of a run of which one rank gets a signal."""
        process = self.start(*options)
        pid = self.find_ranks(process)[rank]
        if when == "computing":
            time.sleep(0.5)
        while when == "writing" and process.poll() is None and not any(self.out.glob(".x.hdf.tmp.*")):
            time.sleep(0.001)
        os.kill(pid, number)
        out, err = process.communicate(timeout=60)
        return process.returncode, out, err

    def expect_gone(self, pid):
        for _ in range(1000):
            if not Path(f"/proc/{pid}").exists():
                return
            time.sleep(0.01)
        self.fail("a rank goes on")

    def expect_named(self, rank, number, text, *arguments):
        code, _, err = self.kill(rank, number, *arguments)
        self.assertEqual(code, 128 + number, err)
        lines = [line for line in err.strip().split("\n") if not re.search(r" \d+ %(, \d+ s left)?$", line)]  # progress
        self.assertEqual(len(lines), 1, err)
        self.assertTrue(lines[0].startswith(f"st-raster: error: rank {rank} on {socket.gethostname().split('.')[0]}"),
                        err)
        self.assertIn(f"was ended by signal {int(number)} ({text})", err)
        self.expect_nothing_left(self.out)
        return err

    def test_a_killed_rank_is_named_with_host_signal_and_likely_cause(self):
        self.assertIn("out of memory?", self.expect_named(1, signal.SIGKILL, "Killed"))

    def test_crashes_are_named_as_defects_without_a_stack_trace(self):
        for number, text in ((signal.SIGSEGV, "Segmentation fault"), (signal.SIGABRT, "Aborted")):
            self.assertIn("please report it", self.expect_named(2, number, text))

    def test_the_first_rank_killed_while_it_writes_leaves_nothing(self):
        self.expect_named(0, signal.SIGKILL, "Killed", "writing")

    def test_a_stopped_rank_ends_the_job_and_is_named(self):
        process = self.start("-q", environment={"ST_STOPPED_SECONDS": "0.6"})
        pid = self.find_ranks(process)[1]
        os.kill(pid, signal.SIGSTOP)
        _, err = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 128 + signal.SIGSTOP, err)
        self.assertEqual(len(err.strip().split("\n")), 1, err)
        self.assertIn("rank 1 on", err)
        self.assertIn(f"(process {pid}) stood still for 0.6 s", err)
        self.expect_nothing_left(self.out)
        self.expect_gone(pid)

    def test_json_says_so_too(self):
        code, out, _ = self.kill(1, signal.SIGKILL, "computing", "--json")
        report = json.loads(out.strip().split("\n")[-1])
        self.assertEqual((report["exit_code"], report["tool"]), (code, "st-raster"))
        self.assertIn("rank 1 on", report["error"])

    def test_a_signal_to_the_tool_reaches_all_ranks(self):
        process = self.start()
        ranks = self.find_ranks(process)
        process.send_signal(signal.SIGTERM)
        _, err = process.communicate(timeout=60)
        self.assertEqual((process.returncode, err), (128 + signal.SIGTERM, ""))
        for pid in ranks.values():
            self.expect_gone(pid)
        self.expect_nothing_left(self.out)

    def test_ranks_end_with_the_tool_that_started_them(self):
        process = self.start()
        ranks = self.find_ranks(process)
        process.kill()
        process.communicate(timeout=60)
        for pid in ranks.values():
            self.expect_gone(pid)


if __name__ == "__main__":
    unittest.main(verbosity=2)
