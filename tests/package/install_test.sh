#!/bin/bash
# cmake --install gives pages and completions that say what --help says, and libraries for find_package(st);
# uninstall leaves nothing.
# usage: install_test.sh SOURCE_DIR BUILD_DIR
set -eu -o pipefail
source=$1 build=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
prefix=$work/prefix
failed() { echo "FAILED: $*"; exit 1; }

cmake --install "$build" --prefix "$prefix" > "$work/install.log" || { cat "$work/install.log"; exit 1; }
cp "$build/install_manifest.txt" "$work/manifest"
PATH=$prefix/bin:$PATH
for tool in "$prefix"/bin/st-*; do
  name=$(basename "$tool")
  page=$prefix/share/man/man1/$name.1.gz
  [ -s "$page" ] || failed "no man page of $name"
  zcat "$page" | sed 's/\\-/-/g' > "$work/page"
  for flag in $("$tool" --help-all | grep -oE '^  (-[a-z],)?--[a-z0-9-]+' | grep -oE -- '--[a-z0-9-]+'); do
    grep -q -- "^\.B .*$flag" "$work/page" || failed "the man page of $name has no $flag"
    for file in bash-completion/completions/$name zsh/vendor-completions/_$name; do
      grep -q -- "$flag" "$prefix/share/$file" || failed "$file has no $flag"
    done
    fish=$prefix/share/fish/vendor_completions.d/$name.fish
    grep -q -- "-l ${flag#--} " "$fish" || failed "fish: $name has no $flag"
  done
  bash -n "$prefix/share/bash-completion/completions/$name" || failed "bash completion of $name"
done
# A completion as bash calls it.
completed=$(bash -c ". $prefix/share/bash-completion/completions/st-export
  COMP_WORDS=(st-export --quad) COMP_CWORD=1; _st_export; echo \${COMPREPLY[*]}")
[ "$completed" = "--quads --quadratic" ] || failed "bash completes --quad to '$completed'"

cp "$build/test_models/box.step" "$work"
make -C "$work" -f "$prefix/share/st/Makefile.workflow" MODEL=box.step NP=1 EXPORT=cgns > "$work/workflow.log" 2>&1 ||
  { cat "$work/workflow.log"; failed "workflow"; }
[ -s "$work/out/box/mesh.cgns" ] || failed "the installed workflow made no mesh.cgns"

cmake -S "$prefix/share/doc/st/examples/volume_mesher" -B "$work/example" -DCMAKE_PREFIX_PATH="$prefix" \
  > "$work/example.log" 2>&1 || { tail -n 30 "$work/example.log"; failed "find_package(st)"; }
cmake --build "$work/example" >> "$work/example.log" 2>&1 ||
  { tail -n 30 "$work/example.log"; failed "the example does not build against the installed libraries"; }
"$work/example/count_tetrahedra" "$work/out/box/mesh.hdf" "$work/out/box/sizing.hdf" > "$work/counted"
for line in "^[1-9][0-9]* triangles" "^about [1-9][0-9]* tetrahedra"; do
  grep -q "$line" "$work/counted" || { cat "$work/counted"; failed "count_tetrahedra"; }
done
if "$work/example/count_tetrahedra" "$work/out/box/mesh.hdf" "$work/out/box/geometry.hdf" 2> /dev/null; then
  failed "count_tetrahedra takes a geometry for a sizing"
fi

# Examples run from where Debian has them, in an empty folder.
examples=$prefix/share/doc/st/examples
for program in make_aircraft make_model; do
  $program > "$work/said" 2>&1 || true
  grep -q "usage: $program" "$work/said" || failed "$program is not installed"
done
for script in openfoam/volume.sh openfoam/flow.sh openfoam/pressure.sh; do
  code=0
  "$examples/$script" 2> "$work/said" || code=$?
  { [ $code = 2 ] && grep -q "usage: $(basename "$script")" "$work/said"; } || failed "$script does not start: $code"
done
if /usr/bin/python3 -c 'import vtk' 2> /dev/null; then
  "$examples/openfoam/draw_pressure.py" --help > "$work/said" || failed "draw_pressure.py does not start"
fi
mkdir "$work/slurm"
cat > "$work/slurm/sbatch" << 'EOF'
#!/bin/sh
for word; do case $word in */Makefile.workflow) test -f "$word" || exit 1 ;; esac; done
echo 7
EOF
chmod +x "$work/slurm/sbatch"
PATH=$work/slurm:$PATH "$examples/cluster/submit.sh" MODEL=box.step > "$work/said" || failed "submit.sh"
grep -q "st-merge: job 7 after 7" "$work/said" || failed "submit.sh"
PATH=$prefix/bin:/usr/bin:/bin "$examples/flap/turn_flap.sh" "$build/test_models/wing_with_flap.step" "$work/flap" \
  "$prefix/bin" > "$work/flap.log" 2>&1 || { tail -n 5 "$work/flap.log"; failed "turn_flap.sh"; }
cp "$build/test_models/box.step" "$work/model.step"
PYTHONPATH=$prefix/lib/python3/dist-packages /usr/bin/python3 -B "$examples/python/grid_family.py" "$work/model.step" \
  "$work/family" 2 > "$work/said" 2>&1 || { cat "$work/said"; failed "grid_family.py"; }

cmake -DMANIFEST="$work/manifest" -P "$source/cmake/uninstall.cmake" > /dev/null
[ ! -e "$prefix" ] || { find "$prefix" | head; failed "uninstall left files"; }
echo "installed, used and uninstalled"
