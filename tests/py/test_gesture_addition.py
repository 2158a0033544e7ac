# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Gestures that are added to a trained recogniser from few samples."""

from __future__ import annotations

from copy import copy

import numpy as np
import pytest

import hri
from hri.core.errors import InvalidArgument

SHAPES = {"fist": 0, "palm": 1, "point": 2}


def rows(label: str, seed: int, num_frames: int = 3) -> np.ndarray:
    """Features of a hand of one of three shapes, which is held in the middle of the picture."""
    rng = np.random.default_rng(seed)
    shape = np.tile(np.eye(6)[SHAPES[label]], (num_frames, 1)) + 0.02 * rng.standard_normal((num_frames, 6))
    return np.concatenate((shape, np.full((num_frames, 3), 0.5)), axis=1).astype("f4")


@pytest.fixture(scope="module")
def signs() -> hri.GestureRecognizer:
    labels = ["fist", "point"] * 6
    samples = [rows(label, seed) for seed, label in enumerate(labels)]
    return hri.GestureRecognizer(model="rbf").fit_features(samples, labels)


def test_a_copy_learns_a_gesture_and_the_recogniser_stays(signs: hri.GestureRecognizer) -> None:
    before = signs.to_model_file().to_bytes()
    more = copy(signs).add_gesture_features("palm", [rows("palm", 20 + take) for take in range(3)])
    assert list(more.classes_) == ["fist", "palm", "point"]
    for label in SHAPES:
        decision = more.recognise_features(rows(label, 50))
        assert decision.label == label, decision  # and not rejected, though its three samples lie close together
    assert signs.to_model_file().to_bytes() == before


def test_errors_leave_the_recogniser_as_it_was(signs: hri.GestureRecognizer) -> None:
    good = [rows("palm", 20)]
    before = signs.to_model_file().to_bytes()
    for label, samples, message in (
        ("", good, "must not be empty"),
        ("no_input", good, "'no_input'"),
        ("fist", good, "'fist' is in the vocabulary already"),
        ("palm", [], "at least one sample"),
        ("palm", [good[0], good[0][:0]], r"samples\[1\]: no frame shows a hand"),
        ("palm", [good[0][:, :8]], "columns"),
        ("palm", [np.full_like(good[0], np.nan)], r"samples\[0\]"),
    ):
        with pytest.raises(InvalidArgument, match=message):
            signs.add_gesture_features(label, samples)
    with pytest.raises(InvalidArgument, match="must be a sequence of signs"):
        signs.add_gesture("palm", "palm.jpg")
    assert signs.to_model_file().to_bytes() == before
