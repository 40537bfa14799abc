#!/bin/bash
# A picture of what a page of st-report shows, for the pages of examples/jobs.
# usage: scripts/render_report.sh PAGE.html PICTURE.png [X,Y,Z,HEIGHT,YAW,PITCH]
# Place and height of what is looked at in the model unit, angles in degrees; default: all from outside. Needs chromium.
set -eu
[ $# -ge 2 ] || { sed -n '2,5s/^# //p' "$0" >&2; exit 2; }
command -v chromium > /dev/null || { echo "render_report: error: chromium is missing" >&2; exit 2; }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
python3 - "$1" "$scratch/page.html" "${3-}" << 'END'
import sys
page, out, view = open(sys.argv[1], encoding="utf-8").read(), sys.argv[2], sys.argv[3]
look = "fit();"
if view:
    x, y, z, height, yaw, pitch = map(float, view.split(","))
    look = (f"camera.yaw = {yaw} * Math.PI / 180; camera.pitch = {pitch} * Math.PI / 180; camera.half = {height} / 2;"
            f"camera.focus = [{x}, {y}, {z}].map((v, k) => v - meta.centre[k]); draw();")
style = "<style>#stage { position: fixed; inset: 0; height: 100vh; z-index: 9; border: 0; }</style>"
page = page.replace("</head>", style + "</head>")
page = page.replace("</body>", f"<script>setTimeout(() => {{ {look} }}, 500);</script></body>")
open(out, "w", encoding="utf-8").write(page)
END
chromium --headless --no-sandbox --use-angle=swiftshader --enable-unsafe-swiftshader --force-prefers-reduced-motion \
  --virtual-time-budget=6000 --window-size=840,480 --hide-scrollbars --user-data-dir="$scratch/browser" \
  --screenshot="$scratch/picture.png" "file://$scratch/page.html" > /dev/null 2>&1
mv "$scratch/picture.png" "$2"
