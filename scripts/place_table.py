#!/usr/bin/env python3
"""Triangles and verdicts of the same shapes moved, turned, scaled, mirrored, reordered, or given as loose faces.

usage: scripts/place_table.py BUILD_DIR MODEL... [--variants moved,turned] [--lmax 5%]
A line for each model, a column for each variant of tests/support/vary_model: triangles in per cent of those of the
shape as it is, and what else differs: the verdict, faces without triangles, area. BUILD_DIR holds bin/ and
tests/support/vary_model.
"""
import argparse
import json
import subprocess
import tempfile
from pathlib import Path

VARIANTS = ["moved", "turned", "tumbled", "scaled", "mirrored", "reordered", "loose", "reversed"]
SCALE = {"scaled": 1e-6}  # of areas
SECONDS = 300  # of each stage
OK, INCOMPLETE = 0, 5


def run(*command):
    """Exit code and the last line of output; "late" after SECONDS."""
    try:
        done = subprocess.run([str(c) for c in command], capture_output=True, text=True, errors="replace",
                              timeout=SECONDS)
    except subprocess.TimeoutExpired:
        return "late", ""
    return done.returncode, done.stdout.splitlines()[-1] if done.stdout.strip() else ""


def report_of(bin_dir, model, raster_options, folder):
    """The report of st-check; the name of the stage that failed where there is none."""
    path = {n: folder / f"{n}.hdf" for n in ("geometry", "raster", "sizing", "patches", "mesh")}
    stages = [("st-import", model, "-o", path["geometry"]),
              ("st-raster", path["geometry"], "-o", path["raster"], *raster_options),
              ("st-prolong", path["raster"], "-o", path["sizing"]),
              ("st-mesh", path["geometry"], path["sizing"], "-o", path["patches"]),
              ("st-merge", path["patches"], "-o", path["mesh"], "--allow-incomplete")]
    for tool, *arguments in stages:
        code, _ = run(bin_dir / tool, *arguments, "-q")
        if code not in (OK, INCOMPLETE):
            return f"{tool} {code}"
    code, line = run(bin_dir / "st-check", path["mesh"], "--geometry", path["geometry"], "--sizing", path["sizing"],
                     "--json")
    return json.loads(line) if line.startswith("{") else f"st-check {code}"


def compared(report, same, area_scale):
    """Triangles in per cent, and what else differs."""
    if isinstance(report, str) or isinstance(same, str):
        return report if isinstance(report, str) else "-"
    cell = f"{100 * report['triangles'] / same['triangles']:.1f}"
    for key, word in (("passes", "passes" if report["passes"] else "fails"),
                      ("closed", "closed" if report["closed"] else "open"),
                      ("components", f"{report['components']} pieces")):
        if report[key] != same[key]:
            cell += f", {word}"
    if len(report["failed"]) != len(same["failed"]):
        cell += f", {len(report['failed'])} faces fail"
    off = report["area"] / (area_scale * same["area"]) - 1
    return cell + (f", area {100 * off:+.2f} %" if abs(off) > 2e-3 else "")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build_dir", type=Path)
    parser.add_argument("models", type=Path, nargs="+")
    parser.add_argument("--variants", default=",".join(VARIANTS))
    parser.add_argument("--lmax", default="")
    parser.add_argument("--bin", type=Path, help="the tools, where they are not in BUILD_DIR/bin")
    arguments = parser.parse_args()
    variants = arguments.variants.split(",")
    raster_options = ["--lmax", arguments.lmax] if arguments.lmax else []
    bin_dir = arguments.bin or arguments.build_dir / "bin"
    print(f"| model | triangles | {' | '.join(variants)} |")
    print("|---|" + "--:|" * (len(variants) + 1))
    for model in arguments.models:
        reports = {}
        for variant in ["same", *variants]:
            with tempfile.TemporaryDirectory() as folder:
                varied = Path(folder) / "model.brep"
                code, _ = run(arguments.build_dir / "tests/support/vary_model", model, varied, variant)
                reports[variant] = report_of(bin_dir, varied, raster_options, Path(folder)) if code == OK else "-"
        same = reports["same"]
        n = same if isinstance(same, str) else f"{same['triangles']:,}"
        cells = [compared(reports[v], same, SCALE.get(v, 1)) for v in variants]
        print(f"| {model.name} | {n} | {' | '.join(cells)} |", flush=True)


if __name__ == "__main__":
    main()
