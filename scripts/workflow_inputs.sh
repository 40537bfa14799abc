#!/bin/bash
# Writes what a stage depends on besides artifacts to OUT/log/<stage>.ref: hashes of its tool, of its option file and
# of each file that its options name. Makes option files that are missing, with every option at its default; st-export
# and st-info have none.
# usage: scripts/workflow_inputs.sh OUT BIN_DIR STAGE...
# exit codes: 2 a bad option file, 3 it names a file that is missing
set -eu -o pipefail
shopt -s inherit_errexit
out=$1 bin=$2
shift 2

hash_of() { sha256sum < "$1" | cut -d' ' -f1; }

# The lines of option file and named files; relative names count from the folder in which make runs, as for the tools.
options_of() {
  local stage=$1 options=$out/$1.toml files file
  if [ ! -f "$options" ]; then
    "$bin/$stage" --print-options > "$options.tmp.$$"
    mv "$options.tmp.$$" "$options"
  fi
  echo "options $(hash_of "$options")"
  files=$("$bin/$stage" --options "$options" --print-inputs)
  while IFS= read -r file; do
    [ -n "$file" ] || continue
    [ -f "$file" ] || { echo "workflow: error: $options names '$file', which does not exist in $PWD" >&2; exit 3; }
    echo "input $(hash_of "$file") $file"
  done <<< "$files"
}

mkdir -p "$out/log"
for stage in "$@"; do
  lines="tool $(hash_of "$bin/$stage")"
  case $stage in
    st-export | st-info) ;;
    *) lines+=$'\n'$(options_of "$stage") ;;
  esac
  echo "$lines" | "$(dirname "$0")/replace_if_changed.sh" "$out/log/$stage.ref"
done
