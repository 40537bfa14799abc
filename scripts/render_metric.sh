#!/bin/bash
# Picture of a sphere of radius 10 whose metric asks for 0.4 along x and 1.6 across.
# usage: scripts/render_metric.sh BIN_DIR SPHERE.brep IMAGE_DIR [--check]      needs python3-vtk9, xvfb and xauth
set -eu
[ $# -ge 3 ] || { sed -n '2,3s/^# //p' "$0" >&2; exit 2; }
here=$(cd "$(dirname "$0")" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
head='MeshVersionFormatted 2 Dimension 3'
{
  echo "$head Vertices 8"
  for z in -15 15; do for y in -15 15; do for x in -15 15; do echo "$x $y $z 0"; done; done; done
  echo "Hexahedra 1 1 2 4 3 5 6 8 7 0 End"
} > "$scratch/metric.mesh"
{
  echo "$head SolAtVertices 8 1 3"
  for _ in 1 2 3 4 5 6 7 8; do echo '6.25 0 0.390625 0 0 0.390625'; done
  echo End
} > "$scratch/metric.sol"
"$1/st-import" "$2" -o "$scratch/geometry.hdf" -q
"$1/st-raster" "$scratch/geometry.hdf" --lmin 0.05 --lmax 4 -o "$scratch/raster.hdf" -q
"$1/st-prolong" "$scratch/raster.hdf" --background "$scratch/metric.sol" --only -o "$scratch/sizing.hdf" -q
"$1/st-mesh" "$scratch/geometry.hdf" "$scratch/sizing.hdf" -o "$scratch/patches.hdf" -q
"$1/st-merge" "$scratch/patches.hdf" -o "$scratch/mesh.hdf" -q
/usr/bin/python3 "$here/render_mesh.py" "$scratch/mesh.hdf" -o "$3" \
  --at sizes_metric=0,0,0,11,0.35,0.8,0.5 "${@:4}"
