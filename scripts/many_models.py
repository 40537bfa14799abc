#!/usr/bin/env python3
"""Makes CAD models for scripts/many_files.py, the same ones each time, and prints their paths, small files first.

They are the models of the tests (make_models, vsp_models.py, varied_models), and each MODEL as it is, in the variants
of vary_model and with its faces cut by cut_model. Those that cannot be made are named.

usage: scripts/many_models.py BUILD_DIR FOLDER [--varied 240] [--vary MODEL...] [--with FILE...]
--varied: numbers of varied_models. --vary: small models to vary, beside a few of the tests. --with: files to print
as they are. BUILD_DIR holds tests/support/.
"""
import argparse
import subprocess
import sys
from pathlib import Path

VARIANTS = ["moved", "turned", "tumbled", "scaled", "mirrored", "reordered", "loose", "reversed"]
CUTS = 2  # planes, each through all faces
OF_TESTS = ["concept.step", "block_with_hole.step", "torus.brep", "wing_in_body.brep", "capsule_in_sphere_50.brep"]
VSP = Path(__file__).resolve().parents[1] / "tests" / "support" / "vsp_models.py"


def run(*command):
    """Whether it ended well; what it said otherwise is passed on."""
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, errors="replace")
    if done.returncode:
        print(f"many_models.py: {' '.join(str(c) for c in command)}: {done.stderr.strip()}", file=sys.stderr)
    return done.returncode == 0


def vary(support, model, folder):
    folder.mkdir(exist_ok=True)
    for variant in VARIANTS:
        run(support / "vary_model", model, folder / f"{model.stem}_{variant}.brep", variant)
    run(support / "cut_model", model, folder / f"{model.stem}_cut.brep", 1, CUTS)


def main():
    parser = argparse.ArgumentParser(usage=__doc__.replace("%", "%%"))
    parser.add_argument("build_dir", type=lambda path: Path(path).resolve())
    parser.add_argument("folder", type=lambda path: Path(path).resolve())
    parser.add_argument("--varied", type=int, default=240)
    parser.add_argument("--vary", type=Path, nargs="*", default=[])
    parser.add_argument("--with", dest="files", type=lambda path: Path(path).resolve(), nargs="*", default=[])
    options = parser.parse_args()
    support, folder = options.build_dir / "tests" / "support", options.folder
    folder.mkdir(parents=True, exist_ok=True)
    run(support / "make_models", folder / "tests")
    run(sys.executable, VSP, folder / "vsp")
    run(support / "varied_models", folder / "varied", 0, options.varied - 1)
    for model in [folder / "tests" / name for name in OF_TESTS] + options.vary:
        vary(support, model, folder / "variants")
    models = [path for path in folder.glob("*/*.*")] + options.files
    print("\n".join(str(path) for path in sorted(models, key=lambda path: (path.stat().st_size, path.name))))


if __name__ == "__main__":
    main()
