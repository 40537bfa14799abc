#!/bin/bash
# Builds with sanitizers and assertions, and runs the tests that they watch. Options as in CMakePresets.json.
# usage: scripts/sanitize.sh address|thread|chain [BUILD_DIR]
#   address   all unit tests with the address and undefined-behaviour sanitizers, then their coverage against its floors
#   thread    unit tests of base and comm, and the task farm of comm at 1, 2 and 3 ranks, with the thread sanitizer
#   chain     the tools from st-raster to st-remesh with 4 threads on two models, with the thread sanitizer
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

chain() { # BUILD_DIR
  "$root/scripts/build.sh" "$1" --preset tsan -- st_tools
  run_chain "$1/bin"
}

run_chain() { # BIN_DIR; st-import is one thread that forks, which this sanitizer cannot follow: run as any other
  local bin=$1 model folder log
  folder=$(mktemp -d)
  # OpenCASCADE and TBB are not instrumented; their own locks are not seen.
  export TSAN_OPTIONS="suppressions=$root/tests/sanitized/chain.supp"
  for model in mech_netgen_screw.step mech_esp_piston.brep; do
    log=$folder/$model.log
    (
      cd "$folder"
      one() {
        "$@" -q >> "$log" 2>&1 || [ $? -eq 5 ] || { tail -n 60 "$log" >&2; exit 1; }
        ! grep -A 30 'WARNING: ThreadSanitizer' "$log" >&2
      }
      one "$bin/st-import" "$ST_CORPUS/$model" -o g.hdf
      one "$bin/st-raster" g.hdf -o r.hdf --lmax 5% --threads 4
      one "$bin/st-prolong" r.hdf -o s.hdf --threads 4
      one "$bin/st-mesh" g.hdf s.hdf -o p.hdf --threads 4
      one "$bin/st-merge" p.hdf -o m.hdf --allow-incomplete --threads 4
      one "$bin/st-check" m.hdf --geometry g.hdf --sizing s.hdf --threads 4
      one "$bin/st-prolong" r.hdf -o half.hdf --scale 0.7 --threads 4
      one "$bin/st-remesh" m.hdf g.hdf half.hdf -o again.hdf --threads 4
    ) || fail "$model with the thread sanitizer"
  done
  rm -r "$folder"
}

fail() {
  echo "sanitize: error: $1 failed; see the lines above" >&2
  exit 1
}

case ${1:-} in
  address) address "${2:-$root/build/asan}" ;;
  thread) thread "${2:-$root/build/tsan}" ;;
  chain) chain "${2:-$root/build/tsan}" ;;
  *) sed -n '3,6p' "$0" >&2; exit 2 ;;
esac
