#!/usr/bin/env python3
"""Triangles and quality with stretched sizes, against the same lengths in all directions: for docs/dev/bench.md.

usage: scripts/stretch_table.py BIN_DIR MODEL... [--max-aspect 16]
"""
import argparse
import json
import tempfile
from pathlib import Path

from table_common import run


def checked(bin_dir, geometry, folder, aspect):
    """The report of st-check."""
    path = {n: folder / f"{n}.hdf" for n in ("raster", "sizing", "patches", "mesh")}
    run(bin_dir / "st-raster", geometry, "--max-aspect", aspect, "-o", path["raster"], "-q")
    run(bin_dir / "st-prolong", path["raster"], "-o", path["sizing"], "-q")
    run(bin_dir / "st-mesh", geometry, path["sizing"], "-o", path["patches"], "-q")
    run(bin_dir / "st-merge", path["patches"], "-o", path["mesh"], "--allow-incomplete", "-q")
    check = [bin_dir / "st-check", path["mesh"], "--geometry", geometry, "--sizing", path["sizing"], "--json"]
    return json.loads(run(*check))


def row(bin_dir, model, aspect, folder):
    geometry = folder / "geometry.hdf"
    run(bin_dir / "st-import", model, "-o", geometry, "-q")
    plain, long = checked(bin_dir, geometry, folder, 1), checked(bin_dir, geometry, folder, aspect)
    share = 100 * long["triangles"] / plain["triangles"]
    quality, before = long["quality"], plain["quality"]
    normals = [r["deviation"]["normal_mean_deg"] for r in (plain, long)]
    off = [100 * (long[key] / plain[key] - 1) for key in ("area", "volume") if plain.get(key)]
    shape = " / ".join(f"{x:+.3f} %" for x in off)
    defects = ", ".join(str(long[key]) for key in ("folds", "crossings", "boundary_edges"))
    cells = [model.name, f"{plain['triangles']:,}", f"{long['triangles']:,}", f"{share:.0f} %",
             f"{before['mean']:.3f} / {before['p1']:.3f}", f"{quality['mean']:.3f} / {quality['p1']:.3f}",
             str(quality["above_150_deg"]), defects, f"{normals[0]:.2f}° / {normals[1]:.2f}°", shape]
    print(f"| {' | '.join(cells)} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin_dir", type=Path)
    parser.add_argument("models", type=Path, nargs="+")
    parser.add_argument("--max-aspect", default="16")
    arguments = parser.parse_args()
    heads = ["model", "triangles", "stretched", "share", "quality: mean / p1", "stretched", "above 150°",
             "folds, crossings, open edges", "normals off by", "area / volume"]
    print(f"| {' | '.join(heads)} |")
    print("|---|" + "--:|" * (len(heads) - 1))
    for model in arguments.models:
        with tempfile.TemporaryDirectory() as folder:
            row(arguments.bin_dir, model, arguments.max_aspect, Path(folder))


if __name__ == "__main__":
    main()
