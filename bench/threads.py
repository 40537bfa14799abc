#!/usr/bin/env python3
"""Wall time of each stage of the chain with one thread and with more, and the hash of the mesh.

usage: bench/threads.py MODEL [--bin DIR] [--threads 1,2] [--triangles N] [--runs N]

--triangles scales the sizes by `st-prolong --target-triangles`; default: the sizes as they are. The best of --runs
counts (default 3), the numbers of threads in turn. Run it on a quiet machine.
"""
import argparse
import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
THREADED = {"raster", "prolong", "mesh", "merge", "check"}


def chain(folder, model, n_triangles):
    """Stage and arguments, in order."""
    f = {name: folder / f"{name}.hdf" for name in ("geometry", "raster", "sizing", "patches", "mesh")}
    scale = ["--target-triangles", n_triangles] if n_triangles else []
    return [("import", [model, "-o", f["geometry"]]), ("raster", [f["geometry"], "-o", f["raster"]]),
            ("prolong", [f["raster"], "-o", f["sizing"], *scale]),
            ("mesh", [f["geometry"], f["sizing"], "-o", f["patches"]]), ("merge", [f["patches"], "-o", f["mesh"]]),
            ("check", [f["mesh"], "--geometry", f["geometry"], "--sizing", f["sizing"]])]


def run(bin_dir, stage, arguments, n_threads):
    """Seconds, and the summary."""
    threads = ["--threads", n_threads] if stage in THREADED else []
    words = [str(w) for w in (bin_dir / f"st-{stage}", *arguments, *threads, "--json")]
    start = time.monotonic()
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    seconds = time.monotonic() - start
    if done.returncode not in (0, 5):
        sys.exit(f"{' '.join(words)}: exit {done.returncode}: {done.stderr}")
    return seconds, json.loads(done.stdout.splitlines()[-1])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("model", type=Path)
    parser.add_argument("--bin", type=Path, default=ROOT / "build/release/bin")
    parser.add_argument("--threads", default="1,2", type=lambda text: [int(n) for n in text.split(",")])
    parser.add_argument("--triangles", type=int)
    parser.add_argument("--runs", type=int, default=3)
    o = parser.parse_args()
    best, hashes, n_triangles = {}, set(), 0
    with tempfile.TemporaryDirectory() as temporary:
        stages = chain(Path(temporary), o.model, o.triangles)
        for _ in range(o.runs):
            for n in o.threads:
                for stage, arguments in stages:
                    seconds, summary = run(o.bin, stage, arguments, n)
                    best[n, stage] = min(best.get((n, stage), seconds), seconds)
                    if stage == "merge":
                        hashes.add(summary["hash"])
                        n_triangles = summary["triangles"]
    names = [stage for stage, _ in stages]
    print(f"{o.model.name}: {n_triangles:,} triangles; {len(hashes)} hash of the mesh")
    print("| threads | " + " | ".join(f"st-{s}" for s in names) + " | chain | ratio |")
    print("|--:" * (len(names) + 3) + "|")
    for n in o.threads:
        row = [best[n, s] for s in names]
        first = sum(best[o.threads[0], s] for s in names)
        print(f"| {n} | " + " | ".join(f"{s:.2f}" for s in [*row, sum(row)]) + f" | {first / sum(row):.2f} |")


if __name__ == "__main__":
    main()
