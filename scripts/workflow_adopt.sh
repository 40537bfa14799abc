#!/bin/bash
# Where st-run made OUT (--keep) and make was never there: what the results depend on is as old as the run, so that make
# goes on from them. A model that was changed since, or is another one, runs.
# usage: scripts/workflow_adopt.sh OUT MODEL     after the .ref files were made
set -eu
out=$1 model=$2 kept=$out/st-run.toml
[ -f "$kept" ] && [ ! -f "$out/log/adopted" ] || exit 0
touch "$out/log/adopted"
[ "$(head -n 1 "$kept")" = "# model $(realpath -s -- "$model")" ] && [ ! "$model" -nt "$kept" ] || exit 0
touch -r "$kept" "$out"/*.ref "$out"/log/*.ref
