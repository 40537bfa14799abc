#!/bin/bash
# Readers of text and of artifacts in one process, led by coverage (libFuzzer). Seeds are made by the tools.
# usage: tests/fuzz/run_readers.sh FUZZ_BUILD_DIR BIN_DIR MODEL SECONDS [READER]...
#   FUZZ_BUILD_DIR  cmake --preset fuzz && ninja -C build/fuzz fuzz_readers
#   BIN_DIR         tools of another build; MODEL: a small CAD file, such as box.brep of the test models
#   READER          all by default; what was found lies in FUZZ_BUILD_DIR/found
set -eu -o pipefail
[ $# -ge 4 ] || { sed -n '3,6p' "$0" >&2; exit 2; }
fuzzer=$(find "$1" -name fuzz_readers -type f -executable)
build=$(cd "$1" && pwd) bin=$2 model=$3 seconds=$4
shift 4
readers=("$@")
if [ ${#readers[@]} -eq 0 ]; then
  readers=(stl obj ply msh vtu vtkhdf fro bac toml groups sizes flite geometry raster sizing patches mesh)
fi
root=$(cd "$(dirname "$0")/../.." && pwd)
work=$build/corpus
export ST_FUZZ_SEEDS=$build/seeds
export ASAN_OPTIONS=detect_leaks=0:allocator_may_return_null=0
mkdir -p "$ST_FUZZ_SEEDS" "$build/found"
cd "$ST_FUZZ_SEEDS"
"$bin/st-import" "$model" -o geometry.hdf -q
"$bin/st-raster" geometry.hdf -o raster.hdf --lmax 20% -q
"$bin/st-prolong" raster.hdf -o sizing.hdf -q
"$bin/st-mesh" geometry.hdf sizing.hdf -o patches.hdf -q
"$bin/st-merge" patches.hdf -o mesh.hdf -q

# Good files of a reader, in its folder.
seed() { # READER
  mkdir -p "$work/$1"
  case $1 in
    stl | msh | vtu | fro) "$bin/st-export" mesh.hdf -o "$work/$1/good.$1" -q ;;
    flite) "$bin/st-export" geometry.hdf -o "$work/$1/good.dat" -q ;;
    bac) "$bin/st-export" sizing.hdf -o "$work/$1/good.bac" -q ;;
    vtkhdf) cp "$root/tests/fuzz/seeds/box.vtkhdf.hdf" "$work/$1" ;;
    toml) printf '[[source]]\ntype = "line"\npoints = [[0, 0, 0], [30, 8, 0]]\nlength = ["5mm", 2]\nradius = 0.3\n' ;;
    obj) printf 'g a\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1/1 2//2 3\ng b\nf -4 -2 -1\nf 1 2 3 4\n' ;;
    ply)
      printf 'ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n'
      printf 'element face 2\nproperty list uchar int vertex_indices\nend_header\n'
      printf '0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n4 0 1 2 3\n'
      ;;
    groups) printf '[[group]]\nname = "a"\nfaces = [1, "3-5"]\n' ;;
    sizes) printf '[[size]]\nfaces = ["1"]\nlmax = 0.2\nalpha = 10\n[[size]]\ngroups = ["b"]\nlmin = "1%%"\n' ;;
  esac > "$work/$1/good.text"
}

status=0
for reader in "${readers[@]}"; do
  seed "$reader"
  if ! "$fuzzer" --reader="$reader" -max_total_time="$seconds" -timeout=20 -rss_limit_mb=4096 -max_len=40000 \
    -print_final_stats=1 -artifact_prefix="$build/found/$reader-" "$work/$reader" > "$build/$reader.log" 2>&1; then
    status=1
    echo "$reader: $(grep -m1 -E 'ERROR|runtime error|Assertion' "$build/$reader.log" ||
      tail -n 1 "$build/$reader.log")"
  fi
  grep -E 'number_of_executed_units' "$build/$reader.log" | sed "s/^/$reader /" || true
done
exit $status
