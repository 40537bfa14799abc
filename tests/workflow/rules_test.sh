#!/bin/bash
# The make rules of Makefile.workflow, with fake tools: what runs when, and what a failure leaves.
# usage: rules_test.sh SOURCE_DIR
set -eu -o pipefail
source=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
. "$source/tests/workflow/common.sh"
use_fake_tools
echo model-a > a.step

all="st-import st-raster st-prolong st-mesh st-merge st-check st-export st-info "
run MODEL=a.step
expect "a first run runs every stage" "$ran" "$all"
expect "a first run succeeds" "$status" 0
expect "the report says where the mesh is" "$(grep -c out/a/mesh.hdf <<< "$said" | sed 's/^[1-9].*/yes/')" yes

run MODEL=a.step
expect "a second run runs nothing" "$ran" ""
expect "a second run says so" "$(grep -c 'up to date' <<< "$said")" 1

later touch a.step
run MODEL=a.step
expect "a touched model of the same content runs nothing" "$ran" ""

echo 'alpha = 5' > out/a/st-raster.toml
run MODEL=a.step
rm out/a/st-raster.toml
run MODEL=a.step
expect "a removed option file comes back with the defaults and counts as an edit" "$ran" \
  "st-raster st-prolong st-mesh st-merge st-check st-export st-info "
echo 'sources = ["wake.toml"]' > out/a/st-prolong.toml
run MODEL=a.step
expect "a file that an option names and that is missing stops make before anything runs" "$status $ran" "2 "
missing="out/a/st-prolong.toml names 'wake.toml', which does not exist"
expect "and the message names both files" "$(grep -c "$missing" <<< "$said")" 1
echo '[[source]]' > wake.toml
run MODEL=a.step
expect "once it is there its stage runs" "$ran" "st-prolong st-mesh st-merge st-check st-export st-info "
rm wake.toml
run MODEL=a.step
expect "a file that disappears stops make" "$status $ran" "2 "
rm out/a/st-prolong.toml
run MODEL=a.step

run MODL=a.step
expect "a misspelt variable is refused" "$status $ran" "2 "
expect "and the nearest name said" "$(grep -c 'unknown variable MODL.*did you mean MODEL?' <<< "$said")" 1
run MODEL=a.step XYZZY=1
expect "a variable like no other is refused without a guess" "$status $ran $(grep -c 'did you mean' <<< "$said")" "2  0"
run MODEL=a.step CXX=c++ CXXFLAGS=-O2 VERBOSE=1 STEPS=3 OMPI_MCA_btl=tcp ST_CORPUS=/nowhere
expect "variables of compilers, examples and MPI are passed on" "$status $ran" "0 "
run MODEL=new.step EXPORT="stl vtk"
expect "a format that is none is refused before anything runs" "$status $ran $(ls out)" "2  a"
formats="'vtk' is no format; the formats are stl .* poly; did you mean vtu?"
expect "and the formats are named" "$(grep -c "$formats" <<< "$said")" 1
run MODEL=a.step BLANK=yes
expect "a switch that is neither 0 nor 1 is refused" "$status $ran" "2 "
run MODEL=a.step BLANK=0 ALLOW_INCOMPLETE=0
expect "0 turns a switch off" "$status $ran" "0 "
run MODEL=a.step LAUNCH=env NP=3
expect "a launcher and a number of ranks exclude each other" "$status $ran" "2 "
said=$(cd "$source" && make help)
commands=$(sed -n '3,7s/^ *make MODEL=wing.step *\([a-zA-Z]*\).*/\1/p' <<< "$said" | tr '\n' ' ')
expect "help starts with the five commands of a user" "$commands" "mesh after remesh EXPORT LAUNCH "
expect "plain make at the top knows the same rules" "$said" "$(make -f "$source/Makefile.workflow" help)"

run MODEL=a.step OUT=b BLANK=1
expect "blanking takes two passes and one raster" "$ran" \
  "st-import st-raster st-prolong st-mesh st-merge st-prolong st-mesh st-merge st-check st-export st-info "
run MODEL=a.step OUT=b BLANK=1
expect "a second run with blanking runs nothing" "$ran" ""
run MODEL=a.step OUT=b
expect "without blanking the second pass is made again" "$ran" "st-prolong st-mesh st-merge st-check st-export st-info "
run MODEL=a.step OUT=b BLANK=1
expect "and with it again, from the mesh of the first" "$ran" "st-prolong st-mesh st-merge st-check st-export st-info "
expect "the mesh of the first pass blanks" "$(grep -cx st-merge b/sizing.hdf)" 1
rm -r b "$FAKE_LOG.np"
run MODEL=a.step OUT=b NP=7
expect "the parallel stages take the number of ranks" "$(tr '\n' ' ' < "$FAKE_LOG.np")" "st-raster 7 st-mesh 7 "
rm -r b

run MODEL=a.step NP=7
expect "the number of ranks does not make results old" "$ran" ""
run MODEL=a.step EXPORT="stl vtu"
expect "a further export is made alone" "$ran" "st-export st-info "
run MODEL=a.step "$PWD/nothing" || true
expect "an unknown target fails" "$status" 2
run MODEL=a.step out/a/mesh.obj
expect "an export is a target" "$ran" "st-export "

cat > launch <<'END'
#!/bin/bash
echo "$0 $1" >> "$FAKE_LOG"
case " $* " in *" --np "*) exit 9 ;; esac
shift
exec "$@"
END
chmod +x launch
run MODEL=a.step OUT=c LAUNCH="./launch 'two words'"
expect "a launcher starts the parallel stages, without --np" "$status $ran" \
  "0 st-import ./launch two words st-raster st-prolong ./launch two words st-mesh st-merge st-check st-export st-info "
echo 'slope = 0.1' > c/st-prolong.toml
run MODEL=a.step OUT=c LAUNCH="./launch 'two words'" remesh
expect "and remeshing" "$status $ran" "0 st-prolong ./launch two words st-remesh st-check st-export st-info "
expect "of the mesh at hand" "$(grep -cx st-merge c/remesh/mesh.hdf) $(grep -c slope c/mesh.hdf || true)" "1 0"
expect "with the new sizes" "$(grep -cx 'slope = 0.1' c/remesh/mesh.hdf)" 1
FAKE_FAIL="st-remesh 5"
export FAKE_FAIL
echo 'too-long = 2' > c/st-remesh.toml
run MODEL=a.step OUT=c remesh
expect "an incomplete mesh is kept apart" "$status $(cd c/remesh && echo mesh*hdf)" "2 mesh.incomplete.hdf"
unset FAKE_FAIL
rm -r c
run MODEL=a.step OUT=c remesh
expect "remeshing what is not meshed yet meshes it first" "$status $ran" \
  "0 st-import st-raster st-prolong st-mesh st-merge st-prolong st-remesh st-check st-export st-info "
rm -r c

later touch bin/*
run MODEL=a.step
expect "tools built again with the same content run nothing" "$ran" ""
echo '# a new version' >> bin/st-mesh
run MODEL=a.step
expect "a changed tool runs its stage and what follows" "$ran" "st-mesh st-merge st-check st-export st-info "

echo model-b > a.step
run MODEL=a.step
expect "a changed model runs everything" "$ran" "$all"
mkdir other
echo model-c > other/a.step
run MODEL=other/a.step
expect "another model of the same name is refused" "$status $ran" "2 "
expect "and the message names the remedy" "$(grep -c 'give OUT=' <<< "$said")" 1
cp a.step other/a.step
run MODEL=other/a.step
expect "the same model elsewhere is the same" "$status $ran" "0 "

echo model-d > "other/my wing's #1.step"
run MODEL="other/my wing's #1.step"
expect "a model's path may hold spaces, quotes and hashes" "$status $ran" "0 $all"
expect "its folder has none" "$(ls out)" "$(printf 'a\nmy_wing_s__1')"
run MODEL=missing.step
expect "a missing model is refused" "$status" 2
run MODEL=other
expect "a folder as a model is refused" "$status" 2

echo model-e > e.step
export FAKE_FAIL="st-prolong 3"
run MODEL=e.step
expect "a failed stage stops make" "$status $ran" "2 st-import st-raster st-prolong "
expect "and leaves no artifact" "$(echo out/e/*.hdf)" "out/e/geometry.hdf out/e/raster.hdf"
unset FAKE_FAIL
run MODEL=e.step
expect "afterwards make goes on where it stopped" "$ran" "st-prolong st-mesh st-merge st-check st-export st-info "

echo '# edited' >> out/e/st-raster.toml
export FAKE_FAIL="st-raster 5"
run MODEL=e.step
expect "a raster of which parts are missing stops make" "$status $ran" "2 st-raster "
expect "and is kept under a name that no rule trusts" "$(ls out/e/raster*)" out/e/raster.incomplete.hdf
run MODEL=e.step ALLOW_INCOMPLETE=1
expect "raster and sizing are allowed to be incomplete when asked" "$status $ran" \
  "0 st-raster st-prolong st-mesh st-merge st-check st-export st-info "
unset FAKE_FAIL

echo '# edited' >> out/e/st-mesh.toml
export FAKE_FAIL="st-mesh 5"
run MODEL=e.step
expect "an incomplete stage stops make" "$status $ran" "2 st-mesh "
expect "its artifact is kept under a name that no rule trusts" "$(ls out/e/patches*)" out/e/patches.incomplete.hdf
run MODEL=e.step ALLOW_INCOMPLETE=1
expect "make goes on with it when asked" "$status $ran" "0 st-mesh st-merge st-check st-export st-info "
unset FAKE_FAIL

echo '# edited' >> out/e/st-raster.toml
FAKE_KILL=st-raster setsid make -f "$source/Makefile.workflow" TOOLS="$work/bin" MODEL=e.step > killed.log 2>&1 &
make_id=$!
for _ in $(seq 200); do [ -s "$FAKE_LOG.pid" ] && break; sleep 0.05; done
kill -KILL "$(cat "$FAKE_LOG.pid")"
wait $make_id || true
run MODEL=e.step
expect "a killed stage runs again, and what follows" "$ran" \
  "st-raster st-prolong st-mesh st-merge st-check st-export st-info "
expect "and leaves no temporary" "$(find out/e -name '.*.tmp.*' | wc -l)" 0

FAKE_CHECK=5
export FAKE_CHECK
echo '# edited' >> out/e/st-merge.toml
run MODEL=e.step
expect "a mesh that does not pass ends make with an error, after the report" \
  "$status $(grep -c 'did not pass' <<< "$said")" "2 1"
unset FAKE_CHECK
run MODEL=e.step
expect "and the verdict stays" "$status $ran" "2 "

missing() {  # how many of these files do not exist
  local n=0 file
  for file in "$@"; do [ -e "$file" ] || n=$((n + 1)); done
  echo $n
}
mkdir -p proj out/foreign
cp a.step proj/my.brep
echo mine > proj/notes.txt
echo mine > out/foreign/notes.txt
run MODEL=proj/my.brep OUT="$PWD/proj" EXPORT="stl ugrid" BLANK=1
expect "results may lie beside the model" "$status" 0
touch proj/mesh.mapbc proj/log/own.txt
run MODEL=proj/my.brep OUT="$PWD/proj" clean
expect "clean removes the results alone" \
  "$status $(cd proj && find . -type f ! -name 'st-*.toml' | sort | tr '\n' ' ')" \
  "0 ./log/own.txt ./my.brep ./notes.txt "
expect "and names what it keeps" "$(grep -c 'keeps what make did not write.*: log my.brep notes.txt' <<< "$said")" 1
run MODEL=a.step OUT=out/foreign clean
expect "a folder that make did not fill is not cleaned" "$status $(ls out/foreign)" "2 notes.txt"
run MODEL=a.step OUT=d BLANK=1
run MODEL=a.step OUT=d remesh
run MODEL=a.step OUT=d distclean FORCE=1
expect "a folder of results alone is gone" "$status $(missing d)" "0 1"
run MODEL=a.step OUT=d clean
expect "cleaning what is not there is fine" "$status" 0
for odd in .brep ...brep /.step; do
  run MODEL=$odd clean
  expect "$odd gives no folder a name: nothing is removed" \
    "$status $(ls -d out/a) $(grep -c 'give OUT=' <<< "$said")" "2 out/a 1"
done

# shellcheck disable=SC2016
dollar='a$(shell touch pwned)`touch pwned`$HOME.step'
cp a.step "$dollar"
run MODEL="$dollar" OUT=d
expect "a model's name is text, nothing in it is run" "$status $(missing pwned)" "0 1"
MODEL=$dollar run OUT=d distclean FORCE=1
expect "nor when it comes from the environment" "$status $(missing pwned d)" "0 2"
run MODEL=$'a\ntouch pwned\n.step' OUT=d
expect "a model's name with a line break is refused" "$status $ran" "2 "
cp a.step ./-f.step
run MODEL=-f.step OUT=d
expect "a model's name may begin with a dash" "$status $ran" "0 $all"
# shellcheck disable=SC2016
for given in 'NP=1;touch pwned' NP=x 'TOOLS=bin;touch pwned' OUT= OUT=-rf; do
  run MODEL=a.step "$given"
  expect "$given is refused" "$status $(missing pwned)" "2 1"
done

if localedef -i de_DE -f UTF-8 "$work/de_DE.UTF-8" > /dev/null 2>&1 || [ -d "$work/de_DE.UTF-8" ]; then
  export LOCPATH=$work
  { LC_ALL=de_DE.UTF-8 run MODEL=a.step OUT=f; } 2> /dev/null  # this shell itself cannot
  expect "a locale with a decimal comma gives the same report" \
    "$status $(grep -c '^  total .*\.[0-9]* s$' f/report.txt)" "0 1"
else
  echo "SKIPPED: localedef cannot make a locale with a decimal comma"
fi

finish "all workflow rules hold"
