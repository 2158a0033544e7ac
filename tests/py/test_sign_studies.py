# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The studies of shape features, on drawn signs."""

from __future__ import annotations

import json
from pathlib import Path

import cv2
import numpy as np
import pytest

from hri import studies
from hri.core.errors import InvalidArgument
from hri.features.hand import hand_column_names
from hri.studies import sign_features
from hri.studies.sign_shapes import CLASSIFIERS, scaled
from hri.synthetic.signer import make_gesture_corpus


@pytest.fixture(scope="module")
def data_dir(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("data")
    make_gesture_corpus(folder / "sign_digits", labels=("0", "1", "5"), num_persons=10, seed=3)
    return folder


def run(name: str, data_dir: Path, **only: list[str]) -> dict:
    return studies.run_study(studies.get_study(name), data_dir, lambda *progress: None, only)


def test_every_classifier_tells_drawn_signs_of_unseen_persons_apart(data_dir: Path) -> None:
    chosen = ["orientation 18 (60x40)", "haar+mfcc", "mfcc (outline)", "wavelet moments", "fourier (phase)"]
    result = run("sign-features", data_dir, features=chosen)
    assert result["num_without_hand"] == 0
    found = {(row["features"], row["classifier"]): row for row in result["rows"]}
    assert set(found) == {(features, classifier) for features in chosen for classifier in CLASSIFIERS}
    assert all(len(row["per_fold"]) == 5 for row in result["rows"])
    assert min(found["wavelet moments", c]["accuracy_mean"] for c in ("euclidean", "1-nn", "svm")) >= 0.9
    again = run("sign-features", data_dir, features=["haar+mfcc"], classifier=["svm"])
    assert again["rows"] == [found["haar+mfcc", "svm"]]


def test_coefficients_and_levels_are_measured_step_by_step(data_dir: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sign_features, "COEFFICIENTS", (12, 14))
    result = run("sign-coefficients", data_dir, features=["mfcc", "haar+mfcc"], classifier=["3-nn"])
    found = {(row["signal"], row["features"], row["coefficients"]): row["per_fold"] for row in result["rows"]}
    assert list(found) == [
        (signal, features, count)
        for signal in ("picture", "outline")
        for features in ("mfcc", "haar+mfcc")
        for count in (12, 14)
    ]
    levels = run("sign-wavelets", data_dir, wavelet=["haar", "sym8"], classifier=["3-nn"])["rows"]
    for signal in ("picture", "outline"):
        count = sign_features.NUM_COEFFICIENTS[signal]
        of = {(row["wavelet"], row["level"]): row["per_fold"] for row in levels if row["signal"] == signal}
        assert [level for name, level in of if name == "haar"] == [0, 1, 2, 3, 4]
        assert of["haar", 0] == of["sym8", 0] == found[signal, "mfcc", count], (
            "without a wavelet it does not matter which"
        )
        assert of["haar", 3] == found[signal, "haar+mfcc", count]


def test_cepstra_are_framed_as_the_thesis_has_it() -> None:
    for name, per_frame, frames in (("mfcc", 12, 11), ("haar+mfcc", 12, 11), ("db2+mfcc (outline)", 14, 1)):
        kind, options = sign_features.FEATURES[name]
        assert len(hand_column_names(kind, **options)) == per_frame * frames, name


def test_distances_are_drawn(hri, data_dir: Path, tmp_path: Path) -> None:
    only = ("--only", "features=fourier,hu moments")
    result = hri("study", "sign-distances", "--data", data_dir, "--out", tmp_path, *only)
    assert result.code == 0
    found = json.loads((tmp_path / "sign-distances.json").read_text())
    assert [(row["features"], row["sign"]) for row in found["rows"]] == [
        (features, sign) for features in ("fourier", "hu moments") for sign in "015"
    ]
    assert all(row["nearest_mean"] <= row["between_mean"] for row in found["rows"])
    assert len(found["points"]["fourier"]["features 2 and 10"]["5"]) == 10
    assert "hu moments" in (tmp_path / "sign-distances.md").read_text()
    assert cv2.imread(str(tmp_path / "sign-distances.png")).std() > 5


def test_separation_is_in_units_of_the_spread() -> None:
    rng = np.random.default_rng(0)
    classes = np.repeat([0, 1], 500)
    vectors = rng.standard_normal((1000, 4)).astype("f4") * [1, 10, 100, 0] + classes[:, None] * [6, 60, 600, 0]
    found = sign_features.separation(vectors, classes, 2)
    # Means 6 apart and deviations of 1 in three of four features, over the spread of all: root of 1 + 3 * 3.
    assert found[0]["between_mean"] == pytest.approx(6 / np.sqrt(10) * np.sqrt(3 / 4), rel=0.05)
    assert found[0]["within_mean"] == pytest.approx(np.sqrt(3 / 10) * np.sqrt(1 / 4) * 0.92, rel=0.05)
    assert found[1]["ratio_mean"] == pytest.approx(found[1]["between_mean"] / found[1]["within_mean"])


def test_columns_that_do_not_change_become_zero() -> None:
    rows = np.array([[1, 5, 2], [3, 5, 2], [5, 5, 2]], "f4")
    np.testing.assert_allclose(scaled(rows, rows)[:, 1:], 0)
    np.testing.assert_allclose(scaled(rows, rows)[:, 0], [-1.2247, 0, 1.2247], atol=1e-4)


def test_features_that_there_are_not_are_refused(data_dir: Path) -> None:
    with pytest.raises(InvalidArgument, match="axis features has no 'sift'"):
        run("sign-features", data_dir, features=["sift"])
