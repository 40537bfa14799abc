#!/bin/bash
# Ties the folder of results to one model: OUT/model.ref holds the model's content hash and path, and changes only with the content. Makes
# the option files that are missing, with every option at its default.
# usage: scripts/workflow_model.sh OUT BIN_DIR MODEL       exit 2 when OUT holds the results of another model
set -eu -o pipefail
out=$1 bin=$2 model=$3
[ -f "$model" ] || { echo "workflow: error: MODEL '$model' is no file" >&2; exit 3; }
mkdir -p "$out"
path=$(realpath "$model")
hash=$(sha256sum < "$model" | cut -d' ' -f1)
if [ -f "$out/model.ref" ]; then
  { read -r old_hash && IFS= read -r old_path; } < "$out/model.ref"
  if [ "$old_hash" != "$hash" ] && [ "$old_path" != "$path" ]; then
    echo "workflow: error: $out holds the results of another model, $old_path; give OUT=<folder> for $model" >&2
    exit 2
  fi
fi
if [ "${old_hash-}" != "$hash" ]; then
  printf '%s\n%s\n' "$hash" "$path" > "$out/model.ref.tmp.$$"
  mv "$out/model.ref.tmp.$$" "$out/model.ref"
fi
for stage in st-import st-raster st-prolong st-mesh st-merge; do
  file=$out/$stage.toml
  [ -f "$file" ] && continue
  "$bin/$stage" --print-options > "$file.tmp.$$"
  mv "$file.tmp.$$" "$file"
done
