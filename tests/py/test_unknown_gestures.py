# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Gestures outside the vocabulary, rest poses and empty pictures: the study of their rejection."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import hri
import hri.studies
from hri.datasets import Dataset
from hri.media import read_frames
from hri.studies import unknown_gestures
from hri.studies.unknown_gestures import empty_clips, rest_before
from hri.synthetic.signer import make_gesture_corpus
from hri.vision.hands import find_silhouettes


def test_the_rest_before_a_movement_is_found() -> None:
    rng = np.random.default_rng(0)
    rows = np.concatenate([np.zeros((20, 5)), np.cumsum(np.ones((12, 5)), axis=0), np.full((8, 5), 12.0)])
    rows = (rows + rng.normal(0, 0.01, rows.shape)).astype(np.float32)
    assert 18 <= len(rest_before(rows)) <= 21
    assert len(rest_before(rows[20:])) == 0
    assert len(rest_before(rows[:1])) == 0
    assert len(rest_before(np.zeros((30, 5), np.float32))) == 0


def test_the_study_of_unknown_gestures_runs_whole(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(unknown_gestures, "NUM_HALVES", 2)
    make_gesture_corpus(tmp_path / "sign_digits", labels=["1", "2", "3", "5"], num_persons=5)
    (tmp_path / "webcam_gestures").mkdir()
    study = hri.studies.get_study("unknown-gestures")
    found = hri.studies.run_study(study, tmp_path, lambda *_: None, {"data": ("sign-digits",)})
    row = found["rows"][0]
    assert len(found["details"]["sign-digits"]["by_half"]["eer"]) == 2
    assert row["accuracy_mean"] > 0.8 and row["eer_mean"] < 0.5
    assert "rest_eer_mean" not in row  # stills have no rest
    assert len(found["details"]["sign-digits"]["by_half"]["absent_accepts"]) == 2  # walls are shown to every fold


def test_empty_clips_are_walls_in_noise() -> None:
    clips = empty_clips(3, seed=1)
    assert all(len(clip) == 12 and clip[0].shape == (120, 160, 3) for clip in clips)
    assert all(2 < float((clip[0].astype(float) - clip[1]).std()) < 6 for clip in clips)
    assert np.array_equal(clips[0][0], empty_clips(1, seed=1)[0][0])


def test_a_wall_is_no_hand(tmp_path: Path) -> None:
    """Most walls that are mistaken for a hand have borders too weak to be trusted; drawn hands never are."""
    make_gesture_corpus(tmp_path / "g", labels=["1", "5"], num_persons=3)
    dataset = Dataset.load(tmp_path / "g", "gesture")
    recognizer = hri.train(dataset, hri.GestureRecognizer())
    for sample in dataset.samples:
        assert recognizer.recognise(read_frames(sample.path).frames).status != "no_input"
    walls = [recognizer.recognise(clip).status for clip in empty_clips(20)]
    assert walls.count("no_input") >= 16 and walls.count("recognised") == 0
    found = [s for clip in empty_clips(20) for s in find_silhouettes(clip) if s.mask.any()]
    assert found and recognizer.observation_features(found).shape[0] < len(found) / 2
    asked = hri.GestureRecognizer(min_quality=0.0)
    assert asked.observation_features(found).shape[0] == len(found)
