#!/bin/bash
# Writes the bundled example, a transport aircraft, unless it is there and newer than the program that makes it.
# usage: scripts/make_example.sh BIN_DIR OUT.step
set -eu
program=$1/make_aircraft
step=$2
if [ "$step" -nt "$program" ]; then exit 0; fi
[ -x "$program" ] || { echo "example: error: $program is missing; give MODEL=<CAD file>" >&2; exit 1; }
echo "example: making $step"
mkdir -p "$(dirname "$step")"
"$program" "$step.tmp.step" > "$step.log" || { cat "$step.log" >&2; rm -f "$step.tmp.step"; exit 1; }
mv "$step.tmp.step" "$step"
