#!/bin/bash
# scripts/tidy.sh judges the layers that changed, and fails on what clang-tidy finds there.
# usage: tidy_test.sh SOURCE_DIR
set -eu -o pipefail
source=$1
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"
mkdir -p scripts lib/base/deep lib/mesh tools build/check
cp "$source/scripts/tidy.sh" scripts/
cp "$source/.clang-tidy" .
commit() { git add -A && git -c user.name=t -c user.email=t@t commit -qm "$1"; }
status=0
failed() { echo "failed: $1" >&2; cat out >&2; status=1; }

git init -q
echo 'int f() { return 1; }' > lib/base/deep/f.cpp
echo 'double g(int n) { return n / 2; }' > lib/mesh/g.cpp
for file in lib/base/deep/f.cpp lib/mesh/g.cpp; do
  printf '{"directory": "%s", "file": "%s/%s", "command": "c++ -std=c++20 -c %s"}\n' "$PWD" "$PWD" $file $file
done | paste -sd, | sed 's/.*/[&]/' > build/check/compile_commands.json
echo build > .gitignore
commit first
echo '// changed' >> lib/base/deep/f.cpp
commit second
scripts/tidy.sh > out 2>&1 || failed "a clean layer passes, whatever the others hold"
grep -q '1 files of lib/base' out || failed "only the layer that changed is judged"
echo '// changed' >> lib/mesh/g.cpp
commit third
! scripts/tidy.sh > out 2>&1 || failed "a finding in a layer that changed is an error"
grep -q 'lib/mesh/g.cpp.*bugprone-integer-division' out || failed "and is shown"
! scripts/tidy.sh --all > out 2>&1 || failed "--all judges all layers"
! scripts/tidy.sh --base not_there > out 2>&1 || failed "an unknown revision means all layers"
scripts/tidy.sh --base HEAD > out 2>&1 || failed "nothing changed is no error"
exit $status
