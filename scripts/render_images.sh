#!/bin/bash
# Renders the pictures of the documentation from a run of the bundled example (mesh.hdf and sizing.hdf).
# usage: scripts/render_images.sh BIN_DIR RUN_DIR [IMAGE_DIR]      needs python3-vtk9, xvfb and xauth
set -eu
[ $# -ge 2 ] || { sed -n '2,3s/^# //p' "$0" >&2; exit 2; }
here=$(cd "$(dirname "$0")" && pwd)
images=${3:-$here/../docs/images}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
"$1/st-export" "$2/sizing.hdf" -o "$scratch/sizing.vtu" -q
/usr/bin/python3 "$here/render_mesh.py" "$2/mesh.hdf" -o "$images"
/usr/bin/python3 "$here/render_sizing.py" "$scratch/sizing.vtu" --mesh "$2/mesh.hdf" -o "$images"
