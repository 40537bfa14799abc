#!/bin/bash
# A picture of what a page of st-report shows, for the pages of examples/jobs.
# usage: scripts/render_report.sh PAGE.html PICTURE.png [X,Y,Z,HEIGHT,YAW,PITCH]
# Place and height of what is looked at in the model unit, angles in degrees; default: all from outside.
# Needs chromium and python3-vtk9. The picture has 256 colours, so that it is small.
set -eu
[ $# -ge 2 ] || { sed -n '2,6s/^# //p' "$0" >&2; exit 2; }
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
/usr/bin/python3 - "$scratch/picture.png" "$2" << 'END'
import struct
import sys
import zlib
import numpy
import vtk
from vtk.util.numpy_support import vtk_to_numpy
reader = vtk.vtkPNGReader()
reader.SetFileName(sys.argv[1])
reader.Update()
width, height, _ = reader.GetOutput().GetDimensions()
pixels = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())[:, :3].reshape(height, width, 3)[::-1]
key = (pixels.astype(int) >> 4) @ [256, 16, 1]  # boxes of 16 shades each way; those used most keep a colour
used = numpy.argsort(-numpy.bincount(key.ravel(), minlength=4096), kind="stable")[:256]
colours = numpy.array([pixels[key == k].mean(axis=0) if (key == k).any() else (0, 0, 0) for k in used])
middles = numpy.array([(k >> 8, k >> 4 & 15, k & 15) for k in range(4096)]) * 16 + 8
nearest = ((middles[:, None, :] - colours[None]) ** 2).sum(axis=2).argmin(axis=1).astype(numpy.uint8)
nearest[used] = numpy.arange(256)
rows = b"".join(b"\0" + row.tobytes() for row in nearest[key])
def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
with open(sys.argv[2], "wb") as out:
    out.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 3, 0, 0, 0)) +
              chunk(b"PLTE", colours.round().astype(numpy.uint8).tobytes()) + chunk(b"IDAT", zlib.compress(rows, 9)) +
              chunk(b"IEND", b""))
END
