#!/bin/bash
# To be sourced: a folder $work that goes at the end, a bare Debian in $root, and commands in it.
work=$(mktemp -d)
root=$work/root
trap 'rm -rf --one-file-system "$work"' EXIT
failed() { echo "FAILED: $*"; exit 1; }

# Says so and returns 1 where there is no way to make one.
can_make_root() {
  if [ "$(id -u)" = 0 ] && command -v mmdebstrap > /dev/null; then return; fi
  echo "SKIPPED: NOT TESTED in a bare Debian; apt-get install mmdebstrap, and run this as root"
  return 1
}

# usage: make_root PACKAGE,PACKAGE...
make_root() {
  # shellcheck source=/dev/null
  release=$(. /etc/os-release && echo "$VERSION_CODENAME")
  mmdebstrap --quiet --variant=apt --mode=root --skip=check/empty --include="$1" "$release" "$root" \
    > "$work/log" 2>&1 || { cat "$work/log"; failed "mmdebstrap"; }
}

# Runs a command line there, in a name space of its own, so that nothing stays mounted.
inside() {
  # shellcheck disable=SC2016
  unshare --mount bash -c 'mount -t proc proc "$0/proc" && mount --rbind /dev "$0/dev" && mount --rbind /sys "$0/sys" &&
    exec chroot "$0" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root sh -c "$1"' "$root" "$1" > "$work/log" 2>&1 ||
    { cat "$work/log"; failed "$1, in a bare Debian"; }
}
