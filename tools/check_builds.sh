#!/usr/bin/env bash
# check_builds.sh [VARIANT...]: builds of libhri that ./run test does not make, each with the tests that concern it. All
# without names. Logs go to build/variants/; only those of failures are printed.
#   asan      Clang, with address and undefined-behaviour sanitizers: all tests of the core, all instruction sets; half an hour,
#             of which GTEST_FILTER may leave out what trains most, as .ci/run does
#   python    Clang, with the same sanitizers: Python's tests of signals, features and models
#   tsan      thread sanitizer: the tests that start threads; in shared libraries, whose exports are looked at, too
#   wheel     the package as pip builds and installs it, see tools/check_fresh_install.sh
#   small     no exceptions, no training, as part of another project: programs that only recognise, the size of one, what is
#             installed, and how errors are reported
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

logs=$PWD/build/variants
max_small_bytes=400000
sanitized_tests=(cepstra.py codebook.py signal.py wavelet_packets.py spectrograms.py lda.py hmm.py possibility_models.py
  models.py)
mkdir -p "$logs"

# tests_in PROGRAM: Suite.Test of each, a line each.
tests_in() {
  GTEST_FILTER='*' "$1" --gtest_list_tests | sed 's/ *#.*//' |
    while IFS= read -r line; do
      case $line in
        '  '*) printf '%s%s\n' "$suite" "${line#  }" ;;
        *.) suite=$line ;;
      esac
    done
}

# check_filter PROGRAM...: every pattern that GTEST_FILTER leaves out must stand for a test, or it has been renamed.
check_filter() {
  local programs=("$@") names=() patterns=() pattern name found stale=0
  for program in "${programs[@]}"; do mapfile -t -O "${#names[@]}" names < <(tests_in "$program"); done
  IFS=: read -ra patterns <<<"${GTEST_FILTER#-}"
  for pattern in ${patterns[@]+"${patterns[@]}"}; do
    found=0
    for name in "${names[@]}"; do
      # shellcheck disable=SC2053 # a pattern, as GoogleTest has it
      [[ $name == $pattern ]] && { found=1; break; }
    done
    ((found)) || { echo "GTEST_FILTER: $pattern stands for no test" >&2; stale=1; }
  done
  return "$stale"
}

# tests_of NAME TARGET...: builds test programs and runs them, each in two halves side by side.
tests_of() {
  local name=$1 halves
  shift
  cmake --build "build/$name" --target "$@"
  [[ -z ${GTEST_FILTER:-} ]] || check_filter "${@/#/build/$name/tests/cpp/}"
  for target in "$@"; do
    [[ -n $(tests_in "build/$name/tests/cpp/$target") ]] || { echo "$target has no tests" >&2; return 1; }
    halves=()
    for half in 0 1; do
      GTEST_TOTAL_SHARDS=2 GTEST_SHARD_INDEX=$half \
        "build/$name/tests/cpp/$target" --gtest_brief=1 &
      halves+=($!)
    done
    wait "${halves[0]}"
    wait "${halves[1]}"
  done
}

# names_missing_file PROGRAM: which fails, as it should, for a model that is not there.
names_missing_file() {
  local output
  if output=$("$1" missing.hri missing.wav 2>&1) || [[ $output != *missing.hri* ]]; then
    printf '%s reports no missing file: %s\n' "$1" "$output" >&2
    return 1
  fi
}

check_asan() {
  cmake --preset asan
  tests_of asan core_tests io_tests signal_tests features_tests models_tests language_tests htk_tests recognition_tests
}

# The runtime of the sanitizers comes before Python, which was built without them. -S: no editable install is seen.
check_python() {
  local python=$PWD/.venv/bin/python site=$PWD/build/asan/site packages
  packages=$("$python" -c 'import sysconfig; print(sysconfig.get_path("purelib"))')
  cmake --preset asan -DHRI_BUILD_PYTHON=ON -DPython_EXECUTABLE="$python" -Dpybind11_DIR="$("$python" -m pybind11 --cmakedir)"
  cmake --build build/asan --target hri_python
  rm -rf "$site"
  mkdir -p "$site"
  cp -r python/hri "$site"
  cmake --install build/asan --component python --prefix "$site"
  sanitized() {
    PYTHONPATH=$site:$packages PYTHONMALLOC=malloc ASAN_OPTIONS=detect_leaks=0 \
      LD_PRELOAD=$(clang++ -print-file-name="libclang_rt.asan-$(uname -m).so") "$python" -S "$@"
  }
  # It is built without vision, which an error has to say.
  { sanitized -c 'from hri import _native_vision' 2>&1 || true; } | grep HRI_BUILD_VISION
  # Two processes: one after the other, the tests would leave a core alone.
  local files=("${sanitized_tests[@]/#/tests/py/test_}") half=$(((${#sanitized_tests[@]} + 1) / 2)) first
  sanitized -m pytest -q -p no:cacheprovider "${files[@]::half}" &
  first=$!
  sanitized -m pytest -q -p no:cacheprovider "${files[@]:half}"
  wait "$first"
}

check_tsan() {
  local consumer=build/tsan/consumer
  cmake --preset tsan -DHRI_BUILD_VISION=OFF -DBUILD_SHARED_LIBS=ON
  cmake --build build/tsan --target thread_tests hri_core
  [[ $(tests_in build/tsan/tests/cpp/thread_tests) == *Thread* ]] || { echo "no tests of threads" >&2; return 1; }
  build/tsan/tests/cpp/thread_tests --gtest_brief=1 --gtest_filter='*Thread*'
  # Shared libraries take a build of their own, and this one is no slower for them.
  tools/check_exports.sh build/tsan
  rm -rf build/tsan/installed "$consumer"
  cmake --install build/tsan --component development --prefix build/tsan/installed
  test -f build/tsan/installed/lib/pkgconfig/hri-core.pc
  cmake -S examples/consumer -B "$consumer" -G Ninja -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_CXX_FLAGS=-fsanitize=thread \
    -DCMAKE_PREFIX_PATH="$PWD/build/tsan/installed"
  cmake --build "$consumer" --target recognise_word
  # What the library throws reaches the program.
  names_missing_file "$consumer/recognise_word"
}

check_wheel() {
  CXX=clang++ tools/check_fresh_install.sh
}

check_small() {
  local prefix=$PWD/build/small/installed program=build/small/consumer/stream_words size status=0
  local options=(-G Ninja -DCMAKE_BUILD_TYPE=Release -DHRI_EXCEPTIONS=OFF -DHRI_INFERENCE_ONLY=ON -DHRI_SIMD=OFF
    -DHRI_UNITY_BUILD=ON)
  cmake -S examples/subproject -B build/small "${options[@]}" -DHRI_INSTALL=OFF
  cmake --build build/small
  rm -rf "$prefix" build/small/alone build/small/consumer
  cmake --install build/small --prefix build/small/alone
  [[ $(cd build/small/alone && find . -type f) == ./bin/recognise_word ]] ||
    { echo "a project installs parts of libhri that it did not ask for" >&2; return 1; }
  cmake -S examples/subproject -B build/small -DHRI_INSTALL=ON
  cmake --install build/small --component development --prefix "$prefix"
  cmake -S examples/consumer -B build/small/consumer -G Ninja -DCMAKE_BUILD_TYPE=MinSizeRel -DCMAKE_PREFIX_PATH="$prefix"
  cmake --build build/small/consumer
  strip -o "$program.stripped" "$program"
  size=$(stat -c %s "$program.stripped")
  # recognise_word can read speech embeddings, too.
  echo "a program that recognises words by cepstra has $size bytes"
  ((size <= max_small_bytes)) || { echo "more than $max_small_bytes" >&2; return 1; }
  # Without exceptions, errors reach the handler: this one ends the program with 3.
  build/small/consumer/stream_words missing.hri missing.wav 2>build/small/error.log || status=$?
  if [[ $status != 3 ]] || ! grep -q missing.hri build/small/error.log; then
    echo "no error was reported" >&2
    return 1
  fi
}

all=(asan python tsan wheel small)
(($#)) || set -- "${all[@]}"
failed=()
for variant in "$@"; do
  [[ " ${all[*]} " == *" $variant "* ]] || { echo "unknown variant $variant; there are ${all[*]}" >&2; exit 2; }
  begin=$SECONDS
  # A subshell by itself, so that set -e holds in it.
  set +e
  (set -e; "check_$variant") >"$logs/$variant.log" 2>&1
  status=$?
  set -e
  if ((status == 0)); then
    printf '%s: fine, %d s\n' "$variant" $((SECONDS - begin))
  else
    failed+=("$variant")
    tail -40 "$logs/$variant.log" >&2
  fi
done
if ((${#failed[@]})); then
  printf 'failed: %s (logs in build/variants)\n' "${failed[*]}" >&2
  exit 1
fi
