#!/usr/bin/env bash
# Verify every kept result that is out of date: measure a part of it anew and stamp it with the present code.
# HRI_DATA names the folder of recordings, HRI_ROBOT_DATA that of the robot's factory motions, HRI_JOBS how many run at
# once (1). Arguments: results to verify, such as docs/results/fsdd.json; without any, all that are out of date. Changes to
# cpp, bindings and python have to be committed and built before; the results that this writes need not be.
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit

verify() {
  local study data=${HRI_DATA:-}
  if [[ $1 == */bench.json ]]; then
    printf 'measured as a whole only: ./run bench --json %s\n' "$1" >&2
    return
  fi
  study=$(.venv/bin/python -c 'import json, sys; print(json.load(open(sys.argv[1]))["study"])' "$1")
  [[ $study == factory-* ]] && data=${HRI_ROBOT_DATA:-$data}
  .venv/bin/hri study "$study" --data "$data" --verify "$1" || printf 'not verified: %s\n' "$1" >&2
}
export -f verify

results=("$@")
((${#results[@]})) || mapfile -t results < <(.venv/bin/python tools/generate_tables.py --stale)
# shellcheck disable=SC2016 # expanded by the shell that xargs starts
printf '%s\n' ${results[@]+"${results[@]}"} | xargs -r -P "${HRI_JOBS:-1}" -I '{}' bash -c 'verify "$1"' _ '{}'
.venv/bin/python tools/generate_tables.py
.venv/bin/python tools/generate_tables.py --check
