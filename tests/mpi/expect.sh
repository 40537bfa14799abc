#!/bin/bash
# expect.sh CODE TEXT COMMAND...: runs the command; passes when it exits with CODE ("any": not 0) and its stderr has
# TEXT exactly once (if TEXT is not empty).
code=$1 text=$2
shift 2
errors=$(mktemp)
trap 'rm -f "$errors"' EXIT
"$@" 2>"$errors"
got=$?
cat "$errors" >&2
if [ "$code" = any ]; then
  [ $got -ne 0 ] || { echo "exit code 0, expected a failure" >&2; exit 1; }
elif [ "$got" != "$code" ]; then
  echo "exit code $got, expected $code" >&2
  exit 1
fi
[ -z "$text" ] && exit 0
count=$(grep -cF -- "$text" "$errors")
[ "$count" = 1 ] || { echo "'$text' is there $count times, expected once" >&2; exit 1; }
