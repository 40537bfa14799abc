#!/usr/bin/env python3
"""How near to a number of triangles that is asked for st-prolong's estimate and st-run's mesh come, model by model.

usage: scripts/target_table.py BIN_DIR MODEL...

Each model is meshed with its default sizes, then with a tenth, three tenths and all of that number asked for. A row
has, in per cent of what was asked for: the first mesh, and that of st-run, which is made anew where it is off by more
than 3 %; last the number of meshes that were made.
"""
import argparse
import json
import subprocess
import tempfile
from pathlib import Path

SHARES = (0.1, 0.3, 1)


def triangles(bin_dir, model, folder, *options):
    """(first mesh, last mesh, number of meshes) of a run."""
    done = subprocess.run([bin_dir / "st-run", model, "-o", folder / "mesh.hdf", "--json", *options],
                          capture_output=True, text=True)
    if done.returncode not in (0, 5):  # 5: a check fails
        raise SystemExit(f"{model}: {done.stderr}")
    said = [line for line in done.stderr.splitlines() if line.startswith("st-mesh ")]
    return int(said[0].split()[1]), json.loads(done.stdout)["triangles"], len(said)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin_dir", type=Path)
    parser.add_argument("models", type=Path, nargs="+")
    args = parser.parse_args()
    print("| model | asked for | first mesh, % | st-run, % | meshes |\n|---|--:|--:|--:|--:|")
    with tempfile.TemporaryDirectory() as folder:
        for model in args.models:
            default = triangles(args.bin_dir, model, Path(folder))[1]
            for share in SHARES:
                asked = round(share * default)
                first, last, n = triangles(args.bin_dir, model, Path(folder), "--target-triangles", str(asked))
                row = [model.stem, asked, f"{100 * (first / asked - 1):+.1f}", f"{100 * (last / asked - 1):+.1f}", n]
                print("| " + " | ".join(map(str, row)) + " |", flush=True)


if __name__ == "__main__":
    main()
