#!/bin/bash
# Removes what the workflow wrote into OUT, by name, and the folders that are empty then. Nothing else is touched: what
# it did not write stays, and is named.
# usage: scripts/workflow_clean.sh OUT EXPORT_FORMAT...
# exit codes: 2 OUT holds no results of the workflow
set -eu -o pipefail
shopt -s nullglob dotglob
out=$1
shift
if [ ! -e "$out" ]; then exit 0; fi
if [ ! -f "$out/model.ref" ]; then
  echo "workflow: error: $out holds no results of make (it has no model.ref); nothing was removed, look into it" >&2
  exit 2
fi

files=(model.ref blank.ref preset.ref base.ref check.txt report.txt report.html mesh.mapbc mesh.lb8.mapbc mesh.b8.mapbc)
for artifact in geometry raster sizing patches mesh; do files+=("$artifact.hdf" "$artifact.incomplete.hdf"); done
for format in "$@"; do files+=("mesh.$format"); done
for stage in import raster prolong mesh merge check remesh export info; do
  files+=("st-$stage.toml" "log/st-$stage".{ref,log,seconds})
done

# The files of one folder of results, and what a killed run left of them.
remove_results() {
  local folder=$1 file
  for file in "${files[@]}" {patches,mesh}.failures.hdf log/fresh; do
    rm -f "$folder/$file" "$folder/$file.tmp."* "$folder/$(dirname "$file")/.$(basename "$file").tmp."*
  done
  rm -f "$folder/check.tmp."* "$folder/report.tmp."*
  rmdir "$folder/log" 2> /dev/null || true
}

remove_moving_source() {
  rm -f "$1/source.toml" "$1/sizing.hdf" "$1"/mesh_{[0-9]*,restored}.hdf "$1"/{remesh,check}_{[0-9]*,restored}.json \
    "$1"/frame_{[0-9]*,restored}.png
}

remove_moving_source "$out/moving_source"
for folder in "$out/open" "$out/remesh" "$out"; do remove_results "$folder"; done
for folder in "$out/open" "$out/remesh" "$out/moving_source" "$out"; do rmdir "$folder" 2> /dev/null || true; done
left=("$out"/*)
[ ${#left[@]} -eq 0 ] || echo "workflow: $out keeps what make did not write: ${left[*]#"$out/"}"
