#!/bin/bash
# Ties the folder of results to one model and to the tools: OUT/model.ref holds the model's content hash and path, OUT/log/<stage>.tool the
# hash of the tool; they change only with the content. Makes the option files that are missing, with every option at its default.
# usage: scripts/workflow_model.sh OUT BIN_DIR MODEL       exit 2 when OUT holds the results of another model
set -eu -o pipefail
out=$1 bin=$2 model=$3
[ -f "$model" ] || { echo "workflow: error: MODEL '$model' is no file" >&2; exit 3; }
mkdir -p "$out/log"
path=$(realpath "$model")
hash=$(sha256sum < "$model" | cut -d' ' -f1)
if [ -f "$out/model.ref" ]; then
  { read -r old_hash && IFS= read -r old_path; } < "$out/model.ref"
  if [ "$old_hash" != "$hash" ] && [ "$old_path" != "$path" ]; then
    echo "workflow: error: $out holds the results of another model, $old_path; give OUT=<folder> for $model" >&2
    exit 2
  fi
fi

replace() { cat > "$1.tmp.$$" && mv "$1.tmp.$$" "$1"; }

[ "${old_hash-}" = "$hash" ] || printf '%s\n%s\n' "$hash" "$path" | replace "$out/model.ref"
for stage in st-import st-raster st-prolong st-mesh st-merge; do
  tool=$(sha256sum < "$bin/$stage")
  [ "$tool" = "$(cat "$out/log/$stage.tool" 2> /dev/null)" ] || echo "$tool" | replace "$out/log/$stage.tool"
  if [ ! -f "$out/$stage.toml" ]; then
    template=$("$bin/$stage" --print-options)
    echo "$template" | replace "$out/$stage.toml"
  fi
done
