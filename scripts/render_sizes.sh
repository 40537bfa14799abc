#!/bin/bash
# Slices of the octree of a run of the bundled example with and without blanking: size, cause, and what is blanked.
# usage: scripts/render_sizes.sh BIN_DIR RUN_DIR IMAGE_DIR  RUN_DIR: raster.hdf and mesh.hdf; needs python3-vtk9, xvfb
set -eu
[ $# -eq 3 ] || { sed -n '2,3s/^# //p' "$0" >&2; exit 2; }
here=$(cd "$(dirname "$0")" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
"$1/st-prolong" "$2/raster.hdf" --no-blank -o "$scratch/open.hdf" -q
"$1/st-prolong" "$2/raster.hdf" --blank "$2/mesh.hdf" -o "$scratch/blanked.hdf" -q
for field in open blanked; do
  "$1/st-export" "$scratch/$field.hdf" -o "$scratch/$field.vtu" -q
  for by in size cause; do
    /usr/bin/python3 "$here/render_sizing.py" "$scratch/$field.vtu" --mesh "$2/mesh.hdf" \
      --by $by --suffix "_${by}_$field" -o "$3"
  done
done
/usr/bin/python3 "$here/render_sizing.py" "$scratch/blanked.vtu" --mesh "$2/mesh.hdf" \
  --by colour --suffix _blanked_cells -o "$3"
