#!/bin/bash
# Renders a slice through the octree of a block with a curved slot, with st-raster --gap-cells 4, and the mesh.
# usage: scripts/render_gap.sh BIN_DIR curved_slot.brep IMAGE_DIR [--check] [--without]
# The model: make_models DIR. --check: draw nothing, exit code 1 when the picture is stale; --without: without the
# option, as sizing_slot_0.png. Needs python3-vtk9, xvfb
set -eu
[ $# -ge 3 ] || { sed -n '2,5s/^# //p' "$0" >&2; exit 2; }
here=$(cd "$(dirname "$0")" && pwd)
bin=$(realpath "$1") model=$(realpath "$2") images=$(realpath "$3")
shift 3
gap=(--gap-cells 4) name=sizing_slot check=()
for argument in "$@"; do
  case $argument in
    --check) check=(--check) ;;
    --without) gap=() name=sizing_slot_0 ;;
    *) echo "render_gap: error: unknown argument '$argument'" >&2; exit 2 ;;
  esac
done
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"
"$bin/st-import" "$model" -q
"$bin/st-raster" geometry.hdf --lmax 5% --lmin 0.05% "${gap[@]}" -q
"$bin/st-prolong" raster.hdf -q
"$bin/st-mesh" geometry.hdf sizing.hdf -q
"$bin/st-merge" patches.hdf -q
"$bin/st-export" sizing.hdf -o sizing.vtu -q
/usr/bin/python3 "$here/render_sizing.py" sizing.vtu --mesh mesh.hdf --slice $name 20 9 7.03 6 -o "$images" \
  "${check[@]}"
