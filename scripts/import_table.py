#!/usr/bin/env python3
"""Imports every CAD file of the corpus and compares what st-import says with what INDEX.tsv says: one table.

usage: scripts/import_table.py BIN_DIR [--models GLOB] [--format md|tsv] [--free-edges]

The corpus is ST_CORPUS (default ../shared/corpus beside the repository). A file that the index calls closed, or unsewn
and closable, must come out closed with the same number of faces; every free edge of an open one must be listed with its
place. --free-edges prints these places below the table. Exit 1 when a file does not fit the index, fails or takes more
than --time-limit seconds (default 60), else 0.
"""
import argparse
import csv
import fnmatch
import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
CORPUS = Path(os.environ.get("ST_CORPUS") or ROOT / "../shared/corpus").resolve()
SUFFIXES = {".step", ".stp", ".iges", ".igs", ".brep", ".fli"}
COLUMNS = ["model", "index", "import", "solids", "shells", "faces", "free edges", "non-manifold", "findings", "repairs",
           "seconds", "verdict"]


def models(pattern):
    with open(CORPUS / "INDEX.tsv", newline="") as f:
        for row in csv.DictReader(f, delimiter="\t"):
            if Path(row["file"]).suffix.lower() in SUFFIXES and fnmatch.fnmatch(row["file"], pattern):
                yield row


def run_import(tool, path, output, limit):
    start = time.monotonic()
    try:
        run = subprocess.run([tool, path, "-o", output, "-q", "--json"], capture_output=True, text=True, timeout=limit)
    except subprocess.TimeoutExpired:
        return None, f"more than {limit} s", time.monotonic() - start
    seconds = time.monotonic() - start
    if run.returncode != 0:
        return None, f"exit {run.returncode}: {run.stderr.strip().splitlines()[-1:]}", seconds
    return json.loads(run.stdout.splitlines()[-1]), "", seconds


def expected(row):
    return "OPEN" if row["closed"].startswith("OPEN") else "closed"


def verdict(row, report):
    """What does not fit the index; empty when everything does."""
    wrong = []
    if row["faces"].isdigit() and int(row["faces"]) != report["faces"]:
        wrong.append(f"{row['faces']} faces expected")
    if expected(row) == "closed" and not report["closed"]:
        wrong.append("closed expected")
    listed = [f for f in report["findings"] if f["what"] == "free edge" and len(f["xyz"]) == 3]
    if len(listed) != report["free_edges"]:
        wrong.append(f"{len(listed)} of {report['free_edges']} free edges listed")
    return "; ".join(wrong)


def remark(row, report):
    return "ok, closed though the index says open" if expected(row) == "OPEN" and report["closed"] else "ok"


def table_row(row, report, error, seconds):
    if report is None:
        return [row["file"], expected(row)] + [""] * 8 + [f"{seconds:.2f}", error]
    state = "closed" if report["closed"] else "open"
    return [row["file"], expected(row), state,
            *(str(report[k]) for k in ("solids", "shells", "faces", "free_edges", "nonmanifold_edges")),
            str(len(report["findings"])), str(len(report["repairs"])), f"{seconds:.2f}", verdict(row, report)
            or remark(row, report)]


def print_table(rows, style):
    if style == "tsv":
        print("\n".join("\t".join(r) for r in [COLUMNS] + rows))
        return
    print("| " + " | ".join(COLUMNS) + " |")
    print("|" + "---|" * len(COLUMNS))
    for r in rows:
        print("| " + " | ".join(r) + " |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin_dir")
    parser.add_argument("--models", default="*")
    parser.add_argument("--format", choices=["md", "tsv"], default="md")
    parser.add_argument("--free-edges", action="store_true")
    parser.add_argument("--time-limit", type=float, default=60)
    args = parser.parse_args()
    tool = Path(args.bin_dir) / "st-import"
    if not (CORPUS / "INDEX.tsv").exists():
        sys.exit(f"{CORPUS}: no corpus here; set ST_CORPUS")
    rows, details = [], []
    with tempfile.TemporaryDirectory() as folder:
        for row in models(args.models):
            report, error, seconds = run_import(tool, CORPUS / row["file"], Path(folder) / "g.hdf", args.time_limit)
            rows.append(table_row(row, report, error, seconds))
            for f in (report or {"findings": []})["findings"]:
                if f["what"] == "free edge":
                    details.append(f"{row['file']}: {f['entity']} at ({', '.join(f'{x:.6g}' for x in f['xyz'])}), "
                                   f"length {f['size']:.4g}")
    print_table(rows, args.format)
    if args.free_edges:
        print("\n" + "\n".join(details))
    return 0 if all(r[-1].startswith("ok") for r in rows) else 1


if __name__ == "__main__":
    sys.exit(main())
