#!/bin/bash
# cpack gives Debian packages that lintian finds no error in and whose tools run from where they are unpacked.
# usage: deb_test.sh SOURCE_DIR BUILD_DIR
set -eu -o pipefail
build=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failed() { echo "FAILED: $*"; exit 1; }

for program in cpack dpkg-deb dpkg-shlibdeps lintian; do
  command -v "$program" > /dev/null || { echo "SKIPPED: no $program; scripts/setup.sh check"; exit 77; }
done
(cd "$build" && cpack -G DEB -B "$work") > "$work/cpack.log" 2>&1 || { tail -n 20 "$work/cpack.log"; exit 1; }
for package in st st-dev; do
  deb=$(echo "$work/${package}"_*.deb)
  [ -s "$deb" ] || failed "no package $package"
  lintian --allow-root "$deb" > "$work/lintian.log" 2>&1 || { cat "$work/lintian.log"; failed "lintian on $package"; }
  if grep -E "^E:" "$work/lintian.log"; then failed "lintian on $package"; fi
  dpkg-deb -x "$deb" "$work/root"
done
dpkg-deb -f "$work"/st_*.deb Depends | grep -q "libocct-data-exchange" || failed "the libraries are no dependencies"
said=$(cd "$work" && env -i PATH="$work/root/usr/bin:/usr/bin:/bin" sh -c \
  "for m in assembly.step box.igs box.step; do st-import $build/test_models/\$m -q || exit; done; st-info geometry.hdf")
grep -q "faces  *6" <<< "$said" || failed "the unpacked tools do not run"
[ -f "$work/root/usr/lib/cmake/st/stConfig.cmake" ] || failed "st-dev has no stConfig.cmake"
echo "$(basename "$work"/st_*.deb) and its -dev package are sound"
