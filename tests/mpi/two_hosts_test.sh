#!/bin/bash
# Two hosts: namespaces with network and host name of their own, joined by a virtual cable. st-raster, st-mesh and
# st-remesh with a rank on each make what one rank makes. The namespaces end with this script, however it ends:
# nothing stays behind.
# usage: two_hosts_test.sh BIN_DIR MODELS_DIR       exit 77 where namespaces are not permitted
set -eu -o pipefail
if [ -z "${INSIDE_NAMESPACES-}" ]; then
  spaces=(--net --uts --mount --pid --fork --kill-child --mount-proc)
  [ "$(id -u)" -eq 0 ] || spaces+=(--user --map-root-user)
  if ! refusal=$(unshare "${spaces[@]}" ip link add cable type veth peer name other 2>&1); then
    echo "SKIPPED: two hosts not tested, namespaces are not permitted here: $refusal"
    exit 77
  fi
  INSIDE_NAMESPACES=1 exec unshare "${spaces[@]}" "$0" "$@"
fi

bin=$1 model=$2/assembly.step
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
fail() { echo "FAILED: $1" >&2; exit 1; }

# --- the hosts: a is here, b in namespaces of its own; private addresses, and no way to anywhere else ---
unshare --net --uts sleep 600 &
b=$!
on_b() { nsenter --target $b --net --uts "$@"; }
for _ in $(seq 100); do
  [ "$(readlink /proc/$b/ns/net)" = "$(readlink /proc/self/ns/net)" ] || break
  sleep 0.05
done
hostname host-a
on_b hostname host-b
ip link add cable type veth peer name cable netns $b
ip address add 10.77.0.1/30 dev cable
on_b ip address add 10.77.0.2/30 dev cable
for link in lo cable; do
  ip link set $link up
  on_b ip link set $link up
done

# --- mpirun reaches b through a stand-in for ssh ---
printf '#!/bin/bash\nshift\nexec nsenter --target %d --net --uts sh -c "$*"\n' $b > agent
chmod +x agent
export TMPDIR=$work PMIX_MCA_gds=hash OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export OMPI_MCA_hwloc_base_binding_policy=none OMPI_MCA_orte_execute_quiet=1
on_both() {
  mpirun -host 10.77.0.1,10.77.0.2 -np 2 --mca plm rsh --mca plm_rsh_agent "$work/agent" \
    --mca oob_tcp_if_include cable --mca btl_tcp_if_include cable "$@"
}
bytes_received() { awk '$1 == "cable:" { print $2 }' /proc/net/dev; }

hosts=$(on_both hostname | sort | tr '\n' ' ')
[ "$hosts" = "host-a host-b " ] || fail "the ranks are not on two hosts but on $hosts"

# --- the same artifacts at one rank and over both hosts ---
hash_of() { "$bin/st-info" "$1" --hash; }
same() {  # same ARTIFACT COMMAND...: the output of one rank is alone_ARTIFACT
  local artifact=$1 passed
  shift
  "$@" alone_"$artifact" > /dev/null
  passed=$(bytes_received)
  on_both "$@" "$artifact" > /dev/null
  passed=$(($(bytes_received) - passed))
  [ "$(hash_of "$artifact")" = "$(hash_of alone_"$artifact")" ] || fail "$artifact differs from that of one rank"
  [ "$passed" -gt 10000 ] || fail "$artifact: only $passed bytes passed between the hosts"
  echo "$artifact: the same at one rank and over two hosts, $passed bytes from host-b to host-a"
}
"$bin/st-import" "$model" -o geometry.hdf -q
same raster.hdf "$bin/st-raster" geometry.hdf --lmax 1% -o
"$bin/st-prolong" raster.hdf -o sizing.hdf -q
same patches.hdf "$bin/st-mesh" geometry.hdf sizing.hdf -o
"$bin/st-merge" patches.hdf -o mesh.hdf -q
"$bin/st-prolong" raster.hdf -o finer.hdf --scale 0.8 -q
same remeshed.hdf "$bin/st-remesh" mesh.hdf geometry.hdf finer.hdf --merged
