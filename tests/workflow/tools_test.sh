#!/bin/bash
# Makefile.workflow with the real tools on a small model: up to date means nothing to do, an edit runs only what
# follows.
# usage: tools_test.sh SOURCE_DIR BIN_DIR MODELS_DIR
set -eu -o pipefail
source=$1 bin=$2 models=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
unset MAKEFLAGS MAKELEVEL MFLAGS MODEL OUT NP LAUNCH EXPORT BLANK ALLOW_INCOMPLETE TOOLS BUILD

fail() { echo "FAILED: $1"; cat said.txt; exit 1; }
export NP=2
run() { make -f "$source/Makefile.workflow" TOOLS="$bin" "$@" > said.txt 2>&1; }
stamps() { stat -c '%n %y' out/block_with_hole/*.hdf; }

run MODEL="$models/block_with_hole.step" EXPORT="stl vtu" || fail "the chain did not run"
for name in geometry.hdf raster.hdf sizing.hdf patches.hdf mesh.hdf mesh.stl mesh.vtu report.txt; do
  [ -s "out/block_with_hole/$name" ] || fail "$name is missing"
done
grep -q triangles said.txt || fail "the report does not say how many triangles"
grep -q 'st-mesh .* s$' said.txt || fail "the report does not say the time of st-mesh"
first=$("$bin/st-info" out/block_with_hole/mesh.hdf --hash)

before=$(stamps)
run MODEL="$models/block_with_hole.step" EXPORT="stl vtu" || fail "the second run failed"
[ "$before" = "$(stamps)" ] || fail "the second run made something"
grep -q 'up to date' said.txt || fail "the second run does not say that all is up to date"
run MODEL="$models/block_with_hole.step" report || fail "no page was written"
[ "$before" = "$(stamps)" ] || fail "the page made something else, too"
grep -q 'Mesh report' out/block_with_hole/report.html || fail "the page is not there"

sleep 0.02
echo 'slope = 0.1' > out/block_with_hole/st-prolong.toml
run MODEL="$models/block_with_hole.step" EXPORT="stl vtu" || fail "the run after an edit failed"
changed=$(diff <(echo "$before") <(stamps) | sed -n 's/^> .*\/\([a-z]*\)\.hdf .*/\1/p' | tr '\n' ' ' || true)
[ "$changed" = "mesh patches sizing " ] || fail "an edit of st-prolong.toml made: $changed"
second=$("$bin/st-info" out/block_with_hole/mesh.hdf --hash)
[ "$first" != "$second" ] || fail "the edited option was not taken"

# Remeshing keeps the mesh at hand and follows the edited sizes; the moving source leaves the results alone, too.
cat >> out/block_with_hole/st-prolong.toml << 'END'
[[source]]
type = "point"
at = [0, 0, 0]
length = 0.3
radius = 1
END
before=$(stamps)
run MODEL="$models/block_with_hole.step" remesh || fail "remeshing did not run"
run MODEL="$models/block_with_hole.step" moving-source STEPS=1 FRAMES=0 FROM="0 0 0" LENGTH=0.3 RADIUS=1 OUT=moving ||
  fail "the source did not move"
grep -q '^restored' said.txt || fail "the moving source does not end with its table"
[ "$before" = "$(stamps)" ] || fail "remeshing touched other artifacts than its own"
remeshed=out/block_with_hole/remesh/mesh.hdf
[ "$second" != "$("$bin/st-info" $remeshed --hash)" ] || fail "the source was not taken"
"$bin/st-info" $remeshed | grep -q "from mesh .*$second" || fail "the mesh at hand was not the one remeshed"
run MODEL="$models/block_with_hole.step" remesh LAUNCH="mpirun --quiet --allow-run-as-root --oversubscribe -np 2" ||
  fail "a launcher instead of NP did not run"
grep -q 'is up to date' said.txt || fail "a second remesh ran something"

echo 'slope = 0' > out/block_with_hole/st-prolong.toml
if run MODEL="$models/block_with_hole.step"; then fail "a bad option file went through"; fi
grep -q 'st-prolong.toml:1' said.txt || fail "the message does not name file and line"
[ "$second" = "$("$bin/st-info" out/block_with_hole/mesh.hdf --hash)" ] || fail "a failed stage touched the mesh"
echo "the workflow holds with the real tools"
