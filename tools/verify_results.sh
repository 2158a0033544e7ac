#!/usr/bin/env bash
# Verify every kept result that is out of date: measure a part of it anew and stamp it with the present code.
# HRI_DATA names the folder of recordings, HRI_ROBOT_DATA that of the robot's factory motions. Arguments: results to verify,
# such as docs/results/fsdd.json; without any, all that are out of date.
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit

results=("$@")
if ((${#results[@]} == 0)); then
  mapfile -t results < <(.venv/bin/python tools/generate_tables.py --stale)
fi
failed=()
for result in ${results[@]+"${results[@]}"}; do
  study=$(.venv/bin/python -c 'import json, sys; print(json.load(open(sys.argv[1]))["study"])' "$result")
  data=${HRI_DATA:-}
  [[ $study == factory-* ]] && data=${HRI_ROBOT_DATA:-$data}
  .venv/bin/hri study "$study" --data "$data" --verify "$result" || failed+=("$result")
done
.venv/bin/python tools/generate_tables.py || failed+=(tables)
if ((${#failed[@]})); then
  printf 'not verified: %s\n' "${failed[*]}" >&2
  exit 1
fi
