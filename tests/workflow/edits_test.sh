#!/bin/bash
# What an edit runs: a table of edits, each made to results that are up to date, with fake tools or with the real ones.
# usage: edits_test.sh SOURCE_DIR [BIN_DIR MODELS_DIR]
set -eu -o pipefail
source=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
# shellcheck source-path=SCRIPTDIR source=common.sh
. "$source/tests/workflow/common.sh"
if [ $# -gt 1 ]; then
  use_real_tools "$2"
  cp "$3/block_with_hole.step" a.step
else
  use_fake_tools
  echo model > a.step
fi

# Files that options name. The model is a block in millimetres.
source_at() { printf '[[source]]\ntype = "point"\nat = [%s, 0, 0]\nlength = "%s"\nradius = "3%%"\n' "$1" "$2"; }
echo '[[size]]
lmax = "4%"' > sizes.toml
echo '[[group]]
name = "first"
faces = 1' > groups.toml
source_at 0 1% > wake.toml
source_at 5 1% > near.toml
echo '0 0 0' > points.csv
# shellcheck disable=SC2016
echo '$MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
4
1 -900 -900 -900
2 900 0 0
3 0 900 0
4 0 0 900
$EndNodes
$Elements
1
1 4 0 1 2 3 4
$EndElements
$NodeData
1
"length"
1
0
3
0
1
4
1 100
2 100
3 100
4 100
$EndNodeData' > background.msh

# option STAGE 'KEY = VALUE': sets an option at the top of the stage's option file
option() {
  { echo "$2"; sed "/^${2%% *} =/d" "out/a/$1.toml"; } > edited
  mv edited "out/a/$1.toml"
}
unset_option() { sed -i "/^$2 =/d" "out/a/$1.toml"; }
append() { printf '%s\n' "${@:2}" >> "$1"; }
change_tool() { for tool in "$@"; do echo '# another version' >> "bin/$tool"; done; }

chain="import raster prolong mesh merge check export info"
# What stands in the table -> what the log says: "raster+" is that stage and what follows, "-" nothing.
expanded() {
  local stage words=
  for stage in $1; do
    case $stage in
      -) ;;
      *+) words+="${stage%+}${chain#*"${stage%+}"} " ;;
      *) words+="$stage " ;;
    esac
  done
  for stage in $words; do printf 'st-%s ' "$stage"; done
}

export NP=1 EXPORT=ascii.stl
run MODEL=a.step
expect "the first run" "$status $ran" "0 $(expanded import+)"
cp out/a/mesh.ascii.stl solid.stl
cp out/a/patches.hdf part.hdf

# edit | arguments of make | what runs. Edits marked with * are made with fake tools only.
n_edits=0
while IFS='|' read -r edit arguments expected; do
  read -r edit <<< "$edit"
  case $edit in
    '' | '#'*) continue ;;
    '*'*) [ $# -eq 1 ] || continue; edit=${edit#'*'} ;;
  esac
  sleep 0.01
  eval "$edit"
  read -ra words <<< "$arguments"
  run MODEL=a.step "${words[@]//+/ }"
  expect "$edit; make $arguments" "$status $ran" "0 $(expanded "$expected")"
  n_edits=$((n_edits + 1))
done << 'TABLE'
# the model, by its content
  :                                                        |                         | -
  touch a.step                                             |                         | -
  append a.step ''                                         |                         | import+
# each option file, by its content
  touch out/a/*.toml                                       |                         | -
  option st-import 'small = "0.02%"'                       |                         | import+
  option st-raster 'alpha = 12'                            |                         | raster+
  option st-prolong 'slope = 0.25'                         |                         | prolong+
  option st-mesh 'enhance-rounds = 4'                      |                         | mesh+
  option st-merge 'verbose = true'                         |                         | merge+
  option st-check 'min-mean-quality = 0.3'                 |                         | check info
  append out/a/st-raster.toml '[st-mesh]' 'np = 1'         |                         | raster+
# each file that an option names: naming it, touching it, editing it
  option st-import 'groups = "groups.toml"'                |                         | import+
  touch groups.toml                                        |                         | -
  append groups.toml 'role = "wall"'                       |                         | import+
  option st-raster 'sizes = "sizes.toml"'                  |                         | raster+
  touch sizes.toml                                         |                         | -
  append sizes.toml 'alpha = 15'                           |                         | raster+
  option st-prolong 'sources = ["wake.toml", "near.toml"]' |                         | prolong+
  touch wake.toml near.toml                                |                         | -
  append near.toml 'doubling = "9%"'                       |                         | prolong+
  option st-prolong 'background = "background.msh"'        |                         | prolong+
  sed -i 's/^4 100/4 90/' background.msh                   |                         | prolong+
  option st-prolong 'sample = "points.csv"'                |                         | prolong+
  append points.csv '1 1 1'                                |                         | prolong+
  option st-prolong 'blank = "solid.stl"'                  |                         | prolong+
  append solid.stl ''                                      |                         | prolong+
  unset_option st-prolong blank                            |                         | prolong+
  append solid.stl ''                                      |                         | -
* option st-mesh 'edges = "part.hdf"'                      |                         | mesh+
* append part.hdf ''                                       |                         | mesh+
# named in the table of the tool
  unset_option st-prolong sources                          |                         | prolong+
  append out/a/st-prolong.toml '[st-prolong]' 'sources = "wake.toml"' | | prolong+
  append wake.toml 'doubling = "8%"'                       |                         | prolong+
# tables in the option file itself
  append out/a/st-prolong.toml '[[st-prolong.source]]' 'type = "point"' 'at = [9, 0, 0]' 'length = "2%"' | | prolong+
  unset_option st-raster sizes; append out/a/st-raster.toml '[[st-raster.size]]' 'lmax = "3%"' | | raster+
  unset_option st-import groups; append out/a/st-import.toml '[[group]]' 'name = "second"' 'faces = 2' | | import+
# variables
  :                                                        | NP=2                    | -
  :                                                        | LAUNCH=env              | -
  :                                                        | EXPORT=ascii.stl+vtu    | export info
  :                                                        | PRESET=preview          | raster+
  :                                                        | PRESET=preview          | -
  :                                                        |                         | -
  :                                                        | PRESET=none             | raster+
  :                                                        | BLANK=1                 | prolong mesh merge prolong+
  :                                                        | BLANK=1                 | -
  :                                                        |                         | prolong+
# tools, by their content
  touch bin/*                                              |                         | -
  change_tool st-mesh                                      | LAUNCH=env              | mesh+
  change_tool st-check st-info                             |                         | check info
  change_tool st-export                                    |                         | export info
# remesh: the mesh stays, sizes are made anew
  :                                                        | remesh                  | prolong remesh check export info
  :                                                        | remesh                  | -
  option st-prolong 'slope = 0.22'                         | remesh                  | prolong remesh check export info
  append wake.toml '# nearer'                              | remesh                  | prolong remesh check export info
  option st-raster 'alpha = 11'                            | remesh          | raster prolong remesh check export info
  option st-remesh 'too-long = 1.5'                        | remesh                  | remesh check export info
* option st-remesh 'made-for = "part.hdf"'                 | remesh                  | remesh check export info
* append part.hdf ''                                       | remesh                  | remesh check export info
  touch out/a/mesh.hdf                                     | remesh                  | -
  :                                                        | remesh EXPORT=ascii.stl+obj | export info
  change_tool st-remesh                                    | remesh                  | remesh check export info
  :                                                        | remesh BLANK=1          | prolong remesh check export info
# and the whole mesh with the same edits; a new mesh is remeshed again
  :                                                        |                         | prolong+
  :                                                        | remesh                  | prolong remesh check export info
  option st-mesh 'enhance-rounds = 3'                      |                         | mesh+
  :                                                        | remesh                  | remesh check export info
TABLE
expect "no edit of the table is lost" "$((n_edits > 45))" 1
finish "$n_edits edits run what depends on them, and nothing else"
