#!/usr/bin/env python3
"""What joining smooth faces does to meshes at default sizes: a line for each model and value of --composite.

usage: composite_table.py [--bin DIR] [--work DIR] [--modes none,harm] [--jobs 2] [--seconds 120] MODEL|FOLDER ...

Of folders all CAD files are taken. A mode that joins nothing is no run of its own: it has the numbers of "none".

Columns: model, mode, triangles, those below 10 and 20 degrees; of those below 10 degrees how many touch an edge along
which normals stay within 3 degrees (smooth), no edge at all (inside) and only edges that turn by more (real), as
st-check tells; their causes; exit code of st-check; pairs of triangles that cross and folds (wrong); seconds of the
chain; composites joined, refused and divided, with reasons, and what st-mesh took apart.

The last lines are sums of the models that all modes meshed: all of them, without the model that has most triangles
below 10 degrees, those whose faces were joined, medians of the changes of these, and the reasons of refusals.
"""
import argparse
import collections
import concurrent.futures
import json
import re
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import h5py
import numpy

CAD_SUFFIXES = {".step", ".stp", ".iges", ".igs", ".brep"}
COUNTS = ("triangles", "below 10", "below 20", "smooth", "inside", "real", "seconds")


def smallest_angles(mesh):
    """Of all triangles, and which of them touch no edge."""
    with h5py.File(mesh) as file:
        x, corner = file["VTKHDF/Points"][:], file["VTKHDF/Connectivity"][:].reshape(-1, 3)
        is_inside = (file["VTKHDF/PointData/entity_dim"][:][corner] == 2).all(axis=1)
    side = [x[corner[:, (k + 2) % 3]] - x[corner[:, (k + 1) % 3]] for k in range(3)]
    length = [numpy.linalg.norm(s, axis=1) for s in side]
    with numpy.errstate(all="ignore"):
        cosine = [-(side[k - 1] * side[k - 2]).sum(axis=1) / (length[k - 1] * length[k - 2]) for k in range(3)]
        angle = numpy.degrees(numpy.arccos(numpy.clip(cosine, -1, 1)))
    return numpy.nan_to_num(angle).min(axis=0), is_inside


class NoMesh(Exception):
    """A tool of the chain failed, and which."""


class Joining:
    """What st-import -v says of joining."""

    def __init__(self, said):
        found = re.search(r"\((\d+) faces became (\d+)\)", said)
        self.n_joined = int(found[2]) if found else 0
        self.apart = ""
        self.divided = re.findall(r"^  divided: .*?\): (.*)$", said, re.M)
        self.refused = re.findall(r"^  not joined: .*?\): (.*)$", said, re.M)
        self.stays = re.findall(r"^  stays: (.*)$", said, re.M)

    def text(self):
        reasons = "; ".join(sorted({*self.divided, *self.refused}))
        counts = f"{self.n_joined} joined, {len(self.refused)} refused, {len(self.divided)} divided"
        return " ".join([counts, reasons]).strip() + self.apart


class Chain:
    def __init__(self, options, folder):
        self.tools, self.folder, self.end = options.bin, folder, time.monotonic() + options.seconds
        self.seconds = 0.0

    def run(self, tool, *arguments):
        begin = time.monotonic()
        command = [str(self.tools / tool), *map(str, arguments)]
        try:
            done = subprocess.run(command, capture_output=True, text=True, timeout=max(1, self.end - begin))
        except subprocess.TimeoutExpired:
            raise NoMesh(f"{tool}: late") from None
        self.seconds += time.monotonic() - begin
        return done

    def file(self, name):
        return self.folder / f"{name}.hdf"

    def need(self, tool, *arguments):
        done = self.run(tool, *arguments)
        if done.returncode not in (0, 5):
            raise NoMesh(f"{tool}: code {done.returncode}")
        return done.stdout + done.stderr

    def join(self, model, mode):
        return Joining(self.need("st-import", model, "-o", self.file("geometry"), "--composite", mode, "-v"))

    def mesh(self):
        """What st-mesh says of composites that fail, exit code and JSON of st-check."""
        apart = []
        for tool, inputs, output in (("st-raster", ["geometry"], "raster"), ("st-prolong", ["raster"], "sizing"),
                                     ("st-mesh", ["geometry", "sizing"], "patches"), ("st-merge", ["patches"], "mesh")):
            said = self.need(tool, *map(self.file, inputs), "-o", self.file(output), "--threads", 1)
            apart += re.findall(r"^  (.* apart)$", said, re.M) if tool == "st-mesh" else []
        seconds = self.seconds
        done = self.run("st-check", self.file("mesh"), "--geometry", self.file("geometry"), "--json", "--threads", 1)
        self.seconds = seconds
        if not self.file("mesh").exists() or not done.stdout:
            raise NoMesh("no mesh")
        return "".join("; " + line for line in apart), done.returncode, json.loads(done.stdout)


class Row:
    def __init__(self, chain, mode, composites):
        self.mode, self.composites = mode, composites
        composites.apart, self.code, said = chain.mesh()
        self.n_wrong = said["crossings"] + said["folds"]
        angle, is_inside = smallest_angles(chain.file("mesh"))
        sharp, smooth = said["causes"]["sharp"], said["causes"]["sharp"]["at_smooth_edges"]
        self.worst = sharp["worst"]
        below10, inside = int((angle < 10).sum()), int(((angle < 10) & is_inside).sum())
        self.counts = [len(angle), below10, int((angle < 20).sum()), smooth, inside, below10 - smooth - inside,
                       chain.seconds]
        self.causes = ", ".join(f"{n} {cause}" for cause, n in sharp["by_cause"].items() if n) or "-"

    def text(self, model):
        counts = [*self.counts[:-1], self.causes, self.code, self.n_wrong, f"{self.counts[-1]:.2f}",
                  self.composites.text()]
        return "\t".join(map(str, [model.name, self.mode, *counts]))


def rows_of(options, modes, model):
    """Lines of a model, and its rows by mode; none where one has no mesh."""
    rows, lines = {}, []
    for mode in modes:
        with tempfile.TemporaryDirectory() as folder:
            chain = Chain(options, Path(folder))
            try:
                composites = chain.join(model, mode)
                if composites.n_joined == 0 and "none" in rows:
                    rows[mode] = rows["none"]
                    lines.append(f"{model.name}\t{mode}\tas none\t{composites.text()}")
                    continue
                rows[mode] = Row(chain, mode, composites)
                lines.append(rows[mode].text(model))
            except NoMesh as why:
                lines.append(f"{model.name}\t{mode}\tno mesh\t{why}")
    return lines, rows if len(rows) == len(modes) else {}


def share(before, after):
    return f"{100 * (after / before - 1):+.1f} %" if before else "-"


def print_sums(title, all_rows, modes):
    """`all_rows`: rows by mode, one for each model."""
    sums = {mode: numpy.sum([rows[mode].counts for rows in all_rows], axis=0) for mode in modes} if all_rows else {}
    for mode, sum_of in sums.items():
        first = sums[modes[0]]
        changes = " ".join(share(first[k], sum_of[k]) for k in (1, 2, 3)) if mode != modes[0] else ""
        counts = "\t".join(f"{x:.0f}" for x in sum_of[:-1])
        print(f"{title}, {len(all_rows)} models\t{mode}\t{counts}\t{sum_of[-1]:.2f}\t{changes}")


def print_medians(all_rows, modes):
    for mode in modes[1:]:
        for k in (1, 2):
            changes = [100 * (rows[mode].counts[k] / rows[modes[0]].counts[k] - 1) for rows in all_rows
                       if rows[modes[0]].counts[k]]
            if changes:
                print(f"median of changes of {len(changes)} models, {COUNTS[k]}\t{mode}\t"
                      f"{statistics.median(changes):+.1f} %")


def add_options(parser):
    parser.add_argument("--bin", type=Path, default=Path("build/check/bin"))
    parser.add_argument("--work", type=Path, help="folder for what is made meanwhile")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=120, help="of the chain of one model in one mode")
    parser.add_argument("model", type=Path, nargs="+")


def models_of(given):
    """Files as they are; of folders all CAD files."""
    return [m for path in given for m in (sorted(path.rglob("*")) if path.is_dir() else [path])
            if m == path or m.suffix.lower() in CAD_SUFFIXES]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--modes", default="none,harm")
    add_options(parser)
    options = parser.parse_args()
    tempfile.tempdir = str(options.work) if options.work else None
    modes = options.modes.split(",")
    models = models_of(options.model)
    print("\t".join(["model", "mode", *COUNTS[:-1], "causes", "code", "wrong", COUNTS[-1], "composites"]))
    all_rows = []
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for lines, rows in pool.map(lambda m: rows_of(options, modes, m), models):
            print("\n".join(lines), flush=True)
            all_rows += [rows] if rows else []
    print_sums("all", all_rows, modes)
    worst = max(all_rows, key=lambda rows: rows[modes[0]].counts[1], default=None)
    print_sums("without the worst", [rows for rows in all_rows if rows is not worst], modes)
    joined = [rows for rows in all_rows if any(rows[mode].composites.n_joined for mode in modes)]
    print_sums("with composites", joined, modes)
    print_medians(joined, modes)
    for mode in modes[1:]:
        composites = [rows[mode].composites for rows in all_rows]
        reasons = collections.Counter(why for u in composites for why in u.refused)
        print(f"composites\t{mode}\t{sum(u.n_joined for u in composites)} joined, {sum(reasons.values())} refused, "
              f"{sum(len(u.divided) for u in composites)} divided")
        for why, n in reasons.most_common():
            print(f"refused\t{mode}\t{n}\t{why}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
