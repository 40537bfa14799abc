#!/bin/bash
# Meshes a turbine's passage and a cube with the same nodes on opposite sides; draws both sides of the passage.
# usage: pairs.sh OUT BIN     results go to the folder OUT; BIN has the tools and make_model
# exit codes: as the tools; 5 when a check fails
set -eu -o pipefail
out=$1 bin=$2
here=$(cd "$(dirname "$0")" && pwd)
mkdir -p "$out"

mesh() {  # NAME CAD PAIRS SCALE [options of st-raster]
  name=$1 cad=$2 pairs=$3 scale=$4
  shift 4
  "$bin/st-import" "$cad" -o "$out/$name.hdf" --unit m
  "$bin/st-raster" "$out/$name.hdf" -o "$out/raster.hdf" "$@"
  "$bin/st-prolong" "$out/raster.hdf" -o "$out/sizing.hdf" --scale "$scale"
  "$bin/st-mesh" "$out/$name.hdf" "$out/sizing.hdf" -o "$out/patches.hdf" --pairs "$pairs"
  "$bin/st-merge" "$out/patches.hdf" -o "$out/${name}_mesh.hdf"
  "$bin/st-check" "$out/${name}_mesh.hdf" --geometry "$out/$name.hdf"
  for suffix in msh cgns su2; do "$bin/st-export" "$out/${name}_mesh.hdf" -o "$out/$name.$suffix"; done
}

"$bin/make_model" cascade "$out/cascade.step"
mesh passage "$out/cascade.step" "$here/passage.toml" 2.5
mesh cube "$here/cube.obj" auto 1 --lmax 8%
"$bin/st-export" "$out/passage_mesh.hdf" -o "$out/passage.msh2"
python3 "$here/draw_pair.py" "$out/passage.msh2" "$out/pair.svg"
