#!/bin/bash
# Writes stdin to a file, unless the file holds just that: its time stamp changes only with its content.
# usage: ... | scripts/replace_if_changed.sh FILE
set -eu
mkdir -p "$(dirname "$1")"
temporary=$1.tmp.$$
trap 'rm -f "$temporary"' EXIT
cat > "$temporary"
cmp -s "$temporary" "$1" || mv "$temporary" "$1"
