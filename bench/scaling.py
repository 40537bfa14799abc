#!/usr/bin/env python3
"""Time and memory per triangle over the number of triangles: one model, one thread, the same sizes scaled as a whole.

usage: bench/scaling.py MODEL [--bin DIR] [--triangles 100000,1000000,5000000] [--runs N] [--work DIR]

Sizes are rastered once and scaled by `st-prolong --target-triangles`; then st-mesh, st-merge and st-check are measured
(wall and processor time, the best of --runs; largest resident memory of the process). Run it on a quiet machine: the
load average is printed with the table, and time per triangle is processor time, which other work on the machine
disturbs least.
"""
import argparse
import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
STAGES = ["mesh", "merge", "check"]


def measure(command):
    """Processor seconds, wall seconds, largest resident memory in bytes and the JSON summary of a tool."""
    start = time.monotonic()
    with tempfile.TemporaryFile("w+") as out:
        process = subprocess.Popen([str(c) for c in command] + ["--json"], stdout=out, stderr=subprocess.PIPE,
                                   stdin=subprocess.DEVNULL)
        errors = process.stderr.read().decode()
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        seconds = time.monotonic() - start
        if process.returncode not in (0, 5):
            sys.exit(f"{' '.join(map(str, command))}: exit {process.returncode}: {errors}")
        out.seek(0)
        summary = json.loads(out.read().rstrip().splitlines()[-1])
        return usage.ru_utime + usage.ru_stime, seconds, 1024 * usage.ru_maxrss, summary


def best(command, runs):
    results = [measure(command) for _ in range(runs)]
    return min(results, key=lambda r: r[0])


def measure_size(bin_dir, work, n_wanted, runs):
    """One row: triangles, and what measure() gives for each stage."""
    tool = lambda name: bin_dir / f"st-{name}"  # noqa: E731
    measure([tool("prolong"), work / "raster.hdf", "-o", work / "sizing.hdf", "--target-triangles", n_wanted])
    cad = ["--geometry", work / "geometry.hdf", "--sizing", work / "sizing.hdf"]
    one = ["--threads", 1]
    mesh = [tool("mesh"), work / "geometry.hdf", work / "sizing.hdf", "-o", work / "patches.hdf", *one]
    row = {"mesh": best(mesh, runs),
           "merge": best([tool("merge"), work / "patches.hdf", "-o", work / "mesh.hdf", *one], runs),
           "check": best([tool("check"), work / "mesh.hdf", *cad, *one], runs)}
    row["triangles"] = row["check"][3]["triangles"]
    row["passes"] = row["check"][3]["passes"]
    return row


def print_table(rows):
    print("| triangles | st-mesh, wall s | µs per triangle | bytes per triangle | st-merge s | µs | bytes | st-check s "
          "| µs | bytes | passes |")
    print("|--:" * 10 + "|---|")
    for row in rows:
        n = row["triangles"]
        cells = [f"{row[s][1]:.2f} | {1e6 * row[s][0] / n:.2f} | {row[s][2] / n:.0f}" for s in STAGES]
        print(f"| {n:,} | {' | '.join(cells)} | {'yes' if row['passes'] else 'no'} |")
    for stage in STAGES:
        per = [row[stage][0] / row["triangles"] for row in rows]
        print(f"st-{stage}: largest over smallest time per triangle {max(per) / min(per):.2f}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("model", type=Path)
    parser.add_argument("--bin", type=Path, default=ROOT / "build/release/bin")
    parser.add_argument("--triangles", default="100000,300000,1000000,3000000,5000000")
    parser.add_argument("--runs", type=int, default=2)
    parser.add_argument("--work", type=Path, help="folder for artifacts (default: a temporary one)")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        work = arguments.work or Path(temporary)
        work.mkdir(parents=True, exist_ok=True)
        measure([arguments.bin / "st-import", arguments.model, "-o", work / "geometry.hdf"])
        measure([arguments.bin / "st-raster", work / "geometry.hdf", "-o", work / "raster.hdf"])
        rows = [measure_size(arguments.bin, work, n, arguments.runs) for n in arguments.triangles.split(",")]
    print(f"{arguments.model.name}, load average {os.getloadavg()[0]:.1f} (1 min)")
    print_table(rows)


if __name__ == "__main__":
    main()
