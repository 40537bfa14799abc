#!/bin/bash
# Runs make while no other make works in OUT: a second one waits. The lock is held by make and all that it starts, so
# that what outlives a killed make is waited for, too. An OUT with blanks and the like is given to make as a link.
# usage: scripts/workflow_lock.sh OUT MODEL work|clean COMMAND...   the command gets OUT=<folder>; MODEL may be empty
# exit codes: 3 there is no such model; else as the command
set -eu -o pipefail
out=$1 model=$2 kind=$3
here=$(pwd -P)
shift 3

# Until the lock is that of the file: clean may have removed the one that was waited for.
hold() {
  local file=$out/log/lock status
  while true; do
    [ -d "$out/log" ] || mkdir -p "$out/log"
    exec 9>> "$file"
    status=0
    flock -n -E 99 9 || status=$?
    if [ $status -eq 99 ]; then
      echo "workflow: another make works in $out; waiting for it" >&2
      status=0
      flock 9 || status=$?
    fi
    if [ $status -ne 0 ]; then
      echo "workflow: warning: $file cannot be locked here; do not start a second make in $out" >&2
      return
    fi
    [ ! "$file" -ef /proc/$$/fd/9 ] || return 0
  done
}

# By a link with a plain name; what is said names the folder itself.
run_by_link() {
  local name
  name=$(basename "$out" | tr -c '[:alnum:]._+\200-\377\n-' _)
  folder=$(mktemp -d /tmp/st-workflow.XXXXXX)
  trap 'rm -rf "$folder"' EXIT
  mkdir -p "$out"
  ln -s "$(realpath -- "$out")" "$folder/$name"
  ST_WORKFLOW_SHOWN="s|$folder/$name|$(printf %s "$out" | sed 's/[\\&|]/\\&/g')|g"
  export ST_WORKFLOW_SHOWN ST_WORKFLOW_LOCK=$here//$folder/$name
  { "$@" "OUT=$folder/$name" 2>&1 >&8 8>&- | sed -u "$ST_WORKFLOW_SHOWN" >&2; } 8>&1 | sed -u "$ST_WORKFLOW_SHOWN"
  rmdir "$out" 2> /dev/null || true  # clean could remove no more than the link
}

if [ "$kind" = work ] && [ -n "$model" ] && [ ! -f "$model" ]; then
  echo "workflow: error: MODEL '$model' does not exist" >&2
  exit 3
fi
if [ "$kind" = work ] || [ -f "$out/model.ref" ]; then hold; fi
"${0%/*}/workflow_dates.sh" "$out"  # make looks at dates as it begins
if [ -z "$(printf %s "$out" | tr -d '[:alnum:]._+/@,~\200-\377-')" ]; then
  export ST_WORKFLOW_LOCK=$here//$out
  exec "$@" "OUT=$out"
fi
if [ "$kind" = clean ] && [ ! -e "$out" ]; then exit 0; fi
run_by_link "$@"
