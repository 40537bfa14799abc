#!/bin/bash
# clang-tidy with the checks of .clang-tidy, over the sources of lib and tools that changed since a revision. A header
# that changed is judged in its own source, or in one that includes it.
# usage: scripts/tidy.sh [--all | --base REV] [--most N] [BUILD_DIR]     BUILD_DIR: configured, default build/check
#   --base REV   default: where this branch left origin/main, or the commit before this one. Where nothing changed
#                since, what the last commit to lib or tools changed is judged
#   --most N     at most so many files; the others are named as not judged
set -eu -o pipefail
cd "$(dirname "$0")/.."
base=$(git merge-base HEAD origin/main 2> /dev/null || true)
[ "$base" != "$(git rev-parse HEAD)" ] && [ -n "$base" ] || base=HEAD~1
build=build/check most=
while [ $# -gt 0 ]; do
  case $1 in
    --all) base=; shift ;;
    --base) base=${2:?--base needs a revision}; shift 2 ;;
    --most) most=${2:?--most needs a number}; shift 2 ;;
    -*) sed -n '4p' "$0" >&2; exit 2 ;;
    *) build=$1; shift ;;
  esac
done
if [ ! -f "$build/compile_commands.json" ]; then
  echo "tidy: error: $build has no compile_commands.json; configure it first" >&2
  exit 2
fi
if [ -n "$base" ] && ! git rev-parse -q --verify "$base^{commit}" > /dev/null; then
  echo "tidy: WARNING: $base is not here, so nothing tells what changed: all files count as changed"
  base=
fi

all_sources() { git ls-files -- 'lib/*.cpp' 'tools/*.cpp'; }
# of the files on stdin: sources as they are, headers by a source that includes them
sources_of() {
  local file
  while IFS= read -r file; do
    case $file in
      *.cpp) [ ! -f "$file" ] || echo "$file" ;;
      *.h)
        [ -f "$file" ] || continue
        if [ -f "${file%.h}.cpp" ]; then
          echo "${file%.h}.cpp"
        else
          git grep -lF "#include \"${file#*/}\"" -- 'lib/*.cpp' 'tools/*.cpp' | sed -n 1p || true
        fi ;;
    esac
  done | sort -u
}
changed_since() { git diff --name-only "$1" -- lib tools .clang-tidy; }

what="the files that changed since $base"
changed=
[ -z "$base" ] || changed=$(changed_since "$base")
if [ -n "$base" ] && [ -z "$changed" ]; then
  last=$(git log -n 1 --format=%h -- lib tools .clang-tidy)
  echo "tidy: WARNING: nothing in lib and tools changed since $base; judging what commit $last changed there"
  what="the files of commit $last"
  changed=$(git show --name-only --format= "$last" -- lib tools .clang-tidy)
fi
if [ -z "$base" ] || grep -qx '.clang-tidy' <<< "$changed"; then
  what="all files"
  mapfile -t sources < <(all_sources)
else
  mapfile -t sources < <(sources_of <<< "$changed")
fi
if [ ${#sources[@]} -eq 0 ]; then
  echo "tidy: $what hold no source"
  exit 0
fi
if [ -n "$most" ] && [ ${#sources[@]} -gt "$most" ]; then
  echo "tidy: WARNING: NOT judged, more than $most files: ${sources[*]:$most}"
  sources=("${sources[@]:0:$most}")
fi
echo "tidy: ${#sources[@]} files, $what"
log=$build/tidy.log
status=0
printf '%s\0' "${sources[@]}" |
  xargs -0 -P"$(nproc)" -n1 clang-tidy -p "$build" --quiet > "$log" 2> "$log.errors" || status=1
grep -hE 'warning:|error:' "$log" "$log.errors" | sort -u || true
[ $status = 0 ] || { echo "tidy: error: see the lines above; the whole log is $log" >&2; exit 1; }
