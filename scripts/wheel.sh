#!/bin/bash
# Makes a Python wheel of tools that are built: these, the libraries they need, the module st, and all licences. Tools
# without ranks are one program there, which does what its name says.
#
# usage: scripts/wheel.sh BUILD_DIR [OUT_DIR]         default OUT_DIR: BUILD_DIR
#
# The wheel runs where the C and C++ libraries are as new as here, with numpy and h5py of the system. What only draws on
# screens or reads from the network is not in it: libraries that need such parts get stubs, which are never called.
# Needs patchelf and binutils besides what the build needs. Prints the name of the wheel.
set -eu -o pipefail
build=$(realpath "${1:?usage: scripts/wheel.sh BUILD_DIR [OUT_DIR]}") out=$(realpath -m "${2:-$1}")
source=$(realpath "$(dirname "$0")/..")
PATH=$PATH:/usr/sbin:/sbin  # ldconfig

fail() {
  echo "wheel: error: $1" >&2
  exit 6
}
for program in cmake ldconfig patchelf nm strip gcc python3 dpkg-query; do
  command -v "$program" > /dev/null || fail "there is no $program; apt-get install cmake patchelf binutils gcc python3"
done
[ -x "$build/bin/st-mesh" ] || fail "$build has no bin/st-mesh; build the tools first"

# Of the C and C++ library, which every system has.
system='^(libc|libm|libdl|librt|libpthread|libstdc\+\+|libgcc_s|ld-linux-x86-64|linux-vdso)\.so'
# What draws in windows, with their fonts and pictures, and the network.
stubbed='^(libTKV3d|libTKService|libcurl|libcrypto)\.so'

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
package=$work/wheel/st
mkdir -p "$package"/{bin,lib/st,licenses} "$out"
cp "$source"/python/st/*.py "$package"
cmake --build "$build" --target st_named_tools > "$work/log" || { tail "$work/log"; fail "no st_named_tools"; }
tools=$(find "$build/bin" -maxdepth 1 -name 'st-*' -type f -perm -u+x -printf '%f\n' | sort)
for tool in $tools; do
  grep -qF "\"$tool\"" "$build/generated/named_tools/named_tools.inc" || cp -t "$package/bin" "$build/bin/$tool"
done
cp "$build/st_named_tools" "$package/bin/st-run"
cp -t "$package/lib/st" "$build"/lib/st/*.so  # readers that the import loads
cp "$source/LICENSE" "$package/licenses/st"

needed() { patchelf --print-needed "$1"; }
ldconfig -p > "$work/libraries"
path_of() { awk -v name="$1" '$1 == name && /x86-64/ && !n++ {print $NF}' "$work/libraries"; }

# A library's folder may be none of the loader's, as that of the serial HDF5.
found_in() {
  local dir
  for dir in $(patchelf --print-rpath "$1" | tr : ' '); do
    [ ! -e "$dir/$2" ] || { echo "$dir/$2"; return; }
  done
  path_of "$2"
}

# Copies what a file needs, and what that needs.
collect() {
  local name path
  for name in $(needed "$1"); do
    if [[ $name =~ $system ]] || [ -e "$package/lib/$name" ]; then continue; fi
    if [[ $name =~ $stubbed ]]; then
      path_of "$name" >> "$work/stubbed"
      continue
    fi
    path=$(found_in "$1" "$name")
    [ -n "$path" ] || fail "$1 needs $name, which is nowhere"
    cp -L "$path" "$package/lib/$name"
    chmod u+w "$package/lib/$name"
    realpath "$path" >> "$work/from"
    collect "$path"
  done
}
touch "$work/stubbed"
for file in "$package"/bin/* "$package"/lib/st/*; do collect "$file"; done

# A library of the same name with the functions that the copied ones ask of it, and with its data as zeros.
make_stub() {
  local name symbols
  name=$(basename "$1")
  nm -D -P --defined-only "$1" | awk '{sub(/@.*/, "", $1); print $1, $2, "0x" $4}' | sort -u > "$work/defined"
  symbols=$(for library in "$package"/lib/*.so* "$package"/lib/st/*; do nm -D -P --undefined-only "$library"; done |
    awk '{print $1}' | sort -u |
    awk 'NR == FNR {is_there[$1]; next} {split($1, of, "@")} of[1] in is_there {print $1}' "$work/defined" -)
  awk 'NR == FNR {kind[$1] = $2; size[$1] = $3; next} {split($1, of, "@")}
    kind[of[1]] ~ /[VDBRu]/ {print "long " of[1] "[(" size[of[1]] " + 7) / 8] = {0};"; next}
    {print "void " of[1] "(void) { __builtin_trap(); }"}' "$work/defined" - <<< "$symbols" > "$work/stub.c"
  awk -F@ 'NF > 1 {of[$NF] = of[$NF] " " $1 ";"} END {for (v in of) print v " {" of[v] " };"}' <<< "$symbols" \
    > "$work/stub.map"
  [ -s "$work/stub.map" ] || echo '{ global: *; };' > "$work/stub.map"
  gcc -shared -fPIC -fno-builtin -w -Wl,-soname,"$name" -Wl,--version-script="$work/stub.map" \
    -o "$package/lib/$name" "$work/stub.c"
}
sort -u "$work/stubbed" > "$work/stubs"
while read -r library; do make_stub "$library"; done < "$work/stubs"

for tool in "$package"/bin/*; do
  strip "$tool"
  patchelf --set-rpath "\$ORIGIN/../lib" "$tool"
done
for library in "$package"/lib/*.so*; do patchelf --set-rpath "\$ORIGIN" "$library"; done
for reader in "$package"/lib/st/*; do
  strip --strip-unneeded "$reader"
  patchelf --set-rpath "\$ORIGIN/.." "$reader"
done

hdf5=$(sed -n 's/^ST_HDF5_STATIC:[A-Z]*=\(\/.*\)/\1/p' "$build/CMakeCache.txt")  # linked into the tools
[ -z "$hdf5" ] || realpath "$hdf5" >> "$work/from"
# Licences, as Debian's packages have them, and the texts that these name. A package may know its files in /lib, which
# is /usr/lib.
sort -u "$work/from" | while read -r library; do
  owner=$(dpkg-query -S "$library" 2> /dev/null || dpkg-query -S "${library#/usr}") || fail "whose is $library?"
  echo "${owner%%:*}"
done > "$work/owners"
printf '%s\n' libcli11-dev libeigen3-dev nlohmann-json3-dev >> "$work/owners"  # headers that are compiled in
sort -u "$work/owners" | while read -r owner; do
  cp -L "/usr/share/doc/$owner/copyright" "$package/licenses/$owner" || fail "$owner has no licence in /usr/share/doc"
done
texts=$(grep -ohE '/usr/share/common-licenses/[A-Za-z0-9.-]*[A-Za-z0-9]' "$package"/licenses/* | sort -u)
mkdir "$package/licenses/common"
for text in $texts; do
  cp -L "$text" "$package/licenses/common" || fail "there is no $text"
done

version=$(sed -n 's/^project(st VERSION \([0-9.]*\).*/\1/p' "$source/CMakeLists.txt")
glibc=$(getconf GNU_LIBC_VERSION | cut -d ' ' -f 2 | tr . _)
# shellcheck disable=SC2086
python3 "$source/packaging/wheel.py" "$work/wheel" "$out" "$version" "manylinux_${glibc}_x86_64" $tools
