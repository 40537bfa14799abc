#!/bin/bash
# Writes the bundled example, a transport aircraft, unless it is there, made by just this program.
# usage: scripts/make_example.sh BIN_DIR OUT.step
set -eu
program=$1/make_aircraft
step=$2
[ -x "$program" ] || { echo "example: error: $program is missing; give MODEL=<CAD file>" >&2; exit 1; }
made_by=$(sha256sum < "$program")
if [ -f "$step" ] && [ "$made_by" = "$(cat "$step.made_by" 2> /dev/null)" ]; then exit 0; fi
echo "example: making $step"
mkdir -p "$(dirname "$step")"
temporary=$step.tmp.$$
trap 'rm -f "$temporary".*' EXIT
"$program" "$temporary.step" > "$temporary.log" || { cat "$temporary.log" >&2; exit 1; }
mv "$temporary.step" "$step"
mv "$temporary.log" "$step.log"
echo "$made_by" > "$step.made_by"
