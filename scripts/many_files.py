#!/usr/bin/env python3
"""The whole chain on many CAD files with defaults: a line per file, then counts of verdicts.

Lines are added to TABLE as the files are done, and files that it has already are passed over: a stopped run goes on.
A line has the file, the exit codes of the stages, closed or open by the import, seconds, and what went wrong.

usage: find FOLDER -name '*.st*p' | scripts/many_files.py BIN_DIR TABLE [--seconds 120]
--seconds: of each stage.
"""
import argparse
import collections
import subprocess
import sys
import tempfile
import time
from pathlib import Path

STAGES = (
    ("import", "st-import {model} -o {at}/g.hdf"),
    ("raster", "st-raster {at}/g.hdf -o {at}/r.hdf"),
    ("prolong", "st-prolong {at}/r.hdf -o {at}/s.hdf"),
    ("mesh", "st-mesh {at}/g.hdf {at}/s.hdf -o {at}/p.hdf"),
    ("merge", "st-merge {at}/p.hdf -o {at}/m.hdf"),
    ("check", "st-check {at}/m.hdf --geometry {at}/g.hdf"),
)


def run_chain(bin_dir, model, seconds):
    """Exit codes of the stages up to one that leaves nothing, closed or open, and the last words of those that fail."""
    codes, shape, words = [], "", []
    with tempfile.TemporaryDirectory() as at:
        for name, line in STAGES:
            command = [w.format(model=model, at=at) for w in line.split()]
            try:
                done = subprocess.run([bin_dir / command[0], *command[1:]], capture_output=True, text=True,
                                      errors="replace", timeout=seconds, check=False)
            except subprocess.TimeoutExpired:
                return codes + ["late"], shape, words + [f"{command[0]}: no end in {seconds} s"]
            codes.append(str(done.returncode))
            if name == "import":
                shape = "closed" if ", closed," in done.stdout else "open" if done.returncode == 0 else ""
            if done.returncode:
                words.append((done.stdout if name == "check" else done.stderr).strip().splitlines()[-1:])
            if done.returncode not in (0, 5):
                break
    return codes, shape, [w[0] for w in words if w]


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("bin_dir", type=lambda path: Path(path).resolve())
    parser.add_argument("table", type=Path)
    parser.add_argument("--seconds", type=float, default=120)
    options = parser.parse_args()
    lines = options.table.read_text(encoding="utf-8").splitlines() if options.table.exists() else []
    done = {line.split("\t")[0] for line in lines}
    with options.table.open("a", encoding="utf-8") as table:
        for model in (line.rstrip("\n") for line in sys.stdin):
            if model in done:
                continue
            start = time.monotonic()
            codes, shape, words = run_chain(options.bin_dir, model, options.seconds)
            taken = f"{time.monotonic() - start:.1f}"
            lines.append("\t".join([model, " ".join(codes), shape, taken, " | ".join(words)]))
            print(lines[-1], file=table, flush=True)
    for (codes, shape), n in collections.Counter(tuple(line.split("\t")[1:3]) for line in lines).most_common():
        print(f"{n:6} {shape:6} {codes}")


if __name__ == "__main__":
    main()
