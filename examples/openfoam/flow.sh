#!/bin/bash
# Potential flow around the walls of a case made by volume.sh, and the gradient of the potential.
# usage: flow.sh CASE
set -eu -o pipefail
[ $# -eq 1 ] || { sed -n '2,3s/^# //p' "$0" >&2; exit 2; }
export WM_PROJECT_DIR=${WM_PROJECT_DIR:-/usr/share/openfoam}
cd "$1"
potentialFoam -writePhi > log.potentialFoam 2>&1 || { tail -n 5 log.potentialFoam >&2; exit 5; }
# Each correction for faces that are not orthogonal begins with a smaller residual than the one before, or diverges.
residual=$(sed -n 's/.*Solving for Phi, Initial residual = \([^,]*\),.*/\1/p' log.potentialFoam | tail -n 1)
awk -v r="$residual" 'BEGIN { exit !(r ~ /^[0-9]/ && r + 0 < 0.01) }' || {
  echo "flow: error: the flow diverges (residual ${residual:-none} of log.potentialFoam, below 0.01 expected):" \
    "use a mesh that is less stretched, or smaller steps of size" >&2
  exit 5
}
# potentialFoam also writes a velocity U, made from the flux through each face. On tetrahedra that of Debian's
# OpenFOAM 1912 is wrong in two of its components; the potential itself is right, and so is its gradient.
postProcess -func 'grad(Phi)' > log.gradient 2>&1 || { tail -n 5 log.gradient >&2; exit 5; }
grep -E "Continuity error|ExecutionTime" log.potentialFoam
