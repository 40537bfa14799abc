#!/bin/bash
# Writes stdin, which is text, to a file, unless the file holds just that: its time stamp changes only with its content.
# usage: ... | scripts/replace_if_changed.sh FILE
set -eu
text=$(< /dev/stdin)
if [ -f "$1" ] && [ "$(< "$1")" = "$text" ]; then exit 0; fi
[ -d "${1%/*}" ] || mkdir -p "${1%/*}"
printf '%s\n' "$text" > "$1.tmp.$$"
mv "$1.tmp.$$" "$1"
