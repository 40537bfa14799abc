#!/bin/bash
# The job chain of examples/cluster, with stand-ins for sbatch and srun: jobs, order, resources, ranks, failures.
# usage: cluster_test.sh SOURCE_DIR [BIN_DIR MODELS_DIR]
set -eu -o pipefail
source=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
# shellcheck source-path=SCRIPTDIR source=common.sh
. "$source/tests/workflow/common.sh"
submit=$source/examples/cluster/submit.sh
export QUEUE=$work/queue RANKS=
mkdir slurm queue "my models"
export PATH=$work/slurm:$PATH
if [ $# -gt 1 ]; then
  use_real_tools "$2"
  cp "$3/block_with_hole.step" "my models/a.step"
  RANKS=2
else
  use_fake_tools
  echo model > "my models/a.step"
fi

# Jobs run when they are submitted, from a copy of their script, as Slurm does; queue/<id> says how they ended.
cat > slurm/sbatch <<'END'
#!/bin/bash
set -eu
id=$(($(ls "$QUEUE" | wc -l) + 100)) nodes=1 ntasks= per_node=1 before= name=
while [[ $1 == --* ]]; do
  case $1 in
    --dependency=afterok:*) before=${1##*:} ;;
    --nodes=*) nodes=${1#*=} ;;
    --ntasks=*) ntasks=${1#*=} ;;
    --ntasks-per-node=*) per_node=${1#*=} ;;
    --job-name=*) name=${1#*=} ;;
    --parsable | --kill-on-invalid-dep=yes | --time=*) ;;
    *) echo "sbatch: error: option $1 is not known" >&2; exit 1 ;;
  esac
  shift
done
tasks=${ntasks:-$((nodes * per_node))} script=$(mktemp)
cp "$1" "$script"
shift
status=cancelled
if [ -z "$before" ] || grep -q '^ok' "$QUEUE/$before"; then
  status=ok
  SLURM_JOB_ID=$id SLURM_NTASKS=$tasks SLURM_PROCID=0 bash "$script" "$@" > "$QUEUE.$id.out" 2>&1 || status=failed
fi
rm "$script"
echo "$status $name $nodes $tasks" > "$QUEUE/$id"
echo "$id;cluster"
END
cat > slurm/srun <<'END'
#!/bin/bash
set -eu
[ "$1" = --mpi=pmix ] && shift
echo "srun $SLURM_NTASKS" >> "$FAKE_LOG"
case " $* " in *" --np "*) echo "srun: error: --np within a job" >&2; exit 1 ;; esac
[ -n "$RANKS" ] || exec "$@"
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_hwloc_base_binding_policy=none
exec env -u SLURM_JOB_ID -u SLURM_NTASKS -u SLURM_PROCID mpirun --quiet -np "$RANKS" "$@"
END
chmod +x slurm/*

# submit ARGUMENTS...: as run of common.sh, and the jobs in $jobs
submit() {
  rm -f queue/* "$FAKE_LOG"
  status=0
  said=$("$submit" "$@" MODEL="my models/a.step" TOOLS="$work/bin" EXPORT=vtu 2>&1) || status=$?
  jobs=$(find queue -type f | sort | xargs -r cat | tr '\n' ',')
  ran=$(uniq "$FAKE_LOG" 2> /dev/null | tr '\n' ' ' || true)
  [[ $jobs != *failed* || -n "${FAKE_FAIL-}" ]] || cat queue.*.out
}

submit
expect "each stage is a job with its resources" "$status $jobs" \
  "0 ok st-import 1 1,ok st-raster 2 64,ok st-prolong 1 1,ok st-mesh 2 64,ok st-merge 1 1,ok all 1 1,"
expect "srun starts the ranks of the parallel stages" "$ran" \
  "st-import srun 64 st-raster st-prolong srun 64 st-mesh st-merge st-check st-export st-info "
expect "each job waits for the one before" "$(tail -n 5 <<< "$said" | cut -d' ' -f 2- | tr '\n' ',')" \
  "job 101 after 100,job 102 after 101,job 103 after 102,job 104 after 103,job 105 after 104,"

submit
expect "a chain that is up to date runs nothing" "$status $ran" "0 "

if [ $# -eq 1 ]; then
  export FAKE_FAIL="st-mesh 3"
  echo '# edited' >> out/a/st-prolong.toml
  submit
  expect "a failed stage cancels what waits for it" "$jobs" \
    "ok st-import 1 1,ok st-raster 2 64,ok st-prolong 1 1,failed st-mesh 2 64,cancelled st-merge 1 1,cancelled all 1 1,"
  unset FAKE_FAIL
  submit --from st-mesh
  expect "the rest starts from the failed stage" "$jobs $ran" \
    "ok st-mesh 2 64,ok st-merge 1 1,ok all 1 1, srun 64 st-mesh st-merge st-check st-export st-info "
  submit --from st-msh
  expect "an unknown stage is refused, and nothing is submitted" "$status $jobs" "2 "
  submit --form st-mesh
  expect "so is an unknown option" "$status $jobs" "2 "
fi

echo 'slope = 0.25' > out/a/st-prolong.toml
submit --remesh --from remesh-sizes
expect "remeshing is a chain of jobs, too" "$status $jobs $ran" \
  "0 ok remesh-sizes 1 1,ok st-remesh 2 64,ok remesh 1 1, st-prolong srun 64 st-remesh st-check st-export st-info "

if [ $# -gt 1 ]; then
  rm -rf queue.*
  run MODEL="my models/a.step" OUT=alone NP=1
  echo 'slope = 0.25' > alone/st-prolong.toml
  run MODEL="my models/a.step" OUT=alone NP=1 remesh
  for mesh in mesh.hdf remesh/mesh.hdf; do
    alone=$("$2/st-info" alone/$mesh --hash)
    expect "the jobs make the $mesh of one rank" "$("$2/st-info" out/a/$mesh --hash)" "$alone"
  done
fi
finish "the job chain holds"
