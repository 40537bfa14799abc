#!/bin/bash
# The pictures of the documentation show what the tools make now; a mesh of other sizes and a lost picture are found.
# usage: pictures_test.sh SOURCE_DIR BIN_DIR RUN_DIR MODELS_DIR      RUN_DIR: the bundled example, meshed by defaults
# The guide's and the stretched ones take minutes: scripts/render_images.sh BIN_DIR RUN_DIR --models MODELS_DIR --check.
# flow_aircraft.png is judged by eye (scripts/render_flow.sh).
set -eu -o pipefail
source=$1 bin=$2 run=$3 models=$4
/usr/bin/python3 -c 'import vtk' 2> /dev/null || { echo "SKIPPED: no VTK, no picture was judged"; exit 77; }
export PYTHONDONTWRITEBYTECODE=1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
images=$source/docs/images
result=0
"$source/scripts/render_images.sh" "$bin" "$run" --images "$images" --check || result=1
"$source/scripts/render_gap.sh" "$bin" "$models/curved_slot.brep" "$images" --check || result=1
[ $result = 0 ] || { echo "FAILED: make these again (scripts/render_images.sh), and look at them"; exit 1; }

# every picture says what it shows, and a page shows it
for picture in "$images"/*.png; do
  name=$(basename "$picture")
  grep -rqF --include='*.md' "images/$name" "$source"/*.md "$source/docs" ||
    { echo "FAILED: no page shows $name"; exit 1; }
  grep -aq "tEXtshows" "$picture" || [ "$name" = flow_aircraft.png ] ||
    { echo "FAILED: $name does not say what it shows"; exit 1; }
done

# a slot with other lengths, and no picture at all, are stale
expect_stale() {
  if "$source/scripts/render_gap.sh" "$bin" "$models/curved_slot.brep" "$work" "${@:2}" --check > "$work/said"; then
    cat "$work/said"
    echo "FAILED: not found: $1"
    exit 1
  fi
  grep -q "^STALE: sizing_slot" "$work/said"
  echo "found: $1"
}
expect_stale "a picture that is not there"
cp "$images/sizing_slot.png" "$work/sizing_slot_0.png"
expect_stale "a picture of other sizes" --without
