#!/usr/bin/env python3
"""Share of the lines of lib that ran, by layer, against the floors of tests/coverage_floors.txt.

usage: coverage.py BUILD_DIR             after the tests of a build with --coverage (preset asan); exit 1 below a floor
       coverage.py BUILD_DIR --update    write what is measured, rounded down, as floors
       coverage.py --self-test           a layer below its floor, one without a floor and one without lines are found
"""
import json
import os
import subprocess
import sys
from collections import defaultdict
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
FLOORS = ROOT / "tests/coverage_floors.txt"


def measure(build):
    """gcovr's summary of the objects of lib: [{"filename", "line_covered", "line_total"}]."""
    objects = sorted(str(p) for p in (build / "CMakeFiles").glob("st_*.dir"))
    command = ["gcovr", "--root", ROOT, "--object-directory", build, "--filter", str(ROOT / "lib") + "/",
               "-j", str(os.cpu_count()), "--json-summary", "-", *objects]
    output = subprocess.run(command, cwd=ROOT, stdout=subprocess.PIPE, text=True, check=True).stdout
    return json.loads(output)["files"]


def percent_by_layer(files):
    covered, total = defaultdict(int), defaultdict(int)
    for file in files:
        layer = Path(file["filename"]).parts[1]
        covered[layer] += file["line_covered"]
        total[layer] += file["line_total"]
    return {layer: 100 * covered[layer] / total[layer] for layer in sorted(total) if total[layer]}


def read_floors():
    lines = FLOORS.read_text(encoding="utf-8").splitlines() if FLOORS.is_file() else []
    return {layer: float(percent) for layer, percent in (line.split() for line in lines if line.strip())}


def violations(percents, floors):
    for layer in sorted(percents.keys() | floors.keys()):
        if layer not in floors:
            yield f"coverage: {layer} has no floor; run scripts/coverage.py with --update"
        elif percents.get(layer, 0) < floors[layer]:
            measured, floor = percents.get(layer, 0), floors[layer]
            yield f"coverage: {layer} {measured:.1f} %, its floor is {floor:.0f} %; write tests for what is new"


def self_test():
    counts = {"lib/base/a.cpp": (3, 4), "lib/mesh/b.cpp": (9, 10), "lib/mesh/c.cpp": (0, 10)}
    files = [{"filename": f, "line_covered": covered, "line_total": total} for f, (covered, total) in counts.items()]
    found = list(violations(percent_by_layer(files), {"base": 75, "mesh": 46, "io": 1}))
    expected = ["coverage: io 0.0 %", "coverage: mesh 45.0 %"]
    found += list(violations(percent_by_layer(files), {"mesh": 45}))
    expected += ["coverage: base has no floor"]
    return 0 if [f[:len(e)] for f, e in zip(found, expected)] == expected and len(found) == len(expected) else 1


def main():
    if "--self-test" in sys.argv:
        return self_test()
    percents = percent_by_layer(measure(Path(sys.argv[1]).resolve()))
    for layer, percent in percents.items():
        print(f"coverage: {layer:9} {percent:5.1f} % of lines")
    if "--update" in sys.argv:
        FLOORS.write_text("".join(f"{layer} {int(percent)}\n" for layer, percent in percents.items()), encoding="utf-8")
        return 0
    found = list(violations(percents, read_floors()))
    print("\n".join(found), end="\n" if found else "")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
