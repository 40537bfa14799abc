#!/usr/bin/env python3
"""Where st-mesh spends its time: share of samples by kind of work, from Linux perf.

usage: bench/profile.py GEOMETRY.hdf SIZING.hdf [--bin DIR]      needs perf and the right to use it
"""
import argparse
import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
KINDS = [  # the first that fits a symbol; what the compiler inlined counts for its caller
    ("enhancer: swap, smooth, collapse",
     r"\benhance\b|Enhancer|ring_of|edge_length|can_swap|Triangulation::(swap|collapse)"),
    ("front: points, circumcircles", r"advance_front|Front::|circumradius|metric_of|FaceMesher"),
    ("triangulation: search, cavities, predicates", r"Triangulation|orient2d|predicate"),
    ("evaluation of surfaces and curves",
     r"evaluate|patch_|KnotSpans|Surface|Curve|Geom|BSpl|Adaptor|sincos|\b__?(sin|cos)"),
    ("size queries", r"OctreeField|SizeField|RefinedField|morton"),
    ("facets that cross", r"crossing|Forest|triangles_cross|cross"),
    ("memory and reading, writing", r"mem(move|cpy|set)|malloc|free|page|folio|XXH|H5|concatenate|clear_|copy_"),
]


def samples_of(command):
    """(share in per cent, symbol) of a run under perf."""
    with tempfile.TemporaryDirectory() as folder:
        data = Path(folder) / "perf.data"
        done = subprocess.run(["perf", "record", "-q", "-o", data, *command], capture_output=True, text=True)
        if done.returncode not in (0, 5):
            sys.exit(f"profile: error: {' '.join(map(str, command))}: exit {done.returncode}: {done.stderr.strip()}")
        report = subprocess.run(["perf", "report", "-i", data, "--stdio", "--no-children"], capture_output=True,
                                text=True).stdout
    rows = [re.match(r"\s*([\d.]+)%\s+\S+\s+(\S+)\s+\[.\]\s+(.*)", line) for line in report.splitlines()]
    return [(float(r[1]), f"{r[3].strip()}") for r in rows if r]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("geometry")
    parser.add_argument("sizing")
    parser.add_argument("--bin", type=Path, default=ROOT / "build/release/bin")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        samples = samples_of([str(arguments.bin / "st-mesh"), arguments.geometry, arguments.sizing, "-o",
                              f"{folder}/patches.hdf", "-q"])
    shares = {name: 0.0 for name, _ in KINDS} | {"other": 0.0}
    for share, symbol in samples:
        shares[next((name for name, pattern in KINDS if re.search(pattern, symbol)), "other")] += share
    for name, share in shares.items():
        print(f"{share:5.1f} %  {name}")


if __name__ == "__main__":
    main()
