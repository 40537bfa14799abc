#!/bin/bash
# Submits the chain to Slurm: one job per stage, each starting when the one before has succeeded.
# usage: submit.sh [--remesh] [--from STAGE] VARIABLE=VALUE...    variables of make help: MODEL=wing.step TOOLS=DIR
# A failed stage cancels those that wait for it; remove the cause and submit the rest with --from STAGE.
set -eu -o pipefail
here=$(dirname "$(realpath "$0")")
workflow=$(realpath "$here/../../Makefile.workflow")

# What is requested from sbatch: edit it for your cluster and model. The ranks of st-raster, st-mesh and st-remesh are
# the tasks of their jobs; the other stages have one task.
resources_of() {
  case $1 in
    st-raster | st-mesh | st-remesh) echo --nodes=2 --ntasks-per-node=32 --time=02:00:00 ;;
    *) echo --nodes=1 --ntasks=1 --time=01:00:00 ;;
  esac
}

stages="st-import st-raster st-prolong st-mesh st-merge all"
from=
while [[ ${1-} == --* ]]; do
  case $1 in
    --remesh) stages="st-import st-raster remesh-sizes st-remesh remesh"; shift ;;
    --from) from=${2-none}; shift $(($# > 1 ? 2 : 1)) ;;
    *) echo "submit: error: unknown option $1; see the first lines of $0" >&2; exit 2 ;;
  esac
done
if [ -n "$from" ]; then
  case " $stages " in
    *" $from "*) stages="$from${stages#*"$from"}" ;;
    *) echo "submit: error: --from $from: the stages are $stages" >&2; exit 2 ;;
  esac
fi

before=
for stage in $stages; do
  read -ra resources <<< "$(resources_of "$stage")"
  options=(--parsable "--job-name=$stage" --kill-on-invalid-dep=yes ${before:+"--dependency=afterok:$before"})
  job=$(sbatch "${options[@]}" "${resources[@]}" "$here/stage.sbatch" "$workflow" "$stage" "$@")
  job=${job%%;*}  # a cluster's name may follow
  echo "$stage: job $job${before:+ after $before}"
  before=$job
done
