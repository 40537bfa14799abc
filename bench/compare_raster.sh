#!/bin/bash
# st-raster at default options beside Debian's gmsh: sizes from curvature + 1-D meshing (gmsh -1 -nt 1,
# Mesh.MeshSizeFromCurvature 36 = 10 degrees, the same smallest and largest length), one rank and one thread, in one
# run, ROUNDS times in turn; the best of each counts, wall and processor time. Reading the CAD file is left out on both
# sides: st-raster opens a geometry artifact that st-import made; gmsh's own clock of "meshing 1D" starts when it has
# read its file. st-raster is charged with its whole process all the same (start, opening, writing), gmsh with
# "meshing 1D" alone. What is compared is not the same work: gmsh asks for curvature along curves only; st-raster
# samples curves and the inside of faces, and builds and writes the octree.
# usage: bench/compare_raster.sh [BIN_DIR] [MODEL...]     default models: two of the corpus (ST_CORPUS); ROUNDS=3; exit
# 1 when gmsh needs less processor time on one
set -eu
here=$(cd "$(dirname "$0")/.." && pwd)
bin=${1:-$here/build/release/bin}
shift || true
corpus=${ST_CORPUS:-$here/../shared/corpus}
[ $# -gt 0 ] || set -- "$corpus/aero_d150_wing_body_half.brep" "$corpus/mech_geouned_scdr.stp"
command -v gmsh > /dev/null || { echo "compare_raster.sh: needs gmsh" >&2; exit 2; }
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT

run_st() { # of the whole process: wall time and user + system time
  local TIMEFORMAT='%R %U %S'
  { time "$bin/st-raster" "$out/geometry.hdf" -o "$out/raster.hdf" --json > "$out/raster.json" 2> "$out/st.err"; } \
    2> "$out/time" || { cat "$out/st.err" >&2; return 1; }
  awk '{ print $1 }' "$out/time" >> "$out/st_wall"
  awk '{ print $2 + $3 }' "$out/time" >> "$out/st_cpu"
}
value() { grep -o "\"$1\":[-0-9.e+]*" "$out/raster.json" | head -1 | cut -d: -f2; }  # groups have samples, too
run_gmsh() {
  gmsh -1 -nt 1 "$1" -clcurv 36 -clmin "$(value lmin)" -clmax "$(value lmax)" -format msh22 -o "$out/curves.msh" -v 5 \
    > "$out/gmsh.log" 2>&1
  sed -n 's/.*Done meshing 1D (Wall \([0-9.e+-]*\)s, CPU.*/\1/p' "$out/gmsh.log" >> "$out/gmsh_wall"
  sed -n 's/.*Done meshing 1D (Wall .*s, CPU \([0-9.e+-]*\)s).*/\1/p' "$out/gmsh.log" >> "$out/gmsh_cpu"
}
best() { sort -g "$out/$1" | head -1; }

status=0
echo "gmsh $(gmsh --version 2>&1 | tail -1), ${ROUNDS:-3} rounds"
for model in "$@"; do
  rm -f "$out"/*
  "$bin/st-import" "$model" -o "$out/geometry.hdf" -q
  for _ in $(seq "${ROUNDS:-3}"); do
    run_st
    run_gmsh "$model"
  done
  segments=$(sed -n 's/.* nodes \([0-9]*\) elements.*/\1/p' "$out/gmsh.log" | tail -1)
  awk -v m="$(basename "$model")" -v sw="$(best st_wall)" -v sc="$(best st_cpu)" -v gw="$(best gmsh_wall)" \
    -v gc="$(best gmsh_cpu)" -v n="$(value samples)" \
    -v c="$(value cells)" -v s="$segments" 'BEGIN {
    printf "%s\n  st-raster, whole process  %8.3f s wall %8.3f s processor  %d samples, %d cells\n", m, sw, sc, n, c
    printf "  gmsh, meshing 1D          %8.3f s wall %8.3f s processor  %d segments\n", gw, gc, s
    printf "  gmsh / st-raster          %8.1f        %8.1f\n", gw / sw, gc / sc
    exit !(sc < gc) }' || status=1
done
exit $status
