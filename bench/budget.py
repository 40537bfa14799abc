#!/usr/bin/env python3
"""Instructions of each stage on three models against stored figures: what a change costs, whatever the machine does.

usage: bench/budget.py BIN_DIR [--models NAME...] [--against BIN_DIR] [--update]       needs valgrind

Each tool runs once under callgrind, with one thread and default options; its child processes count. Without --against
the counts are compared with bench/budget.tsv, else with the same stages of other binaries, run on the same artifacts.
--update stores the counts. Exit 5 where a stage needs over 3 % more: its model, stage and both counts are shown.

The models are those of ST_CORPUS (default ../shared/corpus beside the repository). Counts of one processor and C
library repeat within 0.1 %; others choose other variants of memcpy and sin, so compare --against there.
"""
import argparse
import os
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
CORPUS = Path(os.environ.get("ST_CORPUS") or ROOT / "../shared/corpus").resolve()
STORED = ROOT / "bench" / "budget.tsv"
MODELS = ["aero_d150_wing_body_half.brep", "aero_onera_m6_sharpte.brep", "mech_as1_oc_214.stp"]
ALLOWED = 0.03  # share of a stage's instructions
OK, INCOMPLETE, OVER = 0, 5, 5


def stages(model, folder):
    """(stage, arguments) of the chain; artifacts are in folder."""
    path = lambda name: str(folder / f"{name}.hdf")  # noqa: E731
    cad = ["--geometry", path("geometry"), "--sizing", path("sizing")]
    return [("import", [str(CORPUS / model), "-o", path("geometry"), "--time-limit", "9999"]),
            ("raster", [path("geometry"), "-o", path("raster"), "--threads", "1"]),
            ("prolong", [path("raster"), "-o", path("sizing"), "--threads", "1"]),
            ("mesh", [path("geometry"), path("sizing"), "-o", path("patches"), "--threads", "1"]),
            ("merge", [path("patches"), "-o", path("mesh"), "--allow-incomplete"]),
            ("check", [path("mesh"), *cad, "--threads", "1"])]


def count(tool, arguments):
    """Instructions of a tool and its children."""
    with tempfile.TemporaryDirectory() as folder:
        command = ["valgrind", "--tool=callgrind", "--trace-children=yes", f"--callgrind-out-file={folder}/out.%p",
                   str(tool), *arguments, "-q"]
        done = subprocess.run(command, capture_output=True, text=True, stdin=subprocess.DEVNULL)
        if done.returncode not in (OK, INCOMPLETE):
            sys.exit(f"budget: error: {tool}: exit {done.returncode}: {done.stderr.strip()[-400:]}")
        totals = [line for out in Path(folder).iterdir() for line in out.read_text().splitlines()
                  if line.startswith("totals:")]
    return sum(int(line.split()[1]) for line in totals)


def measure(bin_dir, model, against):
    """{stage: (instructions, instructions of the other binaries or None)}; the next stage reads what bin_dir wrote."""
    counts = {}
    with tempfile.TemporaryDirectory() as folder:
        for stage, arguments in stages(model, Path(folder)):
            other = count(against / f"st-{stage}", arguments) if against else None
            counts[stage] = count(bin_dir / f"st-{stage}", arguments), other
    return counts


def read_stored():
    lines = [line.split("\t") for line in STORED.read_text().splitlines()[1:]] if STORED.exists() else []
    return {(model, stage): int(value) for model, stage, value in lines}


def show(counts):
    """Prints the table; the number of stages over the budget."""
    n_over = 0
    print("| model | stage | before, M | now, M | change |\n|---|---|--:|--:|--:|")
    for (model, stage), (now, before) in counts.items():
        change = now / before - 1 if before else float("nan")
        n_over += change > ALLOWED
        mark = " over" if change > ALLOWED else ""
        print(f"| {model} | {stage} | {(before or 0) / 1e6:,.0f} | {now / 1e6:,.0f} | {100 * change:+.1f} %{mark} |")
    return n_over


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin_dir", metavar="BIN_DIR", type=Path)
    parser.add_argument("--models", nargs="+", default=MODELS, metavar="NAME")
    parser.add_argument("--against", type=Path, metavar="BIN_DIR")
    parser.add_argument("--update", action="store_true")
    arguments = parser.parse_args()
    if missing := [m for m in arguments.models if not (CORPUS / m).exists()]:
        sys.exit(f"budget: error: {CORPUS / missing[0]} is not there; set ST_CORPUS to the folder of the models")
    stored = read_stored()
    with ThreadPoolExecutor(2) as pool:
        of_models = list(pool.map(lambda m: measure(arguments.bin_dir, m, arguments.against), arguments.models))
    counts = {(model, stage): (now, before if arguments.against else stored.get((model, stage)))
              for model, of_model in zip(arguments.models, of_models) for stage, (now, before) in of_model.items()}
    n_over = show(counts)
    if arguments.update:
        rows = stored | {key: now for key, (now, _) in counts.items()}
        STORED.write_text("model\tstage\tinstructions\n" + "".join(f"{m}\t{s}\t{n}\n" for (m, s), n in rows.items()))
    sys.exit(OVER if n_over and not arguments.update else OK)


if __name__ == "__main__":
    main()
