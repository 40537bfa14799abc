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
# Of a file: $name, and $record of its folder.
locate() {
  name=${1##*/} record=.st-written
  case $1 in */*) record=${1%/*}/.st-written ;; esac
}

# Whether the record has a file of this name and size.
has_size() {
  local bytes recorded
  [ -f "$record" ] || return 1
  while read -r _ bytes recorded; do
    if [ "$bytes" = "$1" ] && [ "$recorded" = "$name" ]; then return 0; fi
  done < "$record"
  return 1
}

require() {
  local file i foreign=() present=() sizes=()
  for file in "$@"; do
    if [ -s "$file" ]; then present+=("$file"); fi
  done
  [ ${#present[@]} -gt 0 ] || return 0
  mapfile -t sizes < <(stat -L -c %s -- "${present[@]}")
  for i in "${!present[@]}"; do
    locate "${present[i]}"
    has_size "${sizes[i]-}" || foreign+=("${present[i]}")
  done
  [ ${#foreign[@]} -eq 0 ] || {
    echo "workflow: error: would be replaced, but make did not write it, or it was changed since: ${foreign[*]};" \
      "move it away, or give OUT=<folder>" >&2
    exit 2
  }
}

# The line of a file in its record.
line_of() { printf '%s %s\n' "$(cksum < "$1")" "${1##*/}"; }

note() {
  local file rest
  for file in "$@"; do
    locate "$file"
    rest=$(awk -v name="$name" '{ l = $0; sub(/^[0-9]+ [0-9]+ /, "", l) } l != name' "$record" \
      2> /dev/null || true)
    { [ -z "$rest" ] || printf '%s\n' "$rest"; line_of "$file"; } > "$record.tmp.$$"
    mv "$record.tmp.$$" "$record"
  done
}

# HDF5 artifacts carry a hash of their content.
is_own() {
  case $1 in
    *.hdf) grep -aqF content_hash -- "$1" ;;
    *) locate "$1"; grep -sqxF -- "$(line_of "$1")" "$record" ;;
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
