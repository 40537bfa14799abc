#!/bin/bash
# Renders the pictures of the documentation, or says which of them are stale. Those of a run of the bundled example are
# always made; with MODELS_DIR (make_models DIR) all others, too, but for flow_aircraft.png (scripts/render_flow.sh).
# usage: scripts/render_images.sh BIN_DIR RUN_DIR [--models MODELS_DIR] [--images IMAGE_DIR] [--check]
# RUN_DIR: mesh.hdf and sizing.hdf; needs python3-vtk9, xvfb and xauth
# exit codes: 1 with --check, when a picture is stale: it shows another mesh than the tools make now
set -eu
[ $# -ge 2 ] || { sed -n '2,6s/^# //p' "$0" >&2; exit 2; }
here=$(cd "$(dirname "$0")" && pwd)
bin=$(realpath "$1") run=$(realpath "$2") images=$here/../docs/images models='' check=()
shift 2
while [ $# -gt 0 ]; do
  case $1 in
    --models) models=$(realpath "$2"); shift 2 ;;
    --images) images=$(realpath "$2"); shift 2 ;;
    --check) check=(--check); shift ;;
    *) echo "render_images: error: unknown argument '$1'" >&2; exit 2 ;;
  esac
done
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
result=0
draw() { # SCRIPT ARGUMENTS...
  local script=$1
  shift
  /usr/bin/python3 "$here/$script" "$@" -o "$images" "${check[@]}" || result=1
}
"$bin/st-export" "$run/sizing.hdf" -o "$scratch/sizing.vtu" -q
draw render_mesh.py "$run/mesh.hdf"
slices=("$scratch/sizing.vtu" --mesh "$run/mesh.hdf")
draw render_sizing.py "${slices[@]}"
draw render_sizing.py "${slices[@]}" --by cause --view sizing_section --as sizing_causes
draw render_sizing.py "${slices[@]}" --by colour --view sizing_section --as sizing_blanked_cells
cat > "$scratch/wake.toml" << 'END'
[[source]]
name = "wake"
type = "line"
points = [[22, 8.2, 0.5], [24, 8.2, 0.9]]
length = [0.02, 0.08]
END
"$bin/st-prolong" "$run/sizing.hdf" --sources "$scratch/wake.toml" -o "$scratch/wake.hdf" -q
"$bin/st-export" "$scratch/wake.hdf" -o "$scratch/wake.vtu" -q
draw render_sizing.py "$scratch/wake.vtu" --mesh "$run/mesh.hdf" --field "$scratch/wake.hdf"
if [ -n "$models" ]; then
  "$here/render_gap.sh" "$bin" "$models/curved_slot.brep" "$images" "${check[@]}" || result=1
  "$here/render_stretched.sh" "$bin" "$images" "${check[@]}" || result=1
  "$here/render_metric.sh" "$bin" "$models/sphere.brep" "$images" "${check[@]}" || result=1
  draw render_guide.py "$bin"
fi
exit $result
