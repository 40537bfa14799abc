#!/bin/bash
# Builds the documentation as a site: build/site/index.html. A page outside the navigation or a link to nothing is an
# error. The pages lie in the site as in the repository, so their links hold in both.
# usage: scripts/site.sh [SITE_DIR]      needs mkdocs
set -eu -o pipefail
cd "$(dirname "$0")/.."
site=$(realpath -m "${1:-build/site}")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir "$scratch/pages"
find README.md CONTRIBUTING.md CHANGELOG.md LICENSE docs examples \
  \( -name '*.md' -o -name '*.png' -o -name '*.svg' -o -name LICENSE \) -print0 |
  xargs -0 cp --parents -t "$scratch/pages"
sed "s|^docs_dir:.*|docs_dir: $scratch/pages|; s|^site_dir:.*|site_dir: $site|" mkdocs.yml > "$scratch/mkdocs.yml"
PYTHONDONTWRITEBYTECODE=1 mkdocs build --strict --clean -f "$scratch/mkdocs.yml" > "$scratch/said" 2>&1 ||
  { grep -v "^INFO" "$scratch/said" >&2; exit 1; }
(cd "$scratch/pages" && find . -name '*.md' -printf '%P\n') | while read -r page; do
  grep -q ": $page\$" mkdocs.yml || { echo "site: error: $page has no line in mkdocs.yml" >&2; exit 1; }
done
python3 scripts/site_links.py "$site"
echo "$site/index.html"
