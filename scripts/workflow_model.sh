#!/bin/bash
# Ties the folder of results to one model: OUT/model.ref holds the model's hash and path, and changes only with its
# content.
# usage: scripts/workflow_model.sh OUT MODEL
# exit codes: 2 OUT holds the results of another model, 3 there is no such model
set -eu -o pipefail
out=$1 model=$2
[ -f "$model" ] || { echo "workflow: error: MODEL '$model' does not exist" >&2; exit 3; }
path=$(realpath -- "$model")
hash=$(sha256sum < "$model")
hash=${hash%% *}
if [ -f "$out/model.ref" ]; then
  { read -r old_hash && IFS= read -r old_path; } < "$out/model.ref"
  if [ "$old_hash" = "$hash" ]; then exit 0; fi
  if [ "$old_path" != "$path" ]; then
    echo "workflow: error: $out holds the results of another model, $old_path; give OUT=<folder> for $model" >&2
    exit 2
  fi
fi
printf '%s\n%s\n' "$hash" "$path" | "${0%/*}/replace_if_changed.sh" "$out/model.ref"
