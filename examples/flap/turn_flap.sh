#!/bin/bash
# Meshes a model with a flap, turns the flap about its hinge, and takes the mesh along.
# usage: turn_flap.sh MODEL OUT BIN [NP]     results go to the folder OUT
# Environment: FLAP group or part to turn; HINGE "x y z x y z" two points of its hinge line; ANGLE in degrees. Defaults
# suit wing_with_flap.step.
# exit codes: as the tools; 5 when a check fails
set -eu -o pipefail
model=$1 out=$2 bin=$3 np=${4:-1}
flap=${FLAP:-flap} hinge=${HINGE:-63.5 0 0  63.5 100 0} angle=${ANGLE:-5}
mkdir -p "$out"

"$bin/st-import" "$model" -o "$out/geometry.hdf"
"$bin/st-raster" "$out/geometry.hdf" -o "$out/raster.hdf" --np "$np"
"$bin/st-prolong" "$out/raster.hdf" -o "$out/sizing.hdf"
"$bin/st-mesh" "$out/geometry.hdf" "$out/sizing.hdf" -o "$out/patches.hdf" --np "$np"
"$bin/st-merge" "$out/patches.hdf" -o "$out/mesh.hdf"

"$bin/st-edit" "$out/geometry.hdf" -o "$out/turned.hdf" --of "$flap" --transform "hinge $hinge $angle" --require-valid
"$bin/st-raster" "$out/turned.hdf" -o "$out/turned_raster.hdf" --np "$np"
"$bin/st-prolong" "$out/turned_raster.hdf" -o "$out/turned_sizing.hdf"
"$bin/st-remesh" "$out/mesh.hdf" "$out/turned.hdf" "$out/turned_sizing.hdf" --moved --merged "$out/turned_mesh.hdf" \
  --np "$np"
"$bin/st-check" "$out/turned_mesh.hdf" --geometry "$out/turned.hdf" --sizing "$out/turned_sizing.hdf"
