#!/usr/bin/env python3
"""What wings, blades and sails of many kinds get by preset: a table in docs/dev/wings.md.

usage: scripts/wing_shapes_table.py BIN_DIR WING_MODELS [MODEL...] [--presets euler rans]

WING_MODELS is the program tests/support/wing_models of the build. `held` is the least of the surfaces' shares of the
span with at most 1.3 times what was asked for at nose and trailing edge; lengths are the largest of all stations.
`flat` is the number of angles above 150 degrees, `others` the mean quality of triangles that are in no row.
"""
import argparse
import subprocess
import tempfile
from pathlib import Path

from preset_table import check_mesh


def worst(wings, place):
    values = [100 * s[place]["normal"] / s["chord"] for w in wings for s in w["stations"] if s[place]]
    return f"{max(values):.2g}" if values else "-"


def least_bases(wings):
    values = [s["base_cells"] for w in wings for s in w["stations"] if s["base_cells"]]
    return f"{min(values):.1f}" if values else "-"


def row(name, preset, report):
    wings = report.get("lifting_surfaces", [])
    rows = report.get("rows", {})
    mean = rows["others_mean"] if rows else report["quality"]["mean"]
    shapes = f"| {report['quality']['above_150_deg']} | {mean:.3f}"
    if not wings:
        return f"| {name} | {preset} | {report['triangles']:,} | 0 | - | - | - | - | - {shapes} |"
    return (f"| {name} | {preset} | {report['triangles']:,}{'' if report['passes'] else ' (fails)'} | {len(wings)} "
            f"| {100 * min(w['covered'] for w in wings):.0f} | {100 * min(w['held'] for w in wings):.0f} "
            f"| {worst(wings, 'nose')} | {worst(wings, 'trailing')} | {least_bases(wings)} {shapes} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin_dir", type=Path)
    parser.add_argument("wing_models", type=Path)
    parser.add_argument("models", nargs="*")
    parser.add_argument("--presets", nargs="+", default=["euler", "rans"])
    arguments = parser.parse_args()
    print("| model | preset | triangles | surfaces | covered, % | held, % "
          "| nose | trailing edge | base | flat | others |\n"
          "|---|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|")
    listed = subprocess.run([arguments.wing_models], check=True, capture_output=True, text=True).stdout.split()
    for name in arguments.models or [n for n in listed if not n.startswith(("part_", "vane_passage"))]:
        with tempfile.TemporaryDirectory() as folder:
            model = Path(folder) / f"{name}.brep"
            subprocess.run([arguments.wing_models, name, model], check=True, capture_output=True)
            for preset in arguments.presets:
                print(row(name, preset, check_mesh(arguments.bin_dir, model, preset, Path(folder))), flush=True)


if __name__ == "__main__":
    main()
