#!/bin/bash
# Writes what a stage depends on besides artifacts to OUT/log/<stage>.ref: hashes of its tool, of its option file and
# of each file that its options name. Makes option files that are missing, with every option at its default, or as
# st-run had them where it made OUT (--keep); st-export and st-info have none.
# usage: scripts/workflow_inputs.sh OUT BIN_DIR STAGE...
# exit codes: 2 a bad option file, 3 it names a file that is missing
set -eu -o pipefail
shopt -s inherit_errexit
out=$1 bin=$2
shift 2

# The hashes of files, one for each line; one program for all of them.
hashes_of() {
  local found
  mapfile -t found < <(sha256sum -- "$@")
  found=("${found[@]#\\}")  # before a name with a backslash
  [ ${#found[@]} -eq $# ] || exit 3
  printf '%.64s\n' "${found[@]}"
}

has_options() { case $1 in st-export | st-info) return 1 ;; esac; }

# The files that a stage's options name; relative names count from the folder in which make runs, as for the tools.
named_files() {
  local options=$out/$1.toml files file
  files=$("$bin/$1" --options "$options" --print-inputs)
  while IFS= read -r file; do
    [ -n "$file" ] || continue
    [ -f "$file" ] || { echo "workflow: error: $options names '$file', which does not exist in $PWD" >&2; exit 3; }
    printf '%s\n' "$file"
  done <<< "$files"
}

# The table of a stage in what st-run has left.
kept_options() { awk -v table="[$1]" '/^\[/ { is_own = $0 == table; next } is_own && NF' "$out/st-run.toml"; }

[ -d "$out/log" ] || mkdir -p "$out/log"
stages=() kinds=() files=()  # what is hashed
add() { stages+=("$1") kinds+=("$2") files+=("$3"); }
for stage in "$@"; do
  add "$stage" tool "$bin/$stage"
  has_options "$stage" || continue
  options=$out/$stage.toml
  if [ ! -f "$options" ]; then
    "$bin/$stage" --print-options > "$options.tmp.$$"
    [ ! -f "$out/st-run.toml" ] || kept_options "$stage" >> "$options.tmp.$$"
    mv "$options.tmp.$$" "$options"
  fi
  add "$stage" options "$options"
  named=$(named_files "$stage")
  while IFS= read -r file; do
    [ -z "$file" ] || add "$stage" input "$file"
  done <<< "$named"
done
hashes=$(hashes_of "${files[@]}")
mapfile -t hashes <<< "$hashes"
for stage in "$@"; do
  text=
  for i in "${!files[@]}"; do
    [ "${stages[i]}" = "$stage" ] || continue
    text+=${text:+$'\n'}"${kinds[i]} ${hashes[i]}"
    [ "${kinds[i]}" != input ] || text+=" ${files[i]}"
  done
  ref=$out/log/$stage.ref  # as replace_if_changed.sh, without three programs for each stage
  [ ! -f "$ref" ] || [ "$(< "$ref")" != "$text" ] || continue
  printf '%s\n' "$text" > "$ref.tmp.$$"
  mv "$ref.tmp.$$" "$ref"
done
