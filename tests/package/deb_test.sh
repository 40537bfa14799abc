#!/bin/bash
# cpack gives Debian packages that lintian finds no error in and whose tools run from where they are unpacked.
# Part of scripts/release.sh with --bare: apt-get installs it in a bare Debian, where it then makes meshes and reports.
# usage: deb_test.sh SOURCE_DIR BUILD_DIR [--bare MODELS]
set -eu -o pipefail
build=$2 models=${4:-$2/test_models}
# shellcheck source=tests/package/bare_root.sh
. "$(dirname "$0")/bare_root.sh"

for program in cpack dpkg-deb dpkg-shlibdeps lintian; do
  command -v "$program" > /dev/null || { echo "SKIPPED: no $program; scripts/setup.sh check"; exit 77; }
done
(cd "$build" && cpack -G DEB -B "$work") > "$work/cpack.log" 2>&1 || { tail -n 20 "$work/cpack.log"; exit 1; }
for package in st st-dev; do
  deb=$(echo "$work/${package}"_*.deb)
  [ -s "$deb" ] || failed "no package $package"
  lintian --allow-root "$deb" > "$work/lintian.log" 2>&1 || { cat "$work/lintian.log"; failed "lintian on $package"; }
  if grep -E "^E:" "$work/lintian.log"; then failed "lintian on $package"; fi
  dpkg-deb -x "$deb" "$work/unpacked"
done
dpkg-deb -f "$work"/st_*.deb Depends | grep -q "libocct-data-exchange" || failed "the libraries are no dependencies"
said=$(cd "$work" && env -i PATH="$work/unpacked/usr/bin:/usr/bin:/bin" sh -c \
  "for m in assembly.step box.igs box.step; do st-import $models/\$m -q || exit; done; st-info geometry.hdf")
grep -q "faces  *6" <<< "$said" || failed "the unpacked tools do not run"
[ -f "$work/unpacked/usr/lib/cmake/st/stConfig.cmake" ] || failed "st-dev has no stConfig.cmake"
echo "$(basename "$work"/st_*.deb) and its -dev package are sound"

if [ "${3:-}" != --bare ] || ! can_make_root; then exit 0; fi
make_root ca-certificates
mkdir "$root/models"
cp -t "$root/models" "$work"/st_*.deb "$models"/{assembly.step,box.igs,box.step}
inside "apt-get update && apt-get install -y --no-install-recommends /models/st_*.deb"
inside "cd /models && for m in assembly.step box.igs box.step; do st-run \$m --report \$m.html -q || exit; done"
for model in assembly.step box.igs box.step; do
  [ -s "$root/models/$model.html" ] || failed "no report of $model, in a bare Debian"
done
inside "cd /models && st-run box.step --np 2 -q && make_aircraft aircraft.step && st-run aircraft.step --preset preview"
grep "passes" "$work/log" || failed "no mesh of the aircraft that passes, in a bare Debian"
echo "$(basename "$work"/st_*.deb): does so in a bare Debian $release, too"
