#!/usr/bin/env bash
# Which lines and branches the tests reach: those of libhri by the C++ tests, those of hri.robot by the Python tests (slow
# ones too). Tables go to the terminal, pages to build/coverage/pages. Fails below MIN_LINES percent of the lines of either.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

min_lines=${MIN_LINES:-95}
build=build/coverage
pages=$build/pages
python=$PWD/.venv/bin/python
mkdir -p "$pages/cpp"
failed=()

{ cmake --preset coverage && cmake --build "$build"; } >"$build/build.log" 2>&1 ||
  { tail -40 "$build/build.log" >&2; exit 1; }
find "$build" -name '*.gcda' -delete
ctest --test-dir "$build" --no-tests=error --parallel "$(nproc)" --quiet --output-on-failure -O "$build/ctest.log" || failed+=("C++ tests")
# Branches that the compiler adds for exceptions stand in no source; instances of a template share their lines.
"$python" -m gcovr --root . --object-directory "$build" --filter "$PWD/cpp/" --merge-lines --exclude-throw-branches \
  --exclude-unreachable-branches --gcov-exclude-directories '.*CompilerIdCXX.*' --gcov-suspicious-hits-threshold 0 \
  --html-details "$pages/cpp/index.html" --txt "$build/cpp.txt" --txt-summary \
  --fail-under-line "$min_lines" || failed+=("lines of libhri")

export COVERAGE_FILE=$PWD/$build/robot.coverage
"$python" -m coverage run --branch --source=hri.robot -m pytest -q -m "slow or not slow" tests/py/test_robot_*.py \
  tests/py/test_balance.py tests/py/test_getting_up.py tests/py/test_imitation.py tests/py/test_udp_robot.py ||
  failed+=("Python tests")
"$python" -m coverage html --quiet --directory "$pages/robot"
"$python" -m coverage report --fail-under "$min_lines" || failed+=("lines of hri.robot")

echo "pages: $pages/cpp/index.html, $pages/robot/index.html"
if ((${#failed[@]})); then
  printf 'coverage: failed: %s\n' "${failed[*]}" >&2
  exit 1
fi
