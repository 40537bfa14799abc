#!/bin/bash
# The two cases of the paper: processor time of each stage with one thread, and st-raster and st-mesh replayed on more.
# usage: bench/paper.sh [BIN_DIR] [OUT_DIR]
#   aircraft: the bundled one in its far field, 237 faces, with paper_aircraft.toml (the paper: 346 surfaces, 322,204)
#   fighter:  2,988 faces by examples/store/fighter.py, in a far field, 1.6 million triangles (the paper: 2,749 surfaces
#             and as many triangles)
# Each is meshed in two passes: the second one's sizes do not pass through the mesh of the first (st-prolong --blank).
set -eu
here=$(cd "$(dirname "$0")/.." && pwd)
bin=${1:-$here/build/release/bin}
out=${2:-$(mktemp -d)}
mkdir -p "$out"
on=(-q --threads 1)

processor_seconds() { # command...
  local TIMEFORMAT="%U %S" spent
  spent=$({ time "$@" > "$out/log" 2>&1; } 2>&1) || { cat "$out/log" >&2; return 1; }
  awk '{ printf "%.2f", $1 + $2 }' <<< "$spent"
}

# No journal: on more processors a run ends before it would begin.
pass() { # name prolong-options...: times of st-prolong, st-mesh, st-merge
  local at=$out/$1 trace=$out/$1.mesh.csv
  shift
  echo "$(processor_seconds "$bin/st-prolong" "$at.raster.hdf" -o "$at.sizing.hdf" "${on[@]}" "$@")" \
    "$(processor_seconds "$bin/st-mesh" "$at.geometry.hdf" "$at.sizing.hdf" -o "$at.patches.hdf" --trace "$trace" \
      --journal-after 1e9 "${on[@]}")" \
    "$(processor_seconds "$bin/st-merge" "$at.patches.hdf" -o "$at.mesh.hdf" "${on[@]}")"
}

replayed() { # trace
  python3 -B "$here/bench/replay.py" "$1" --ranks 1,2,4,16,32,256
  python3 -B "$here/bench/replay.py" "$1" --ranks 1,2,16 --threads 16 | tail -3
}

case_of() { # name prolong-options raster-options...: out/name.geometry.hdf is there
  local name=$1 at=$out/$1 prolong raster first second check
  read -ra prolong <<< "$2"
  shift 2
  echo "| $name | st-raster | first pass: st-prolong | st-mesh | st-merge | second: st-prolong | st-mesh |" \
    "st-merge | st-check | all |"
  echo "|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|"
  raster=$(processor_seconds "$bin/st-raster" "$at.geometry.hdf" -o "$at.raster.hdf" --trace "$at.raster.csv" \
    "${on[@]}" "$@")
  first=$(pass "$name" --no-blank "${prolong[@]}")
  mv "$at.mesh.hdf" "$at.first.hdf"
  second=$(pass "$name" --blank "$at.first.hdf" "${prolong[@]}")
  check=$(processor_seconds "$bin/st-check" "$at.mesh.hdf" --geometry "$at.geometry.hdf" \
    --sizing "$at.sizing.hdf" "${on[@]}")
  echo "$raster $first $second $check" |
    awk '{ printf "| seconds |"; for (i = 1; i <= 8; ++i) { printf " %s |", $i; all += $i } printf " %.2f |\n", all }'
  "$bin/st-info" "$out/$name.mesh.hdf"
  echo "st-raster, replayed"
  replayed "$out/$name.raster.csv"
  echo "st-mesh of the second pass, replayed"
  replayed "$out/$name.mesh.csv"
}

"$bin/make_aircraft" "$out/aircraft.step" > /dev/null
echo "st-import: $(processor_seconds "$bin/st-import" "$out/aircraft.step" -o "$out/aircraft.geometry.hdf" -q) s"
case_of aircraft "" --alpha 10 --lmin 0.0075 --edge-size none --sizes "$here/bench/paper_aircraft.toml"

python3 -B "$here/examples/store/fighter.py" "$out/fighter.dat" "$out/fighter.toml"
echo "st-import: $(processor_seconds "$bin/st-import" "$out/fighter.dat" -o "$out/fighter.geometry.hdf" --unit m \
  --groups "$out/fighter.toml" -q) s"
case_of fighter "--target-triangles 1600000"
