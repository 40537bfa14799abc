#!/bin/bash
# The end of the workflow: the verdict on the mesh, time per stage, where the files are. RESULTS is OUT or OUT/remesh.
# usage: workflow_report.sh check RESULTS OUT BIN_DIR                 RESULTS/check.txt: exit code of st-check, its text
#        workflow_report.sh write RESULTS OUT BIN_DIR [EXPORTED...]   RESULTS/report.txt
#        workflow_report.sh show RESULTS                              prints it; exit 5 when the mesh did not pass
set -eu -o pipefail
export LC_ALL=C  # printf and awk read 0.5 in every locale
action=$1 results=$2
own=${0%/*}/workflow_own.sh

check() {
  local out=$1 bin=$2 status=0 said=$results/check.tmp.$$
  rm -f "$results/check.tmp."* "$results/report.tmp."*  # of runs that were killed
  "$bin/st-check" "$results/mesh.hdf" -v --options "$out/st-check.toml" \
    --geometry "$out/geometry.hdf" --sizing "$results/sizing.hdf" > "$said" || status=$?
  if [ $status -ne 0 ] && [ $status -ne 5 ]; then
    rm -f "$said"
    exit $status
  fi
  "$own" require "$results/check.txt"
  { echo $status; cat "$said"; } > "$results/check.txt"
  rm -f "$said"
  "$own" note "$results/check.txt"
  : > "$results/log/fresh"
}

times() {
  local total=0 stage seconds
  for stage in st-import st-raster st-prolong st-mesh st-merge st-remesh st-export; do
    [ -f "$results/log/$stage.seconds" ] || continue
    seconds=$(< "$results/log/$stage.seconds")
    printf '  %-10s %8.2f s\n' "$stage" "$seconds"
    total=$(awk "BEGIN { print $total + $seconds }")
  done
  printf '  %-10s %8.2f s\n' total "$total"
}

write() {
  local out=$1 bin=$2 again=make
  [ "$results" = "$out" ] || again="make remesh"
  shift 2
  {
    echo "model   $(sed -n 2p "$out/model.ref")"
    preset=$(sed -n 's/^preset: //p' "$out/preset.ref")
    [ -z "$preset" ] || echo "preset  $preset (kept for the next make here; PRESET=none leaves it)"
    "$bin/st-info" "$results/mesh.hdf"
    sed 1d "$results/check.txt"
    echo "time per stage (of the run that made each artifact)"
    times
    echo "files"
    printf '  %s\n' "$results/mesh.hdf" "$@" "$out/geometry.hdf" "$out/raster.hdf" "$results/sizing.hdf"
    [ ! -f "$results/patches.hdf" ] || echo "  $results/patches.hdf"
    echo "options: edit $out/st-<stage>.toml and run $again again"
  } | sed "${ST_WORKFLOW_SHOWN-}" > "$results/report.tmp.$$"
  "$own" require "$results/report.txt"
  mv "$results/report.tmp.$$" "$results/report.txt"
  "$own" note "$results/report.txt"
}

show() {
  [ -f "$results/log/fresh" ] || echo "$results is up to date"
  rm -f "$results/log/fresh"
  cat "$results/report.txt"
  if [ "$(head -n 1 "$results/check.txt")" != 0 ]; then
    echo "workflow: error: the mesh did not pass st-check, see above" >&2
    exit 5
  fi
}

shift 2
"$action" "$@"
