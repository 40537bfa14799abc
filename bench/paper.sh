#!/bin/bash
# The two cases of the paper by their like: time of each stage with one thread and with two, st-mesh replayed on more.
# usage: bench/paper.sh [BIN_DIR] [OUT_DIR]     needs the corpus (ST_CORPUS); run it on a quiet machine
#   aircraft: 272 faces, 322,000 triangles, angle of 10 degrees, inner sizes blanked (the paper: 346 surfaces, 322,204)
#   fighter:  3 machines of 1,369 faces side by side, 1.6 million triangles (the paper: 2,749 surfaces, 1.6 million)
set -eu
here=$(cd "$(dirname "$0")/.." && pwd)
bin=${1:-$here/build/release/bin}
out=${2:-$(mktemp -d)}
corpus=${ST_CORPUS:-$here/../shared/corpus}
mkdir -p "$out"

seconds() { # command...: wall time
  local TIMEFORMAT=%R
  { time "$@" > "$out/log" 2>&1; } 2>&1 || { cat "$out/log" >&2; return 1; }
}

case_of() { # name triangles raster-options...: out/name.geometry.hdf is there
  local name=$1 n=$2 threads
  shift 2
  echo "| $name, threads | st-raster | st-prolong | st-mesh | st-merge | st-check | all |"
  echo "|--:|--:|--:|--:|--:|--:|--:|"
  for threads in 1 2; do
    local at=$out/$name on=(-q --threads "$threads")
    local raster prolong mesh merge check
    raster=$(seconds "$bin/st-raster" "$at.geometry.hdf" -o "$at.raster.hdf" "${on[@]}" "$@")
    prolong=$(seconds "$bin/st-prolong" "$at.raster.hdf" -o "$at.sizing.hdf" --target-triangles "$n" "${on[@]}")
    mesh=$(seconds "$bin/st-mesh" "$at.geometry.hdf" "$at.sizing.hdf" -o "$at.patches.hdf" --trace "$at.$threads.csv" \
      --journal-after 1e9 "${on[@]}")  # on more processors it ends before a journal begins
    merge=$(seconds "$bin/st-merge" "$at.patches.hdf" -o "$at.mesh.hdf" "${on[@]}")
    check=$(seconds "$bin/st-check" "$at.mesh.hdf" --geometry "$at.geometry.hdf" --sizing "$at.sizing.hdf" \
      "${on[@]}") || true
    echo "$threads $raster $prolong $mesh $merge ${check:-0}" |
      awk '{ printf "| %d | %s | %s | %s | %s | %s | %.2f |\n", $1, $2, $3, $4, $5, $6, $2 + $3 + $4 + $5 + $6 }'
  done
  "$bin/st-info" "$out/$name.mesh.hdf"
  python3 -B "$here/bench/replay.py" "$out/$name.1.csv" --ranks 1,2,16,32,256
  python3 -B "$here/bench/replay.py" "$out/$name.1.csv" --ranks 1,2,16 --threads 16 | tail -3
}

"$bin/st-import" "$corpus/aero_d150_fullspan.brep" -o "$out/aircraft.geometry.hdf" -q
case_of aircraft 322000 --alpha 10

"$bin/st-import" "$corpus/mech_geouned_scdr.stp" -o "$out/1.hdf" -q
for i in 2 3; do
  "$bin/st-edit" "$out/1.hdf" -o "$out/$i.hdf" --transform "translate $((i * 5000)) 0 0" -q
done
"$bin/st-edit" "$out/1.hdf" "$out/2.hdf" "$out/3.hdf" --as one,two,three -o "$out/fighter.geometry.hdf" -q
case_of fighter 1600000
