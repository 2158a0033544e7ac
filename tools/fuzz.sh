#!/usr/bin/env bash
# fuzz.sh [TARGET|all] [SECONDS]: lets libFuzzer look for inputs that crash, hang, take too much memory or throw what is
# no hri::Error. TARGET is a file of tests/fuzz without its ending, as in model_fuzz; SECONDS are for each (60). What is
# learned stays in build/fuzz/corpus, what is found goes to build/fuzz/findings: reduce it, fix the cause, and keep it
# in tests/fuzz/seeds.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

target=${1:-all}
seconds=${2:-60}
# The sanitizers make everything about ten times as slow: this stands for two seconds.
max_seconds=20
max_megabytes=512

targets=()
for source in tests/fuzz/*_fuzz.cpp; do targets+=("$(basename "$source" .cpp)"); done
if [[ $target != all ]]; then
  [[ " ${targets[*]} " == *" $target "* ]] || { echo "no target $target; there are: ${targets[*]}" >&2; exit 2; }
  targets=("$target")
fi

mkdir -p build/fuzz
{ cmake --preset asan && cmake --build build/asan --target "${targets[@]}"; } >build/fuzz/build.log 2>&1 ||
  { tail -40 build/fuzz/build.log >&2; exit 1; }

failed=()
for name in "${targets[@]}"; do
  mkdir -p "build/fuzz/corpus/$name" build/fuzz/findings
  seeds=()
  [[ -d tests/fuzz/seeds/$name ]] && seeds+=("tests/fuzz/seeds/$name")
  [[ $name == model_fuzz ]] && seeds+=(tests/py/models_v1 tests/py/models_v2)
  if "build/asan/tests/fuzz/$name" -max_total_time="$seconds" -timeout="$max_seconds" -rss_limit_mb="$max_megabytes" \
    -max_len=65536 -print_final_stats=1 -artifact_prefix="build/fuzz/findings/$name-" \
    "build/fuzz/corpus/$name" ${seeds[@]+"${seeds[@]}"} >"build/fuzz/$name.log" 2>&1; then
    printf '%s: %s executions in %s s, nothing found\n' "$name" \
      "$(sed -n 's/^stat::number_of_executed_units: *//p' "build/fuzz/$name.log")" "$seconds"
  else
    failed+=("$name")
    tail -40 "build/fuzz/$name.log" >&2
  fi
done
if ((${#failed[@]})); then
  printf 'fuzz: found something: %s\n' "${failed[*]}" >&2
  exit 1
fi
