# What the tests of the make rules share; sourced in a folder of their own, $work, with the source tree in $source.
# shellcheck shell=bash disable=SC2154,SC2034,SC2016
unset MAKEFLAGS MAKELEVEL MFLAGS MODEL OUT NP LAUNCH EXPORT PRESET BLANK ALLOW_INCOMPLETE TOOLS BUILD
export FAKE_LOG=$work/ran
tools="st-import st-raster st-prolong st-mesh st-merge st-remesh st-check st-info st-export"
failures=0

use_fake_tools() {
  mkdir bin
  for tool in $tools; do install "$source/tests/workflow/fake_tool.sh" "bin/$tool"; done
}

# The real tools behind scripts that note what ran.
use_real_tools() {
  mkdir bin
  for tool in $tools; do
    printf '%s\n' '#!/bin/bash' "case \" \$* \" in *' --print-'*) ;; *) echo $tool >> \"\$FAKE_LOG\" ;; esac" \
      "exec '$1/$tool' \"\$@\"" > "bin/$tool"
    chmod +x "bin/$tool"
  done
}

# run ARGUMENTS...: make's exit code in $status, what ran in $ran, what it said in $said
run() {
  : > "$FAKE_LOG"
  status=0
  said=$(make -f "$source/Makefile.workflow" TOOLS="$work/bin" "$@" 2>&1) || status=$?
  ran=$(tr '\n' ' ' < "$FAKE_LOG")
}

expect() {  # expect WHAT ACTUAL EXPECTED
  [ "$2" != "$3" ] || return 0
  printf 'FAILED %s:%s: %s\n  expected: %s\n' "$0" "${BASH_LINENO[0]}" "$1" "$3"
  printf '  actual:   %s\n  said: %s\n' "$2" "${said-}"
  failures=$((failures + 1))
}

later() { sleep 0.02; "$@"; }  # a time stamp that is certainly newer

finish() {
  if [ $failures -gt 0 ]; then exit 1; fi
  echo "$1"
}
