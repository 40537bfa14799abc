#!/usr/bin/python3
"""Pictures of docs/guide/sizing_guide.md: one setting of the bundled aircraft changed at a time, two meshes in each.

usage: render_guide.py BIN_DIR [-o docs/images] [--only NAME ...] [--check]
--check: draw nothing; exit code 1 when a picture shows other meshes.
Needs python3-vtk9 and, without a display, xvfb. Takes two minutes.
"""
import argparse
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import render_common as common
import render_mesh
from render_common import vtk

SIZE = (1280, 440)
GAP = 0.01  # of the width, between the halves
# Places on the bundled aircraft: middle, direction to the viewer, half height, triangle edges in pixels.
WING = ((19.4, 11.5, 0.0), (-0.35, 0.3, 0.9), 2.6, 0.6)
NACELLE = ((14.2, 5.6, -1.9), (-0.6, 0.75, 0.3), 1.6, 0.7)
NOSE = ((18.3, 11.86, 0.0), (-0.7, 0.2, 0.65), 0.3, 1.0)
BASE = ((21.07, 12.15, 0.02), (0.9, 0.25, 0.35), 0.05, 1.2)
BODY = ((13.0, 2.5, 0.5), (-0.45, 0.8, 0.4), 3.2, 0.6)
# name: place, and the options of both halves, for st-raster and for st-prolong; all with --preset preview
PICTURES = {
    "guide_alpha": (NACELLE, ("--alpha 20", ""), ("--alpha 5", "")),
    "guide_lmax": (BODY, ("--lmax 5% --lmin 0.08%", ""), ("--lmax 0.5% --lmin 0.08%", "")),
    "guide_lmin": (NACELLE, ("--lmin 0.3% --edge-size none", ""), ("--lmin 0.03% --edge-size none", "")),
    "guide_slope": (WING, ("", "--slope 0.5"), ("", "--slope 0.1")),
    "guide_edge_size": (NOSE, ("--edge-size 1%chord", ""), ("--edge-size 0.3%chord", "")),
    "guide_chord_cells": (WING, ("--chord-cells 15", ""), ("--chord-cells 60", "")),
    "guide_base_cells": (BASE, ("--edge-size 0.3%chord --base-cells 1", ""),
                         ("--edge-size 0.3%chord --base-cells 4", "")),
    "guide_wall": (NACELLE, ("", ""), ("--wall-cells 2", "")),
    "guide_aspect": (WING, ("", ""), ("--max-aspect 16", "")),
}


def tool(bin_dir, name, *arguments):
    subprocess.run([bin_dir / name, *arguments, "-q"], check=True)


def mesh_of(bin_dir, folder, raster_options, prolong_options):
    """The aircraft's mesh with these options; runs once for each pair of options."""
    key = "".join(c if c.isalnum() else "_" for c in raster_options + "+" + prolong_options)
    file = {n: folder / f"{key}_{n}.hdf" for n in ("raster", "sizing", "patches", "mesh")}
    if not file["mesh"].exists():
        geometry = folder / "geometry.hdf"
        tool(bin_dir, "st-raster", geometry, "--preset", "preview", *raster_options.split(), "-o", file["raster"])
        grow = ["--preset", "preview", *prolong_options.split()]
        tool(bin_dir, "st-prolong", file["raster"], *grow, "-o", file["sizing"])
        tool(bin_dir, "st-mesh", geometry, file["sizing"], "-o", file["patches"])
        tool(bin_dir, "st-merge", file["patches"], "-o", file["mesh"])
    return render_mesh.Mesh(str(file["mesh"]))


def shown(meshes, place):
    """Triangles in each part of both halves."""
    focus, direction, half_height, _ = place
    half = (SIZE[0] // 2, SIZE[1])
    return [n for mesh in meshes for n in mesh.shown(~mesh.is_outer(), focus, direction, half_height, half)]


def draw(meshes, place, path):
    """Both meshes side by side, from the same place."""
    focus, direction, half_height, edge_width = place
    window = None
    for mesh, left in zip(meshes, (0.0, 0.5 + GAP / 2)):
        selected = ~mesh.is_outer() & render_mesh.in_picture(mesh, focus, direction, half_height)
        renderer = render_mesh.scene(mesh, selected, edge_width)
        renderer.SetViewport(left, 0, left + 0.5 - GAP / 2, 1)
        common.look(renderer, focus, direction, half_height)
        if window is None:
            window = common.window_of(renderer, SIZE)
        else:
            renderer.SetBackground(1, 1, 1)
            window.AddRenderer(renderer)
    between = vtk.vtkRenderer()
    between.SetBackground(0.5, 0.5, 0.55)
    between.SetViewport(0.5 - GAP / 2, 0, 0.5 + GAP / 2, 1)
    window.AddRenderer(between)
    common.write_png(window, path, shown(meshes, place))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin_dir", type=Path)
    parser.add_argument("-o", "--output", default="docs/images")
    parser.add_argument("--only", nargs="+", choices=PICTURES, default=list(PICTURES))
    parser.add_argument("--check", action="store_true")
    options = parser.parse_args()
    stale = False
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        step = folder / "aircraft.step"
        subprocess.run([options.bin_dir / "make_aircraft", step], check=True, stdout=subprocess.DEVNULL)
        tool(options.bin_dir, "st-import", step, "-o", folder / "geometry.hdf")
        for picture in options.only:
            place, *halves = PICTURES[picture]
            meshes = [mesh_of(options.bin_dir, folder, *half) for half in halves]
            path = os.path.join(options.output, picture + ".png")
            if options.check:
                stale |= not common.is_current(path, shown(meshes, place))
                continue
            draw(meshes, place, path)
            texts = [f"{half[0]} {half[1]}".strip() or "defaults" for half in halves]
            print(", ".join(f"{text}: {len(mesh.triangles):,} triangles" for text, mesh in zip(texts, meshes)))
    return 1 if stale else 0


if __name__ == "__main__":
    sys.exit(main())
