#!/bin/bash
# Pictures of stretched triangles on the bundled example: a wing with --max-aspect 16, from its tip and at its trailing
# edge.
# usage: scripts/render_stretched.sh BIN_DIR IMAGE_DIR [--check]      needs python3-vtk9, xvfb and xauth
set -eu
[ $# -ge 2 ] || { sed -n '2,4s/^# //p' "$0" >&2; exit 2; }
here=$(cd "$(dirname "$0")" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
"$here/make_example.sh" "$1" "$scratch/aircraft.step"
"$1/st-import" "$scratch/aircraft.step" -o "$scratch/geometry.hdf" -q
"$1/st-raster" "$scratch/geometry.hdf" --max-aspect 16 -o "$scratch/raster.hdf" -q
"$1/st-prolong" "$scratch/raster.hdf" -o "$scratch/sizing.hdf" -q
"$1/st-mesh" "$scratch/geometry.hdf" "$scratch/sizing.hdf" -o "$scratch/patches.hdf" -q
"$1/st-merge" "$scratch/patches.hdf" -o "$scratch/mesh.hdf" -q
/usr/bin/python3 "$here/render_mesh.py" "$scratch/mesh.hdf" -o "$2" --prefix stretched --view mesh_wing_tip \
  --view mesh_trailing_edge "${@:3}"
