#!/bin/bash
# The end of the workflow: the verdict on the mesh, time per stage, where the files are.
# usage: scripts/workflow_report.sh check OUT BIN_DIR                  writes OUT/check.txt: exit code of st-check, then what it says
#        scripts/workflow_report.sh write OUT BIN_DIR [EXPORTED...]    writes OUT/report.txt
#        scripts/workflow_report.sh show OUT                           prints it; exit 5 when the mesh did not pass
set -eu -o pipefail
action=$1 out=$2

check() {
  local bin=$1 status=0
  "$bin/st-check" "$out/mesh.hdf" --geometry "$out/geometry.hdf" --sizing "$out/sizing.hdf" > "$out/check.tmp.$$" || status=$?
  if [ $status -ne 0 ] && [ $status -ne 5 ]; then
    rm -f "$out/check.tmp.$$"
    exit $status
  fi
  { echo $status; cat "$out/check.tmp.$$"; } > "$out/check.txt"
  rm -f "$out/check.tmp.$$"
  touch "$out/log/fresh"
}

times() {
  local total=0 stage seconds
  for stage in st-import st-raster st-prolong st-mesh st-merge st-export; do
    [ -f "$out/log/$stage.seconds" ] || continue
    seconds=$(< "$out/log/$stage.seconds")
    printf '  %-10s %8.2f s\n' "$stage" "$seconds"
    total=$(awk "BEGIN { print $total + $seconds }")
  done
  printf '  %-10s %8.2f s\n' total "$total"
}

write() {
  local bin=$1
  shift
  {
    echo "model   $(sed -n 2p "$out/model.ref")"
    "$bin/st-info" "$out/mesh.hdf"
    sed 1d "$out/check.txt"
    echo "time per stage (of the run that made each artifact)"
    times
    echo "files"
    printf '  %s\n' "$out/mesh.hdf" "$@" "$out/geometry.hdf" "$out/raster.hdf" "$out/sizing.hdf" "$out/patches.hdf"
    echo "options: edit $out/st-<stage>.toml and run make again"
  } > "$out/report.tmp.$$"
  mv "$out/report.tmp.$$" "$out/report.txt"
}

show() {
  [ -f "$out/log/fresh" ] || echo "$out is up to date"
  rm -f "$out/log/fresh"
  cat "$out/report.txt"
  if [ "$(head -n 1 "$out/check.txt")" != 0 ]; then
    echo "workflow: error: the mesh did not pass st-check, see above" >&2
    exit 5
  fi
}

shift 2
"$action" "$@"
