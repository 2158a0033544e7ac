#!/usr/bin/env bash
# fuzz.sh [TARGET|all] [SECONDS]: lets libFuzzer look for inputs that crash, hang, take too much memory or throw what is
# no hri::Error. TARGET is a file of tests/fuzz without its ending, as in model_fuzz; SECONDS are for each (60). What is
# learned stays in build/fuzz/corpus, what is found goes to build/fuzz/findings: reduce it, fix the cause, and keep it
# in tests/fuzz/seeds. HRI_JOBS is how many targets run at a time, 1 by default.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

target=${1:-all}
seconds=${2:-60}
# The sanitizers make everything about ten times as slow: this stands for two seconds. They also take memory of their own
# for every block, and keep blocks that were given back: this stands for 512 megabytes, which no single block may exceed.
max_seconds=20
max_megabytes=1024
max_block_megabytes=512
export ASAN_OPTIONS=${ASAN_OPTIONS:-quarantine_size_mb=16}

targets=()
for source in tests/fuzz/*_fuzz.cpp; do targets+=("$(basename "$source" .cpp)"); done
if [[ $target != all ]]; then
  [[ " ${targets[*]} " == *" $target "* ]] || { echo "no target $target; there are: ${targets[*]}" >&2; exit 2; }
  targets=("$target")
fi

for name in "${targets[@]}"; do
  compgen -G "tests/fuzz/seeds/$name/*" >/dev/null ||
    { echo "$name has no seeds: without an input that is read as it should be, nothing behind the reader is reached" >&2; exit 1; }
done

mkdir -p build/fuzz
{ cmake --preset asan && cmake --build build/asan --target "${targets[@]}"; } >build/fuzz/build.log 2>&1 ||
  { tail -40 build/fuzz/build.log >&2; exit 1; }

# look_for NAME: with one target, for so many seconds.
look_for() {
  local name=$1 seeds=("tests/fuzz/seeds/$1")
  mkdir -p "build/fuzz/corpus/$name" build/fuzz/findings
  [[ $name == model_fuzz ]] && seeds+=(tests/py/models_v1 tests/py/models_v2)
  if "build/asan/tests/fuzz/$name" -max_total_time="$seconds" -timeout="$max_seconds" -rss_limit_mb="$max_megabytes" \
    -malloc_limit_mb="$max_block_megabytes" -max_len=65536 -print_final_stats=1 -artifact_prefix="build/fuzz/findings/$name-" \
    "build/fuzz/corpus/$name" "${seeds[@]}" >"build/fuzz/$name.log" 2>&1; then
    printf '%s: %s executions in %s s, nothing found\n' "$name" \
      "$(sed -n 's/^stat::number_of_executed_units: *//p' "build/fuzz/$name.log")" "$seconds"
  else
    printf 'fuzz: %s found something\n' "$name" >&2
    tail -40 "build/fuzz/$name.log" >&2
    return 1
  fi
}
export -f look_for
export seconds max_seconds max_megabytes max_block_megabytes
# shellcheck disable=SC2016 # the other shell expands it
printf '%s\n' "${targets[@]}" | xargs -P "${HRI_JOBS:-1}" -I '{}' bash -c 'look_for "$1"' _ '{}'
