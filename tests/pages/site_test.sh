#!/bin/bash
# The pages build as a site without a link to nothing; planted links to nothing and a page without navigation are found.
# usage: site_test.sh SOURCE_DIR
set -eu -o pipefail
source=$1
command -v mkdocs > /dev/null || { echo "SKIPPED: no mkdocs, the site was not built (scripts/setup.sh site)"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$source"
cp -r --parents README.md CONTRIBUTING.md CHANGELOG.md LICENSE mkdocs.yml docs examples scripts/site* "$work"
cd "$work"
scripts/site.sh "$work/site" | tee said
[ -s site/docs/guide/to_the_flow.html ] || { echo "FAILED: pages are missing"; exit 1; }
grep -q "images/flow_aircraft.png" site/docs/guide/to_the_flow.html || { echo "FAILED: a picture is missing"; exit 1; }

expect() { # TEXT: the site is refused with this text
  if scripts/site.sh "$work/site" > said 2>&1; then echo "FAILED: not refused: $1"; exit 1; fi
  grep -qF "$1" said || { cat said; echo "FAILED: not said: $1"; exit 1; }
  echo "found: $1"
}
cp docs/glossary.md kept
echo "[there](meshing.md#no-such-place)" >> docs/glossary.md
expect "no-such-place"
cp kept docs/glossary.md
echo "[there](no_such_page.html)" >> docs/glossary.md
expect "no_such_page"
cp kept docs/glossary.md
echo "# Planted" > docs/planted.md
expect "docs/planted.md has no line in mkdocs.yml"
