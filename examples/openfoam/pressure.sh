#!/bin/bash
# From a closed surface mesh to a picture of the pressure on its walls: volume.sh, flow.sh and draw_pressure.py.
# usage: pressure.sh mesh.msh|mesh.smesh CASE      CASE: a new folder, in which pressure.png is drawn
# exit codes: as volume.sh
set -eu -o pipefail
[ $# -eq 2 ] || { sed -n '2,3s/^# //p' "$0" >&2; exit 2; }
here=$(dirname "$(realpath "$0")")
"$here/volume.sh" "$1" "$2"
"$here/flow.sh" "$2"
"$here/draw_pressure.py" "$2" "$2/pressure.png"
echo "$2/pressure.png"
