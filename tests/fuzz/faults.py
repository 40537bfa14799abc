#!/usr/bin/env python3
"""Faults from outside: kills at random moments, full disks, odd surroundings. Afterwards the same hash, nothing left.

usage: tests/fuzz/faults.py BIN_DIR [--kills N] [--disks N] [--resumed N] [--seed N] [--model NAME]

Kills: SIGKILL, SIGTERM or SIGINT to the tool, its process group or one of two ranks, at a random moment of a stage.
The output is absent or whole, the code is that of the signal, a killed rank is named, and the repeated run gives the
same hash and leaves no temporary. Disks: a tmpfs of a few kB; the code is 6, one message names the output, nothing
is left, and with more space the hash is the same. Needs root (skipped without). Surroundings: German locale, empty
environment, no HOME, none or a wrong TMPDIR, stack of 1 MB, closed stdout, two runs into one output. Outputs: a FIFO,
a folder, a link, a limit of file sizes, no permission (needs root). Exit 1 when a case fails.
--resumed N does something else: N times st-mesh on the D150 of ST_CORPUS with a million triangles, at 1, 2 and 3 ranks.
SIGKILL to the tool, its group, or a rank at a random moment; the run goes on by itself or is given again. The hash is
that of an undisturbed run, and no part whose end is in a journal is made again; prints both counts of each case.
"""
import argparse
import collections
import json
import os
import random
import re
import resource
import signal
import struct
import subprocess
import sys
import tempfile
import time
from pathlib import Path

SIGNALS = [signal.SIGKILL, signal.SIGTERM, signal.SIGINT]
PARALLEL = {"st-raster", "st-mesh", "st-remesh"}


class Stages:
    """Each stage on good inputs, its hash and how long it takes."""

    def __init__(self, bin_dir, model, folder):
        self.bin, self.good, self.hash, self.seconds = bin_dir, folder, {}, {}
        g = {n: folder / f"{n}.hdf" for n in ("geometry", "raster", "sizing", "patches", "mesh")}
        self.inputs = {"st-import": [model], "st-raster": [g["geometry"]], "st-prolong": [g["raster"]],
                       "st-mesh": [g["geometry"], g["sizing"]], "st-merge": [g["patches"]],
                       "st-remesh": [g["mesh"], g["geometry"], g["sizing"], "--too-long", "1.05"]}
        for tool, output in zip(self.inputs, [*g.values(), folder / "re.hdf"]):
            start = time.monotonic()
            self.run(tool, output, check=True)
            self.seconds[tool] = time.monotonic() - start
            self.hash[tool] = self.hash_of(output)

    def command(self, tool, output, ranks=1):
        return [str(self.bin / tool), *map(str, self.inputs[tool]), "-o", str(output), "-q",
                *(["--np", str(ranks)] if ranks > 1 else [])]

    def run(self, tool, output, **keywords):
        pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
        return subprocess.run(self.command(tool, output), text=True, **(pipes | keywords))

    def hash_of(self, path):
        done = subprocess.run([self.bin / "st-info", path, "--hash"], capture_output=True, text=True)
        return done.stdout.strip() if done.returncode == 0 else f"unreadable: {done.stderr}"

    def wrong_after_repeat(self, tool, output):
        """A run that nothing disturbs: what is wrong with its output or its folder."""
        for left in output.parent.glob(".*.tmp.*"):
            os.utime(left, (0, 0))  # younger ones might be of another machine and stay for a minute
        done = self.run(tool, output)
        if done.returncode != 0:
            return f"repeated: exit {done.returncode}: {done.stderr}"
        if self.hash_of(output) != self.hash[tool]:
            return f"repeated: another hash {self.hash_of(output)}"
        left = sorted(p.name for p in output.parent.iterdir() if p != output)
        return f"left: {left}" if left else ""


def children(pid):
    for task in Path("/proc").glob(f"{pid}/task/*/children"):
        try:
            own = [int(child) for child in task.read_text().split()]
        except OSError:  # it has ended
            continue
        for child in own:
            yield child
            yield from children(child)


def ranks_of(process, tool):
    """The ranks that run below the tool and its mpirun."""
    found = []
    for child in children(process.pid):
        try:
            name = Path(f"/proc/{child}/comm").read_text().strip()
        except OSError:
            continue
        if name == tool[:15]:
            found.append(child)
    return found


def kill(stages, rng, folder):
    """(what was done, what is wrong or "")."""
    tool, sent, output = rng.choice(list(stages.inputs)), rng.choice(SIGNALS), folder / "x.hdf"
    target = rng.choice(["tool", "group", "rank"] if tool in PARALLEL else ["tool", "group"])
    ranks = 2 if target == "rank" or (tool in PARALLEL and rng.random() < 0.3) else 1
    process = subprocess.Popen(stages.command(tool, output, ranks), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                               text=True, start_new_session=True)
    time.sleep(rng.random() * (stages.seconds[tool] + 0.3 * (ranks - 1)))
    of_ranks = ranks_of(process, tool) if target == "rank" else []
    try:
        if target == "group":
            os.killpg(process.pid, sent)
        else:
            os.kill(rng.choice(of_ranks) if of_ranks else process.pid, sent)
    except ProcessLookupError:
        pass
    try:
        err = process.communicate(timeout=60)[1]
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        return f"{tool} {target} {sent.name}", "does not end"
    code, what = process.returncode, f"{tool} {target} {sent.name}"
    allowed = {0, -sent, 128 + sent}
    if code not in allowed:
        return what, f"exit {code}: {err}"
    if of_ranks and code == 128 + signal.SIGKILL and sent == signal.SIGKILL and "signal 9" not in err:
        return what, f"the killed rank is not named: {err!r}"
    if output.exists() and stages.hash_of(output) != stages.hash[tool]:
        return what, "half an output"
    if code == 0 and not output.exists():
        return what, "success without an output"
    deadline = time.monotonic() + 10
    while time.monotonic() < deadline and any(tool in comm and str(output) in line for comm, line in processes()):
        time.sleep(0.1)
    return what, stages.wrong_after_repeat(tool, output)


def processes():
    """Name and command line of each; a process may end while it is asked."""
    for p in Path("/proc").iterdir():
        try:
            if p.name.isdigit():
                yield (p / "comm").read_text(), (p / "cmdline").read_text()
        except OSError:
            pass


def full_disk(stages, rng, folder):
    tool = rng.choice(list(stages.inputs))
    sizes = {"st-import": "geometry", "st-raster": "raster", "st-prolong": "sizing", "st-mesh": "patches",
             "st-merge": "mesh", "st-remesh": "re"}
    room = max(4, rng.randrange((stages.good / f"{sizes[tool]}.hdf").stat().st_size // 1024) // 4 * 4)
    if subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={room}k", "tmpfs", folder]).returncode != 0:
        return "skipped", ""
    what, output = f"{tool} {room} kB", folder / "x.hdf"
    try:
        done = stages.run(tool, output)
        lines = done.stderr.splitlines()
        left = [p.name for p in folder.iterdir()]
        if done.returncode != 6 or len(lines) != 1 or "x.hdf" not in lines[0] or left:
            return what, f"exit {done.returncode}, left {left}: {done.stderr}"
        subprocess.run(["mount", "-o", "remount,size=16m", folder], check=True)
        return what, stages.wrong_after_repeat(tool, output)
    finally:
        subprocess.run(["umount", folder], check=True)


RECORD = struct.Struct("<8siiqQ32s32sQ")  # of a journal, lib/io/file/journal_record.h
DONE = 3


def parts_done(journal):
    """Parts that the files of a journal have finished; a torn record ends a file."""
    done = set()
    for path in journal.glob("*-*"):
        data, at = path.read_bytes(), 0
        while at + RECORD.size <= len(data):
            magic, kind, _, _, n_bytes, key, _, _ = RECORD.unpack_from(data, at)
            at += RECORD.size + n_bytes
            if magic != b"ST-jrnl1" or at > len(data):
                break
            if kind == DONE:
                done.add(key)
    return len(done)


class Resumed:
    """st-mesh on a model of a million triangles, killed and given again."""

    def __init__(self, bin_dir, folder):
        self.bin, self.folder = bin_dir, folder
        model = Path(os.environ.get("ST_CORPUS") or Path(__file__).parents[3] / "shared/corpus")
        g, r, s, p = (folder / f"{n}.hdf" for n in "grsp")
        for command in (["st-import", model / "aero_d150_wing_body_half.brep", "-o", g], ["st-raster", g, "-o", r],
                        ["st-prolong", r, "-o", s, "--target-triangles", 1000000]):
            subprocess.run([str(bin_dir / command[0]), *map(str, command[1:]), "-q"], check=True)
        start = time.monotonic()
        subprocess.run(self.command(p, 1), check=True, capture_output=True)
        self.seconds = time.monotonic() - start
        self.hash = self.hash_of(p)

    def command(self, output, ranks):
        return [str(self.bin / "st-mesh"), str(self.folder / "g.hdf"), str(self.folder / "s.hdf"), "-o", str(output),
                "--json", "--threads", "1", "--journal-after", "0.2", "--np", str(ranks)]

    def start(self, output, ranks, seconds):
        process = subprocess.Popen(self.command(output, ranks), stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                   text=True, start_new_session=True)
        time.sleep(seconds)
        return process

    def hash_of(self, path):
        return subprocess.run([self.bin / "st-info", path, "--hash"], capture_output=True, text=True).stdout.strip()

    def case(self, rng, k):
        """(what was done, what is wrong or "")."""
        output, ranks = self.folder / f"k{k}" / "p.hdf", k % 3 + 1
        output.parent.mkdir()
        target, moment = rng.choice(["tool", "group", "rank"][:3 if ranks > 1 else 2]), rng.random()
        process = self.start(output, ranks, moment * self.seconds)
        while process.poll() is not None:  # too late: it was done
            process.communicate()
            output.unlink()
            moment *= 0.8
            process = self.start(output, ranks, moment * self.seconds)
        of_ranks = ranks_of(process, "st-mesh") if target == "rank" or ranks > 1 else []
        if target == "group":
            os.killpg(process.pid, signal.SIGKILL)
            for rank in of_ranks:  # mpirun gives each a group of its own
                os.kill(rank, signal.SIGKILL)
        else:
            os.kill(rng.choice(of_ranks) if target == "rank" and of_ranks else process.pid, signal.SIGKILL)
        out, err = process.communicate(timeout=300)
        what = f"np {ranks} {target} at {moment:.2f}"
        by_itself = process.returncode == 0
        if by_itself:
            found = re.findall(r"ended: (\d+) parts", err)
            n_done = int(found[-1]) if found else 0
        else:
            deadline = time.monotonic() + 20
            while time.monotonic() < deadline and any(str(output) in line for _, line in processes()):
                time.sleep(0.1)
            n_done = parts_done(Path(f"{output}.journal"))
            again = subprocess.run(self.command(output, ranks), capture_output=True, text=True)
            if again.returncode != 0:
                return what, f"again: exit {again.returncode}: {again.stderr}"
            out = again.stdout
        report = json.loads(out.strip().split("\n")[-1])
        same, resumed = self.hash_of(output) == self.hash, report["parts_resumed"]
        left = [p.name for p in output.parent.iterdir() if p != output]
        print(f"{what}: {n_done} of {report['parts']} parts were finished, {resumed} taken over, "
              f"{report['parts'] - resumed} made again{', by itself' if by_itself else ''}", flush=True)
        output.unlink()
        if not same or left or resumed != n_done:
            return what, f"same hash: {same}, left {left}, {n_done} finished, {resumed} taken over"
        return what, ""


def small_stack():
    resource.setrlimit(resource.RLIMIT_STACK, (2**20, 2**20))


def small_files():
    resource.setrlimit(resource.RLIMIT_FSIZE, (2048, 2048))


def german(env, folder):
    """The environment with a decimal comma; the locale is made in a folder where the system can make it."""
    made = subprocess.run(["localedef", "-i", "de_DE", "-f", "UTF-8", str(folder / "de_DE.UTF-8")], capture_output=True)
    if not (folder / "de_DE.UTF-8").is_dir():
        print(f"SKIPPED: localedef cannot make a locale with a decimal comma: {made.stderr.decode()}", flush=True)
        return env
    return env | {"LC_ALL": "de_DE.UTF-8", "LOCPATH": str(folder)}


def surroundings(stages, folder):
    """(what, what is wrong) of each."""
    env, output = dict(os.environ), folder / "x.hdf"
    odd = {"German locale": {"env": german(env, stages.good)}, "empty environment": {"env": {}},
           "no HOME": {"env": {k: v for k, v in env.items() if k != "HOME"}},
           "no TMPDIR": {"env": {k: v for k, v in env.items() if k != "TMPDIR"}},
           "wrong TMPDIR": {"env": env | {"TMPDIR": "/does/not/exist"}}, "stack of 1 MB": {"preexec_fn": small_stack},
           "closed stdout": {"preexec_fn": lambda: os.close(1), "stdout": None},
           "closed stdin": {"preexec_fn": lambda: os.close(0)}}
    for what, keywords in odd.items():
        for tool in stages.inputs:
            done = stages.run(tool, output, **keywords)
            same = done.returncode == 0 and stages.hash_of(output) == stages.hash[tool]
            yield f"{tool}, {what}", "" if same else f"exit {done.returncode}: {done.stderr}"
            output.unlink(missing_ok=True)
    for tool in stages.inputs:
        both = [subprocess.Popen(stages.command(tool, output), stderr=subprocess.PIPE) for _ in range(2)]
        codes = [p.communicate() and p.returncode for p in both]
        same = codes == [0, 0] and [p.name for p in folder.iterdir()] == ["x.hdf"]
        yield f"{tool}, two at once", "" if same else f"exit {codes}, {list(folder.iterdir())}"
        output.unlink(missing_ok=True)


def outputs(stages, folder):
    """Outputs that are no plain file or cannot be written: (what, what is wrong) of each."""
    output, target = folder / "x.hdf", folder / "target.hdf"

    def refused(tool, code, left, **keywords):
        done = stages.run(tool, output, **keywords)
        lines, there = done.stderr.splitlines(), sorted(p.name for p in folder.iterdir())
        good = done.returncode == code and len(lines) == 1 and "x.hdf" in lines[0] and there == left
        return "" if good else f"exit {done.returncode}, left {there}: {done.stderr}"

    for tool in stages.inputs:
        yield f"{tool}, files of 2 kB at most", refused(tool, 6, [], preexec_fn=small_files)
        os.mkfifo(output)
        wrong = refused(tool, 6, ["x.hdf"])
        yield f"{tool}, a FIFO as output", wrong or ("" if output.is_fifo() else "the FIFO is gone")
        output.unlink()
        output.mkdir()
        yield f"{tool}, a folder as output", refused(tool, 6, ["x.hdf"])
        output.rmdir()
        target.write_text("before")
        output.symlink_to(target)
        done = stages.run(tool, output)
        replaced = not output.is_symlink() and target.read_text() == "before"  # what it points to stays
        same = done.returncode == 0 and replaced and stages.hash_of(output) == stages.hash[tool]
        yield f"{tool}, a link as output", "" if same else f"exit {done.returncode}: {done.stderr}"
        output.unlink()
        target.unlink()
        if os.geteuid() == 0:  # others may not write there
            yield f"{tool}, no permission", refused(tool, 6, [], preexec_fn=lambda: os.setuid(65534))


def kill_and_resume(args):
    with tempfile.TemporaryDirectory() as top:
        runs, rng = Resumed(args.bin_dir, Path(top)), random.Random(args.seed)
        wrong = [(what, text) for what, text in (runs.case(rng, k) for k in range(args.resumed)) if text]
    for what, text in wrong:
        print(f"FAILED {what}: {text}")
    print(f"{args.resumed} killed and resumed, {len(wrong)} failed")
    return 1 if wrong else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin_dir", type=Path)
    parser.add_argument("--kills", type=int, default=300)
    parser.add_argument("--disks", type=int, default=50)
    parser.add_argument("--resumed", type=int, default=0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--model", default="dome")
    args = parser.parse_args()
    signal.signal(signal.SIGINT, signal.default_int_handler)  # ignored in background jobs of a shell
    if args.resumed:
        return kill_and_resume(args)
    model = min(Path(os.environ.get("ST_MODELS") or args.bin_dir.parent / "test_models").glob(args.model + ".*"))
    counts, failed = collections.Counter(), 0
    with tempfile.TemporaryDirectory() as top:
        good = Path(top) / "good"
        good.mkdir()
        stages, rng = Stages(args.bin_dir, model, good), random.Random(args.seed)

        def cases():
            fresh = lambda: Path(tempfile.mkdtemp(dir=top))  # noqa: E731
            for _ in range(args.kills):
                yield "kills", *kill(stages, rng, fresh())
            for _ in range(args.disks if os.geteuid() == 0 else 0):
                yield "full disks", *full_disk(stages, rng, fresh())
            for what, wrong in surroundings(stages, fresh()):
                yield "surroundings", what, wrong
            folder = fresh()
            for path in (Path(top), good, folder):
                path.chmod(0o755)
            for what, wrong in outputs(stages, folder):
                yield "outputs", what, wrong

        for kind, what, wrong in cases():
            counts[kind] += 1
            if wrong:
                failed += 1
                print(f"FAILED {kind}: {what}: {wrong}", flush=True)
    print(", ".join(f"{n} {kind}" for kind, n in counts.items()) + f", {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
