#!/usr/bin/env bash
# check_builds.sh [VARIANT...]: builds of libhri that ./run test does not make, each with the tests that concern it. All
# without names. Logs go to build/variants/; only those of failures are printed.
#   asan      Clang, with address and undefined-behaviour sanitizers: all tests of the core, all instruction sets; half an hour,
#             of which GTEST_FILTER may leave out the training of words, as .ci/run does
#   python    Clang, with the same sanitizers: Python's tests of signals, features and models
#   tsan      thread sanitizer: the tests that start threads
#   shared    shared libraries: what they export, and a program that uses them
#   small     no exceptions, no training: a program that only recognises, and its size
#   minimum   the oldest CMake, pybind11 and NumPy that are promised
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

logs=$PWD/build/variants
max_small_bytes=400000
sanitized_tests=(cepstra.py codebook.py signal.py wavelet_packets.py spectrograms.py lda.py hmm.py possibility_models.py
  models.py)
mkdir -p "$logs"

# configure NAME OPTIONS...: into build/NAME.
configure() {
  local name=$1
  shift
  cmake -S . -B "build/$name" -G Ninja -DHRI_BUILD_VISION=OFF "$@"
}

# tests_of NAME TARGET...: builds test programs and runs them, each in two halves side by side.
tests_of() {
  local name=$1 halves
  shift
  cmake --build "build/$name" --target "$@"
  for target in "$@"; do
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

# install_and_use NAME: what is installed from build/NAME builds the example project.
install_and_use() {
  local name=$1
  rm -rf "build/$name/installed" "build/$name/consumer"
  cmake --install "build/$name" --component development --prefix "build/$name/installed"
  cmake -S examples/consumer -B "build/$name/consumer" -G Ninja -DCMAKE_BUILD_TYPE=MinSizeRel \
    -DCMAKE_PREFIX_PATH="$PWD/build/$name/installed"
  cmake --build "build/$name/consumer"
}

check_asan() {
  cmake --preset asan
  tests_of asan core_tests io_tests signal_tests features_tests models_tests recognition_tests
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
  PYTHONPATH=$site:$packages PYTHONMALLOC=malloc ASAN_OPTIONS=detect_leaks=0 \
    LD_PRELOAD=$(clang++ -print-file-name="libclang_rt.asan-$(uname -m).so") \
    "$python" -S -m pytest -q -p no:cacheprovider "${sanitized_tests[@]/#/tests/py/test_}"
}

check_tsan() {
  cmake --preset tsan -DHRI_BUILD_VISION=OFF
  cmake --build build/tsan --target thread_tests
  build/tsan/tests/cpp/thread_tests --gtest_brief=1 --gtest_filter='*Thread*'
}

check_shared() {
  configure shared -DCMAKE_BUILD_TYPE=Release -DBUILD_SHARED_LIBS=ON
  cmake --build build/shared
  tools/check_exports.sh build/shared
  install_and_use shared
}

check_small() {
  configure small -DCMAKE_BUILD_TYPE=Release -DHRI_EXCEPTIONS=OFF -DHRI_INFERENCE_ONLY=ON -DHRI_SIMD=OFF
  cmake --build build/small
  install_and_use small
  local program=build/small/consumer/recognise_word size
  strip -o "$program.stripped" "$program"
  size=$(stat -c %s "$program.stripped")
  echo "a program that recognises words has $size bytes"
  ((size <= max_small_bytes)) || { echo "more than $max_small_bytes" >&2; return 1; }
}

check_minimum() {
  local venv=$PWD/build/minimum
  rm -rf "$venv"
  "${HRI_PYTHON:-python3}" -m venv "$venv"
  "$venv/bin/pip" install --quiet --disable-pip-version-check "cmake==3.22.*" "pybind11==2.12.*" "numpy==1.24.*" \
    "scikit-build-core==0.11.*" pathspec
  PATH=$venv/bin:$PATH "$venv/bin/pip" install --quiet --disable-pip-version-check --no-build-isolation --no-deps . \
    --config-settings build-dir=build/minimum/build --config-settings cmake.define.HRI_BUILD_VISION=OFF \
    --config-settings cmake.build-type=Debug --config-settings cmake.define.CMAKE_CXX_FLAGS_DEBUG=-O0
  (cd "$venv" && bin/python - <<'PYTHON')
import numpy as np
import hri

pause = np.zeros(4000, "f4")
tones = [np.concatenate([pause, 0.3 * np.sin(np.arange(8000, dtype="f4") * f), pause]) for f in (0.2, 0.21, 0.6, 0.62)]
words = hri.WordRecognizer().fit(tones, ["low", "low", "high", "high"], sample_rate_hz=16000)
assert words.predict(tones, 16000).tolist() == ["low", "low", "high", "high"]
try:
    from hri import _native_vision
except ImportError as error:
    assert "HRI_BUILD_VISION" in str(error), error
else:
    raise AssertionError("built without vision, and has it")
PYTHON
}

all=(asan python tsan shared small minimum)
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
