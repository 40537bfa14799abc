#!/bin/bash
# Whose files are these? What ST and make write under names of their own stands in the record of its folder,
# .st-written, as cksum prints it (lib/io/file/output_files.h); artifacts say it themselves.
# usage: workflow_own.sh require FILE...    of those that are there, each is ours and was not changed (by its size)
#        workflow_own.sh note FILE...       they are ours
#        workflow_own.sh remove FILE...     removes those that are ours and were not changed, and leaves the others
# exit codes: 2 a file is not ours
set -eu -o pipefail
action=$1
shift
record_of() { printf '%s/.st-written' "$(dirname -- "$1")"; }

require() {
  local file foreign=()
  for file in "$@"; do
    [ -s "$file" ] || continue
    line="^[0-9]+ $(stat -L -c %s -- "$file") "
    if ! grep -sE "$line" -- "$(record_of "$file")" | cut -d' ' -f3- | grep -qxF -- "$(basename -- "$file")"; then
      foreign+=("$file")
    fi
  done
  [ ${#foreign[@]} -eq 0 ] || {
    echo "workflow: error: would be replaced, but make did not write it, or it was changed since: ${foreign[*]};" \
      "move it away, or give OUT=<folder>" >&2
    exit 2
  }
}

# The line of a file in its record.
line_of() { printf '%s %s\n' "$(cksum < "$1")" "$(basename -- "$1")"; }

note() {
  local file record rest
  for file in "$@"; do
    record=$(record_of "$file")
    rest=$(awk -v name="$(basename -- "$file")" '{ l = $0; sub(/^[0-9]+ [0-9]+ /, "", l) } l != name' "$record" \
      2> /dev/null || true)
    { [ -z "$rest" ] || printf '%s\n' "$rest"; line_of "$file"; } > "$record.tmp.$$"
    mv "$record.tmp.$$" "$record"
  done
}

# HDF5 artifacts carry a hash of their content.
is_own() {
  case $1 in
    *.hdf) grep -aqF content_hash -- "$1" ;;
    *) grep -sqxF -- "$(line_of "$1")" "$(record_of "$1")" ;;
  esac
}

remove() {
  local file
  for file in "$@"; do
    [ -f "$file" ] || continue
    if [ ! -s "$file" ] || is_own "$file"; then rm -f -- "$file"; fi
  done
}

"$action" "$@"
