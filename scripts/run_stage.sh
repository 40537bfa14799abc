#!/bin/bash
# Runs one stage of the workflow: says what it says, keeps its wall time in OUT/log/<stage>.seconds and its last lines
# in OUT/log/<stage>.log.
# usage: scripts/run_stage.sh OUT STAGE COMMAND... -o|--merged ARTIFACT ...   exits as the command, which may be a
# launcher's A stage that ends with 5 (incomplete) keeps its artifact as <name>.incomplete.hdf, which no rule trusts,
# unless ALLOW_INCOMPLETE is 1.
set -u -o pipefail
out=$1 stage=$2
shift 2
artifact=
for ((i = 1; i < $#; ++i)); do
  next=$((i + 1))
  case ${!i} in -o | --merged) artifact=${!next} ;; esac
done
log=$out/log/$stage
[ -d "$out/log" ] || mkdir -p "$out/log"
runs() { kill -0 "$1" 2> /dev/null && ! grep -q '^State:.Z' "/proc/$1/status" 2> /dev/null; }
for leftover in "${artifact%/*}/.${artifact##*/}.tmp."*; do  # of a run that was killed
  owner=${leftover##*.tmp.}
  [ ! -f "$leftover" ] || runs "${owner%%.*}" || rm -f "$leftover"
done
: > "$out/log/fresh"  # something ran: the report is new

start=${EPOCHREALTIME/[.,]/}
printf '%s\n' "$(printf '%q ' "$@")" > "$log.log"
"$@" | tee -a "$log.log"
status=$?
stop=${EPOCHREALTIME/[.,]/}

if [ $status -eq 5 ]; then
  if [ "${ALLOW_INCOMPLETE:-}" = 1 ]; then
    echo "workflow: continuing although $artifact is incomplete" >&2
    status=0
  else
    incomplete=${artifact%.hdf}.incomplete.hdf
    if [ -s "$incomplete" ] && ! grep -aqF content_hash -- "$incomplete"; then
      echo "workflow: error: $incomplete is not of make; move it away" >&2
      rm -f "$artifact"
      exit 6
    fi
    [ ! -f "$artifact" ] || mv "$artifact" "$incomplete"
    echo "workflow: error: $incomplete is incomplete; inspect it, or continue with ALLOW_INCOMPLETE=1" >&2
  fi
fi
milliseconds=$(((stop - start) / 1000))
[ $status -ne 0 ] || printf '%d.%03d\n' $((milliseconds / 1000)) $((milliseconds % 1000)) > "$log.seconds"
exit $status
