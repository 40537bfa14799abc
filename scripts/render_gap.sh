#!/bin/bash
# Renders a slice through the octree of a block with a curved slot, without and with st-raster --gap-cells 4, and a mesh.
# usage: scripts/render_gap.sh BIN_DIR curved_slot.brep IMAGE_DIR      the model: make_models DIR; needs python3-vtk9, xvfb
set -eu
[ $# -eq 3 ] || { sed -n '2,3s/^# //p' "$0" >&2; exit 2; }
here=$(cd "$(dirname "$0")" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd_to() { (cd "$scratch" && "$@"); }
bin=$(cd "$1" && pwd)
"$bin/st-import" "$2" -o "$scratch/geometry.hdf" -q
for n in 0 4; do
  gap=()
  [ $n = 0 ] || gap=(--gap-cells "$n")
  cd_to "$bin/st-raster" geometry.hdf -o raster.hdf --lmax 5% --lmin 0.05% "${gap[@]}" -q
  cd_to "$bin/st-prolong" raster.hdf -o sizing.hdf -q
  cd_to "$bin/st-mesh" geometry.hdf sizing.hdf -o patches.hdf -q
  cd_to "$bin/st-merge" patches.hdf -o mesh.hdf -q
  cd_to "$bin/st-export" sizing.hdf -o sizing.vtu -q
  /usr/bin/python3 "$here/render_sizing.py" "$scratch/sizing.vtu" --mesh "$scratch/mesh.hdf" \
    --slice sizing_slot_$n 20 9 7.03 6 -o "$3"
done
