#!/usr/bin/env python3
"""What joining smooth faces does to meshes at default sizes: a line for each model and value of --composite.

usage: composite_table.py [--bin DIR] [--work DIR] [--modes none,harm,smooth] MODEL ...

Columns: model, mode, triangles, those below 10 and 20 degrees; of these, those that a corner, a strip, a short
edge or a size jump forces, and the others (free), as st-check tells; exit code of st-check; seconds of the
chain; what st-import says of joining. The last lines are sums of the models that all modes meshed.
"""
import argparse
import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import h5py
import numpy


def smallest_angles(mesh):
    with h5py.File(mesh) as file:
        x, corner = file["VTKHDF/Points"][:], file["VTKHDF/Connectivity"][:].reshape(-1, 3)
    side = [x[corner[:, (k + 2) % 3]] - x[corner[:, (k + 1) % 3]] for k in range(3)]
    length = [numpy.linalg.norm(s, axis=1) for s in side]
    with numpy.errstate(all="ignore"):
        cosine = [-(side[k - 1] * side[k - 2]).sum(axis=1) / (length[k - 1] * length[k - 2]) for k in range(3)]
        angle = numpy.degrees(numpy.arccos(numpy.clip(cosine, -1, 1)))
    return numpy.nan_to_num(angle).min(axis=0)


class Chain:
    def __init__(self, tools, folder):
        self.tools, self.folder, self.seconds = tools, folder, 0.0

    def run(self, tool, *arguments):
        begin = time.monotonic()
        done = subprocess.run([str(self.tools / tool), *map(str, arguments)], capture_output=True, text=True)
        self.seconds += time.monotonic() - begin
        return done

    def file(self, name):
        return self.folder / f"{name}.hdf"

    def mesh(self, model, mode):
        """Returns what st-import says of joining, or None where no mesh comes of it."""
        said = self.run("st-import", model, "-o", self.file("geometry"), "--composite", mode)
        if said.returncode != 0:
            return None
        for tool, inputs, output in (("st-raster", ["geometry"], "raster"), ("st-prolong", ["raster"], "sizing"),
                                     ("st-mesh", ["geometry", "sizing"], "patches"), ("st-merge", ["patches"], "mesh")):
            if self.run(tool, *map(self.file, inputs), "-o", self.file(output)).returncode not in (0, 5):
                return None
        return said.stdout.strip().split("; ", 1)[-1].split("repairs")[-1].lstrip("; ")

    def check(self):
        seconds = self.seconds
        done = self.run("st-check", self.file("mesh"), "--geometry", self.file("geometry"), "--json")
        self.seconds = seconds
        return done.returncode, json.loads(done.stdout)


def causes(said):
    by_cause = said["causes"]["sharp"]["by_cause"]
    return ", ".join(f"{n} {cause}" for cause, n in by_cause.items() if n) or "-"


def row(tools, model, mode):
    with tempfile.TemporaryDirectory() as folder:
        chain = Chain(tools, Path(folder))
        joining = chain.mesh(model, mode)
        if joining is None or not chain.file("mesh").exists():
            return None, f"{model.name}\t{mode}\tno mesh"
        angle, (code, said) = smallest_angles(chain.file("mesh")), chain.check()
        counts = [len(angle), int((angle < 10).sum()), int((angle < 20).sum()), chain.seconds]
        text = [model.name, mode, *counts[:3], causes(said), code, f"{chain.seconds:.2f}", joining]
        return counts, "\t".join(map(str, text))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=Path, default=Path("build/check/bin"))
    parser.add_argument("--work", type=Path, help="folder for what is made meanwhile")
    parser.add_argument("--modes", default="none,harm,smooth")
    parser.add_argument("model", type=Path, nargs="+")
    options = parser.parse_args()
    tempfile.tempdir = str(options.work) if options.work else None
    modes = options.modes.split(",")
    sums = {mode: numpy.zeros(4) for mode in modes}
    for model in options.model:
        rows = [row(options.bin, model, mode) for mode in modes]
        for _, text in rows:
            print(text, flush=True)
        if all(counts for counts, _ in rows):
            for mode, (counts, _) in zip(modes, rows):
                sums[mode] += counts
    for mode, (n, below10, below20, seconds) in sums.items():
        print(f"all\t{mode}\t{n:.0f}\t{below10:.0f}\t{below20:.0f}\t\t\t{seconds:.2f}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
