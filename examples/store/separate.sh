#!/bin/bash
# A store falls from a fighter: each step moves its faces, and the mesh follows. What is away from it stays the same.
# usage: separate.sh OUT BIN [NP]     results go to the folder OUT
# Environment: STEPS (20); DT seconds of each (0.04); PANELS of the fighter (24x16); AWAY (3.5) metres from the store's
# middle, from where the mesh of walls has to be the same to the last bit
# exit codes: as the tools; 5 when a check fails
set -eu -o pipefail
export LC_ALL=C  # awk and printf read 0.5 in every locale
out=$1 bin=$2 np=${3:-1}
here=$(dirname "$(realpath "$0")")
steps=${STEPS:-20} dt=${DT:-0.04} panels=${PANELS:-24x16} away=${AWAY:-3.5}
store=store_inner middle="11.5 2.2 -1.2" # of fighter.py
mkdir -p "$out"
if ! /usr/bin/python3 -c 'import h5py' 2> /dev/null; then
  echo "separate: error: /usr/bin/python3 has no h5py to compare meshes with; install python3-h5py" >&2
  exit 3
fi

# Lengths in metres: by default they are shares of the extent, which grows while the store falls.
sizes() { # NAME: from its geometry to its sizes
  "$bin/st-raster" "$out/$1.geometry.hdf" -o "$out/raster.hdf" --lmin 0.0065 --lmax 0.4 --np "$np" -q
  "$bin/st-prolong" "$out/raster.hdf" -o "$out/$1.sizing.hdf" -q
}

check() { # NAME: its mesh
  "$bin/st-check" "$out/$1.mesh.hdf" --geometry "$out/$1.geometry.hdf" --sizing "$out/$1.sizing.hdf" \
    > "$out/check.log" 2>&1 || { cat "$out/check.log" >&2; exit 5; }
}

# The way from one step to the next: pushed off at 3 m/s, falling, its nose going down by 20 degrees a second.
motion() { # STEP: "DEGREES DOWN X Y Z", the last three its middle before
  awk -v k="$1" -v dt="$dt" -v middle="$middle" 'function down(t) { return 3 * t + 0.5 * 9.81 * t * t }
    BEGIN { split(middle, m); printf "%.9g %.9g %s %s %.9g\n", -20 * dt, down(k * dt) - down((k - 1) * dt), m[1], m[2],
            m[3] - down((k - 1) * dt) }'
}

/usr/bin/python3 -B "$here/fighter.py" "$out/fighter.dat" "$out/fighter.toml" --panels "$panels"
"$bin/st-import" "$out/fighter.dat" -o "$out/00.geometry.hdf" --unit m --groups "$out/fighter.toml" -q
sizes 00
"$bin/st-mesh" "$out/00.geometry.hdf" "$out/00.sizing.hdf" -o "$out/patches.hdf" --np "$np" -q
"$bin/st-merge" "$out/patches.hdf" -o "$out/00.mesh.hdf" -q
check 00

last=00
for ((step = 1; step <= steps; ++step)); do
  name=$(printf %02d "$step")
  read -r degrees down x y z <<< "$(motion "$step")"
  start=$EPOCHREALTIME
  "$bin/st-edit" "$out/$last.geometry.hdf" -o "$out/$name.geometry.hdf" --of "$store" \
    --transform "rotate 0 1 0 $degrees at $x $y $z; translate 0 0 -$down" -q
  sizes "$name"
  "$bin/st-remesh" "$out/$last.mesh.hdf" "$out/$name.geometry.hdf" "$out/$name.sizing.hdf" --moved \
    --merged "$out/$name.mesh.hdf" --np "$np" -q
  seconds=$(awk -v a="$start" -v b="$EPOCHREALTIME" 'BEGIN { printf "%.2f", b - a }')
  check "$name"
  echo -n "step $name: $seconds s, "
  /usr/bin/python3 -B "$here/away.py" "$out/$last.mesh.hdf" "$out/$name.mesh.hdf" "$away" "$x" "$y" "$z" "-$down"
  last=$name
done
