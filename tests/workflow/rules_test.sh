#!/bin/bash
# The make rules of Makefile.workflow, with fake tools: what runs when, and what a failure leaves.
# usage: rules_test.sh SOURCE_DIR
set -eu -o pipefail
source=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
unset MAKEFLAGS MAKELEVEL MFLAGS MODEL OUT NP EXPORT BLANK ALLOW_INCOMPLETE TOOLS BUILD
export FAKE_LOG=$work/ran
mkdir bin
for tool in st-import st-raster st-prolong st-mesh st-merge st-check st-info st-export; do
  cp "$source/tests/workflow/fake_tool.sh" "bin/$tool"
  chmod +x "bin/$tool"
done
echo model-a > a.step

failures=0
# run ARGUMENTS...: make's exit code in $status, what ran in $ran, what it said in $said
run() {
  : > "$FAKE_LOG"
  status=0
  said=$(make -f "$source/Makefile.workflow" TOOLS="$work/bin" "$@" 2>&1) || status=$?
  ran=$(tr '\n' ' ' < "$FAKE_LOG")
}
expect() {  # expect WHAT ACTUAL EXPECTED
  if [ "$2" != "$3" ]; then
    printf 'FAILED %s:%s: %s\n  expected: %s\n  actual:   %s\n  said: %s\n' "$0" "${BASH_LINENO[0]}" "$1" "$3" "$2" "$said"
    failures=$((failures + 1))
  fi
}
later() { sleep 0.02; "$@"; }  # a time stamp that is certainly newer

all="st-import st-raster st-prolong st-mesh st-merge st-check st-export st-info "
run MODEL=a.step
expect "a first run runs every stage" "$ran" "$all"
expect "a first run succeeds" "$status" 0
expect "the report says where the mesh is" "$(grep -c out/a/mesh.hdf <<< "$said" | sed 's/^[1-9].*/yes/')" yes

run MODEL=a.step
expect "a second run runs nothing" "$ran" ""
expect "a second run says so" "$(grep -c 'up to date' <<< "$said")" 1

later touch a.step
run MODEL=a.step
expect "a touched model of the same content runs nothing" "$ran" ""

echo 'slope = 0.1' > out/a/st-prolong.toml
run MODEL=a.step
expect "an edited option file runs its stage and what follows" "$ran" "st-prolong st-mesh st-merge st-check st-export st-info "
echo '# nothing' >> out/a/st-merge.toml
run MODEL=a.step
expect "the last stage's option file runs the last stage alone" "$ran" "st-merge st-check st-export st-info "
rm out/a/st-raster.toml
run MODEL=a.step
expect "a removed option file comes back with the defaults and counts as an edit" "$ran" "st-raster st-prolong st-mesh st-merge st-check st-export st-info "

run MODEL=a.step OUT=b BLANK=1
expect "blanking takes two passes and one raster" "$ran" "st-import st-raster st-prolong st-mesh st-merge st-prolong st-mesh st-merge st-check st-export st-info "
run MODEL=a.step OUT=b BLANK=1
expect "a second run with blanking runs nothing" "$ran" ""
run MODEL=a.step OUT=b
expect "without blanking the second pass is made again" "$ran" "st-prolong st-mesh st-merge st-check st-export st-info "
run MODEL=a.step OUT=b BLANK=1
expect "and with it again, from the mesh of the first" "$ran" "st-prolong st-mesh st-merge st-check st-export st-info "
expect "the mesh of the first pass blanks" "$(grep -cx st-merge b/sizing.hdf)" 1
rm -r b

run MODEL=a.step NP=7
expect "the number of ranks does not make results old" "$ran" ""
run MODEL=a.step EXPORT="stl vtu"
expect "a further export is made alone" "$ran" "st-export st-info "
run MODEL=a.step "$PWD/nothing" || true
expect "an unknown target fails" "$status" 2
run MODEL=a.step out/a/mesh.obj
expect "an export is a target" "$ran" "st-export "

later touch bin/*
run MODEL=a.step
expect "tools built again with the same content run nothing" "$ran" ""
echo '# a new version' >> bin/st-mesh
run MODEL=a.step
expect "a changed tool runs its stage and what follows" "$ran" "st-mesh st-merge st-check st-export st-info "

echo model-b > a.step
run MODEL=a.step
expect "a changed model runs everything" "$ran" "$all"
mkdir other
echo model-c > other/a.step
run MODEL=other/a.step
expect "another model of the same name is refused" "$status $ran" "2 "
expect "and the message names the remedy" "$(grep -c 'give OUT=' <<< "$said")" 1
cp a.step other/a.step
run MODEL=other/a.step
expect "the same model elsewhere is the same" "$status $ran" "0 "

echo model-d > "other/my wing's #1.step"
run MODEL="other/my wing's #1.step"
expect "a model's path may hold spaces, quotes and hashes" "$status $ran" "0 $all"
expect "its folder has none" "$(ls out)" "$(printf 'a\nmy_wing_s__1')"
run MODEL=a.step OUT="two words"
expect "an OUT with spaces is refused" "$status" 2
run MODEL=missing.step
expect "a missing model is refused" "$status" 2
run MODEL=other
expect "a folder as a model is refused" "$status" 2

echo model-e > e.step
export FAKE_FAIL="st-prolong 3"
run MODEL=e.step
expect "a failed stage stops make" "$status $ran" "2 st-import st-raster st-prolong "
expect "and leaves no artifact" "$(ls out/e/*.hdf | tr '\n' ' ')" "out/e/geometry.hdf out/e/raster.hdf "
unset FAKE_FAIL
run MODEL=e.step
expect "afterwards make goes on where it stopped" "$ran" "st-prolong st-mesh st-merge st-check st-export st-info "

later touch out/e/st-raster.toml
export FAKE_FAIL="st-raster 5"
run MODEL=e.step
expect "a raster of which parts are missing stops make" "$status $ran" "2 st-raster "
expect "and is kept under a name that no rule trusts" "$(ls out/e/raster*)" out/e/raster.incomplete.hdf
run MODEL=e.step ALLOW_INCOMPLETE=1
expect "raster and sizing are allowed to be incomplete when asked" "$status $ran" "0 st-raster st-prolong st-mesh st-merge st-check st-export st-info "
unset FAKE_FAIL

later touch out/e/st-mesh.toml
export FAKE_FAIL="st-mesh 5"
run MODEL=e.step
expect "an incomplete stage stops make" "$status $ran" "2 st-mesh "
expect "its artifact is kept under a name that no rule trusts" "$(ls out/e/patches*)" out/e/patches.incomplete.hdf
run MODEL=e.step ALLOW_INCOMPLETE=1
expect "make goes on with it when asked" "$status $ran" "0 st-mesh st-merge st-check st-export st-info "
unset FAKE_FAIL

later touch out/e/st-raster.toml
FAKE_KILL=st-raster setsid make -f "$source/Makefile.workflow" TOOLS="$work/bin" MODEL=e.step > killed.log 2>&1 &
make_id=$!
for _ in $(seq 200); do [ -s "$FAKE_LOG.pid" ] && break; sleep 0.05; done
kill -KILL "$(cat "$FAKE_LOG.pid")"
wait $make_id || true
run MODEL=e.step
expect "a killed stage runs again, and what follows" "$ran" "st-raster st-prolong st-mesh st-merge st-check st-export st-info "
expect "and leaves no temporary" "$(find out/e -name '.*.tmp.*' | wc -l)" 0

FAKE_CHECK=5
export FAKE_CHECK
later touch out/e/st-merge.toml
run MODEL=e.step
expect "a mesh that does not pass ends make with an error, after the report" "$status $(grep -c 'did not pass' <<< "$said")" "2 1"
unset FAKE_CHECK
run MODEL=e.step
expect "and the verdict stays" "$status $ran" "2 "

[ $failures -eq 0 ] && echo "all workflow rules hold"
exit $((failures > 0))
