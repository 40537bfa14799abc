#!/bin/bash
# Installs the Debian packages that adapt.py needs. Where all are there it does nothing, and needs no root.
# usage: setup.sh [--list]
set -eu -o pipefail
packages=(tetgen gmsh openfoam python3 python3-numpy python3-vtk9 xvfb xauth)
case "$#${1:-}" in
  0) ;;
  1--list) printf '%s\n' "${packages[@]}" && exit 0 ;;
  *) sed -n '2,3s/^# //p' "$0" >&2 && exit 2 ;;
esac
missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2> /dev/null || true)
  [ "$status" = installed ] || missing+=("$package")
done
[ ${#missing[@]} -gt 0 ] || exit 0
echo "setup: installing ${missing[*]}"
as_root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo > /dev/null ||
    { echo "setup: error: neither root nor sudo; as root: apt-get install ${missing[*]}" >&2; exit 1; }
  as_root=(sudo)
fi
apt() { "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq -o Dpkg::Use-Pty=0 "$@"; }
{ apt update && apt install -y --no-install-recommends "${missing[@]}"; } >&2 ||
  { echo "setup: error: apt-get could not install ${missing[*]}; see the lines above" >&2; exit 1; }
