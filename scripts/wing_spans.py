#!/usr/bin/env python3
"""How much span of wings, blades and sails of many kinds is not covered but warned of: a table in docs/dev/wings.md.

usage: scripts/wing_spans.py BIN_DIR WING_MODELS [MODEL...]

Without models: all of WING_MODELS (tests/support/wing_models of the build) that are no machine parts, under `rans`.
Of trailing edges without a nose, and of those that belong to no lifting surface, all counts as warned of; of the two
edges of a base that no surface has, half.
"""
import argparse
import re
import subprocess
import tempfile
from pathlib import Path

SURFACE = re.compile(r"lifting surface.*?, span ([0-9.e-]+).*?(?:seen on (\d+) %|(no nose is seen)|$)", re.M)
UNUSED = re.compile(r"warning: (\d+) trailing edges?, ([0-9.e-]+).*? long")
FAR = {"far_wing"}  # 3002 long: it would hide the others


def spans_of(bin_dir, program, name):
    """All span, and what of it is warned of."""
    with tempfile.TemporaryDirectory() as folder:
        model, geometry, raster = (Path(folder) / f for f in ("model.brep", "geometry.hdf", "raster.hdf"))
        subprocess.run([program, name, model], check=True, capture_output=True)
        subprocess.run([bin_dir / "st-import", model, "-o", geometry, "-q"], check=True, capture_output=True)
        done = subprocess.run([bin_dir / "st-raster", geometry, "-o", raster, "--no-surface", "--preset", "rans"],
                              check=True, capture_output=True, text=True)
    span = warned = 0
    for own, seen, no_nose in SURFACE.findall(done.stdout + done.stderr):
        span += float(own)
        warned += float(own) * (1 if no_nose else 1 - float(seen) / 100 if seen else 0)
    for number, length in UNUSED.findall(done.stderr):
        span += float(length) / (2 - int(number) % 2)
        warned += float(length) / (2 - int(number) % 2)
    return span, warned


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin_dir", type=Path)
    parser.add_argument("wing_models", type=Path)
    parser.add_argument("models", nargs="*")
    arguments = parser.parse_args()
    listed = subprocess.run([arguments.wing_models], check=True, capture_output=True, text=True).stdout.split()
    print("| model | span | warned of | share, % |\n|---|--:|--:|--:|")
    names = arguments.models or [n for n in listed if not n.startswith("part_") and n not in FAR]
    total = total_warned = 0
    for name in names:
        span, warned = spans_of(arguments.bin_dir, arguments.wing_models, name)
        total += span
        total_warned += warned
        if warned:
            print(f"| {name} | {span:.3g} | {warned:.3g} | {100 * warned / span:.1f} |", flush=True)
    print(f"| all {len(names)} | {total:.4g} | {total_warned:.3g} | {100 * total_warned / total:.1f} |")


if __name__ == "__main__":
    main()
