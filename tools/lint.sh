#!/usr/bin/env bash
# Formatters, linters and the type checker, over everything. --fix lets the formatters write; --analyze adds Clang's static
# analyzer, which triples the time of clang-tidy. `./run lint` calls it.
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit

fix=0
checks=
for argument in "$@"; do
  case $argument in
    --fix) fix=1 ;;
    --analyze) checks='clang-analyzer-core.*,-clang-analyzer-core.UndefinedBinaryOperatorResult,-clang-analyzer-core.uninitialized.Assign,clang-analyzer-cplusplus.*,clang-analyzer-deadcode.*' ;;
    *) echo "lint: unknown argument: $argument" >&2; exit 2 ;;
  esac
done
python=.venv/bin/python
failed=()

step() {
  local name=$1
  shift
  printf '\033[1m==> %s\033[0m\n' "$name" >&2
  "$@" || failed+=("$name")
}

mapfile -t cpp_files < <(find cpp bindings tests/cpp tests/fuzz examples -name '*.cpp' -o -name '*.hpp' | sort)
python_dirs=(python tests/py benchmarks tools)

if ((fix)); then
  step clang-format clang-format -i "${cpp_files[@]}"
  step "ruff format" "$python" -m ruff format --quiet "${python_dirs[@]}"
  step "ruff check" "$python" -m ruff check --fix --quiet "${python_dirs[@]}"
else
  step clang-format clang-format --dry-run -Werror "${cpp_files[@]}"
  step "ruff format" "$python" -m ruff format --check --quiet "${python_dirs[@]}"
  step "ruff check" "$python" -m ruff check "${python_dirs[@]}"
fi
step mypy "$python" -m mypy
step "stubs are up to date" "$python" tools/generate_stubs.py --check
step "tables and results are up to date" "$python" tools/generate_tables.py --check
step "tables of options are up to date" "$python" tools/generate_option_tables.py --check
step shellcheck shellcheck run tools/*.sh .ci/run
# Only findings; the commands and counts of suppressed warnings are noise, unless it fails to start.
# The files of a folder are read as one, which takes a fifth of the time: most of it goes to Eigen's and pybind11's headers.
tidy() {
  cmake -S . -B build/tidy -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_EXPORT_COMPILE_COMMANDS=ON -DHRI_BUILD_PYTHON=ON \
    -DHRI_UNITY_BUILD=ON -DPython_EXECUTABLE="$PWD/$python" -Dpybind11_DIR="$("$python" -m pybind11 --cmakedir)" \
    >build/tidy.log || return
  local status=0
  "$python" .venv/bin/run-clang-tidy.py -clang-tidy-binary .venv/bin/clang-tidy -quiet -hide-progress -p build/tidy \
    -checks="$checks,-bugprone-suspicious-include" \
    -extra-arg=-Wno-ignored-optimization-argument -j "$(nproc)" "$PWD/(build/tidy|cpp/src|bindings)/.*\.c(pp|xx)$" 2>build/tidy.errors || status=$?
  ((status == 0)) || tail -40 build/tidy.errors >&2
  return "$status"
}
step clang-tidy tidy

if ((${#failed[@]})); then
  printf 'lint: failed: %s\n' "${failed[*]}" >&2
  exit 1
fi
