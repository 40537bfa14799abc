#!/bin/bash
# st-raster at default options beside Debian's gmsh: sizes from curvature + 1-D meshing (gmsh -1 -nt 1, Mesh.MeshSizeFromCurvature 36 = 10 degrees, the
# same smallest and largest length), one rank and one thread, in one run, ROUNDS times in turn; the best of each counts.
# Reading the CAD file is left out on both sides: st-raster opens a geometry artifact that st-import made; gmsh's own clock of "meshing 1D" starts when it
# has read its file. st-raster is charged with its whole process all the same (start, opening, writing), gmsh with "meshing 1D" alone. What is compared is
# not the same work: gmsh asks for curvature along curves only; st-raster samples curves and the inside of faces, and builds and writes the octree.
# usage: bench/compare_raster.sh [BIN_DIR] [MODEL...]     default models: two of the corpus (ST_CORPUS); ROUNDS=3; exit 1 when gmsh is faster on one
set -eu
here=$(cd "$(dirname "$0")/.." && pwd)
bin=${1:-$here/build/release/bin}
shift || true
corpus=${ST_CORPUS:-$here/../shared/corpus}
[ $# -gt 0 ] || set -- "$corpus/aero_d150_wing_body_half.brep" "$corpus/mech_geouned_scdr.stp"
command -v gmsh > /dev/null || { echo "compare_raster.sh: needs gmsh" >&2; exit 2; }
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT

run_st() { # wall time of the process and the stage's own clock
  local start end
  start=$(date +%s.%N)
  "$bin/st-raster" "$out/geometry.hdf" -o "$out/raster.hdf" --json > "$out/raster.json"
  end=$(date +%s.%N)
  awk -v a="$start" -v b="$end" 'BEGIN { print b - a }' >> "$out/st"
}
value() { sed -n "s/.*\"$1\":\([-0-9.e+]*\).*/\1/p" "$out/raster.json" | tail -1; }
run_gmsh() {
  gmsh -1 -nt 1 "$1" -clcurv 36 -clmin "$(value lmin)" -clmax "$(value lmax)" -format msh22 -o "$out/curves.msh" -v 5 > "$out/gmsh.log" 2>&1
  sed -n 's/.*Done meshing 1D (Wall \([0-9.e+-]*\)s.*/\1/p' "$out/gmsh.log" >> "$out/gmsh"
  sed -n 's/.*From start: Wall \([0-9.e+-]*\)s.*/\1/p' "$out/gmsh.log" | tail -1 >> "$out/whole"
}
best() { sort -g "$1" | head -1; }

status=0
echo "$(gmsh --version 2>&1 | tail -1 | sed 's/^/gmsh /'), ${ROUNDS:-3} rounds"
for model in "$@"; do
  rm -f "$out"/*
  "$bin/st-import" "$model" -o "$out/geometry.hdf" -q
  for _ in $(seq "${ROUNDS:-3}"); do
    run_st
    run_gmsh "$model"
  done
  st=$(best "$out/st") gmsh=$(best "$out/gmsh") whole=$(best "$out/whole")
  segments=$(sed -n 's/.* nodes \([0-9]*\) elements.*/\1/p' "$out/gmsh.log" | tail -1)
  awk -v m="$(basename "$model")" -v st="$st" -v g="$gmsh" -v w="$whole" -v n="$(value samples)" -v c="$(value cells)" -v s="$segments" 'BEGIN {
    printf "%s\n  st-raster %8.3f s  whole process: %d samples, %d cells\n  gmsh      %8.3f s  meshing 1D: %d segments (whole process %.3f s)\n  gmsh / st-raster %.1f\n",
      m, st, n, c, g, s, w, g / st }'
  awk -v st="$st" -v g="$gmsh" 'BEGIN { exit !(st < g) }' || status=1
done
exit $status
