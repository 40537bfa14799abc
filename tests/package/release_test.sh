#!/bin/bash
# scripts/release.sh runs all steps in order, and where one fails leaves the files as they were, without commit or tag.
# The steps themselves are stand-ins that write down that they ran.
# usage: release_test.sh SOURCE_DIR
set -eu -o pipefail
source=$1
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"
status=0
failed() { echo "failed: $1" >&2; cat ../out >&2; status=1; }

mkdir -p steps clone
for step in make python3 cmake cpack; do
  cat > steps/$step <<'STEP'
#!/bin/bash
name=$(basename "$0")
echo "$name" >> "$RAN"
[ "$name" != cpack ] || touch "st_0.3.0_amd64.deb" "st-dev_0.3.0_amd64.deb"
[ "${BREAKS:-}" != "$name" ]
STEP
  chmod +x steps/$step
done
export PATH=$scratch/steps:$PATH RAN=$scratch/ran
cd clone
mkdir -p scripts docs bench packaging/spack/st build/release tests/package
cp "$source/scripts/release.sh" scripts/
cp ../steps/cmake scripts/wheel.sh
cp ../steps/cmake tests/package/wheel_test.sh
cp ../steps/cmake tests/package/deb_test.sh
for file in CMakeLists.txt README.md docs/packages.md packaging/spack/st/package.py; do
  cp "$source/$file" $file
  old=$(sed -n 's/^project(st VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
  grep -q "$old" $file || failed "$file names the version $old"
  sed -i "s/$old/0.2.0/g" $file
done
printf '# Changelog\n\n## [Unreleased]\n\n- New: a thing.\n\n## [0.2.0] - 2026-11-22\n\n- Old.\n' > CHANGELOG.md
printf 'build\n' > .gitignore
export GIT_AUTHOR_NAME=t GIT_AUTHOR_EMAIL=t@t GIT_COMMITTER_NAME=t GIT_COMMITTER_EMAIL=t@t
git init -q && git add -A && git commit -qm first
before=$(git rev-parse HEAD)
refuses() { ! scripts/release.sh "$1" > ../out 2>&1 && grep -q "$2" ../out; }
unchanged() { [ -z "$(git status --porcelain)" ] && [ "$(git rev-parse HEAD)" = "$before" ] && [ -z "$(git tag)" ]; }

for version in 0.2.0 0.1.9 0.3 x; do
  refuses $version 'no version\|does not come after' || failed "$version is refused"
  unchanged || failed "$version changes nothing"
done
for step in make python3 cmake cpack deb_test.sh wheel.sh wheel_test.sh; do
  BREAKS=$step refuses 0.3.0 error || failed "a release without $step fails"
  unchanged || failed "nothing changes where $step fails"
done
echo more >> README.md
refuses 0.3.0 'not committed' || failed "changes are refused"
git checkout -q README.md

rm -f ../ran
scripts/release.sh 0.3.0 > ../out 2>&1 || failed "a release is made"
[ "$(uniq ../ran | paste -sd' ')" = "make python3 cmake cpack deb_test.sh wheel.sh wheel_test.sh" ] ||
  failed "all steps run in order"
[ -f build/release-0.3.0/st_0.3.0_amd64.deb ] || failed "the package is there"
[ "$(cat build/release-0.3.0/notes.txt)" = "- New: a thing." ] || failed "the notes are those of this version"
[ "$(scripts/release.sh --notes 0.2.0)" = "- Old." ] || failed "notes of an earlier version"
git tag -l --format='%(contents)' v0.3.0 | grep -q 'a thing' || failed "the tag has the notes"
grep -q '^## \[0.3.0\] - 20' CHANGELOG.md || failed "the changelog has the version"
grep -q '^## \[Unreleased\]' CHANGELOG.md || failed "the changelog goes on"
grep -q 'st VERSION 0.3.0' CMakeLists.txt || failed "the sources have the version"
! grep -rq '0\.2\.0' README.md docs packaging || failed "no page names the old version"
[ -z "$(git status --porcelain)" ] || failed "all is committed"
refuses 0.4.0 'nothing under' || failed "a release of nothing is refused"
exit $status
