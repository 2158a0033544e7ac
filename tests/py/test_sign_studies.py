# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The studies of shape features, on drawn signs."""

from __future__ import annotations

import json
from pathlib import Path

import cv2
import numpy as np
import pytest
from sklearn.discriminant_analysis import LinearDiscriminantAnalysis

from hri import studies
from hri.core.errors import InvalidArgument
from hri.features.hand import hand_column_names
from hri.studies import sign_features, sign_framing
from hri.studies.sign_shapes import CLASSIFIERS, SignPictures, read_signs, scaled, shares_right
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
        for signal in ("picture", "outline", "averaged outline")
        for features in ("mfcc", "haar+mfcc")
        for count in (12, 14)
    ]
    levels = run("sign-wavelets", data_dir, wavelet=["haar", "sym8"], classifier=["3-nn"])["rows"]
    for signal in ("picture", "outline", "averaged outline"):
        count = sign_features.NUM_COEFFICIENTS[signal]
        of = {(row["wavelet"], row["level"]): row["per_fold"] for row in levels if row["signal"] == signal}
        assert [level for name, level in of if name == "haar"] == [0, 1, 2, 3, 4]
        assert of["haar", 0] == of["sym8", 0] == found[signal, "mfcc", count], (
            "without a wavelet it does not matter which"
        )
        assert of["haar", 3] == found[signal, "haar+mfcc", count]


def test_cepstra_are_framed_as_the_thesis_has_it() -> None:
    for name, per_frame, frames in (
        ("mfcc", 12, 11),
        ("haar+mfcc", 12, 11),
        ("mfcc (outline)", 12, 11),
        ("db2+mfcc (averaged outline)", 14, 1),
    ):
        kind, options = sign_features.FEATURES[name]
        assert len(hand_column_names(kind, **options)) == per_frame * frames, name


def test_lda_is_that_of_scikit_learn_on_columns_scaled_by_the_training_rows() -> None:
    rng = np.random.default_rng(5)
    classes = rng.integers(0, 4, 400)
    mixed = rng.standard_normal((60, 60))
    vectors = ((rng.standard_normal((400, 60)) + 0.6 * np.eye(4, 60)[classes]) @ mixed).astype("f4")
    train, test = np.arange(300), np.arange(300, 400)
    theirs = LinearDiscriminantAnalysis(priors=[0.25] * 4).fit(vectors[train], classes[train])
    expected = theirs.score(vectors[test], classes[test])
    assert 0.3 < expected < 0.95
    found = shares_right(vectors, classes, train, test, ["lda", "euclidean"])
    assert found["lda"] == pytest.approx(expected, abs=0.011)
    assert found["lda"] > found["euclidean"], "60 columns reach LDA, 40 components the others"


def test_framing_is_measured_with_every_size_and_that_chosen(data_dir: Path) -> None:
    chosen = {"signal": ["outline"], "features": ["mfcc", "haar+mfcc"], "classifier": ["euclidean", "3-nn"]}
    rows = run("sign-framing", data_dir, **chosen)["rows"]
    found = {(r["frames"], r["features"], r["mask"], r["classifier"]): r for r in rows}
    for frames in ("side by side", "averaged"):
        for features, sizes in (("mfcc", (32, 64, 128, 256)), ("haar+mfcc", (128, 256, 512))):
            row = found[frames, features, "chosen", "3-nn"]
            assert set(row["chosen_mask"]) == set(row["per_fold"]) and len(row["per_fold"]) == 5
            assert set(row["chosen_mask"].values()) <= {f"{px} px" for px in sizes}
            for fold, size in row["chosen_mask"].items():
                assert row["per_fold"][fold] == found[frames, features, size, "3-nn"]["per_fold"][fold]
    assert len(found) == len(rows) == 2 * 2 * (5 + 4)
    best = found["side by side", "mfcc", "chosen", "euclidean"]["accuracy_mean"]
    assert best > found["averaged", "mfcc", "chosen", "euclidean"]["accuracy_mean"]


def test_size_is_chosen_by_persons_of_the_training_part_alone(data_dir: Path) -> None:
    signs = read_signs(data_dir, lambda *progress: None)
    rng = np.random.default_rng(0)
    clear = np.eye(3, dtype="f4")[signs.classes] + 0.01 * rng.standard_normal((len(signs.classes), 3)).astype("f4")
    for left_out in range(5):
        test = signs.folds()[left_out].test
        # "b" is worthless but for the persons tested, "a" is good but for them.
        good, bad = clear.copy(), rng.standard_normal(clear.shape).astype("f4")
        good[test], bad[test] = bad[test], clear[test]
        (row,) = [r for r in sign_framing.measure(signs, {"b": bad, "a": good}, ["1-nn"]) if r["mask"] == "chosen"]
        assert row["chosen_mask"][signs.folds()[left_out].name] == "a"


def test_rows_of_a_picture_are_columns_of_the_turned_mask_without_forearm() -> None:
    mask = np.zeros((200, 120), "u1")
    mask[20:180, 30:70] = 255  # 160 high and 40 wide, of which 64 are the hand
    mask[20:40, 30:50] = 0
    mask[20, 30] = 255
    turned = sign_framing.transposed(mask)
    assert turned.flags.c_contiguous and turned.shape == (120, 84)
    np.testing.assert_array_equal(turned.T, mask[:84])
    signs = SignPictures(None, [mask], [mask], 0)
    by_rows, by_columns = (sign_framing.framed_vectors(signs, of, "mfcc", 64) for of in ("rows", "columns"))
    assert by_rows.shape == by_columns.shape == (1, 132)
    assert np.abs(by_rows - by_columns).max() > 1
    symmetric = np.zeros((90, 90), "u1")
    symmetric[10:80, 10:30] = symmetric[10:30, 10:80] = 255
    signs = SignPictures(None, [symmetric], [symmetric], 0)
    by_rows, by_columns = (sign_framing.framed_vectors(signs, of, "mfcc", 64) for of in ("rows", "columns"))
    np.testing.assert_allclose(by_rows, by_columns, atol=0.02)
    np.testing.assert_allclose(
        sign_framing.averaged(by_rows), by_rows.reshape(11, 12).mean(axis=0, keepdims=True), rtol=1e-5
    )


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
