#!/bin/bash
# Builds with sanitizers and assertions, and runs the tests that they watch. Options as in CMakePresets.json.
# usage: scripts/sanitize.sh address|thread [BUILD_DIR]
#   address   all unit tests with the address and undefined-behaviour sanitizers, then their coverage against its floors
#   thread    unit tests of base and comm, and the task farm of comm at 1, 2 and 3 ranks, with the thread sanitizer
set -eu -o pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
export ST_CORPUS=${ST_CORPUS:-$root/../shared/corpus}

address() { # BUILD_DIR
  "$root/scripts/build.sh" "$1" --preset asan -- unit_tests
  find "$1" -name '*.gcda' -delete
  export ASAN_OPTIONS=detect_leaks=0 UBSAN_OPTIONS=print_stacktrace=1 # OpenCASCADE leaves what it allocates once
  # Whole binaries, not ctest's one process for each test: starting them is most of the time.
  (cd "$1/tests" && find . -maxdepth 1 -name 'unit_*' -type f -executable -print0 | sort -rz |
    xargs -0 -P"$(nproc)" -I{} bash -c '{} --gtest_brief=1 > {}.log 2>&1 || { tail -n 200 {}.log; exit 1; }') ||
    fail "unit tests with the address sanitizer"
  python3 "$root/scripts/coverage.py" "$1"
}

thread() { # BUILD_DIR
  "$root/scripts/build.sh" "$1" --preset tsan -- unit_base unit_comm comm_farm
  export TSAN_OPTIONS="suppressions=$root/tests/mpi/tsan.supp"
  (cd "$1" && ctest -j2 --output-on-failure -R '^unit\.|^mpi\..*\.np[123]$') || fail "tests with the thread sanitizer"
}

fail() {
  echo "sanitize: error: $1 failed; see the lines above" >&2
  exit 1
}

case ${1:-} in
  address) address "${2:-$root/build/asan}" ;;
  thread) thread "${2:-$root/build/tsan}" ;;
  *) sed -n '3,5p' "$0" >&2; exit 2 ;;
esac
