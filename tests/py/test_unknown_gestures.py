# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Gestures that were never taught, hands at rest and empty pictures: the study of their rejection."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import hri
import hri.studies
from hri.datasets.synthetic_signer import make_gesture_corpus
from hri.studies import unknown_gestures
from hri.studies.unknown_gestures import empty_clips, rest_before


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


def test_empty_clips_are_walls_in_noise() -> None:
    clips = empty_clips(3, seed=1)
    assert all(len(clip) == 12 and clip[0].shape == (120, 160, 3) for clip in clips)
    assert all(2 < float((clip[0].astype(float) - clip[1]).std()) < 6 for clip in clips)
    assert np.array_equal(clips[0][0], empty_clips(1, seed=1)[0][0])
