#!/usr/bin/env python3
"""st-run on many CAD files with defaults: what is wrong, and nobody says so?

A line of TABLE per file has the exit code of st-run, the verdict of st-check, that of an independent judge, and
how far area, volume and the worst face of the mesh are off those that OpenCASCADE finds in the file as it reads it
(tests/support/cad_measure.cpp). Silent is a file that ends with code 0 and "passes" although area or volume are off by
more than 1 % and the verdict does not say so, a face by more than 3 % that st-check does not count as below the sizes,
or the judge finds crossings inside a part, or folds that the CAD does not have. Areas of a model of which st-import
says that it left out or merged a face may differ. Files that TABLE has already are passed over: a stopped run goes on.

Exit code: 1 when a file is silent.

usage: find FOLDER -name '*.st*p' | scripts/many_files.py BIN_DIR TABLE [--seconds 300] [--jobs 2] [--run OPTIONS]
           [--measure PROGRAM] [--judge PROGRAM]
--seconds: of st-run, the measure and the judge. --run: options of st-run. --measure: cad_measure of the
tests, found beside BIN_DIR otherwise. --judge: gets the mesh, and --open for an open model; prints a line of JSON with
"folds" and "self_intersections".
"""
import argparse
import collections
import concurrent.futures
import json
import os
import re
import shlex
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

COLUMNS = ("file", "code", "shape", "verdict", "judge", "triangles", "area %", "volume %", "face %", "faces off",
           "below sizes", "seconds", "silent", "words")
WHOLE_LIMIT, FACE_LIMIT = 1, 3  # per cent
OTHER_AREA = re.compile(r"repaired: .*(left out|merged into it|without area)|: left out")  # st-import says so


def last_json(text):
    """The last line as an object; empty when it is none."""
    try:
        return json.loads(text.strip().splitlines()[-1])
    except (IndexError, ValueError):
        return {}


class Run:
    """Runs st-run on one file; what is found goes to `row`."""

    def __init__(self, options, model, folder):
        self.options, self.at = options, Path(folder)
        self.row = dict.fromkeys(COLUMNS, "")
        self.row["file"] = model
        self.words = []
        self.said = {}  # what the verdict says of area and volume, per cent
        self.folds = self.cad_folds = 0
        self.has_other_area = False

    def run(self, command):
        """Exit code ("late" after the limit), stdout, stderr. All that the command started ends with it."""
        process = subprocess.Popen([str(c) for c in command], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                   stdin=subprocess.DEVNULL, text=True, errors="replace", start_new_session=True)
        try:
            out, err = process.communicate(timeout=self.options.seconds)
            return process.returncode, out, err
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.communicate()
            return "late", "", f"{Path(command[0]).name}: no end in {self.options.seconds:g} s"

    def mesh(self):
        """Whether there is a mesh."""
        options = shlex.split(self.options.run)
        program = self.options.bin_dir / "st-run"
        code, out, err = self.run([program, self.row["file"], "--keep", self.at, "--json", *options])
        self.row["code"] = str(code)
        said = last_json(out)
        stages = said.get("stages", {})
        self.has_other_area = bool(OTHER_AREA.search(err))
        if "st-import" in stages:
            self.row["shape"] = "closed" if stages["st-import"]["closed"] else "open"
        if "st-check" in stages:
            self.read_verdict(stages["st-check"])
        elif code:
            self.words += [said.get("error") or " ".join(err.strip().splitlines()[-1:])]
        return (self.at / "mesh.hdf").exists()

    def read_verdict(self, found):
        self.row["triangles"] = found["triangles"]
        self.row["verdict"] = "passes" if found["passes"] else "fails: " + " ".join(found["failed"])
        self.row["below sizes"] = found["checks"].get("below-sizes", {}).get("count", 0)
        for key, column in (("area_difference", "area %"), ("volume_difference", "volume %")):
            if abs(found.get(key) or 0) > WHOLE_LIMIT / 100:
                self.said[column] = 100 * found[key]
                self.words.append(f"said: {column} {self.said[column]:.2f}")

    def measure(self):
        files = (self.row["file"], self.at / "mesh.hdf", self.at / "geometry.hdf")
        code, out, err = self.run([self.options.measure, *files])
        found = last_json(out)
        if code or not found:
            self.words.append(f"not measured: {err.strip() or code}")
            return
        for key, column in (("area_error", "area %"), ("volume_error", "volume %"), ("face_error", "face %")):
            if key in found:
                self.row[column] = f"{100 * found[key]:.2f}"
        self.row["faces off"] = found["wrong_faces"]
        self.cad_folds = found.get("cad_folds", 0)
        kinds = ("unsure_faces", "unpaired_faces", "inside_out_faces", "duplicates", "cad_folds")
        notes = [f"{found[k]} {k.replace('_', ' ')}" for k in kinds if found.get(k)]
        if found["wrong_faces"]:
            notes.insert(0, f"worst face {found['worst_face']} of area {found['worst_area']:.3g}")
        self.words += notes

    def ask_judge(self):
        if not self.options.judge:
            return
        is_open = self.row["shape"] == "open"
        code, out, _ = self.run([self.options.judge, self.at / "mesh.hdf", *(["--open"] if is_open else [])])
        found = last_json(out)
        if not found:
            self.row["judge"] = "late" if code == "late" else "no answer"
            return
        kinds = ("self_intersections", "folds", "degenerate", "nonmanifold_edges", "misoriented_edges",
                 "duplicate_nodes")
        self.folds = found.get("folds", 0)
        bad = [f"{found[k]} {k.replace('_', ' ')}" for k in kinds if found.get(k)]
        if found.get("boundary_edges") and not is_open:
            bad.append(f"{found['boundary_edges']} boundary edges")
        self.row["judge"] = ", ".join(bad) or "sound"

    def silent(self):
        """What is wrong although all tools say that it is right."""
        if self.row["verdict"] != "passes" or self.row["code"] != "0":
            return ""
        reasons = []
        if not self.has_other_area:
            reasons += [column for column in ("area %", "volume %") if self.row[column]
                        and abs(float(self.row[column]) - self.said.get(column, 0)) > WHOLE_LIMIT]
            if self.row["faces off"] and int(self.row["faces off"]) > int(self.row["below sizes"] or 0):
                reasons.append("face %")
        if "self intersections" in self.row["judge"]:
            reasons.append("self intersections")
        if self.folds > self.cad_folds:
            reasons.append("folds")
        return ", ".join(reasons)


def examine(options, model):
    start = time.monotonic()
    with tempfile.TemporaryDirectory() as folder:
        run = Run(options, model, folder)
        if run.mesh():
            run.measure()
            run.ask_judge()
    run.row["seconds"] = f"{time.monotonic() - start:.1f}"
    run.row["silent"] = run.silent()
    run.row["words"] = " | ".join(run.words).replace("\t", " ")
    return run.row


def read_table(path):
    if not path.exists():
        return []
    lines = path.read_text(encoding="utf-8").splitlines()
    return [dict(zip(COLUMNS, line.split("\t"))) for line in lines[1:] if line.count("\t") == len(COLUMNS) - 1]


def print_summary(rows):
    kinds = collections.Counter((r["code"], r["shape"], r["verdict"].split(":")[0],
                                 "judge: " + ("sound" if r["judge"] == "sound" else "not" if r["judge"] else "-"))
                                for r in rows)
    for kind, n in kinds.most_common():
        print(f"{n:6} {'  '.join(kind)}")
    silent = [r for r in rows if r["silent"]]
    print(f"{len(rows)} files, {len(silent)} silent")
    for r in silent:
        print(f"  {r['file']}: {r['silent']}; area {r['area %']} %, volume {r['volume %'] or '-'} %, "
              f"worst face {r['face %']} % ({r['faces off']} off), judge {r['judge'] or '-'}; {r['words']}")


def main():
    parser = argparse.ArgumentParser(usage=__doc__.replace("%", "%%"))
    parser.add_argument("bin_dir", type=lambda path: Path(path).resolve())
    parser.add_argument("table", type=Path)
    parser.add_argument("--seconds", type=float, default=300)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--run", default="")
    parser.add_argument("--measure", type=Path)
    parser.add_argument("--judge", type=Path)
    options = parser.parse_args()
    options.measure = options.measure or options.bin_dir.parent / "tests" / "support" / "cad_measure"
    if not options.measure.exists():
        sys.exit(f"many_files.py: error: {options.measure} is not there; build cad_measure, or give --measure")
    rows = read_table(options.table)
    done = {r["file"] for r in rows}
    models = [m for m in dict.fromkeys(line.rstrip("\n") for line in sys.stdin) if m and m not in done]
    is_new = not options.table.exists()
    with options.table.open("a", encoding="utf-8") as table, \
            concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        if is_new:
            print("\t".join(COLUMNS), file=table)
        for future in concurrent.futures.as_completed([pool.submit(examine, options, m) for m in models]):
            rows.append({k: str(v) for k, v in future.result().items()})
            print("\t".join(rows[-1][c] for c in COLUMNS), file=table, flush=True)
    print_summary(rows)
    sys.exit(any(r["silent"] for r in rows))


if __name__ == "__main__":
    main()
