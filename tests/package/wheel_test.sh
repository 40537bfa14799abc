#!/bin/bash
# A wheel installs into a fresh environment, meshes a file of each reader there, and its tools use no library of the
# system beside those of C and C++.
# Part of scripts/release.sh, not of the tests of every build.
# usage: wheel_test.sh SOURCE_DIR BUILD_DIR WHEEL
set -eu -o pipefail
build=$2 wheel=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failed() { echo "FAILED: $*"; exit 1; }

[ "$(stat -c %s "$wheel")" -le $((70 * 1024 * 1024)) ] || failed "the wheel is larger than 70 MB"
/usr/bin/python3 -m venv --system-site-packages "$work/venv" > "$work/log" 2>&1 ||
  { echo "SKIPPED: no python3-venv"; exit 77; }
"$work/venv/bin/pip" install --no-index --no-deps "$wheel" > "$work/log" || { cat "$work/log"; failed "pip"; }
package=$(echo "$work"/venv/lib/python3*/site-packages/st)
for tool in "$package"/bin/* "$package"/lib/st/*; do
  for library in $(env -u LD_LIBRARY_PATH ldd "$tool" | awk '$2 == "=>" {print $3}'); do
    [[ $library == "$package"/* || $(basename "$library") =~ ^(libc|libm|libstdc\+\+|libgcc_s)\.so ]] ||
      failed "$(basename "$tool") uses $library"
  done
done
for tool in "$package"/bin/*; do
  "$work/venv/bin/$(basename "$tool")" --version > /dev/null || failed "$(basename "$tool") --version"
done
ls "$package/licenses/st" "$package"/licenses/libocct-* > /dev/null || failed "licences are missing"
cd "$work"
cat > mesh.py << 'EOF'
import sys
import st
for model in sys.argv[1:]:
    st.mesh(model, "out")
mesh = st.read("out/mesh.hdf")
assert len(mesh.triangles) > 100 and mesh.quality().min() > 0.3, mesh.quality().min()
try:
    st.mesh("nothing.step", "out2")
    sys.exit("no error for a file that is not there")
except st.ToolError as e:
    assert e.code == 3 and "nothing.step" in e.message, e
EOF
models=("$build"/test_models/{assembly.step,box.igs,box.step})
env -i PATH=/usr/bin:/bin "$work/venv/bin/python" mesh.py "${models[@]}" || failed "st.mesh()"
echo "$(basename "$wheel"): installs, meshes a box and an assembly"
