#!/usr/bin/env python3
"""Damaged CAD files through st-import: each must be refused with one clear message or imported, never crash, hang or
succeed with nothing.

usage: fuzz_import.py BIN_DIR [--full] [--cuts N] [--flips N] [--seed N] [--time-limit S] [--models GLOB] [--keep DIR]

Cuts: five files of each format (STEP, IGES, BREP, FLITE) cut at every kilobyte, at most N cuts per file, evenly spread
(--full: 100; default 2). A cut file must be refused (a BREP file may lose what follows the B-Rep). Flips: N cases in
all (--full: 500; default 30), each one to eight bytes of one file set at random; success needs at least one
face. Files come from ST_CORPUS (default ../shared/corpus beside the repository) and, without it, from ST_MODELS. Cases
depend on the seed alone.
--keep DIR keeps the files of failed cases. Exit 1 when a case fails.
"""
import argparse
import fnmatch
import functools
import json
import os
import random
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
CORPUS = Path(os.environ.get("ST_CORPUS") or ROOT / "../shared/corpus").resolve()
FORMATS = {"STEP": (".step", ".stp"), "IGES": (".igs", ".iges"), "BREP": (".brep",), "FLITE": (".fli", ".dat")}
FILES_PER_FORMAT = 5
REFUSED = {3: "unreadable", 4: "unusable"}


def models(pattern):
    """The smallest files of each format: most cases per second, all kinds of content."""
    folder = CORPUS if CORPUS.exists() else Path(os.environ.get("ST_MODELS", "."))
    if folder != CORPUS:
        print(f"{CORPUS}: no corpus here, only {folder} is used; set ST_CORPUS", file=sys.stderr)
    for suffixes in FORMATS.values():
        found = [p for p in sorted(folder.iterdir()) if p.suffix.lower() in suffixes
                 and fnmatch.fnmatch(p.name, pattern)]
        yield from sorted(found, key=lambda p: (p.stat().st_size, p.name))[:FILES_PER_FORMAT]


def cuts(files, n_per_file):
    for path in files:
        data = path.read_bytes()
        places = list(range(1024, len(data.rstrip()), 1024))
        step = max(1, len(places) / n_per_file)
        for k in range(min(n_per_file, len(places))):
            place = places[int(k * step)]
            yield f"{path.name} cut at {place}", path.suffix, data[:place], path


def flips(files, n, seed):
    generator = random.Random(seed)
    data = {path: path.read_bytes() for path in files}
    for k in range(n):
        path = files[k % len(files)]
        changed = bytearray(data[path])
        for _ in range(generator.choice([1, 1, 2, 4, 8])):
            changed[generator.randrange(len(changed))] = generator.randrange(256)
        yield f"{path.name} flip {k}", path.suffix, bytes(changed), None


@functools.cache
def whole(tool, path):
    """Faces and area of an undamaged file."""
    run = subprocess.run([tool, path, "--check", "-q", "--json"], capture_output=True, check=True)
    report = json.loads(run.stdout.splitlines()[-1])
    return report["faces"], report["area"]


def complaint(tool, path, cut_from, limit):
    """What is wrong with how the tool took the file; empty when nothing is."""
    output = path.with_suffix(".hdf")
    try:
        run = subprocess.run([tool, path, "-o", output, "-q", "--json"], capture_output=True, timeout=limit)
    except subprocess.TimeoutExpired:
        return f"hangs for {limit} s"
    error = run.stderr.decode(errors="replace").strip()
    if run.returncode in REFUSED:
        if output.exists():
            return "refused, but left an output"
        lines = [line for line in error.splitlines() if "error:" in line]
        return "" if len(lines) == 1 and ";" in lines[0] else f"no clear message: {error[:200]!r}"
    if run.returncode != 0:
        return f"exit {run.returncode}: {error[-300:]!r}"
    report = json.loads(run.stdout.splitlines()[-1])
    if cut_from and (cut_from.suffix != ".brep"
                     or whole(tool, cut_from) != (report["faces"], report["area"])):  # other data may follow a B-Rep
        return "taken for a whole file"
    return "" if report["faces"] > 0 else "empty success"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin_dir")
    parser.add_argument("--full", action="store_true")
    parser.add_argument("--cuts", type=int)
    parser.add_argument("--flips", type=int)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--time-limit", type=float, default=60)
    parser.add_argument("--models", default="*")
    parser.add_argument("--keep")
    args = parser.parse_args()
    files = list(models(args.models))
    n_cuts = args.cuts if args.cuts is not None else (100 if args.full else 2)
    n_flips = args.flips if args.flips is not None else (500 if args.full else 30)
    tool = Path(args.bin_dir) / "st-import"
    n_cases, failed, slowest = 0, [], (0.0, "")
    with tempfile.TemporaryDirectory() as folder:
        for name, suffix, data, cut_from in [*cuts(files, n_cuts), *flips(files, n_flips, args.seed)]:
            path = Path(folder) / f"case{n_cases}{suffix}"
            path.write_bytes(data)
            start = time.monotonic()
            wrong = complaint(tool, path, cut_from, args.time_limit)
            slowest = max(slowest, (time.monotonic() - start, name))
            n_cases += 1
            if wrong:
                failed.append(name)
                print(f"FAILED {name}: {wrong}", flush=True)
                if args.keep:
                    Path(args.keep).mkdir(parents=True, exist_ok=True)
                    shutil.copy(path, Path(args.keep) / (name.replace(" ", "_") + suffix))
            for left in Path(folder).iterdir():
                left.unlink()
    print(f"{n_cases} cases on {len(files)} files, {len(failed)} failed; slowest {slowest[0]:.1f} s ({slowest[1]})")
    return 1 if failed or n_cases == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
