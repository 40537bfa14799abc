#!/bin/bash
# Configures once and builds; says nothing when there is nothing to do.
# usage: scripts/build.sh BUILD_DIR [cmake options] [-- targets]     targets: what to build, default all
set -eu -o pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
build=$1
shift
options=() targets=()
for argument in "$@"; do
  if [ "$argument" = -- ] || [ ${#targets[@]} -gt 0 ]; then targets+=("$argument"); else options+=("$argument"); fi
done
log=$build/build.log
mkdir -p "$build"
# What one clone compiled serves the next, wherever that lies.
export CCACHE_BASEDIR=${CCACHE_BASEDIR-$root} CCACHE_NOHASHDIR=1 CCACHE_SLOPPINESS=gcno_cwd

say() { if [ -t 1 ]; then printf '\r\033[K%s' "$1"; fi; }
fail() {
  local show=(tail -n 40)
  if grep -qm1 "^FAILED" "$log"; then show=(sed -n "/^FAILED/,\$p"); fi
  "${show[@]}" "$log" | cut -c1-400 | head -n 60 >&2
  echo "build: error: $1; the whole log is $log" >&2
  exit 1
}

if [ ! -f "$build/build.ninja" ]; then
  echo "build: configuring $build"
  rm -f "$build/CMakeCache.txt"
  cmake -S "$root" -B "$build" -G Ninja "${options[@]}" > "$log" 2>&1 || fail "cmake failed"
fi
# Shows the progress of ninja's output on a terminal; silent when nothing is compiled.
progress() {
  local line started=
  while IFS= read -r line; do
    [[ $line == \[*\ Building* || $line == \[*\ Linking* ]] || continue
    [ -n "$started" ] || echo "build: compiling (the log is $log)"
    started=1
    say "${line:0:100}"
  done
  say ""
}
ninja -C "$build" "${targets[@]:1}" 2>&1 | tee "$log" | progress || fail "compiling failed"
