#!/usr/bin/env python3
"""Content hashes of every stage on the corpus, and of three remeshings: what a change that should change nothing must
leave as it was.

usage: scripts/corpus_hashes.py BIN_DIR [--models GLOB] [--np N] [--tile N]     prints one line per artifact: model,
artifact, hash
       scripts/corpus_hashes.py BIN_DIR --compare FILE ...                       compares with what was printed before,
       by these tools or other ones, with other ranks, by another compiler; exit 5 on a difference

With GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4 the C library takes the processor for an older one. --tile: that
of st-mesh, whose meshes are other ones then. BIN_DIR holds the tools. The corpus is ST_CORPUS (default
../shared/corpus beside the repository). A stage that fails is
a line with its exit code.
"""
import argparse
import fnmatch
import os
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
CORPUS = Path(os.environ.get("ST_CORPUS") or ROOT / "../shared/corpus").resolve()
SUFFIXES = {".step", ".stp", ".iges", ".igs", ".brep", ".fli"}
REMESHED = {"aero_onera_m6_sharpte.brep", "mech_as1_oc_214.stp", "mech_occt_bottle.brep"}
OK, INCOMPLETE, DIFFERENT = 0, 5, 5


def chain(bin_dir, model, folder, ranks, tile):
    """(artifact, hash or exit code) of each stage, up to the first that fails."""
    path = lambda name: str(folder / f"{name}.hdf")  # noqa: E731
    stages = [("geometry", "st-import", [str(model)]),
              ("raster", "st-raster", [path("geometry"), *ranks]),
              ("sizing", "st-prolong", [path("raster")]),
              ("patches", "st-mesh", [path("geometry"), path("sizing"), *ranks, *tile]),
              ("mesh", "st-merge", [path("patches"), "--allow-incomplete"])]
    if model.name in REMESHED:
        old = [path("mesh"), path("geometry")]
        stages += [("finer", "st-prolong", [path("raster"), "--slope", "0.1"]),
                   ("remeshed_patches", "st-remesh", [*old, path("finer"), *ranks]),
                   ("remeshed", "st-merge", [path("remeshed_patches")]),
                   ("coarser", "st-prolong", [path("raster"), "--scale", "1.7"]),
                   ("remeshed_coarser", "st-remesh", [*old, path("coarser"), *ranks], "--merged")]
    for name, tool, arguments, *output in stages:
        done = subprocess.run([f"{bin_dir}/{tool}", *arguments, *(output or ["-o"]), path(name)], capture_output=True,
                              text=True,
                              stdin=subprocess.DEVNULL)
        if done.returncode not in (OK, INCOMPLETE):
            yield name, f"exit {done.returncode}"
            return
        info = subprocess.run([f"{bin_dir}/st-info", path(name), "--hash"], capture_output=True, text=True)
        yield name, info.stdout.strip()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin_dir", metavar="BIN_DIR")
    parser.add_argument("--models", default="*", metavar="GLOB")
    parser.add_argument("--np", type=int, default=1)
    parser.add_argument("--tile", metavar="N")
    parser.add_argument("--compare", metavar="FILE")
    arguments = parser.parse_args()
    ranks = ["--np", str(arguments.np)] if arguments.np > 1 else []
    tile = ["--tile", arguments.tile] if arguments.tile else []
    before = {}
    if arguments.compare:
        lines = [line.split("\t") for line in Path(arguments.compare).read_text().splitlines()]
        before = {(model, artifact): value for model, artifact, value in lines}
    n_compared = n_different = 0
    for model in sorted(m for m in CORPUS.iterdir() if m.suffix in SUFFIXES
                        and fnmatch.fnmatch(m.name, arguments.models)):
        with tempfile.TemporaryDirectory() as folder:
            for artifact, value in chain(arguments.bin_dir, model, Path(folder), ranks, tile):
                if not arguments.compare:
                    print(model.name, artifact, value, sep="\t", flush=True)
                    continue
                n_compared += 1
                old = before.get((model.name, artifact), "nothing")
                if value != old:
                    n_different += 1
                    print(f"{model.name} {artifact}: {value}, was {old}", flush=True)
    if arguments.compare:
        print(f"{n_compared} artifacts compared, {n_different} differ")
        sys.exit(OK if n_compared and not n_different else DIFFERENT)


if __name__ == "__main__":
    main()
