#!/usr/bin/env python3
"""Whether TetGen and Gmsh fill the space between a stretched mesh and a far field: the table in docs/dev/bench.md.

Both come from Debian (packages tetgen, gmsh); each gets a limited time.

usage: scripts/fill_table.py BIN_DIR MODEL... [--max-aspect 16] [--preset P] [--farfield box:5] [--seconds 300]
       [--coarse] [--join]
--farfield none: the models have one, or are filled inside. --coarse: larger sizes, for models that would take long.
--join: solids that touch get common faces.
"""
import argparse
import re
import subprocess
import tempfile
from pathlib import Path

COARSE = ("--lmax", "10%", "--lmin", "0.5%", "--alpha", "20")
GEO = 'Merge "mesh.msh";\nSurface Loop(1) = Surface{:};\nVolume(1) = {1};\nMesh.Optimize = 0;\n'


def must(*command):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True)
    if done.returncode not in (0, 5):
        raise SystemExit(f"{command[0]}: {done.stderr}")
    return done.stdout


def make_mesh(bin_dir, model, folder, options):
    """Mesh and far field as mesh.smesh and mesh.msh; the number of triangles and what st-check says."""
    file = {n: folder / f"{n}.hdf" for n in ("geometry", "raster", "sizing", "patches", "mesh")}
    farfield = [] if options.farfield == "none" else ["--farfield", options.farfield]
    join = ["--join"] if options.join else []
    preset = ["--preset", options.preset] if options.preset else []
    must(bin_dir / "st-import", model, *farfield, *join, "-o", file["geometry"], "-q")
    sizes = ["--max-aspect", options.max_aspect, *(COARSE if options.coarse else [])]
    must(bin_dir / "st-raster", file["geometry"], *preset, *sizes, "-o", file["raster"], "-q")
    must(bin_dir / "st-prolong", file["raster"], *preset, "-o", file["sizing"], "-q")
    must(bin_dir / "st-mesh", file["geometry"], file["sizing"], "-o", file["patches"], "-q")
    must(bin_dir / "st-merge", file["patches"], "-o", file["mesh"], "--allow-incomplete", "-q")
    for suffix in ("smesh", "msh"):
        must(bin_dir / "st-export", file["mesh"], "-o", folder / f"mesh.{suffix}", "-q")
    verdict = must(bin_dir / "st-check", file["mesh"], "--geometry", file["geometry"]).splitlines()[-1]
    return re.search(r"(\d+) triangles", verdict).group(1), "passes" if "passes" in verdict else "fails"


def fill(command, folder, seconds):
    """What the program printed, or why there is nothing."""
    try:
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=seconds)
    except subprocess.TimeoutExpired:
        return f"no end in {seconds} s"
    text = done.stdout + done.stderr
    if done.returncode != 0:
        lines = [line for line in text.splitlines() if line.strip(" -")] or [f"exit {done.returncode}"]
        return next((line for line in lines if line.startswith("Error")), lines[-1])
    return text


def tetgen(folder, seconds):
    said = fill(["tetgen", "-pY", "mesh.smesh"], folder, seconds)
    count = re.search(r"Mesh tetrahedra: (\d+)", said)
    return f"{int(count.group(1)):,} tetrahedra" if count else said


def gmsh(folder, seconds):
    (folder / "mesh.geo").write_text(GEO)
    said = fill(["gmsh", "-3", "mesh.geo", "-o", "filled.msh"], folder, seconds)
    count = re.findall(r"(\d+) tetrahedra created", said)
    error = re.search(r"Error\s*: (.*)", said)
    return f"{int(count[-1]):,} tetrahedra" if count and not error else error.group(1) if error else said


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin_dir", type=Path)
    parser.add_argument("models", type=Path, nargs="+")
    parser.add_argument("--max-aspect", default="16")
    parser.add_argument("--preset")
    parser.add_argument("--farfield", default="box:5")
    parser.add_argument("--seconds", type=int, default=300)
    parser.add_argument("--coarse", action="store_true")
    parser.add_argument("--join", action="store_true")
    options = parser.parse_args()
    print("| model | triangles | st-check | TetGen | Gmsh |\n|---|--:|---|---|---|", flush=True)
    for model in options.models:
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            triangles, verdict = make_mesh(options.bin_dir, model, folder, options)
            cells = [model.name, f"{int(triangles):,}", verdict, tetgen(folder, options.seconds),
                     gmsh(folder, options.seconds)]
            print(f"| {' | '.join(cells)} |", flush=True)


if __name__ == "__main__":
    main()
