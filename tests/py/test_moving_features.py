# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The studies of features of single frames of moving gestures, on synthetic films and histograms."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
import pytest

import hri.studies
from hri.core.errors import InvalidArgument
from hri.media import write_video
from hri.studies import moving_features, webcam
from hri.studies.gesture_sentences import GestureClip
from hri.studies.sign_shapes import CLASSIFIERS

LABELS = ("swipeRight", "swipeDown")


def film(flat: bool, seed: int) -> list[np.ndarray]:
    """A flat or an upright hand that goes across the picture."""
    rng = np.random.default_rng(seed)
    x0, y0 = rng.integers(36, 44), rng.integers(54, 66)
    frames = []
    for t in range(30):
        centre = (int(x0 + 3 * np.clip(t - 6, 0, 16)), int(y0))
        frame = np.full((120, 160, 3), 90, np.uint8)
        cv2.ellipse(frame, centre, (26, 9) if flat else (9, 26), 0, 0, 360, (110, 150, 210), -1)
        frames.append(frame)
    return frames


@pytest.fixture
def films(tmp_path: Path) -> Path:
    for label, flat in zip(LABELS, (True, False), strict=True):
        (tmp_path / webcam.FOLDER / label).mkdir(parents=True)
        for take in range(1, 6):
            write_video(tmp_path / webcam.FOLDER / label / f"t{take}.m4v", film(flat, take), 12.0)
    return tmp_path


def test_the_study_of_features_runs_whole(films: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(moving_features, "SEEDS", (0,))
    study = hri.studies.get_study("moving-features")
    wanted = ("orientation 18", "haar+mfcc")
    found = hri.studies.run_study(study, films, lambda *_: None, {"features": wanted}, folds=2)
    shown = {(row["features"], row["classifier"]): row for row in found["rows"]}
    classifiers = (*moving_features.BY_FRAMES, *moving_features.BY_SEQUENCES)
    assert set(shown) == {(name, classifier) for name in wanted for classifier in classifiers}
    for name in wanted:  # the shape alone separates them
        assert shown[name, "knn"]["accuracy_mean"] == 1.0 and shown[name, "knn"]["frames_mean"] > 0.9
        assert shown[name, "HMM, Gaussian"]["accuracy_mean"] == 1.0
        assert set(found["num_neighbours"][name].values()) <= {1, 3, 5, 7}
        assert set(shown[name, "svm"]["frames_per_fold"]) == set(shown[name, "svm"]["per_fold"])
        assert "frames_mean" not in shown[name, "HMM"]


def test_frames_vote_for_their_clip() -> None:
    rng = np.random.default_rng(0)
    rows = [rng.normal(0, 0.1, (5, 2)).astype("f4") + label for label in (0, 1, 0, 1, 1)]
    rows[4][:2] -= 1  # two of five frames look like the other class
    labels = np.array([0, 1, 0, 1, 1])
    fit = CLASSIFIERS["1-nn"]
    shares, right = moving_features.vote(fit, rows, labels, np.array([0, 1]), np.array([2, 3, 4]))
    assert shares == [1.0, 1.0, pytest.approx(0.6)] and right == [True, True, True]
    rows[4][2] -= 1
    assert moving_features.vote(fit, rows, labels, np.array([0, 1]), np.array([4])) == ([pytest.approx(0.4)], [False])


def test_too_few_conditions_are_refused(films: Path) -> None:
    takes = [f'"{label}/t{take}"' for label in LABELS for take in range(1, 6)]
    table = f'[[condition]]\nname = "one"\nclips = [{", ".join(takes)}]\n'
    (films / webcam.FOLDER / webcam.CONDITIONS).write_text(table)
    for name in ("moving-features", "orientation-sentences"):
        with pytest.raises(InvalidArgument, match="1 conditions"):
            hri.studies.run_study(hri.studies.get_study(name), films, lambda *_: None)


def histograms(label: str, condition: int, seed: int) -> GestureClip:
    """A hand that rests, then turns one way; no hand in its first frames."""
    rng = np.random.default_rng(seed)
    angle = np.concatenate([np.zeros(12), np.linspace(0, 1, 14), np.ones(8)]) * (4 if label == "left" else -4)
    bins = np.exp(-0.5 * (np.arange(18)[None, :] - 9 - angle[:, None]) ** 2)
    rows = (bins + rng.normal(0, 0.02, bins.shape)).astype(np.float32)
    rows[:2] = np.nan
    return GestureClip(label, f"condition {condition}", rows)


def test_the_study_of_sentences_decodes_them(monkeypatch: pytest.MonkeyPatch) -> None:
    clips = [histograms(("left", "right")[i % 2], i // 2 % 4, i) for i in range(32)]
    monkeypatch.setattr(moving_features, "_read_histograms", lambda *_: {"18": clips})
    study = hri.studies.get_study("orientation-sentences")
    found = study.run(None, lambda *_: None, model=("ptbhmm",), folds=1)
    (row,) = found["rows"]
    assert (row["bins"], row["model"]) == ("18", "ptbhmm") and set(row["per_fold"]) == {"condition 0"}
    assert row["word_error_mean"] <= 0.1 and row["accuracy_mean"] >= 0.8
    assert row["over_all"]["num_words"] == 3 * 8


def test_histograms_are_read_of_every_frame(films: Path) -> None:
    read = moving_features._read_histograms(films, ("18", "36"), lambda *_: None)
    assert [one.rows.shape for one in read["36"]] == [(30, 36)] * 10
    for one in read["18"]:
        assert not np.isnan(one.rows).any()
    # A flat hand and an upright one have their edges in other directions.
    flat, upright = (np.mean([c.rows for c in read["18"] if c.label == name], axis=(0, 1)) for name in LABELS)
    assert np.abs(flat - upright).max() > 0.2 * flat.max()
