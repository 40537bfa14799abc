#!/bin/bash
# What remeshing a region costs, beside making the whole mesh again on the same sizes.
# usage: compare_remesh.sh BIN MODEL [RANKS...]       RANKS: 1 2 by default
# "whole" is st-mesh and st-merge, "redone" st-remesh --merged: whole processes, from the same sizing to a mesh
# artifact. st-prolong, which both need, is in neither. The least of REPEAT (3) wall times each, taken alternately, and
# user+system seconds of the same run.
# Environment: SCALE of all sizes (0.3: a million triangles on a D150 half aircraft); SOURCES, lines of "x y z length
# radius" in the model unit; FOLDER for the artifacts (removed by default).
set -eu -o pipefail
bin=$1 model=$2
shift 2
ranks=${*:-1 2}
scale=${SCALE:-0.3} repeat=${REPEAT:-3}
sources=${SOURCES:-18 5 0 0.25 10
18 5 0 0.15 10
2 0.5 0.5 0.05 3}
folder=${FOLDER:-$(mktemp -d)}
[ -n "${FOLDER:-}" ] || trap 'rm -rf "$folder"' EXIT
mkdir -p "$folder"
cd "$folder"

"$bin/st-import" "$model" -o geometry.hdf -q
"$bin/st-raster" geometry.hdf -o raster.hdf -q
"$bin/st-prolong" raster.hdf -o sizing.hdf --scale "$scale" -q
"$bin/st-mesh" geometry.hdf sizing.hdf -o patches.hdf -q
"$bin/st-merge" patches.hdf -o mesh.hdf -q

# timed COMMAND...: wall and user+system seconds
timed() {
  local TIMEFORMAT='%R %U %S'
  { time "$@" >&2; } 2>&1 | awk 'END { print $1, $2 + $3 }'
}
whole() {
  "$bin/st-mesh" geometry.hdf "$1" -o patches.hdf -q --np "$2"
  "$bin/st-merge" patches.hdf -o whole.hdf -q
}
redone() { "$bin/st-remesh" "$3" geometry.hdf "$1" --merged remeshed.hdf -q --np "$2"; }

# compare NAME MESH SIZING
compare() {
  local n i shares
  shares=$("$bin/st-remesh" "$2" geometry.hdf "$3" --merged once.hdf --json -q | tail -1 | /usr/bin/python3 -c '
import json, sys
j = json.load(sys.stdin)
before, redone, after = j["triangles_before"], j["triangles_redone"], j["triangles"]
print(f"{before} {100 * redone / before:.1f} {100 * (after - before + redone) / after:.1f}")')
  for n in $ranks; do
    for ((i = 0; i < repeat; ++i)); do
      echo "$(timed whole "$3" "$n") $(timed redone "$3" "$n" "$2")"
    done | awk -v name="$1" -v shares="$shares" -v n="$n" '
      NR == 1 || $1 < whole { whole = $1; whole_cpu = $2 }
      NR == 1 || $3 < redone { redone = $3; redone_cpu = $4 }
      END { split(shares, s)
            printf "%-28s %9d %8s %8s %3d %8.2f %8.2f %6.0f %% %8.2f %8.2f %6.0f %%\n", name, s[1], s[2] " %",
            s[3] " %", n, whole, redone, 100 * redone / whole, whole_cpu, redone_cpu, 100 * redone_cpu / whole_cpu }'
  done
}

echo "source                       triangles   redone      new  np    whole   redone    ratio   whole(cpu) redone ratio"
while read -r x y z length radius; do
  printf '[[source]]\nname = "p"\ntype = "point"\nat = [%s, %s, %s]\nlength = %s\nradius = %s\n' "$x" "$y" "$z" \
    "$length" "$radius" > source.toml
  "$bin/st-prolong" raster.hdf -o finer.hdf --scale "$scale" --sources source.toml -q
  compare "$x $y $z $length $radius" mesh.hdf finer.hdf
  mv once.hdf finer_mesh.hdf
  compare "  taken away" finer_mesh.hdf sizing.hdf
done <<< "$sources"
