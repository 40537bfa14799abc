#!/bin/bash
# cmake --install gives tools that run from any folder and need nothing of the source or build tree.
# usage: install_test.sh BUILD_DIR MODELS_DIR
set -eu -o pipefail
build=$1 models=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cmake --install "$build" --prefix "$work/prefix" > "$work/install.log" || { cat "$work/install.log"; exit 1; }
for tool in st-import st-edit st-raster st-prolong st-mesh st-remesh st-merge st-check st-info st-diff st-export \
  st-metric st-report st-run; do
  (cd / && env -i PATH=/usr/bin:/bin "$work/prefix/bin/$tool" --version > /dev/null) \
    || { echo "FAILED: $tool does not run"; exit 1; }
  if readelf -d "$work/prefix/bin/$tool" \
    | grep -F "$build"; then echo "FAILED: $tool looks for libraries in the build folder"; exit 1; fi
done
mkdir "$work/elsewhere" && cd "$work/elsewhere"
export PATH=$work/prefix/bin:$PATH
st-import "$models/box.step" -q
st-raster geometry.hdf --np 2 -q  # starts itself again under mpirun, from its installed place
[ -s raster.hdf ] || { echo "FAILED: no raster"; exit 1; }
st-run "$models/box.step" -q --np 2 -o run.hdf  # which starts st-raster and st-mesh beside itself
[ -s run.hdf ] || { echo "FAILED: no mesh"; exit 1; }
echo "the installed tools run"
