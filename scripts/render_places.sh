#!/bin/bash
# Pictures of the difficult places (nose, wing tip, nacelle lip, fillet, sphere pole, thin wall ...), each from the
# chain on a corpus model (ST_CORPUS; default ../shared/corpus beside the repository) with default sizes.
# usage: scripts/render_places.sh BIN_DIR IMAGE_DIR [NAME ...]      needs python3-vtk9, xvfb and xauth
set -eu
[ $# -ge 2 ] || { sed -n '2,4s/^# //p' "$0" >&2; exit 2; }
here=$(cd "$(dirname "$0")" && pwd)
bin=$(cd "$1" && pwd)
images=$2
shift 2
wanted=" $* "
corpus=${ST_CORPUS:-$here/../../shared/corpus}
[ -d "$corpus" ] || { echo "render: error: corpus not found at $corpus; set ST_CORPUS" >&2; exit 3; }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

mesh_of() { # model -> its mesh, made once
  local dir=$scratch/$1
  [ -f "$dir/mesh.hdf" ] && return
  mkdir -p "$dir"
  "$bin/st-import" "$corpus/$1" -o "$dir/geometry.hdf" -q
  "$bin/st-raster" "$dir/geometry.hdf" -o "$dir/raster.hdf" -q
  "$bin/st-prolong" "$dir/raster.hdf" -o "$dir/sizing.hdf" -q
  "$bin/st-mesh" "$dir/geometry.hdf" "$dir/sizing.hdf" -o "$dir/patches.hdf" -q
  "$bin/st-merge" "$dir/patches.hdf" -o "$dir/mesh.hdf" -q
}

# name, model, x,y,z,half height of the picture (model unit),direction to the viewer
while read -r name model view; do
  [ "$wanted" = "  " ] || [[ $wanted == *" $name "* ]] || continue
  mesh_of "$model"
  /usr/bin/python3 "$here/render_mesh.py" "$scratch/$model/mesh.hdf" -o "$images" --at "$name=$view"
done <<'PLACES'
nose           aero_d150_wing_body_half.brep    0,0,-0.62,0.35,-0.75,0.6,0.25
wing_tip       aero_d150_wing_body_half.brep    21.4,16.9,-0.25,0.9,-0.35,0.85,0.35
trailing_edge  aero_d150_wing_body_half.brep    20.11,10.44,-0.75,0.1,0.9,0.25,0.35
nacelle_lip    aero_tigl_nacelle.stp            -35.8,0,514.65,60,-0.75,0.45,0.45
fillet         mech_occt_linkrods.step          3.9,2.5,1.87,0.35,-0.4,-0.8,0.45
sphere_pole    basic_refine_sphere_cube.brep    0,0,1,0.4,0.3,0.2,0.9
cone_tip       basic_refine_cone_cone.brep      1,1,0,0.15,-0.6,-0.5,0.1
thin_wall      aero_bladex_propeller_shaft.iges -8.87,-122.49,-24.91,5,0.35,-0.8,-0.5
PLACES
