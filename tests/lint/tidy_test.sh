#!/bin/bash
# scripts/tidy.sh judges the files that changed, says which, and fails on what clang-tidy finds there.
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
  printf '{"directory": "%s", "file": "%s/%s", "command": "c++ -std=c++20 -Ilib -c %s"}\n' "$PWD" "$PWD" $file $file
done | paste -sd, | sed 's/.*/[&]/' > build/check/compile_commands.json
echo 'inline int h(int n) { return n; }' > lib/mesh/h.h
echo '#include "mesh/h.h"' >> lib/mesh/g.cpp
echo build > .gitignore
commit first
! scripts/tidy.sh > out 2>&1 || failed "one commit alone: all files count as changed"
grep -q 'WARNING: HEAD~1 is not here' out || failed "and it says so"
echo '// changed' >> lib/base/deep/f.cpp
commit second
scripts/tidy.sh > out 2>&1 || failed "a clean file passes, whatever the others hold"
grep -q 'tidy: 1 files, the files that changed since HEAD~1' out || failed "only the file that changed is judged"
echo words > README.md
commit third
scripts/tidy.sh > out 2>&1 || failed "nothing changed in lib: the last commit there is judged"
grep -q 'WARNING: nothing in lib and tools changed' out || failed "and it says so"
grep -q '1 files, the files of commit' out || failed "its files are judged"
echo '// changed' >> lib/mesh/h.h
commit fourth
! scripts/tidy.sh > out 2>&1 || failed "a header is judged in a source that includes it"
grep -q 'lib/mesh/g.cpp.*bugprone-integer-division' out || failed "and what is found is shown"
! scripts/tidy.sh --all > out 2>&1 || failed "--all judges all files"
scripts/tidy.sh --all --most 1 > out 2>&1 || failed "--most judges so many files"
grep -q 'WARNING: NOT judged, more than 1 files: lib/mesh/g.cpp' out || failed "and names the others"
! scripts/tidy.sh --base not_there > out 2>&1 || failed "an unknown revision means all files"
exit $status
