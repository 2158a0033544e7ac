# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Gestures that are added to a trained recogniser from few samples."""

from __future__ import annotations

import json
from copy import copy
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("cv2")

from drawn_hands import SIDE_PX, picture, stills
from hri import GestureRecognizer
from hri.core.errors import InvalidArgument
from hri.media import write_image

SHAPES = {"fist": 0, "palm": 1, "point": 2}


def rows(label: str, seed: int, num_frames: int = 3) -> np.ndarray:
    """Features of a hand of one of three shapes, which is held in the middle of the picture."""
    rng = np.random.default_rng(seed)
    shape = np.tile(np.eye(6)[SHAPES[label]], (num_frames, 1)) + 0.02 * rng.standard_normal((num_frames, 6))
    return np.concatenate((shape, np.full((num_frames, 3), 0.5)), axis=1).astype("f4")


@pytest.fixture(scope="module")
def signs() -> GestureRecognizer:
    labels = ["fist", "point"] * 6
    samples = [rows(label, seed) for seed, label in enumerate(labels)]
    return GestureRecognizer(model="rbf").fit_features(samples, labels)


def test_a_copy_learns_a_gesture_and_the_recogniser_stays(signs: GestureRecognizer) -> None:
    before = signs.to_model_file().to_bytes()
    more = copy(signs).add_gesture_features("palm", [rows("palm", 20 + take) for take in range(3)])
    assert list(more.classes_) == ["fist", "palm", "point"]
    for label in SHAPES:
        decision = more.recognise_features(rows(label, 50))
        assert decision.label == label, decision  # and not rejected, though its three samples lie close together
    assert signs.to_model_file().to_bytes() == before


def test_errors_leave_the_recogniser_as_it_was(signs: GestureRecognizer) -> None:
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


def test_the_command_line_adds_a_gesture(hri, tmp_path: Path) -> None:
    clips = [(stills(sign, seed), sign) for seed in range(6) for sign in ("flat", "tall")]
    model, more = tmp_path / "two.hri", tmp_path / "new" / "three.hri"
    GestureRecognizer(model="rbf").fit([clip for clip, _ in clips], [sign for _, sign in clips]).save(model)
    files = [tmp_path / f"cross{seed}.png" for seed in range(4)]
    for seed, path in enumerate(files):
        flat, tall = (picture(sign, 0.5, np.random.default_rng(seed)) for sign in ("flat", "tall"))
        write_image(path, np.where((flat[..., 2] > 165)[..., None], flat, tall))
    wall = tmp_path / "wall.png"
    write_image(wall, np.full((SIDE_PX, SIDE_PX, 3), 120, np.uint8))

    added = hri("add-gesture", "--model", model, "--label", "क्\u200dष", *files[:3], "-o", more, "--json", "-")
    assert added.code == 0 and "3 labels: flat tall क्\u200dष" in added.err
    assert json.loads(added.out) == {"model": str(more), "labels": ["flat", "tall", "क्\u200dष"]}
    seen = hri("recognise", "--gesture", files[3], "--gesture-model", more, "--json", "-")
    assert json.loads(seen.out)["gesture"]["nbest"][0]["label"] == "क्\u200dष"

    before = more.read_bytes()
    for arguments, code, message in (
        (("--model", more, "--label", "flat", files[0]), 3, "'flat' is in the vocabulary already"),
        (("--model", more, "--label", "wall", files[0], wall), 3, "wall.png: no picture shows a hand"),
        (("--model", more, "--label", "none"), 2, "CLIP"),
        (("--label", "none", files[0]), 3, "there is no gesture model yet"),
    ):
        refused = hri("add-gesture", *arguments)
        assert (refused.code, message in refused.err) == (code, True), refused.err
    assert more.read_bytes() == before
