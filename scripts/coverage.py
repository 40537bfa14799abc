#!/usr/bin/env python3
"""Share of the lines of lib that ran, by layer, against the floors of tests/coverage_floors.txt.

usage: coverage.py BUILD_DIR [LAYER...]   after tests of objects compiled with --coverage; exit 1 below a floor
       coverage.py BUILD_DIR [LAYER...] --update   write what is measured, rounded down, as floors of these layers
       coverage.py BUILD_DIR --clean      forget what ran so far
       coverage.py --self-test            a layer below its floor, one without a floor and one without lines are found

LAYER: those that count; default: all that have a floor or lines.
"""
import concurrent.futures
import json
import os
import subprocess
import sys
from collections import defaultdict
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
FLOORS = ROOT / "tests/coverage_floors.txt"
CHUNK = 8  # files for one call of gcov


def compiled_in(build):
    """Where the compiler ran, to which paths of sources are relative."""
    return next(folder for folder in [build, *build.parents] if (folder / "build.ninja").is_file())


def gather_counts(build):
    """Moves counts from counts/, where GCOV_PREFIX put them, to their objects, whatever clone compiled these."""
    for counter in sorted((build / "counts").rglob("*.gcda")):
        path = str(counter)
        counter.replace(build / path[path.rindex("/CMakeFiles/") + 1:])


def read_counts(counters, folder):
    """{source file: {line: it ran}} of some .gcda files of objects compiled in a folder."""
    command = ["gcov", "--json-format", "--stdout", *map(str, counters)]
    output = subprocess.run(command, cwd=ROOT, stdout=subprocess.PIPE, text=True, check=True).stdout
    lines = defaultdict(lambda: defaultdict(bool))
    for report in map(json.loads, output.splitlines()):
        for file in report["files"]:
            path = os.path.normpath(os.path.join(folder, file["file"]))
            if path.startswith(f"{ROOT}/lib/"):
                for line in file["lines"]:
                    lines[path[len(f"{ROOT}/"):]][line["line_number"]] |= line["count"] > 0
    return {path: dict(ran) for path, ran in lines.items()}


def measure(build):
    """The same for all that ran in a build."""
    gather_counts(build)
    counters = sorted(build.rglob("*.gcda"))
    if not counters:
        sys.exit(f"coverage: error: no .gcda file below {build}; build with --coverage and run the tests")
    merged = defaultdict(lambda: defaultdict(bool))
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        chunks = [counters[i:i + CHUNK] for i in range(0, len(counters), CHUNK)]
        for counts in pool.map(read_counts, chunks, [compiled_in(build)] * len(chunks)):
            for path, ran in counts.items():
                for line, has_run in ran.items():
                    merged[path][line] |= has_run
    return merged


def percent_by_layer(files):
    covered, total = defaultdict(int), defaultdict(int)
    for path, ran in files.items():
        layer = Path(path).parts[1]
        covered[layer] += sum(ran.values())
        total[layer] += len(ran)
    return {layer: 100 * covered[layer] / total[layer] for layer in sorted(total) if total[layer]}


def read_floors():
    lines = FLOORS.read_text(encoding="utf-8").splitlines() if FLOORS.is_file() else []
    return {layer: float(percent) for layer, percent in (line.split() for line in lines if line.strip())}


def violations(percents, floors, layers):
    for layer in layers or sorted(percents.keys() | floors.keys()):
        if layer not in floors:
            yield f"coverage: {layer} has no floor; run scripts/coverage.py with --update"
        elif percents.get(layer, 0) < floors[layer]:
            measured, floor = percents.get(layer, 0), floors[layer]
            yield f"coverage: {layer} {measured:.1f} %, its floor is {floor:.0f} %; write tests for what is new"


def self_test():
    files = {"lib/base/a.cpp": {1: True, 2: True, 3: True, 4: False}, "lib/mesh/b.cpp": {1: True, 2: False}}
    found = list(violations(percent_by_layer(files), {"base": 75, "mesh": 51, "io": 1}, []))
    expected = ["coverage: io 0.0 %", "coverage: mesh 50.0 %"]
    found += list(violations(percent_by_layer(files), {"mesh": 50, "io": 1}, ["base", "mesh"]))
    expected += ["coverage: base has no floor"]
    return 0 if [f[:len(e)] for f, e in zip(found, expected)] == expected and len(found) == len(expected) else 1


def main():
    if "--self-test" in sys.argv:
        return self_test()
    build, *layers = [a for a in sys.argv[1:] if not a.startswith("--")]
    build = Path(build).resolve()
    if "--clean" in sys.argv:
        for counters in build.rglob("*.gcda"):
            counters.unlink()
        return 0
    percents = {layer: p for layer, p in percent_by_layer(measure(build)).items() if layer in layers or not layers}
    for layer, percent in percents.items():
        print(f"coverage: {layer:9} {percent:5.1f} % of lines")
    if "--update" in sys.argv:
        floors = read_floors() | {layer: int(percent) for layer, percent in percents.items()}
        FLOORS.write_text("".join(f"{layer} {floors[layer]:.0f}\n" for layer in sorted(floors)), encoding="utf-8")
        return 0
    found = list(violations(percents, read_floors(), layers))
    print("\n".join(found), end="\n" if found else "")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
