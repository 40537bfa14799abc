#!/bin/bash
# Results that are dated in the future, by another clock or a copy, would hide an edit: they are dated now, in the
# order in which they were.
# usage: scripts/workflow_dates.sh OUT
set -eu -o pipefail
out=$1 n=0 before=
[ -d "$out" ] || exit 0
now=${EPOCHREALTIME/,/.}
seconds=${now%.*} nanoseconds=$((10#${now#*.} * 1000))
while IFS= read -r -d '' entry; do
  [ "${entry%% *}" = "$before" ] || n=$((n + 1000))
  before=${entry%% *}
  total=$((nanoseconds + n))
  touch -d "@$((seconds + total / 1000000000)).$(printf %09d $((total % 1000000000)))" -- "${entry#* }"
done < <(find "$out/" -maxdepth 2 -type f -newermt "@$now" ! -name '*.toml' \
  \( -name '*.hdf' -o -name 'mesh.*' -o -name '*.ref' -o -name check.txt -o -name report.txt \) -printf '%T@ %p\0' |
  sort -zn)
