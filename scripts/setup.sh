#!/bin/bash
# Installs the Debian packages that are missing; does nothing, and needs neither root nor network, when none is.
# usage: scripts/setup.sh [build|check|site|adapt] [--list]   build: to build and run; check: also to run all tests;
#                                                           site: the pages as a site only; adapt: examples/adapt only
set -eu -o pipefail

build_packages=(
  g++ cmake ninja-build
  libocct-foundation-dev libocct-modeling-data-dev libocct-modeling-algorithms-dev
  libocct-ocaf-dev libocct-data-exchange-dev
  libtbb-dev libfontconfig-dev  # OpenCASCADE's CMake targets name them, its packages do not
  libhdf5-dev zlib1g-dev libopenmpi-dev openmpi-bin
  libcli11-dev libeigen3-dev libfmt-dev nlohmann-json3-dev libtomlplusplus-dev libxxhash-dev
)
check_packages=(
  ccache libgtest-dev libbenchmark-dev python3 python3-numpy python3-vtk9
  lintian dpkg-dev file  # packages
  clang-format clang-tidy universal-ctags pyflakes3 shellcheck  # lints
  libcgal-dev  # the independent judge of meshes, tests only
  python3-meshio tetgen gmsh libcgns-dev cgns-convert python3-h5py  # foreign readers of exports, tests only
  iproute2 util-linux  # two hosts made of namespaces: tests/mpi/two_hosts_test.sh
  valgrind  # instructions: bench/budget.py
  xvfb xauth   # pictures without a screen: scripts/render_images.sh
  chromium  # the page of st-report in a browser: tests/cli/report_test.py
)
site_packages=(mkdocs python3)
adapt_packages=(tetgen gmsh openfoam python3 python3-numpy python3-vtk9 xvfb xauth)

role=build list=
for argument in "$@"; do
  case $argument in
    build | check | site | adapt) role=$argument ;;
    --list) list=1 ;;
    *)
      echo "setup: error: unknown argument '$argument'; usage: scripts/setup.sh [build|check|site|adapt] [--list]" >&2
      exit 2
      ;;
  esac
done
case $role in
  build) wanted=("${build_packages[@]}") ;;
  check) wanted=("${build_packages[@]}" "${check_packages[@]}" "${site_packages[@]}") ;;
  site) wanted=("${site_packages[@]}") ;;
  adapt) wanted=("${adapt_packages[@]}") ;;
esac
if [ -n "$list" ]; then
  printf '%s\n' "${wanted[@]}"
  exit 0
fi

if ! command -v dpkg-query > /dev/null; then
  echo "setup: this is not a Debian system; make sure that the equivalents of these are installed: ${wanted[*]}" >&2
  exit 0
fi
missing=()
for package in "${wanted[@]}"; do
  status=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2> /dev/null || true)
  [ "$status" = installed ] || missing+=("$package")
done
[ ${#missing[@]} -gt 0 ] || exit 0

echo "setup: installing ${missing[*]}"
as_root=()
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo > /dev/null; then
    echo "setup: error: packages are missing and this is neither root nor a machine with sudo;" \
      "as root: apt-get install ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi
apt() { "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq -o Dpkg::Use-Pty=0 "$@"; }
log=$(mktemp)
trap 'rm -f "$log"' EXIT
if ! { apt update && apt install -y --no-install-recommends "${missing[@]}"; } > "$log" 2>&1; then
  tail -n 30 "$log" >&2
  echo "setup: error: apt-get could not install ${missing[*]}; see the lines above" >&2
  exit 1
fi
