#!/bin/bash
# clang-tidy with the checks of .clang-tidy, over all sources of the layers and tools that changed since a revision.
# usage: scripts/tidy.sh [--all | --base REV] [BUILD_DIR]     BUILD_DIR: configured, default build/check
#   --base REV   default: where this branch left origin/main, or the commit before this one
set -eu -o pipefail
cd "$(dirname "$0")/.."
base=$(git merge-base HEAD origin/main 2> /dev/null || true)
[ "$base" != "$(git rev-parse HEAD)" ] && [ -n "$base" ] || base=HEAD~1
build=build/check
while [ $# -gt 0 ]; do
  case $1 in
    --all) base=; shift ;;
    --base) base=${2:?--base needs a revision}; shift 2 ;;
    -*) sed -n '3p' "$0" >&2; exit 2 ;;
    *) build=$1; shift ;;
  esac
done
if [ ! -f "$build/compile_commands.json" ]; then
  echo "tidy: error: $build has no compile_commands.json; configure it first" >&2
  exit 2
fi
if [ -n "$base" ] && ! git rev-parse -q --verify "$base^{commit}" > /dev/null; then
  echo "tidy: $base is not here; all layers are checked"
  base=
fi

layers=(lib/* tools/*)
if [ -n "$base" ]; then
  changed=$(git diff --name-only "$base" -- lib tools .clang-tidy)
  if ! grep -qx '.clang-tidy' <<< "$changed"; then
    mapfile -t layers < <(cut -d/ -f1,2 <<< "$changed" | sort -u | grep .)
  fi
fi
mapfile -t sources < <(git ls-files -- "${layers[@]/%//*.cpp}")
if [ ${#layers[@]} -eq 0 ] || [ ${#sources[@]} -eq 0 ]; then
  echo "tidy: nothing changed since $base"
  exit 0
fi
echo "tidy: ${#sources[@]} files of ${layers[*]}"
log=$build/tidy.log
status=0
printf '%s\0' "${sources[@]}" |
  xargs -0 -P"$(nproc)" -n1 clang-tidy -p "$build" --quiet > "$log" 2> "$log.errors" || status=1
grep -hE 'warning:|error:' "$log" "$log.errors" | sort -u || true
[ $status = 0 ] || { echo "tidy: error: see the lines above; the whole log is $log" >&2; exit 1; }
