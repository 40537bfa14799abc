#!/usr/bin/env python3
"""Octree cells, triangles and their ratio on ten models of the corpus, for two sizes of cells: one Markdown table.

usage: scripts/octree_table.py BIN_DIR [--models NAME...] [--cells-per-length N]

BIN_DIR holds the tools. The corpus is ST_CORPUS (default ../shared/corpus beside the repository). One rank, default
options but
--cell-per-length 2 and N (default 4, as in st-raster). Exit 0 when every model was meshed, incomplete meshes included,
else 5.
"""
import argparse
import sys
import tempfile

from corpus_table import CORPUS, INCOMPLETE, OK, Chain, Stopped

MODELS = [
    "aero_d150_wing_body_half.brep", "aero_d150_half_with_tail.brep", "aero_evtol_bet.brep",
    "aero_onera_m6_sharpte.brep", "aero_tigl_nacelle.stp",
    "ship_dtmb5415_bulb.iges", "mech_geouned_scdr.stp", "mech_netgen_screw.step", "mech_occt_linkrods.step",
    "mech_esp_piston.brep"]
USUAL = 2


def measure(chain, cell_per_length):
    """Samples, cells and triangles."""
    raster = chain.stage("raster", chain.path("geometry"), "-o", chain.path("raster"), "--cell-per-length",
                         str(cell_per_length))
    chain.stage("prolong", chain.path("raster"), "-o", chain.path("sizing"))
    mesh = chain.stage("mesh", chain.path("geometry"), chain.path("sizing"), "-o", chain.path("patches"),
                       accept=(OK, INCOMPLETE))
    return raster["samples"], raster["cells"], mesh["triangles"]


def row(model, arguments, folder):
    chain = Chain(arguments.bin_dir, folder, 300, 16)
    try:
        chain.stage("import", str(CORPUS / model), "-o", chain.path("geometry"))
        samples, cells, triangles = measure(chain, USUAL)
        _, large_cells, large_triangles = measure(chain, arguments.cells_per_length)
    except Stopped as stop:
        return f"| {model} | {stop} | | | | | | |", False
    return (f"| {model} | {samples:,} | {cells:,} | {triangles:,} | {cells / triangles:.2f} | {large_cells:,} | "
            f"{large_triangles:,} | "
            f"{large_cells / large_triangles:.2f} |"), True


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin_dir")
    parser.add_argument("--models", nargs="+", default=MODELS)
    parser.add_argument("--cells-per-length", type=float, default=4)
    arguments = parser.parse_args()
    n = f"{arguments.cells_per_length:g}"
    print(f"| model | samples | cells | triangles | ratio | cells, N = {n} | triangles, N = {n} | ratio |")
    print("|---|---|---|---|---|---|---|---|")
    is_complete = True
    for model in arguments.models:
        with tempfile.TemporaryDirectory() as folder:
            text, is_done = row(model, arguments, folder)
        print(text, flush=True)
        is_complete &= is_done
    return OK if is_complete else INCOMPLETE


if __name__ == "__main__":
    sys.exit(main())
