#!/bin/bash
# Steady flow around the walls of a case made by volume.sh: SIMPLE of OpenFOAM, second order upwind, and as good as no
# viscosity.
# usage: simple.sh CASE X Y Z      X Y Z: the flow far away, of speed 1, as the case's potential has it
set -eu -o pipefail
[ $# -eq 4 ] || { sed -n '2,4s/^# //p' "$0" >&2; exit 2; }
here=$(dirname "$(realpath "$0")")
export WM_PROJECT_DIR=${WM_PROJECT_DIR:-/usr/share/openfoam}
cd "$1"
# The first fluxes are those of potential flow: a uniform flow would pass the walls, and the first step fail.
potentialFoam -writephi > log.potentialFoam 2>&1 || { tail -n 5 log.potentialFoam >&2; exit 5; }
cp -r "$here/simple/." .
# A cell with two faces on walls and the flow along both others has no flux at all: nothing but viscosity holds its
# velocity. That of a Reynolds number of 100 by the shortest lengths of the mesh is far below the scheme's own.
area=$(sed -n 's/.*Minimum face area = \([^ ]*\)\. .*/\1/p' log.checkMesh)
viscosity=$(LC_ALL=C awk -v a="$area" 'BEGIN { if (a + 0 <= 0) exit 1; print 0.01 * sqrt(a) }') || {
  echo "simple: error: log.checkMesh has no least area of a face" >&2
  exit 5
}
echo "stream ($2 $3 $4); viscosity $viscosity;" > stream
simpleFoam > log.simpleFoam 2>&1 || { tail -n 5 log.simpleFoam >&2; exit 5; }
# Steady: the last change of the pressure is small.
residual=$(sed -n 's/.*Solving for p, Initial residual = \([^,]*\),.*/\1/p' log.simpleFoam | tail -n 1)
awk -v r="$residual" 'BEGIN { exit !(r ~ /^[0-9]/ && r + 0 < 1e-4) }' || {
  echo "simple: error: the flow is not steady (residual ${residual:-none} of log.simpleFoam, below 1e-4 expected):" \
    "use a mesh that is less stretched, or smaller steps of size" >&2
  exit 5
}
last=$(foamListTimes -latestTime 2> log.times)
rm -rf 0
mv "$last" 0  # where readers look first
grep ExecutionTime log.simpleFoam | tail -n 1
