#!/usr/bin/env python3
"""What is left below 10 degrees at edges whose normals stay within 3 degrees, faces apart and by default.

usage: smooth_edges_table.py [--bin DIR] [--work DIR] [--jobs 2] [--seconds 120] MODEL|FOLDER ...

Of folders all CAD files are taken. A line for each model with such triangles: their number with --composite none and
by default, wrong places (crossings and folds) by default, and the composites. Below it, what st-import -v says of
harmful edges that stay, and up to ten of the triangles that are left for each cause, with face, edge and angle.
The last lines are sums of the models that both meshed, with all and without the model that has most.

Files that nobody made for ST: those of Debian's kicad-packages3d, three *.step below 1.5 MB of each folder.
"""
import argparse
import concurrent.futures
import sys
import tempfile

import composite_table as table

SMOOTH_DEG = 3
SMOOTH = table.COUNTS.index("smooth")


def places_left(row):
    """Lines of triangles at smooth edges, the worst of each cause."""
    return [f"  left: {w['value']:.2f} degrees, {w['cause']}, face {w['face']}, edge {w['beside']['edge']}"
            for w in row.worst if w.get("beside", {}).get("edge") and w["beside"]["normals_deg"] <= SMOOTH_DEG]


def lines_of(model, rows):
    none, default = rows["none"], rows["harm"]
    if none.counts[SMOOTH] == default.counts[SMOOTH] == 0:
        return []
    lines = [f"{model.name}\t{none.counts[SMOOTH]}\t{default.counts[SMOOTH]}\t{default.n_wrong}\t"
             f"{default.composites.text()}"]
    if default.counts[SMOOTH]:
        lines += [f"  stays: {why}" for why in default.composites.stays] + places_left(default)
    return lines


def print_sum(title, counts):
    before, after = (sum(pair[k] for pair in counts) for k in (0, 1))
    print(f"{title}, {len(counts)} models\t{before}\t{after}\t{table.share(before, after)}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    table.add_options(parser)
    options = parser.parse_args()
    tempfile.tempdir = str(options.work) if options.work else None
    models = table.models_of(options.model)
    print("model\tnone\tdefault\twrong\tcomposites")
    counts = []
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        results = pool.map(lambda m: table.rows_of(options, ["none", "harm"], m), models)
        for model, (lines, rows) in zip(models, results):
            if not rows:
                print("\n".join(line for line in lines if "\tno mesh\t" in line), flush=True)
                continue
            counts.append([rows[mode].counts[SMOOTH] for mode in ("none", "harm")])
            for line in lines_of(model, rows):
                print(line, flush=True)
    print_sum("all", counts)
    print_sum("without the worst", sorted(counts)[:-1])
    return 0


if __name__ == "__main__":
    sys.exit(main())
