#!/bin/bash
# Fills a closed surface mesh with tetrahedra and makes an OpenFOAM case of it, checked by checkMesh.
# usage: volume.sh mesh.msh|mesh.smesh CASE      .msh is filled by Gmsh, .smesh by TetGen; CASE is a new folder
# exit codes: 2 usage; 3 a file is missing; 5 the volume mesher failed, or checkMesh does not say "Mesh OK"
set -eu -o pipefail
[ $# -eq 2 ] || { sed -n '2,3s/^# //p' "$0" >&2; exit 2; }
mesh=$(realpath "$1") case=$2
here=$(dirname "$(realpath "$0")")
export WM_PROJECT_DIR=${WM_PROJECT_DIR:-/usr/share/openfoam}  # where Debian has it; no other setting is needed
[ -f "$mesh" ] || { echo "volume: error: '$1' does not exist" >&2; exit 3; }
[ ! -e "$case" ] || { echo "volume: error: '$case' exists: remove it or choose another name" >&2; exit 2; }
mkdir -p "$case"
cp -r "$here/case/." "$case"
cd "$case"

fail() {
  echo "volume: error: $1, see $PWD/log.$2" >&2
  exit 5
}

# run NAME COMMAND...: output in log.NAME; its last lines when the command fails
run() {
  local name=$1
  shift
  "$@" > "log.$name" 2>&1 || { tail -n 5 "log.$name" >&2; fail "$name failed" "$name"; }
}

case $mesh in
  *.msh)
    cp "$mesh" mesh.msh
    run gmsh gmsh -3 fill.geo -o filled.msh
    ;;
  *.smesh)
    cp "$mesh" mesh.smesh
    # Y: the triangles stay as they are, so that each keeps its group. o/140: angles above 140 degrees are mended, not
    # only those above 165 as by default: flat tetrahedra make skew faces, and flows that diverge.
    run tetgen tetgen -pAq1.4/15o/140Y mesh.smesh
    run tetgen_to_msh /usr/bin/python3 "$here/tetgen_to_msh.py" mesh.smesh filled.msh
    ;;
  *) echo "volume: error: '$1' is neither .msh nor .smesh" >&2; exit 2 ;;
esac
LC_ALL=C awk -f "$here/patches.awk" filled.msh filled.msh > patches.msh
run gmshToFoam gmshToFoam patches.msh
run changeDictionary changeDictionary  # which patches are walls: system/changeDictionaryDict
run checkMesh checkMesh
grep -E "^ +(cells|points):|Max skewness|non-orthogonality Max" log.checkMesh
grep "^Mesh OK" log.checkMesh || { grep '\*\*\*' log.checkMesh >&2; fail "checkMesh is not content" checkMesh; }
