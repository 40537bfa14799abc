#!/bin/bash
# Whose files lie in OUT, with fake tools: two runs at once, dates in the future, files of the user under names of ours,
# clean, PRESET, odd names of folders.
# usage: files_test.sh SOURCE_DIR
set -eu -o pipefail
source=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
# shellcheck source-path=SCRIPTDIR source=common.sh
. "$source/tests/workflow/common.sh"
use_fake_tools
echo model-a > a.step
all="st-import st-raster st-prolong st-mesh st-merge st-check st-export st-info "

# --- two runs in one folder ---
: > "$FAKE_LOG"
make -f "$source/Makefile.workflow" TOOLS="$work/bin" MODEL=a.step > first.log 2>&1 &
make -f "$source/Makefile.workflow" TOOLS="$work/bin" MODEL=a.step > second.log 2>&1 &
both=0
wait %1 || both=1
wait %2 || both=2
expect "two runs at once succeed, and each stage runs once" "$both $(sort "$FAKE_LOG" | tr '\n' ' ')" \
  "0 $(tr ' ' '\n' <<< "${all% }" | sort | tr '\n' ' ')"
expect "one of them waited, and said so" "$(cat first.log second.log | grep -c 'another make works in out/a')" 1
# The lock is that of what make started, too.
echo '# edited' >> out/a/st-raster.toml
(exec 9>> out/a/log/lock; flock 9; sleep 1; cp out/a/raster.hdf kept.hdf) &
run MODEL=a.step
expect "a run waits for the end of another" "$status $(grep -c edited kept.hdf || true)" "0 0"
wait

# --- dates in the future ---
find out/a -type f -exec touch -d '2100-01-01' {} +
run MODEL=a.step
expect "dates in the future are no edit" "$status $ran" "0 "
touch -d '2100-01-02' out/a/*.hdf out/a/mesh.stl out/a/check.txt out/a/report.txt
echo 'alpha = 7' >> out/a/st-raster.toml
run MODEL=a.step
expect "and hide none" "$status $ran" "0 ${all#st-import }"
touch -d '2100-01-02' out/a/sizing.hdf
touch -d '2100-01-01' out/a/patches.hdf
run MODEL=a.step
expect "what is older stays older" "$status $ran" "0 st-mesh st-merge st-check st-export st-info "
echo 'alpha = 8' >> out/a/st-raster.toml
touch -d '2100-01-01' a.step out/a/st-raster.toml
run MODEL=a.step
run MODEL=a.step
expect "an edit dated in the future runs once" "$status $ran" "0 "

# --- PRESET ---
run MODEL=a.step PRESET=fine
run MODEL=a.step
expect "OUT keeps its preset" "$status $ran $(cat out/a/preset.ref)" "0  preset: fine"
expect "and the report names it" "$(grep -c '^preset  fine ' out/a/report.txt)" 1
run MODEL=a.step remesh
expect "remeshing uses it" "$(grep -cx 'st-prolong fine' out/a/remesh/sizing.hdf)" 1
run MODEL=a.step PRESET=none
expect "until it is given up" "$status $ran" "0 ${all#st-import }"
run MODEL=a.step PRESET=rnas
expect "a preset that is none is refused" "$status $ran" "2 "

# --- files of the user under names of ours ---
for name in mesh.stl mesh.vtu check.txt report.txt; do
  rm -rf b
  mkdir b
  echo mine > "b/$name"
  run MODEL=a.step OUT=b EXPORT="stl vtu"
  expect "$name of the user stops make before anything runs" "$status $ran $(cat "b/$name")" "2  mine"
  expect "and the message names it" "$(grep -c "did not write it.*b/$name" <<< "$said")" 1
  rm "b/$name"
  run MODEL=a.step OUT=b EXPORT="stl vtu"
  expect "without it make runs" "$status" 0
  echo mine >> "b/$name"
  run MODEL=a.step OUT=b EXPORT="stl vtu"
  expect "$name that was edited stops it, too" "$status $ran $(tail -n 1 "b/$name")" "2  mine"
done
run MODEL=a.step OUT=b EXPORT=obj clean
expect "clean leaves what was edited, and names it" \
  "$status $(cd b && echo [a-r]*) $(grep -c 'report.txt' <<< "$said")" "0 report.txt 1"

rm -rf b
mkdir b
echo mine > b/patches.incomplete.hdf
FAKE_FAIL="st-mesh 5" run MODEL=a.step OUT=b
expect "an incomplete artifact replaces no file of the user" "$status $(cat b/patches.incomplete.hdf)" "2 mine"
expect "and is not taken for a complete one" "$(ls b/patches.hdf 2> /dev/null)" ""

# --- clean ---
run MODEL=a.step OUT=c BLANK=1
echo 'alpha = 9' > c/st-raster.toml
run MODEL=a.step OUT=c clean
expect "clean keeps the option files" \
  "$status $(cat c/st-raster.toml) $(find c -mindepth 1 ! -name 'st-*.toml' | wc -l)" "0 alpha = 9 0"
run MODEL=a.step OUT=c clean
expect "a second clean has nothing to do" "$status $(cat c/st-raster.toml)" "0 alpha = 9"
run MODEL=a.step OUT=c distclean
expect "distclean asks" "$status $(cat c/st-raster.toml) $(grep -c 'give FORCE=1' <<< "$said")" "2 alpha = 9 1"
run MODEL=a.step OUT=c distclean FORCE=1
expect "and then removes them" "$status $(ls -d c 2> /dev/null || echo gone)" "0 gone"

# --- blanks and the like in names of folders ---
# shellcheck disable=SC2016
odd='my $(shell touch pwned) re'\''sul&ts|1'
run MODEL=a.step OUT="$odd"
expect "a folder's name is text" "$status $ran $(ls pwned 2> /dev/null)" "0 $all "
expect "results are in it, and named so" "$(head -n 1 "$odd/mesh.hdf") $(grep -cF "$odd/mesh.hdf" <<< "$said")" \
  "st-merge 2"
run MODEL=a.step OUT="$odd"
expect "a second run has nothing to do" "$status $ran $(grep -c 'is up to date' <<< "$said")" "0  1"
run MODEL=a.step OUT="$odd" distclean FORCE=1
expect "it is cleaned" "$status $(ls -d "$odd" 2> /dev/null || echo gone)" "0 gone"

# --- the installed workflow ---
# shellcheck disable=SC2016
prefix="$work/the tools \$HOME" here="$work/some \$x work/deep"
mkdir -p "$prefix/bin" "$prefix/share/st/scripts" "$here"
cp bin/* "$prefix/bin"
cp "$source/Makefile.workflow" "$prefix/share/st"
cp "$source"/scripts/{workflow_*,run_stage,replace_if_changed,nearest_word,make_example}.sh "$prefix/share/st/scripts"
# shellcheck disable=SC2016
printf '#!/bin/sh\necho example > "$1"\n' > "$prefix/bin/make_aircraft"
chmod +x "$prefix/bin/make_aircraft"
installed() {
  : > "$FAKE_LOG"
  status=0
  said=$(cd "$here" && make -f "$prefix/share/st/Makefile.workflow" "$@" 2>&1) || status=$?
  ran=$(tr '\n' ' ' < "$FAKE_LOG")
}
installed MODEL="$work/a.step"
expect "it works below folders with blanks and dollars" "$status $ran" "0 $all"
installed
expect "and meshes its example there" "$status $ran $(ls "$here/out")" "0 $all $(printf 'a\naircraft\nexample')"
installed
expect "once" "$status $ran" "0 "
installed MODEL="$work/a.step" OUT='the results'
expect "into such a folder" "$status $ran $(head -n 1 "$here/the results/mesh.hdf")" "0 $all st-merge"
finish "files of the user and of make are kept apart"
