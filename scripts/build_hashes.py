#!/usr/bin/env python3
"""Content hashes of three models, made by several builds of the tools, with and without AVX2 and FMA in the C library.

usage: scripts/build_hashes.py BIN_DIR... [--models NAME,...]

Builds to compare, for example of -O0, -O2 and -O3, by g++ and clang++:
  cmake -S . -B build/clang -G Ninja -DCMAKE_CXX_COMPILER=clang++ && ninja -C build/clang st_tools
Each stage starts from the artifact of the first build, so that a difference is shown in the stage that makes it. The
first build with all of the processor is the reference; a line for each stage that differs, exit 1 when there is one.
Models come from ST_CORPUS (default ../shared/corpus beside the repository).
"""
import argparse
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

CORPUS = Path(os.environ.get("ST_CORPUS") or Path(__file__).resolve().parents[1] / "../shared/corpus").resolve()
MODELS = ["mech_netgen_screw", "mech_esp_piston", "aero_onera_m6_sharpte"]
PROCESSORS = {"": {}, "without AVX2 and FMA": {"GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4"}}
STAGES = [("geometry", "st-import", ["model"]), ("raster", "st-raster", ["geometry"]),
          ("sizing", "st-prolong", ["raster"]), ("patches", "st-mesh", ["geometry", "sizing"]),
          ("mesh", "st-merge", ["patches"])]


def hashes(bin_dir, environment, files, folder, keeps):
    """Hash of each stage's output; `keeps`: the outputs become inputs of the next stages."""
    result = {}
    for name, tool, inputs in STAGES:
        output = folder / f"{name}.hdf"
        subprocess.run([bin_dir / tool, *(files[i] for i in inputs), "-o", output, "-q"], check=True,
                       env=os.environ | environment)
        done = subprocess.run([bin_dir / "st-info", output, "--hash"], check=True, capture_output=True, text=True)
        result[name] = done.stdout.strip()
        if keeps:
            files[name] = folder / f"reference.{name}.hdf"
            shutil.copyfile(output, files[name])
    return result


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin_dirs", nargs="+", type=Path)
    parser.add_argument("--models", default=",".join(MODELS))
    options = parser.parse_args()
    n_compared, n_different = 0, 0
    for model in options.models.split(","):
        files, reference = {"model": next(CORPUS.glob(model + ".*"))}, None
        with tempfile.TemporaryDirectory() as top:
            for bin_dir in options.bin_dirs:
                for processor, environment in PROCESSORS.items():
                    found = hashes(bin_dir, environment, files, Path(top), reference is None)
                    reference = reference or found
                    for stage in found:
                        n_compared += 1
                        if found[stage] != reference[stage]:
                            n_different += 1
                            print(f"{model}: {stage} of {bin_dir} {processor} differs: {found[stage]}", flush=True)
    print(f"{n_compared} artifacts compared, {n_different} differ")
    return 1 if n_different else 0


if __name__ == "__main__":
    sys.exit(main())
