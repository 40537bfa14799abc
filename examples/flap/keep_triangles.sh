#!/bin/bash
# Meshes one position of a flap and takes the same triangles to another one; draws the wall beside the flap.
# usage: keep_triangles.sh BEFORE AFTER OUT BIN     CAD files of the same topology; results go to the folder OUT
# Environment: WALL=Y the plane y = Y that is drawn; default 12, which suits part_flapped_wing_*.brep
# exit codes: as the tools; 5 when a check fails
set -eu -o pipefail
out=$3 bin=$4
wall=${WALL:-12} here=$(cd "$(dirname "$0")" && pwd)
mkdir -p "$out"

size() {  # CAD POSITION
  position=$2
  "$bin/st-import" "$1" -o "$out/$position.hdf" --unit mm
  "$bin/st-raster" "$out/$position.hdf" -o "$out/${position}_raster.hdf"
  "$bin/st-prolong" "$out/${position}_raster.hdf" -o "$out/${position}_sizing.hdf"
}

size "$1" before
size "$2" after
"$bin/st-mesh" "$out/before.hdf" "$out/before_sizing.hdf" -o "$out/patches.hdf"
"$bin/st-merge" "$out/patches.hdf" -o "$out/mesh.hdf"
"$bin/st-remesh" "$out/mesh.hdf" "$out/after.hdf" "$out/after_sizing.hdf" --moved --keep-connectivity \
  --displacements "$out/displacements.csv" --merged "$out/moved_mesh.hdf"
"$bin/st-check" "$out/moved_mesh.hdf" --geometry "$out/after.hdf"
"$bin/st-export" "$out/mesh.hdf" -o "$out/mesh.obj"
"$bin/st-export" "$out/moved_mesh.hdf" -o "$out/moved_mesh.obj"
python3 "$here/draw_kept.py" "$out" "$wall"
