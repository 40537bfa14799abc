#!/bin/bash
# Pictures of five wings for docs/dev/wings.md, each from the chain at `euler`.
# usage: scripts/render_wings.sh BIN_DIR WING_MODELS IMAGE_DIR [NAME ...]      needs python3-vtk9, xvfb and xauth
# WING_MODELS: the program tests/support/wing_models of the build.
set -eu
[ $# -ge 3 ] || { sed -n '2,4s/^# //p' "$0" >&2; exit 2; }
here=$(cd "$(dirname "$0")" && pwd)
bin=$(realpath "$1") models=$(realpath "$2") images=$(realpath "$3")
shift 3
wanted=" $* "
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"

# name, model, x,y,z,half height of the picture (model unit),direction to the viewer
while read -r name model view; do
  [ "$wanted" = "  " ] || [[ $wanted == *" $name "* ]] || continue
  "$models" "$model" model.brep >/dev/null
  "$bin/st-import" model.brep -q
  "$bin/st-raster" geometry.hdf --preset euler -q
  "$bin/st-prolong" raster.hdf --preset euler -q
  "$bin/st-mesh" geometry.hdf sizing.hdf -q
  "$bin/st-merge" patches.hdf -q
  /usr/bin/python3 "$here/render_mesh.py" mesh.hdf -o "$images" --view "$name" --at "$name=$view"
done <<'PLACES'
wing_serrated      serrated_wing      1.02,2,0,0.25,1,-0.6,0.8
wing_notched       notched_wing       0.93,0.86,0,0.12,1,-0.5,0.8
wing_generator     vortex_generators  0.22,2.2,0.065,0.025,-1,-0.8,0.7
wing_round_tail    round_propeller    0,0.05,0.9,0.09,0.7,-1,0.4
wing_t_tail        t_tail             2.8,0,2.95,0.2,1,-0.7,0.5
PLACES
