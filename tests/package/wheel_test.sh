#!/bin/bash
# A wheel installs into a fresh environment and meshes a file of each reader there. Its tools use no library of the
# system beside those of C and C++, and all that is bundled has a licence that was read. Where mmdebstrap is, the same
# in a bare Debian with Python alone, and with the system's MPI for several ranks.
# Part of scripts/release.sh, not of the tests of every build.
# usage: wheel_test.sh SOURCE_DIR BUILD_DIR WHEEL
set -eu -o pipefail
build=$2 wheel=$3
# shellcheck source=tests/package/bare_root.sh
. "$(dirname "$0")/bare_root.sh"

[ "$(stat -c %s "$wheel")" -le 50000000 ] || failed "the wheel is larger than 50 MB"
/usr/bin/python3 -m venv --system-site-packages "$work/venv" > "$work/log" 2>&1 ||
  { echo "SKIPPED: no python3-venv; the wheel was NOT TESTED"; exit 77; }
"$work/venv/bin/pip" install --no-index --no-deps "$wheel" > "$work/log" || { cat "$work/log"; failed "pip"; }
package=$(echo "$work"/venv/lib/python3*/site-packages/st)
for tool in "$package"/bin/* "$package"/lib/st/*; do
  for library in $(env -u LD_LIBRARY_PATH ldd "$tool" | awk '$2 == "=>" {print $3}'); do
    [[ $library == "$package"/* || $(basename "$library") =~ ^(libc|libm|libstdc\+\+|libgcc_s)\.so ]] ||
      failed "$(basename "$tool") uses $library"
  done
done
for tool in "$build"/bin/st-*; do
  name=$(basename "$tool")
  [ "$("$work/venv/bin/$name" --help)" = "$("$tool" --help)" ] || failed "$name is not the tool of this name"
done
[ -s "$package/licenses/common/LGPL-2.1" ] || failed "the text of a licence is missing"
# None of these is under the GPL.
judged='st|common|libocct-.*|libopenmpi3|libevent-.*|libhwloc15|libudev1|libtbb.*|libfmt9|zlib1g|libaec0|libsz2'
judged+='|libhdf5-dev|libcli11-dev|libeigen3-dev|nlohmann-json3-dev'
unknown=$(find "$package/licenses" -mindepth 1 -maxdepth 1 -printf '%f\n' | grep -vxE "$judged" || true)
[ -z "$unknown" ] || failed "$unknown is bundled; read its licence, and add it to this test where it is not the GPL"

models=$work/models
mkdir "$models"
cp -t "$models" "$build"/test_models/{assembly.step,box.igs,box.step} "$wheel"
cat > "$models/mesh.py" << 'EOF'
import shutil
import sys
import st

for model in ("assembly.step", "box.igs", "box.step"):
    st.mesh(model, "out")
said = []
mesh = st.mesh("box.step", preset="rans", progress=said.append)
assert len(mesh.triangles) > 100 and mesh.quality().min() > 0.3, mesh.quality().min()
assert any(line.startswith("st-mesh") for line in said), said
assert st.run("st-info", "out/mesh.hdf")["exit_code"] == 0
try:
    st.mesh("nothing.step", "out2")
    sys.exit("no error for a file that is not there")
except st.ToolError as e:
    assert e.code == 3 and "nothing.step" in e.message, e
try:
    ranks = st.mesh("box.step", preset="rans", ranks=2)
    assert (ranks.points == mesh.points).all()
except st.ToolError as e:
    assert not shutil.which("mpirun") and "openmpi-bin" in e.message, e
print("several ranks:", shutil.which("mpirun") or "refused, as there is no mpirun")
EOF
cat > "$models/test.sh" << 'EOF'
set -eu
cd "$(dirname "$0")"
"$1/bin/python" -m st box.step
"$1/bin/st-run" assembly.step --report assembly.html -q
[ -s assembly.html ]
"$1/bin/python" mesh.py
EOF
env -i PATH=/usr/bin:/bin bash "$models/test.sh" "$work/venv" > "$work/log" 2>&1 ||
  { cat "$work/log"; failed "meshes"; }
tail -n 1 "$work/log"
echo "$(basename "$wheel"): installs, meshes boxes and an assembly"

can_make_root || exit 0
make_root python3-numpy,python3-h5py,python3-venv
mkdir "$root/models"
cp -r "$models/." "$root/models"
inside "python3 -m venv --system-site-packages /venv && /venv/bin/pip install --no-index --no-deps /models/*.whl"
inside "bash /models/test.sh /venv"
tail -n 1 "$work/log"
inside "apt-get update && apt-get install -y --no-install-recommends openmpi-bin && bash /models/test.sh /venv"
tail -n 1 "$work/log"
echo "$(basename "$wheel"): does so in a bare Debian $release, too"
