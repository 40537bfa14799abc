#!/usr/bin/env python3
"""A family of meshes of one model, each twice as fine: triangles, quality and area of every group as a table.

usage: grid_family.py MODEL [OUT] [LEVELS]        needs st in PYTHONPATH, the tools in PATH or in ST_BIN
"""
import sys
from pathlib import Path

import st


def main(model, out="family", levels=3):
    out = Path(out)
    said = st.mesh(model, out)
    print(f"{model}: {said['st-import']['faces']} faces")
    for level in range(int(levels)):
        if level:  # the geometry and the raster stay; only the sizes are halved
            st.run("st-prolong", out / "raster.hdf", output=out / "sizing.hdf", scale=0.5**level)
            st.run("st-mesh", out / "geometry.hdf", out / "sizing.hdf", output=out / "patches.hdf")
            st.run("st-merge", out / "patches.hdf", output=out / "mesh.hdf")
        mesh = st.read(out / "mesh.hdf")
        quality = mesh.quality()
        print(f"level {level}: {len(mesh.triangles)} triangles,"
              f" quality {quality.mean():.3f} on the mean, {quality.min():.3f} at least")
        for name in mesh.group_name:
            print(f"  {name}: {len(mesh.of_group(name))} triangles, area {mesh.area_of(name):.6g} {mesh.unit or ''}2")
        ratio = st.read(out / "sizing.hdf").size(mesh.points) / mesh.size
        print(f"  sizes at the nodes over those that they were made for: {ratio.min():.3f} to {ratio.max():.3f}")


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    main(*sys.argv[1:])
