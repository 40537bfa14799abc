#!/bin/bash
# A new folder for what tests write, in memory where there is room: outputs are synced, which takes long on a disk.
# Prints its name; in the usual folder for temporaries where /dev/shm has no 4 GB or may hold no programs.
# usage: scripts/memory_folder.sh
set -eu -o pipefail
least_kb=4000000
free_kb=$(df --output=avail -k /dev/shm 2> /dev/null | tail -n 1 || true)
if [ "${free_kb:-0}" -ge $least_kb ] && folder=$(mktemp -d -p /dev/shm st-tests.XXXXXX 2> /dev/null); then
  printf '#!/bin/sh\n' > "$folder/program"
  chmod +x "$folder/program"
  if "$folder/program" 2> /dev/null; then
    rm "$folder/program"
    echo "$folder"
    exit 0
  fi
  rm -r "$folder"
fi
mktemp -d
