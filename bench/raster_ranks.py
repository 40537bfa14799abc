#!/usr/bin/env python3
"""st-raster at several rank counts: wall and processor time of its parts, and what more ranks gain.

usage: bench/raster_ranks.py [BIN_DIR] [MODEL...] [--ranks 1 2 4] [--runs 5] [-- OPTION...]

MODEL: a CAD file, or a geometry.hdf. Default: two of the corpus (ST_CORPUS, default ../shared/corpus beside the
repository). Wall times count only on a quiet machine. Processor times say what the parts cost whatever else runs: work
on demand (sampling, gaps, faces) is shared out evenly, of everything else the busiest rank counts. "even" is from the
trace: what rank 0 does outside tasks, and an even share of all tasks, also of those in the other parts; on a machine
with fewer processors than ranks rank 0 takes more of them. The start of mpirun is outside the stage: 0.3 to 0.6 s. The
best of all runs counts, at one thread. Every run must give the same raster: exit 1 otherwise.
"""
import argparse
import csv
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
CORPUS = Path(os.environ.get("ST_CORPUS") or ROOT / "../shared/corpus")
MODELS = [CORPUS / "aero_d150_wing_body_half.brep", CORPUS / "mech_geouned_scdr.stp"]
ON_DEMAND = {"sampling", "gaps", "faces"}


def summary_of(*command):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(done.stderr)
    return json.loads(done.stdout.rstrip().splitlines()[-1])


def cost_of(part, seconds):
    return sum(seconds) / len(seconds) if part in ON_DEMAND else max(seconds)


def even_cost(trace, ranks):
    """Rank 0's processor seconds if tasks were shared out evenly, without those of messages."""
    with open(trace, newline="") as file:
        rows = [(row["event"], float(row["processor"])) for row in csv.DictReader(file)]
    alone = sum(seconds for event, seconds in rows if event in ("serial", "collect"))
    return alone + sum(seconds for event, seconds in rows if event == "task") / ranks


def best_run(bin_dir, geometry, ranks, runs, options, folder):
    """Least wall time, least estimate from processor times with its parts, least of the trace, hashes."""
    walls, estimates, evens, hashes = [], [], [], set()
    for _ in range(runs):
        run = summary_of(bin_dir / "st-raster", geometry, "-o", folder / "raster.hdf", "--np", ranks, "--json",
                         "--threads", 1, "--trace", folder / "trace.csv", *options)
        evens.append(even_cost(folder / "trace.csv", ranks))
        walls.append(run["seconds"])
        parts = {part: cost_of(part, seconds) for part, seconds in run["processor_seconds_of"].items()}
        estimates.append((sum(parts.values()), parts))
        hashes.add(run["hash"])
    return min(walls), min(estimates, key=lambda e: e[0]), min(evens), hashes


def measure(model, arguments, folder):
    geometry = model if model.suffix == ".hdf" else folder / "geometry.hdf"
    if geometry != model:
        summary_of(arguments.bin_dir / "st-import", model, "-o", geometry, "--json")
    hashes, first = set(), None
    print(f"{model.name}\n  ranks  wall s  speed-up  processor s  speed-up  even s  speed-up  parts (processor s)")
    for ranks in arguments.ranks:
        wall, (estimate, parts), even, seen = best_run(arguments.bin_dir, geometry, ranks, arguments.runs,
                                                       arguments.options, folder)
        hashes |= seen
        first = first or (wall, estimate, even)
        text = "  ".join(f"{part} {seconds:.4f}" for part, seconds in parts.items())
        print(f"  {ranks:5d}  {wall:6.3f}  {first[0] / wall:8.2f}  {estimate:11.3f}  {first[1] / estimate:8.2f}  "
              f"{even:6.3f}  {first[2] / even:8.2f}  {text}", flush=True)
    return len(hashes) == 1


def main():
    words = sys.argv[1:]
    options = words[words.index("--") + 1:] if "--" in words else []
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin_dir", nargs="?", type=Path, default=ROOT / "build/release/bin")
    parser.add_argument("models", nargs="*", type=Path, default=MODELS)
    parser.add_argument("--ranks", nargs="+", type=int, default=[1, 2, 4])
    parser.add_argument("--runs", type=int, default=5)
    arguments = parser.parse_args(words[:words.index("--")] if "--" in words else words)
    arguments.options = options
    is_equal = True
    for model in arguments.models:
        with tempfile.TemporaryDirectory() as folder:
            is_equal &= measure(model, arguments, Path(folder))
    return 0 if is_equal else "the rasters differ"


if __name__ == "__main__":
    sys.exit(main())
