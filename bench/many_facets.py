#!/usr/bin/env python3
"""A binary STL file of many facets, imported and meshed: seconds and memory; figures in docs/dev/bench.md.

usage: bench/many_facets.py BIN_DIR [FACETS ...]

BIN_DIR holds the tools. The file is a ring with waves across and along it: closed, of genus 1, each facet with
normals of its own. Seconds are those of the clock, memory is the largest resident set of a process.
"""
import os
import sys
import tempfile
import time
from pathlib import Path

import numpy

RING, TUBE = 3.0, 1.0  # metres: radius of the ring and of what runs along it


def write_ring(file, facets):
    """A grid of N by N quadrilaterals, each cut in two."""
    steps = round((facets / 2) ** 0.5)
    turn = numpy.linspace(0, 2 * numpy.pi, steps, endpoint=False)
    along, around = numpy.meshgrid(turn, turn, indexing="ij")
    tube = TUBE + 0.08 * numpy.sin(7 * along) * numpy.cos(5 * around) + 0.02 * numpy.sin(31 * along + 3 * around)
    out = RING + 0.3 * numpy.cos(3 * along) + tube * numpy.cos(around)
    nodes = numpy.stack([out * numpy.cos(along), out * numpy.sin(along), tube * numpy.sin(around)], -1).astype("<f4")
    right = numpy.roll(nodes, -1, 0)
    up, across = numpy.roll(nodes, -1, 1), numpy.roll(right, -1, 1)
    halves = [numpy.stack(half, 2).reshape(-1, 3, 3) for half in ((nodes, right, across), (nodes, across, up))]
    records = numpy.zeros(2 * steps * steps, dtype=[("normal", "<f4", 3), ("nodes", "<f4", (3, 3)), ("bytes", "<u2")])
    records["nodes"] = numpy.concatenate(halves)
    with open(file, "wb") as out_file:
        out_file.write(bytes(80) + numpy.uint32(len(records)).tobytes())
        records.tofile(out_file)
    return len(records)


def measured(*command):
    """Seconds and gigabytes of a command that has to succeed."""
    begin = time.monotonic()
    child = os.posix_spawn(command[0], command, os.environ)
    _, status, usage = os.wait4(child, 0)
    if status != 0:
        sys.exit(f"{Path(command[0]).name} failed")
    return time.monotonic() - begin, usage.ru_maxrss / 1e6


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    print("| facets | st-import, s | GB | st-run, s | GB |\n|--:|--:|--:|--:|--:|")
    for facets in [int(n) for n in sys.argv[2:]] or [1_000_000, 5_000_000]:
        with tempfile.TemporaryDirectory() as folder:
            file, bin_dir = f"{folder}/ring.stl", os.path.abspath(sys.argv[1])
            count = write_ring(file, facets)
            cells = [count]
            cells += measured(f"{bin_dir}/st-import", file, "--unit", "m", "-o", f"{folder}/g.hdf", "-q")
            cells += measured(f"{bin_dir}/st-run", file, "--unit", "m", "-o", f"{folder}/m.hdf", "-q")
            print(f"| {cells[0]:,} | {cells[1]:.1f} | {cells[2]:.2f} | {cells[3]:.1f} | {cells[4]:.2f} |", flush=True)


if __name__ == "__main__":
    main()
