#!/bin/bash
# Stands for every tool of the chain in the tests of the make rules: copies what it was given into its output,
# atomically. FAKE_FAIL="<tool> <exit code>" makes one tool fail (5 keeps its artifact, and --allow-incomplete makes it
# 0); FAKE_KILL=<tool> makes it hang over a half-written temporary.
set -eu
tool=${0##*/}
inputs=() output='' allowed='' preset=''
while [ $# -gt 0 ]; do
  case $1 in
    --print-options) echo "# options of $tool"; exit 0 ;;
    --print-inputs)  # the quoted names in lines such as sources = ["a.toml", "b.bac"], also in the table of the tool
      keys='sizes|groups|sources|background|blank|sample|edges|made-for'
      while IFS= read -r line; do
        [[ $line =~ ^($keys)\ = ]] || continue
        while [[ $line =~ \"([^\"]*)\"(.*) ]]; do echo "${BASH_REMATCH[1]}"; line=${BASH_REMATCH[2]}; done
      done < "${inputs[0]}"
      exit 0 ;;
    -o | --merged) output=$2; shift 2 ;;
    --np) echo "$tool $2" >> "${FAKE_LOG:?}.np"; shift 2 ;;
    --options | --geometry | --sizing) inputs+=("$2"); shift 2 ;;
    --allow-incomplete) allowed=1; shift ;;
    --preset) preset=$2; shift 2 ;;
    --*) shift ;;
    *) inputs+=("$1"); shift ;;
  esac
done
echo "$tool" >> "${FAKE_LOG:?}"
if [ -z "$output" ]; then
  echo "$tool says fine"
  [ "$tool" != st-check ] || exit "${FAKE_CHECK:-0}"
  exit 0
fi
temporary=${output%/*}/.${output##*/}.tmp.$$.0
{ echo "$tool${preset:+ $preset}"; cat "${inputs[@]}"; echo content_hash; } > "$temporary"
if [ "${FAKE_KILL:-}" = "$tool" ]; then
  echo $$ > "$FAKE_LOG.pid"
  exec sleep 60
fi
[ "${FAKE_FAIL:-}" != "$tool 3" ] || { rm "$temporary"; echo "$tool: error: told to" >&2; exit 3; }
mv "$temporary" "$output"
case $output in
  *.hdf) ;;
  *) (cd "${output%/*}" && cksum "${output##*/}" >> .st-written) ;;
esac
[ "${FAKE_FAIL:-}" != "$tool 5" ] || [ -n "$allowed" ] || exit 5
echo "$output: made"
