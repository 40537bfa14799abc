#!/bin/bash
# Makes a release of what is committed: checks, figures, package, notes, and a tag. Nothing is pushed.
#
# usage: scripts/release.sh VERSION [OUT_DIR]         such as 0.3.0; default OUT_DIR: build/release-VERSION
#        scripts/release.sh --notes VERSION           prints what CHANGELOG.md says of a version, or of Unreleased
#
# The version goes into the files that name it, and [Unreleased] of CHANGELOG.md gets its number and today's date. Then
# `make check` has to pass, and no stage may need over 3 % more instructions than bench/budget.tsv has. OUT_DIR gets
# the Debian packages, the wheel, figures.txt and notes.txt; the commit gets the tag vVERSION with the notes. Where a
# step fails, the files are as before, and there is neither a commit nor a tag.
set -eu -o pipefail
if [ $# -gt 1 ] && [ "$1" != --notes ]; then set -- "$1" "$(realpath -m "$2")"; fi
cd "$(dirname "$0")/.."

fail() {
  echo "release: error: $1" >&2
  exit "${2:-2}"
}

# The section of a version, without its heading.
notes() {
  sed -n "/^## \[${1//./\\.}\]/,/^## \[/p" CHANGELOG.md | sed '1d; /^## \[/d' | sed '/./,$!d'
}

if [ "${1:-}" = --notes ]; then
  [ -n "$(notes "${2:?a version}")" ] || fail "CHANGELOG.md says nothing of $2"
  notes "$2"
  exit
fi

version=${1:?a version, such as 0.3.0} out=${2:-build/release-$1}
naming=(CMakeLists.txt README.md docs/packages.md packaging/spack/st/package.py)
old=$(sed -n 's/^project(st VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)

[[ $version =~ ^[0-9]+\.[0-9]+\.[0-9]+$ ]] || fail "$version is no version such as 0.3.0"
printf '%s\n' "$old" "$version" | sort -C -V -u || fail "$version does not come after $old"
[ -z "$(git status --porcelain)" ] || fail "there are changes that are not committed"
! git rev-parse -q --verify "refs/tags/v$version" > /dev/null || fail "the tag v$version is there already"
[ -n "$(notes Unreleased)" ] || fail "CHANGELOG.md says nothing under [Unreleased]"

restore() {
  git checkout -q -- CHANGELOG.md "${naming[@]}"
}
trap restore EXIT
sed -i "s/${old//./\\.}/$version/g" "${naming[@]}"
sed -i "s/^## \[Unreleased\]/&\n\n## [$version] - $(date +%F)/" CHANGELOG.md
mkdir -p "$out"

echo "release: checks"
make check || fail "make check failed" 5
echo "release: figures"
python3 bench/budget.py build/check/bin | tee "$out/figures.txt" || fail "a stage needs more than bench/budget.tsv" 5
echo "release: package"
package() { cmake --preset release && cmake --build --preset release && (cd build/release && cpack -G DEB); }
package > "$out/package.log" || fail "no package; see $out/package.log" 6
tests/package/deb_test.sh "$PWD" "$PWD/build/release" --bare "$PWD/build/check/test_models" ||
  fail "the package does not work" 5
mv build/release/*_"$version"_*.deb "$out"
echo "release: wheel"
wheel=$(scripts/wheel.sh build/release "$out") || fail "no wheel" 6
tests/package/wheel_test.sh "$PWD" "$PWD/build/check" "$wheel" || fail "the wheel does not work" 5
notes "$version" > "$out/notes.txt"

git commit -q -m "release: version $version" -m "What users see is in CHANGELOG.md under [$version]." \
  CHANGELOG.md "${naming[@]}"
trap 'git reset -q --mixed HEAD^; restore' EXIT
git tag -a "v$version" --cleanup=verbatim -m "ST $version" -m "$(cat "$out/notes.txt")"
trap - EXIT
echo "release: v$version in $out; push it with: git push origin HEAD v$version"
