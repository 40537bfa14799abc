#!/bin/bash
# Renders the picture of docs/guide/to_the_flow.md: pressure on the bundled aircraft. Takes two minutes.
# usage: scripts/render_flow.sh BIN_DIR [IMAGE_DIR]      needs gmsh, openfoam, python3-vtk9, xvfb and xauth
set -eu
[ $# -ge 1 ] || { sed -n '2,3s/^# //p' "$0" >&2; exit 2; }
here=$(cd "$(dirname "$0")" && pwd)
bin=$(realpath "$1")
images=$(realpath "${2:-$here/../docs/images}")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"
"$bin/make_aircraft" aircraft.step > /dev/null
"$bin/st-import" aircraft.step -q
"$bin/st-raster" geometry.hdf --preset preview -q
"$bin/st-prolong" raster.hdf -q
"$bin/st-mesh" geometry.hdf sizing.hdf -q
"$bin/st-merge" patches.hdf --export mesh.msh -q
"$here/../examples/openfoam/volume.sh" mesh.msh flow
"$here/../examples/openfoam/flow.sh" flow
"$here/../examples/openfoam/draw_pressure.py" flow "$images/flow_aircraft.png"
