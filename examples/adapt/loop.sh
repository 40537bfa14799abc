#!/bin/bash
# From a clean machine to an adapted mesh: packages, the tools where there are none, four cycles.
# usage: loop.sh MODEL FOLDER [options of adapt.py]
set -eu -o pipefail
[ $# -ge 2 ] || { sed -n '2,3s/^# //p' "$0" >&2; exit 2; }
here=$(dirname "$(realpath "$0")")
root=$(realpath "$here/../..")
told() { echo "loop: $1 after $SECONDS s"; }
"$root/scripts/setup.sh" adapt
told "packages"
bin=()
if ! command -v st-import > /dev/null; then
  [ -f "$root/CMakeLists.txt" ] || { echo "loop: error: no st-import: install the package st" >&2; exit 3; }
  "$root/scripts/setup.sh" build
  "$root/scripts/build.sh" "$root/build/release" -DCMAKE_BUILD_TYPE=Release -DST_TESTS=OFF
  bin=(--bin "$root/build/release/bin")
  told "tools"
fi
"$here/adapt.py" "$@" "${bin[@]}"
told "cycles"
