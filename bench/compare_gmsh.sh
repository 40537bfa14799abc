#!/bin/bash
# ST beside Debian's gmsh on one model, one rank: time, triangles, quality, checks. Gmsh twice: with the same smallest
# and largest length and 10 degrees, and on the very lengths of st-prolong as its background field. ST twice: with these
# lengths, and with as many triangles as gmsh makes of its own.
# usage: bench/compare_gmsh.sh MODEL [BIN_DIR] [OUT_DIR]     run it on a quiet machine; needs gmsh and the independent
# judge beside the corpus (ST_CORPUS)
set -eu
here=$(cd "$(dirname "$0")/.." && pwd)
model=$1
bin=${2:-$here/build/release/bin}
out=${3:-$(mktemp -d)}
judge=$(cd "${ST_CORPUS:-$here/../shared/corpus}/.." && pwd)/tools/meshcheck.sh
mkdir -p "$out"
seconds() { # label command...: processor time, which other work on the machine disturbs least; the output is kept
  local label=$1 TIMEFORMAT='%U %S'
  shift
  { time "$@" > "$out/$label.log" 2>&1; } 2> "$out/$label.time" || { cat "$out/$label.log" >&2; return 1; }
  awk '{ printf "%.2f", $1 + $2 }' "$out/$label.time"
}
value() { sed -n "s/.*\"$2\":\([-0-9.e+]*\).*/\1/p" "$out/$1.log" | tail -1; }

read -r -a sizes <<< "${ST_SIZES:-}"
case $model in # gmsh reads STEP and IGES in millimetres
  *.[bB][rR][eE][pP]) unit=() ;;
  *) unit=(--unit mm) ;;
esac
t_import=$(seconds import "$bin/st-import" "$model" -o "$out/geometry.hdf" "${unit[@]}" --json)
t_raster=$(seconds raster "$bin/st-raster" "$out/geometry.hdf" -o "$out/raster.hdf" --json "${sizes[@]}")
t_prolong=$(seconds prolong "$bin/st-prolong" "$out/raster.hdf" -o "$out/sizing.hdf")
t_mesh=$(seconds mesh "$bin/st-mesh" "$out/geometry.hdf" "$out/sizing.hdf" -o "$out/patches.hdf" --json)
t_merge=$(seconds merge "$bin/st-merge" "$out/patches.hdf" -o "$out/mesh.hdf")
t_check=$(seconds check "$bin/st-check" "$out/mesh.hdf") || true
lmin=$(value raster lmin)
lmax=$(value raster lmax)
t_gmsh=$(seconds gmsh gmsh "$model" -2 -algo front2d -nt 1 -clcurv 36 -clmin "$lmin" -clmax "$lmax" -format msh22 \
  -o "$out/gmsh.msh" -v 5)
t_gmsh2d=$(sed -n 's/.*Done meshing 2D (Wall [0-9.]*s, CPU \([0-9.]*\)s.*/\1/p' "$out/gmsh.log" | tail -1)
"$bin/st-export" "$out/sizing.hdf" -o "$out/field.pos" -q
t_field=$(seconds field gmsh "$model" -2 -algo front2d -nt 1 -bgm "$out/field.pos" -clmin "$lmin" -clmax "$lmax" \
  -format msh22 -o "$out/field.msh" -v 5 \
  -string "Mesh.MeshSizeExtendFromBoundary=0;Mesh.MeshSizeFromPoints=0;Mesh.MeshSizeFromCurvature=0;")
t_field2d=$(sed -n 's/.*Done meshing 2D (Wall [0-9.]*s, CPU \([0-9.]*\)s.*/\1/p' "$out/field.log" | tail -1)
n_gmsh=$(awk '/^\$Elements/ { found = 1 } found && $2 == 2 && NF > 5 { n++ } END { print n }' "$out/gmsh.msh")
seconds target "$bin/st-prolong" "$out/raster.hdf" -o "$out/sizing_equal.hdf" --target-triangles "$n_gmsh" > /dev/null
t_equal=$(seconds equal "$bin/st-mesh" "$out/geometry.hdf" "$out/sizing_equal.hdf" -o "$out/patches_equal.hdf" --json)
"$bin/st-merge" "$out/patches_equal.hdf" -o "$out/mesh_equal.hdf" -q
"$judge" "$out/mesh.hdf" > "$out/judge_st.json" || true
"$judge" "$out/mesh_equal.hdf" > "$out/judge_equal.json" || true
"$judge" "$out/gmsh.msh" > "$out/judge_gmsh.json" || true
"$judge" "$out/field.msh" > "$out/judge_field.json" || true
python3 - "$out" "$model" "$t_import" "$t_raster" "$t_prolong" "$t_mesh" "$t_merge" "$t_check" "$t_gmsh" \
  "${t_gmsh2d:-0}" "$t_field" "${t_field2d:-0}" "$t_equal" <<'P'
import json, os, sys
out, model = sys.argv[1:3]
imp, ras, pro, mesh, merge, check, gmsh, gmsh2d, field, field2d, equal = map(float, sys.argv[3:14])
st, gm, bg, eq = (json.load(open(f"{out}/judge_{k}.json")) for k in ("st", "gmsh", "field", "equal"))
chain = imp + ras + pro + mesh + merge + check
print(f"{model}, processor time, load average {os.getloadavg()[0]:.1f}")
print(f"  ST    {st['triangles']:9d} triangles  st-mesh {mesh:6.2f} s ({st['triangles']/mesh:9.0f}/s)  "
      f"chain {chain:6.2f} s "
      f"(import {imp} raster {ras} prolong {pro} merge {merge} check {check})")
print(f"  equal {eq['triangles']:9d} triangles  st-mesh {equal:6.2f} s ({eq['triangles']/equal:9.0f}/s)")
print(f"  gmsh  {gm['triangles']:9d} triangles  2-D     {gmsh2d:6.2f} s ({gm['triangles']/max(gmsh2d,1e-9):9.0f}/s)  "
      f"whole {gmsh:6.2f} s")
print(f"  field {bg['triangles']:9d} triangles  2-D     {field2d:6.2f} s ({bg['triangles']/max(field2d,1e-9):9.0f}/s)  "
      f"whole {field:6.2f} s")
print(f"  per triangle: st-mesh {gmsh2d/gm['triangles']/(mesh/st['triangles']):.1f} x gmsh's 2-D stage, "
      f"at as many triangles {gmsh2d/gm['triangles']/(equal/eq['triangles']):.1f} x; "
      f"chain {gmsh/gm['triangles']/(chain/st['triangles']):.1f} x gmsh from file to mesh")
for name, j in (("ST", st), ("equal", eq), ("gmsh", gm), ("field", bg)):
    print(f"  {name:5s} quality mean {j['mean_q']:.4f} 1st percentile {j['p1_q']:.4f} least angle {j['min_angle']:.2f} "
          f"below 10 deg {j['below_10deg']} "
          f"jump 99.9 % {j['jump_p999']}  open {j['boundary_edges']} non-manifold {j['nonmanifold_edges']} "
          f"folds {j['folds']} crossing {j['self_intersections']}")
P
