#!/usr/bin/env python3
"""What stands against stretched triangles, by model: for issue 38 and docs/dev/bench.md.

usage: scripts/stretch_flaws_table.py BIN_DIR MODEL... [--max-aspect 100] [--preset rans] [--wing-models PROGRAM]

MODEL is a file, or a name that PROGRAM (tests/support/wing_models of the build) knows. `held` is the least of the
surfaces' shares of the span with at most 1.3 times what was asked for, without stretch and with it, and how many
surfaces lose more than 0.01. `time` is the processor time of raster to check for each triangle, with stretch over
without.
"""
import argparse
import os
import subprocess
import tempfile
from pathlib import Path

from preset_table import check_mesh

FIRST_LARGE = 15  # bin of st-check's jumps that begins at 2.5
LOSS = 0.01


def measured(bin_dir, model, preset, folder, aspect):
    """The report of st-check, and the processor time of each triangle in seconds."""
    before = os.times()
    report = check_mesh(bin_dir, model, preset, folder, "--max-aspect", aspect)
    after = os.times()
    spent = after.children_user + after.children_system - before.children_user - before.children_system
    return report, spent / max(1, report["triangles"])


def flaws(report):
    """Triangles above 150 degrees and neighbours that differ by more than 2.5."""
    return f"{report['quality']['above_150_deg']}, {sum(report['jumps']['histogram'][FIRST_LARGE:])}"


def held_cells(plain, long):
    held = [{w["edge"]: w["held"] for w in r.get("lifting_surfaces", [])} for r in (plain, long)]
    worse = [e for e, share in held[0].items() if held[1].get(e, 0) < share - LOSS]
    return [" → ".join(f"{min(h.values()):.3f}" if h else "-" for h in held), f"{len(worse)} of {len(held[0])}"]


def row(bin_dir, model, arguments, folder):
    subprocess.run([bin_dir / "st-import", model, "-o", folder / "geometry.hdf", "-q"], check=True)
    plain, before = measured(bin_dir, model, arguments.preset, folder, 1)
    long, after = measured(bin_dir, model, arguments.preset, folder, arguments.max_aspect)
    share = long["triangles"] / plain["triangles"]
    passes = " → ".join("passes" if r["passes"] else "fails" for r in (plain, long))
    cells = [model.stem, f"{plain['triangles']:,}", f"{long['triangles']:,}", f"{share:.2f}", flaws(plain), flaws(long),
             *held_cells(plain, long), passes, f"{after / before:.2f}"]
    print(f"| {' | '.join(cells)} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin_dir", type=Path)
    parser.add_argument("models", nargs="+")
    parser.add_argument("--max-aspect", default="100")
    parser.add_argument("--preset", default="rans")
    parser.add_argument("--wing-models", type=Path)
    arguments = parser.parse_args()
    heads = ["model", "triangles", "stretched", "share", "above 150°, jumps above 2.5", "stretched", "held",
             "surfaces worse", "st-check", "time"]
    print(f"| {' | '.join(heads)} |\n|---|{'--:|' * (len(heads) - 1)}")
    for name in arguments.models:
        with tempfile.TemporaryDirectory() as folder:
            model = Path(name)
            if not model.exists():
                model = Path(folder) / f"{name}.brep"
                subprocess.run([arguments.wing_models, name, model], check=True, capture_output=True)
            row(arguments.bin_dir, model, arguments, Path(folder))


if __name__ == "__main__":
    main()
