#!/bin/bash
# A source travels over a meshed model: each step is remeshed from the last, checked and drawn; in the end the source is
# taken away again.
# usage: move_source.sh OUT BIN [NP]      OUT: folder with geometry.hdf, raster.hdf, sizing.hdf, mesh.hdf; results go to
# OUT/moving_source
# Environment: FROM, TO "x y z" ends of the way; LENGTH, RADIUS of the source; STEPS (10); FRAMES=0: draw none. Defaults
# suit the bundled aircraft.
# exit codes: as the tools; 5 when a check fails, quality drifts by more than 0.01, or taking the source away leaves 5 %
# more or fewer triangles
set -eu -o pipefail
export LC_ALL=C  # awk and printf read 0.5 in every locale
out=$1 bin=$2 np=${3:-1}
here=$(dirname "$(realpath "$0")")
from=${FROM:-0.5 0.5 0.5} to=${TO:-32 1.5 1.0} length=${LENGTH:-0.06} radius=${RADIUS:-1} steps=${STEPS:-10}
results=$out/moving_source
mkdir -p "$results"
for artifact in geometry raster sizing mesh; do
  [ -f "$out/$artifact.hdf" ] \
    || { echo "move_source: error: $out/$artifact.hdf is missing; mesh the model first" >&2; exit 3; }
done

draw=true
if [ "${FRAMES:-1}" = 0 ]; then
  draw=false
elif ! /usr/bin/python3 -c 'import vtk' 2> /dev/null; then
  draw=false
  echo "SKIPPED: /usr/bin/python3 has no VTK, no frame is drawn" >&2
fi

# The source between both ends, at `step` of `steps`.
write_source() {
  awk -v a="$from" -v b="$to" -v s=$(($1 - 1)) -v n=$((steps > 1 ? steps - 1 : 1)) -v length_="$length" \
    -v radius="$radius" 'BEGIN {
    split(a, p); split(b, q)
    for (i = 1; i <= 3; ++i) x[i] = p[i] + (q[i] - p[i]) * s / n
    printf "[[source]]\nname = \"moving\"\ntype = \"point\"\nat = [%.9g, %.9g, %.9g]\n", x[1], x[2], x[3]
    printf "length = %s\nradius = %s\n", length_, radius
  }' > "$results/source.toml"
}

# remesh SIZING STEP: from the last mesh to the next, checked and noted in steps.tsv
last=$out/mesh.hdf
remesh() {
  local mesh=$results/mesh_$2.hdf
  "$bin/st-remesh" "$last" "$out/geometry.hdf" "$1" --merged "$mesh" --np "$np" --json > "$results/remesh_$2.json"
  echo "step $2: $mesh"
  "$bin/st-check" "$mesh" --geometry "$out/geometry.hdf" --sizing "$1" --json > "$results/check_$2.json" \
    || { cat "$results/check_$2.json" >&2; exit 5; }
  if $draw; then /usr/bin/python3 "$here/draw_frame.py" "$mesh" "$results/frame_$2.png"; fi
  last=$mesh
}

"$bin/st-check" "$last" --geometry "$out/geometry.hdf" --sizing "$out/sizing.hdf" --json > "$results/check_00.json" \
  || exit 5
for ((step = 1; step <= steps; ++step)); do
  write_source $step
  "$bin/st-prolong" "$out/raster.hdf" -o "$results/sizing.hdf" --sources "$results/source.toml" -q
  remesh "$results/sizing.hdf" "$(printf %02d $step)"
done
remesh "$out/sizing.hdf" restored
/usr/bin/python3 "$here/summary.py" "$results" "$steps"
