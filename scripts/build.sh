#!/bin/bash
# Configures once and builds; says nothing when there is nothing to do.
# usage: scripts/build.sh BUILD_DIR [cmake options]
set -eu -o pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
build=$1
shift
log=$build/build.log
mkdir -p "$build"

say() { if [ -t 1 ]; then printf '\r\033[K%s' "$1"; fi; }
fail() {
  { grep -qm1 "^FAILED" "$log" && sed -n "/^FAILED/,\$p" "$log" || tail -n 40 "$log"; } | cut -c1-400 | head -n 60 >&2
  echo "build: error: $1; the whole log is $log" >&2
  exit 1
}

if [ ! -f "$build/build.ninja" ]; then
  echo "build: configuring $build"
  rm -f "$build/CMakeCache.txt"
  cmake -S "$root" -B "$build" -G Ninja "$@" > "$log" 2>&1 || fail "cmake failed"
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
ninja -C "$build" 2>&1 | tee "$log" | progress || fail "compiling failed"
