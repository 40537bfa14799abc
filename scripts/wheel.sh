#!/bin/bash
# Makes a Python wheel of tools that are built: these, the libraries they need, the module st, and all licences.
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
for program in ldconfig patchelf nm strip gcc python3 dpkg-query; do
  command -v "$program" > /dev/null || fail "there is no $program; apt-get install patchelf binutils gcc python3"
done
[ -x "$build/bin/st-mesh" ] || fail "$build has no bin/st-mesh; build the tools first"

# Of the C and C++ library, which every system has.
system='^(libc|libm|libdl|librt|libpthread|libstdc\+\+|libgcc_s|ld-linux-x86-64|linux-vdso)\.so'
# Windows, fonts, pictures and the network.
stubbed='^(libX11|libfontconfig|libfreetype|libfreeimage|libcurl|libcrypto)\.so'

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
package=$work/wheel/st
mkdir -p "$package"/{bin,lib/st,licenses} "$out"
cp "$source"/python/st/*.py "$package"
find "$build/bin" -maxdepth 1 -name 'st-*' -type f -perm -u+x -exec cp -t "$package/bin" {} +
cp -t "$package/lib/st" "$build"/lib/st/*.so  # readers that the import loads
cp "$source/LICENSE" "$package/licenses/st"

needed() { patchelf --print-needed "$1"; }
path_of() { ldconfig -p | awk -v name="$1" '$1 == name && /x86-64/ && !n++ {print $NF}'; }

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

# A library of the same name with the functions that the copied ones ask of it.
make_stub() {
  local name symbols version
  name=$(basename "$1")
  nm -D --defined-only "$1" | awk '{sub(/@.*/, "", $3); print $3}' | sort -u > "$work/defined"
  symbols=$(for library in "$package"/lib/*.so* "$package"/lib/st/*; do nm -D --undefined-only "$library"; done |
    awk '{print $2}' | sort -u |
    awk -F@ 'NR == FNR {is_there[$1]; next} $1 in is_there' "$work/defined" -)
  awk -F@ '{print "void " $1 "(void) { __builtin_trap(); }"}' <<< "$symbols" > "$work/stub.c"
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
# Licences, as Debian's packages have them. A package may know its files in /lib, which is /usr/lib.
sort -u "$work/from" | while read -r library; do
  owner=$(dpkg-query -S "$library" 2> /dev/null || dpkg-query -S "${library#/usr}") || fail "whose is $library?"
  cp -L "/usr/share/doc/${owner%%:*}/copyright" "$package/licenses/${owner%%:*}"
done

version=$(sed -n 's/^project(st VERSION \([0-9.]*\).*/\1/p' "$source/CMakeLists.txt")
glibc=$(getconf GNU_LIBC_VERSION | cut -d ' ' -f 2 | tr . _)
python3 "$source/packaging/wheel.py" "$work/wheel" "$out" "$version" "manylinux_${glibc}_x86_64"
