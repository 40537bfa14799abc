#!/usr/bin/env python3
"""Writes variants of the bundled aircraft: sweep, dihedral, engines, tail and flaps drawn by a fixed seed.

usage: make_models.py FOLDER [--models N] [--jobs N] [--bin FOLDER]

The same numbers are drawn every time. What could not be made is said, with the reason; exit code 1 then.
"""
import argparse
import random
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

TAILS = ("conventional", "t", "cross", "v", "none")


def variants(count):
    """Names and options; every tail comes with every number of engines."""
    numbers = random.Random(41)
    for i in range(count):
        tail, engines = TAILS[i % 5], i // 5 % 3
        flaps = numbers.choice((0, 0, 10, 20, 30, 40))
        sweep, dihedral = round(numbers.uniform(12, 40), 1), round(numbers.uniform(-3, 9), 1)
        options = {"sweep": sweep, "dihedral": dihedral, "engines": engines, "tail": tail, "flaps": flaps}
        yield f"v{i + 1:03}_{tail}_e{engines}_s{sweep:.0f}_f{flaps}", options


def make(program, path, options):
    """What went wrong; None: nothing."""
    if path.exists():
        return None
    words = [word for name, value in options.items() for word in (f"--{name}", str(value))]
    new = path.with_suffix(".new.step")
    done = subprocess.run([program, new, *words], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        new.unlink(missing_ok=True)
        return (done.stderr.strip().splitlines() or [f"exit code {done.returncode}"])[0]
    new.rename(path)
    return None


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--models", type=int, default=100)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--bin", type=Path, default=Path(__file__).resolve().parents[2] / "build/bin",
                        help="folder of make_aircraft")
    o = parser.parse_args()
    o.folder.mkdir(parents=True, exist_ok=True)
    todo = list(variants(o.models))
    with ThreadPoolExecutor(o.jobs) as pool:
        said = list(pool.map(lambda v: make(o.bin / "make_aircraft", o.folder / f"{v[0]}.step", v[1]), todo))
    failed = [(name, why) for (name, _), why in zip(todo, said) if why]
    for name, why in failed:
        print(f"{name}: {why}", file=sys.stderr)
    print(f"{len(todo) - len(failed)} of {len(todo)} models in {o.folder}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
