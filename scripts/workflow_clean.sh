#!/bin/bash
# Removes what the workflow wrote into OUT, by name, and the folders that are empty then. Nothing else is touched:
# option files stay unless FORCE is 1, what it did not write stays, or what was changed since, and is named.
# usage: scripts/workflow_clean.sh OUT FORCE EXPORT_FORMAT...     FORCE: 1, nothing, or "asks": only says what it needs
# exit codes: 2 OUT holds no results of the workflow, or FORCE is needed
set -eu -o pipefail
shopt -s nullglob dotglob
out=$1 force=$2
shift 2
own=${0%/*}/workflow_own.sh
if [ ! -e "$out" ]; then exit 0; fi
option_files=()
for stage in import raster prolong mesh merge check remesh; do
  [ ! -f "$out/st-$stage.toml" ] || option_files+=("st-$stage.toml")
done
if [ "$force" = asks ]; then
  echo "workflow: error: distclean removes the option files of $out, too: ${option_files[*]:-none};" \
    "give FORCE=1, or keep them with make clean" >&2
  exit 2
fi
if [ ! -f "$out/model.ref" ] && [ ${#option_files[@]} -eq 0 ]; then
  echo "workflow: error: $out holds no results of make (it has no model.ref); nothing was removed, look into it" >&2
  exit 2
fi

# Ours by their names; and those that are ours only where no one else wrote them.
files=(model.ref blank.ref preset.ref base.ref log/fresh log/lock log/adopted .st-written)
for stage in import raster prolong mesh merge check remesh export info; do
  files+=("log/st-$stage".{ref,log,seconds})
done
results=(check.txt report.txt report.html mesh.mapbc mesh.lb8.mapbc mesh.b8.mapbc {patches,mesh}.failures.hdf)
for artifact in geometry raster sizing patches mesh; do results+=("$artifact.hdf" "$artifact.incomplete.hdf"); done
for format in "$@"; do results+=("mesh.$format"); done

# The files of one folder of results, and what a killed run left of them.
remove_results() {
  local folder=$1 file
  [ -d "$folder" ] || return 0
  "$own" remove "${results[@]/#/$folder/}"
  for file in "${files[@]}" "${results[@]}"; do
    rm -f "$folder/$file.tmp."* "$folder/$(dirname "$file")/.$(basename "$file").tmp."*
  done
  rm -f "${files[@]/#/$folder/}" "$folder/check.tmp."* "$folder/report.tmp."*
  rmdir "$folder/log" 2> /dev/null || true
}

remove_moving_source() {
  rm -f "$1/source.toml" "$1/sizing.hdf" "$1"/mesh_{[0-9]*,restored}.hdf "$1"/{remesh,check}_{[0-9]*,restored}.json \
    "$1"/frame_{[0-9]*,restored}.png
}

if [ -f "$out/model.ref" ]; then
  remove_moving_source "$out/moving_source"
  for folder in "$out/open" "$out/remesh" "$out"; do remove_results "$folder"; done
fi
if [ "$force" = 1 ]; then
  rm -f "${option_files[@]/#/$out/}"
  option_files=()
fi
for folder in "$out/open" "$out/remesh" "$out/moving_source" "$out"; do rmdir "$folder" 2> /dev/null || true; done
left=()
for file in "$out"/*; do
  case " ${option_files[*]} " in *" ${file##*/} "*) ;; *) left+=("${file##*/}") ;; esac
done
if [ ${#option_files[@]} -gt 0 ]; then
  echo "workflow: $out keeps its option files (make distclean FORCE=1 removes them): ${option_files[*]}"
fi
[ ${#left[@]} -eq 0 ] || echo "workflow: $out keeps what make did not write, or what was changed: ${left[*]}"
