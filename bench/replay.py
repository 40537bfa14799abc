#!/usr/bin/env python3
"""Replays a run of st-mesh on any number of ranks, from the times of its tasks.

usage: bench/replay.py TRACE [--ranks 1,2,16,256] [--threads N] [--latency S] [--bandwidth B] [--times N]
       bench/replay.py --validate GEOMETRY SIZING [--bin DIR] [--runs N]
       bench/replay.py --chain MODEL [--bin DIR] [--runs N] [--on 8,64]

TRACE: what `st-mesh --trace` wrote with one rank and one thread, and --journal-after 1e9: what is replayed ends before
it would begin a journal. Processor times count, so a disk costs nothing.
What is replayed, with one processor for each thread:
- tasks go to whoever is free, in the order of the trace; rank 0 hands them out and meshes itself;
- a message takes --latency, its bytes --bandwidth; rank 0 takes in one result after the other, as long as it took;
- what a task asks of others is on another rank as often as chance has it;
- a broadcast goes through a tree, a long one in shares, each of which goes around;
- all wait for what rank 0 does alone. Its threads share loops, but no piece of one. So do threads that are idle when a
  task begins. Requested lengths, and rows of patches, are each rank's own.
--times N: every task N times and rank 0's work N times as long, as with N times as many triangles: tiles do not grow.
--validate runs st-mesh at 1 and 2 threads and ranks, and compares it with the replay of its trace at one, also with
tasks as much slower as they were there: two processors of a machine share caches and memory.
--chain runs all stages on one processor, and replays each on the threads of --on: st-raster and st-mesh by their
traces; of the others the loops over threads are shared, down to their longest pieces, and the rest takes as long as it
took. Each is run with its loops cut for as many threads. What starting a program takes is in it. The least of --runs
counts.
"""
import argparse
import bisect
import csv
import heapq
import json
import math
import os
import subprocess
import sys
import tempfile
from collections import defaultdict
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]


SCATTERED = 1 << 20  # bytes from which a broadcast goes in shares: Communicator::broadcast()
EVERYWHERE = {"requests", "rows"}  # phases in which each rank works on its own patches


class Call:
    """Tasks, (seconds, bytes, name, id, of the seconds in loops, longest pieces, bytes asked for) in order of their
    start, and what collecting their results took rank 0."""

    def __init__(self):
        self.tasks, self.collect = [], 0.0


class Trace:
    """What rank 0 goes through: ("serial", name, (seconds, of them in loops over threads, the longest pieces)),
    ("broadcast", name, bytes), ("call", name, Call). Processor time, so without what a disk or other programs took.
    .end is the time of this run."""

    def __init__(self, path):
        with open(path, newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        calls, self.steps, self.end, before = defaultdict(Call), [], 0.0, 0.0
        for row in rows:
            call, start, wall, processor = int(row["call"]), *(float(row[k]) for k in ("start", "wall", "processor"))
            if row["event"] == "task":
                if call not in calls:
                    self.steps.append(("call", row["name"], calls[call]))
                calls[call].tasks.append((processor, int(row["bytes"]), row["name"], row["id"],
                                          *(min(processor, float(row[k])) for k in ("loops", "longest")),
                                          int(row["asked"])))
            elif row["event"] == "collect":
                calls[call].collect = processor
                self.end += start - before
            elif row["event"] == "serial":
                seconds = min(wall, processor)
                loops = min(seconds, float(row["loops"]))
                self.steps.append(("serial", row["name"], (seconds, loops, min(loops, float(row["longest"])))))
                self.end += seconds
            else:
                self.steps.append(("broadcast", row["name"], int(row["bytes"])))
                self.end += wall
            if row["event"] != "task":
                before = start + (0 if row["event"] == "collect" else wall)

    def tasks(self):
        return [task for kind, _, call in self.steps if kind == "call" for task in call.tasks]

    def serial(self):
        """Seconds of rank 0 alone by phase, what it takes in included; and of them in loops over threads."""
        parts, loops = defaultdict(float), 0.0
        for kind, name, what in self.steps:
            if kind == "serial":
                if name in EVERYWHERE:
                    parts["not alone: " + name] += what[0]
                    continue
                parts[name] += what[0]
                loops += what[1]
            elif kind == "call":
                parts["results"] += what.collect
        return dict(parts), loops


class Machine:
    def __init__(self, ranks, threads, options, slower=1.0):
        self.ranks, self.threads, self.options, self.slower = ranks, threads, options, slower

    def wire(self, rank, n_bytes=0):
        return 0.0 if rank == 0 else self.options.latency + n_bytes / self.options.bandwidth

    def seconds(self, task, n_idle):
        """Of a task, whose loops so many idle threads share."""
        seconds, _, _, _, loops, longest, asked = task
        shared = seconds - loops + max(loops / (1 + n_idle), longest)
        far = asked * (self.ranks - 1) / self.ranks
        return self.slower * shared + (2 * self.options.latency + far / self.options.bandwidth if far else 0.0)

    def run_call(self, begin, call):
        """Time when all results are collected."""
        tasks = call.tasks * self.options.times
        total = sum(task[1] for task in tasks) or 1
        per_byte = call.collect * self.options.times / total
        events, n_given, n_events = [], 0, 0
        main_free, ends, debt = begin, [begin], 0.0  # of rank 0's main thread; its processor owes the debt to its tasks

        share = len(tasks) / self.ranks  # tasks of a rank, when there are few
        n_idle = self.threads / share - 1 if 0 < share < self.threads else 0.0
        n_idle = min(n_idle, self.threads - 1)

        def give(rank, time):
            nonlocal n_given, n_events
            if n_given < len(tasks):
                seconds = self.seconds(tasks[n_given], n_idle)
                heapq.heappush(events, (time + self.wire(rank) + seconds, n_events, rank, n_given))
                n_given += 1
                n_events += 1

        for _ in range(self.threads):
            for rank in range(self.ranks):
                give(rank, begin)
        end = begin
        while events:
            time, number, rank, task = heapq.heappop(events)
            if rank == 0 and debt > 0 and self.ranks > 1:
                heapq.heappush(events, (time + debt, number, rank, task))
                debt = 0.0
                continue
            cost = per_byte * tasks[task][1]
            if self.ranks == 1:  # the thread itself, one at a time
                main_free = max(main_free, time) + cost
                give(0, main_free)
            else:
                arrival = time + self.wire(rank)
                i = bisect.bisect_left(ends, arrival)  # it answers between two results
                give(rank, ends[i] if i < len(ends) and main_free > arrival else arrival)
                main_free = max(main_free, time + self.wire(rank, tasks[task][1])) + cost
                ends.append(main_free)
                debt += cost
            end = max(end, main_free)
        return end

    def broadcast(self, n_bytes):
        levels = math.ceil(math.log2(self.ranks))
        if n_bytes < SCATTERED:
            return levels * self.wire(1, n_bytes)
        apart = (self.ranks - 1) / self.ranks * n_bytes / self.options.bandwidth if self.ranks > 1 else 0.0
        return 2 * apart + (levels + self.ranks - 1) * self.options.latency

    def run(self, trace):
        time = 0.0
        for kind, name, what in trace.steps:
            if kind == "serial":
                seconds, in_loops, longest = what
                n = self.threads * (self.ranks if name in EVERYWHERE else 1)
                time += (seconds - in_loops) * self.options.times
                time += max(in_loops * self.options.times / n, longest)
            elif kind == "broadcast":
                time += self.broadcast(what * self.options.times)
            else:
                time = self.run_call(time, what)
        return time


def tell(trace, options):
    tasks, (serial, loops) = trace.tasks(), trace.serial()
    work = sum(task[0] for task in tasks)
    heaviest = max(tasks)
    print(f"{len(tasks)} tasks, {work:.3f} s; heaviest: {heaviest[2]} {heaviest[3]}, {heaviest[0]:.3f} s, "
          f"{100 * heaviest[0] / work:.1f} %")
    alone = sum(seconds for name, seconds in serial.items() if not name.startswith("not alone"))
    print("rank 0 alone: " + ", ".join(f"{name} {seconds:.3f}" for name, seconds in serial.items()) +
          f"; {alone:.3f} s alone, of them {loops:.3f} in loops over threads")
    first = Machine(1, 1, options).run(trace)
    print("| ranks | threads | seconds | speed-up |\n|--:|--:|--:|--:|")
    for n in options.ranks:
        seconds = Machine(n, options.threads, options).run(trace)
        print(f"| {n} | {options.threads} | {seconds:.3f} | {first / seconds:.2f} |")


def validate(options):
    geometry, sizing = options.files
    with tempfile.TemporaryDirectory() as folder:
        def measure(*setting):
            best = None
            for _ in range(options.runs):
                path = Path(folder) / "trace.csv"
                words = [options.bin / "st-mesh", geometry, sizing, "-o", Path(folder) / "p.hdf", "--trace", path, "-q",
                         "--journal-after", "1e9", *setting]
                subprocess.run([str(w) for w in words], check=True)
                trace = Trace(path)
                best = trace if best is None or trace.end < best.end else best
            return best
        base = measure("--threads", 1)
        print("| ranks | threads | measured | replayed | difference | tasks slower by | replayed so | difference |")
        print("|--:|--:|--:|--:|--:|--:|--:|--:|")
        for ranks, threads in ((1, 1), (1, 2), (2, 1)):
            run = base if (ranks, threads) == (1, 1) else measure("--np", ranks, "--threads", threads)
            seconds = Machine(ranks, threads, options).run(base)
            slower = sum(t[0] for t in run.tasks()) / sum(t[0] for t in base.tasks())
            slow = Machine(ranks, threads, options, slower).run(base)
            print(f"| {ranks} | {threads} | {run.end:.3f} | {seconds:.3f} | {100 * (seconds / run.end - 1):+.1f} % | "
                  f"{slower:.2f} | {slow:.3f} | {100 * (slow / run.end - 1):+.1f} % |")


def run_stage(name, words, n):
    """Seconds of a run on one processor and thread, and as replayed on n threads, for which its loops are cut."""
    done = subprocess.Popen(["taskset", "-c", "0", *map(str, words), "--json"], stdout=subprocess.PIPE,
                            env=os.environ | {"ST_PIECES_FOR": str(n)})
    summary = json.loads(done.stdout.read().splitlines()[-1])
    _, status, usage = os.wait4(done.pid, 0)
    if os.waitstatus_to_exitcode(status) not in (0, 5):
        sys.exit(f"{words}: exit {os.waitstatus_to_exitcode(status)}")
    seconds = usage.ru_utime + usage.ru_stime
    if name in ("raster", "mesh"):
        trace = Trace(words[-1])
        one, many = (Machine(1, k, argparse.Namespace(times=1, latency=0, bandwidth=1)).run(trace) for k in (1, n))
        return seconds, seconds - one + many
    loops, longest = (summary["processor_seconds"][k] for k in ("in_loops", "longest_pieces"))
    return seconds, seconds - loops + max(loops / n, longest)


def replay_chain(options):
    """Table of all stages on one thread and on more."""
    with tempfile.TemporaryDirectory() as folder:
        f = {name: Path(folder) / f"{name}.hdf" for name in ("geometry", "raster", "sizing", "patches", "mesh")}
        trace, one = ["--trace", Path(folder) / "trace.csv"], ["--threads", 1]
        stages = [("import", [options.files[0], "-o", f["geometry"]]),
                  ("raster", [f["geometry"], "-o", f["raster"], *one, *trace]),
                  ("prolong", [f["raster"], "-o", f["sizing"], *one]),
                  ("mesh", [f["geometry"], f["sizing"], "-o", f["patches"], *one, "--journal-after", "1e9", *trace]),
                  ("merge", [f["patches"], "-o", f["mesh"], *one]),
                  ("check", [f["mesh"], "--geometry", f["geometry"], "--sizing", f["sizing"], *one])]
        print("| stage | one thread | " + " | ".join(f"{n} threads | times" for n in options.on) + " |")
        print("|---|--:" + "|--:|--:" * len(options.on) + "|")
        rows = []
        for name, words in stages:
            of = {n: min(run_stage(name, [options.bin / f"st-{name}", *words], n) for _ in range(options.runs))
                  for n in (1, *options.on)}
            rows.append((of[1][0], [of[n][1] for n in options.on]))
            tell_stage(name, *rows[-1])
        tell_stage("chain", sum(r[0] for r in rows), [sum(of) for of in zip(*(r[1] for r in rows))])


def tell_stage(name, first, on):
    print(f"| {name} | {first:.3f} | " + " | ".join(f"{s:.3f} | {first / s:.2f}" for s in on) + " |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="+", type=Path)
    parser.add_argument("--ranks", default="1,2,4,16,32,256", type=lambda text: [int(n) for n in text.split(",")])
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--latency", type=float, default=20e-6, help="seconds of a message")
    parser.add_argument("--bandwidth", type=float, default=1e9, help="bytes per second into a process")
    parser.add_argument("--times", type=int, default=1)
    parser.add_argument("--validate", action="store_true")
    parser.add_argument("--chain", action="store_true")
    parser.add_argument("--on", default="8,64", type=lambda text: [int(n) for n in text.split(",")])
    parser.add_argument("--bin", type=Path, default=ROOT / "build/release/bin")
    parser.add_argument("--runs", type=int, default=3)
    options = parser.parse_args()
    if len(options.files) != 1 + options.validate:
        sys.exit(__doc__)
    if options.validate:
        validate(options)
    elif options.chain:
        replay_chain(options)
    else:
        tell(Trace(options.files[0]), options)


if __name__ == "__main__":
    main()
