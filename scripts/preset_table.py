#!/usr/bin/env python3
"""What lifting surfaces get by model and preset: the tables in docs/dev/wings.md.

usage: scripts/preset_table.py BIN_DIR MODEL... [--presets euler rans]

All figures are those of st-check --sizing. The last table has triangles, and the least share of the span of a surface
that holds what the preset asks for at nose and trailing edge. Stations lie nearest to 10, 30, 50, 70 and 90 % of the
span.
"""
import argparse
import json
import tempfile
from pathlib import Path

from table_common import run


def check_mesh(bin_dir, model, preset, folder, *lengths):
    """The report of st-check on the mesh of a model. `lengths`: more options of st-raster."""
    path = {n: folder / f"{n}.hdf" for n in ("geometry", "raster", "sizing", "patches", "mesh")}
    if not path["geometry"].exists():
        run(bin_dir / "st-import", model, "-o", path["geometry"], "-q")
    run(bin_dir / "st-raster", path["geometry"], "--preset", preset, *lengths, "-o", path["raster"], "-q")
    run(bin_dir / "st-prolong", path["raster"], "--preset", preset, "-o", path["sizing"], "-q")
    run(bin_dir / "st-mesh", path["geometry"], path["sizing"], "-o", path["patches"], "-q")
    run(bin_dir / "st-merge", path["patches"], "-o", path["mesh"], "--allow-incomplete", "-q")
    return json.loads(run(bin_dir / "st-check", path["mesh"], "--geometry", path["geometry"],
                          "--sizing", path["sizing"], "--json"))


def at_stations(wing, value, form):
    texts = [format(value(s), form) if value(s) else "-" for s in wing["stations"]]
    return "-" if set(texts) <= {"-"} else " ".join(texts)


def wing_row(name, preset, wing):
    def of_chord(place):
        return at_stations(wing, lambda s: 100 * s[place]["normal"] / s["chord"], ".2g")
    off = f"{100 * wing['deviation']:.2g}" if "deviation" in wing else "-"
    return (f"| {name} | {preset} | {wing['edge']} | {wing['triangles']:,} | {100 * wing['covered']:.0f} "
            f"| {100 * wing['held']:.0f} "
            f"| {of_chord('nose')} | {of_chord('trailing')} "
            f"| {at_stations(wing, lambda s: s['chord_cells'], '.0f')} "
            f"| {at_stations(wing, lambda s: s['base_cells'], '.1f')} "
            f"| {at_stations(wing, lambda s: s['growth'], '.2f')} "
            f"| {at_stations(wing, lambda s: s['turning_deg'], '.0f')} | {off} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin_dir", type=Path)
    parser.add_argument("models", type=Path, nargs="+")
    parser.add_argument("--presets", nargs="+", default=["preview", "euler", "rans", "fine"])
    parser.add_argument("--most", type=int, default=2, help="surfaces listed of each model, the largest")
    arguments = parser.parse_args()
    print("| model | preset | edge | triangles | covered, % | held, % | nose | trailing edge | chord | base | growth "
          "| turning | off |\n|---|---|--:|--:|--:|--:|---|---|---|---|---|---|--:|")
    last = []
    for model in arguments.models:
        with tempfile.TemporaryDirectory() as folder:
            counts = []
            for preset in arguments.presets:
                report = check_mesh(arguments.bin_dir, model, preset, Path(folder))
                wings = sorted(report.get("lifting_surfaces", []), key=lambda w: -w["triangles"])
                for wing in wings[:arguments.most]:
                    print(wing_row(model.stem, preset, wing))
                held = f", {100 * min(w['held'] for w in wings):.0f} %" if wings else ""
                counts.append(f"{report['triangles']:,}{held}" + ("" if report["passes"] else " (fails)"))
            last.append(f"| {model.stem} | {len(wings)} | {' | '.join(counts)} |")
        print(end="", flush=True)
    print(f"\n| model | surfaces | {' | '.join(arguments.presets)} |\n|---|--:|{'--:|' * len(arguments.presets)}")
    print("\n".join(last))


if __name__ == "__main__":
    main()
