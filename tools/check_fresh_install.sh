#!/usr/bin/env bash
# Builds the wheel from a copy of the sources with the oldest tools that are promised, installs it into an environment of
# its own, first beside the oldest NumPy, and uses it away from the sources.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
mkdir "$work/source"
tar --exclude=__pycache__ --exclude=./.venv --exclude=./build --exclude=./hri_demo --exclude=./.git -cf - . | tar -xf - -C "$work/source"

python=$PWD/.venv/bin/python
pip=(-m pip --quiet --disable-pip-version-check)
"$python" -m venv "$work/tools"
"$work/tools/bin/python" "${pip[@]}" install "cmake==3.22.*" "pybind11==2.12.*" "scikit-build-core==0.11.*" pathspec
# What is packed and how it installs does not depend on how fast it is.
PATH=$work/tools/bin:$PATH "$work/tools/bin/python" "${pip[@]}" wheel --no-build-isolation --no-deps \
  --config-settings cmake.build-type=Debug --config-settings cmake.define.CMAKE_CXX_FLAGS_DEBUG=-O0 \
  --config-settings cmake.define.HRI_UNITY_BUILD=ON --wheel-dir "$work/wheels" "$work/source"
"$python" -m venv "$work/venv"
"$work/venv/bin/python" "${pip[@]}" install "numpy==1.24.*" "$work"/wheels/libhri-*.whl

cd "$work"
# The base install needs NumPy only; what is missing is named with its extra.
venv/bin/python - <<'PYTHON'
import sys
import numpy as np
import hri

assert not {"cv2", "pybullet", "matplotlib", "click"} & set(sys.modules)
pause = np.zeros(4000, "f4")
tones = [np.concatenate([pause, 0.3 * np.sin(np.arange(8000, dtype="f4") * f), pause]) for f in (0.2, 0.21, 0.6, 0.62)]
words = hri.WordRecognizer().fit(tones, ["low", "low", "high", "high"], sample_rate_hz=16000)
assert words.predict(tones, 16000).tolist() == ["low", "low", "high", "high"]
words.save("words.hri")
assert (hri.WordRecognizer.load("words.hri").scores(tones[0], 16000) == words.scores(tones[0], 16000)).all()
try:
    hri.read_frames("missing.jpg")
except ImportError as error:
    assert "libhri[video]" in str(error), error
else:
    raise AssertionError("a picture was read without OpenCV")
PYTHON

"$work/venv/bin/python" "${pip[@]}" install --upgrade "$(echo wheels/libhri-*.whl)[all]"
venv/bin/hri --version
venv/bin/hri study list >/dev/null
venv/bin/hri robot play --help >/dev/null
venv/bin/python -c 'import hri.robot; assert len(hri.robot.load_gestures()) >= 10'
venv/bin/python -c 'import hri.serve.app as app; assert b"page.js" in app.page_files()["index.html"]'
echo "fresh install: fine"
