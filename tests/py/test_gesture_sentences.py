# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Sentences joined from clips of gestures, and the study of them on synthetic features."""

from __future__ import annotations

import numpy as np
import pytest

from hri.studies import gesture_sentences as study
from hri.studies.gesture_sentences import GestureClip, join, sentences_of
from hri.studies.tables import axes_of

LABELS = ("left", "right", "up")
WAYS = {"left": (-0.3, 0.0), "right": (0.3, 0.0), "up": (0.0, -0.3)}


def clip(label: str, condition: str, seed: int) -> GestureClip:
    """A hand of changing shape that rests, moves one way, and stays there."""
    rng = np.random.default_rng(seed)
    share = np.concatenate([np.zeros(12), np.linspace(0, 1, 14), np.ones(8)])[:, None]
    shape = np.hstack([1 - share, share, share**2, np.full_like(share, 0.5)]) @ np.eye(4, 12)
    track = np.hstack([0.5 + share * WAYS[label], np.full_like(share, -2)])
    rows = np.hstack([shape, track])
    return GestureClip(label, condition, (rows + rng.normal(0, 0.02, rows.shape)).astype(np.float32))


CLIPS = [clip(LABELS[i % 3], f"condition {i % 4}", i) for i in range(36)]


def test_joined_clips_keep_their_frames() -> None:
    made = join(CLIPS[:3], [5, 0])
    assert made.labels == ["left", "right", "up"]
    length = len(CLIPS[0].rows)
    assert made.spans == [("left", 0, 34), ("right", 39, 73), ("up", 73, 107)] and length == 34
    for (_, first, last), one in zip(made.spans, CLIPS, strict=False):
        np.testing.assert_array_equal(made.rows[first:last], one.rows)
    steps = np.diff(made.rows[33:40], axis=0)
    np.testing.assert_allclose(steps, np.broadcast_to(steps[0], steps.shape), atol=1e-5)


def test_every_clip_stands_in_as_many_sentences_and_none_alone() -> None:
    for count in (2, 3, 7, 12):
        sentences = sentences_of(CLIPS[:count], 5, seed=1)
        assert sum(len(s.spans) for s in sentences) == study.NUM_ORDERS * count
        assert all(2 <= len(s.spans) <= study.MAX_GESTURES for s in sentences)
    same = [[s.labels for s in sentences_of(CLIPS, gap, seed=1)] for gap in (0, 15)]
    assert same[0] == same[1]
    gaps = {b[1] - a[2] for s in sentences_of(CLIPS, None, seed=1) for a, b in zip(s.spans, s.spans[1:], strict=False)}
    assert gaps == set(study.GAPS)


def test_the_study_splits_and_names_gestures(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(study, "read_gesture_clips", lambda *_: CLIPS)
    monkeypatch.setattr(study, "NUM_COMPONENTS", 3)
    (found,) = study.STUDIES
    result = found.run(None, lambda *_: None, folds=1)
    assert axes_of(result["rows"]) == ["frames_between", "model", "names"]  # or it could not be verified by one fold
    rows = {(row["frames_between"], row["model"], row["names"]): row for row in result["rows"]}
    assert rows[study.ISOLATED, "", "whole gestures"]["over_all"]["words_right"] == 1
    for model in study.MODELS:
        for gap in study.GAPS:
            whole = rows[gap, model, study.WHOLE]
            assert whole["word_error_mean"] <= 0.1 and whole["over_all"]["boundaries_near"] >= 0.9
    assert result["passed"] and found.run(None, lambda *_: None, model=["ptbhmm"], folds=1)["passed"] is None
