# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Gestures that are added to a trained recogniser from few samples."""

from __future__ import annotations

import json
import logging
from copy import copy
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("cv2")

from drawn_hands import SIDE_PX, picture, stills
from hri import GestureRecognizer
from hri.core.errors import InvalidArgument
from hri.media import write_image
from hri.vision import HandFinder

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


@pytest.mark.parametrize("label", [None, 7.5, True])
def test_a_label_that_is_no_text_is_named(signs: GestureRecognizer, label: object) -> None:
    with pytest.raises(InvalidArgument, match=f"^label must be text, got {label}"):
        copy(signs).add_gesture(label, [stills("tall", 1)])
    with pytest.raises(InvalidArgument, match=f"^label must be text, got {label}"):
        copy(signs).add_gesture_features(label, [rows("palm", 20)])


def test_options_set_after_training_count_for_the_next_one_alone() -> None:
    clips = [stills(sign, seed) for seed in range(4) for sign in ("flat", "tall")]
    signs = GestureRecognizer(model="rbf").fit(clips, [0, 1] * 4)
    new = [np.rot90(stills("tall", 30 + seed)[0], k=1)[None] for seed in range(3)]
    changed = copy(signs).set_params(features__crop_px=16, min_quality=0.9, source="landmarks", use_faces=True)
    expected = copy(signs).add_gesture(7, new)
    assert list(expected.classes_) == ["0", "1", "7"]
    assert changed.face_finder() is None
    np.testing.assert_array_equal(changed.features(clips[0]), signs.features(clips[0]))
    np.testing.assert_array_equal(changed.features_and_quality(clips[0])[0], signs.features(clips[0]))
    hands = [HandFinder().find(clips[0])[0]]
    np.testing.assert_array_equal(changed.observation_features(hands), signs.observation_features(hands))
    assert changed.add_gesture(7, new).to_model_file().to_bytes() == expected.to_model_file().to_bytes()

    other = GestureRecognizer(model="rbf", features={"crop_px": 16}, min_quality=0.0)
    anew = copy(signs).set_params(features__crop_px=16, min_quality=0.0).fit(clips, [0, 1] * 4)
    assert anew.to_model_file().to_bytes() == other.fit(clips, [0, 1] * 4).to_model_file().to_bytes()
    np.testing.assert_array_equal(
        changed.untrained().set_params(source="silhouettes", use_faces=False).features(clips[0]),
        other.set_params(min_quality=0.9).untrained().features(clips[0]),
    )


def test_training_names_the_clips_without_a_hand(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    wall = np.full((SIDE_PX, SIDE_PX, 3), 120, np.uint8)
    write_image(tmp_path / "wall.png", wall)
    clips = [stills(sign, seed) for seed in range(4) for sign in ("flat", "tall")]
    labels = ["flat", "tall"] * 4
    with caplog.at_level(logging.WARNING, "hri"):
        GestureRecognizer(model="rbf").fit(clips, labels)
        assert not caplog.records
        GestureRecognizer(model="rbf").fit([*clips, tmp_path / "wall.png", *[[wall]] * 5], [*labels, *["flat"] * 6])
    (record,) = caplog.records
    assert (
        "6 of 14: X[8] (" in record.getMessage() and "wall.png), X[9], X[10], X[11], X[12], ..." in record.getMessage()
    )


@pytest.mark.parametrize(
    ("groups", "message"),
    [(["ann"], "X, y and groups differ in length: 2, 2, 1"), (["ann", None], r"groups\[1\] must be text, got None")],
)
def test_wrong_groups_are_refused_before_any_clip_is_read(groups: list[str], message: str) -> None:
    with pytest.raises(InvalidArgument, match=message):
        GestureRecognizer().fit(["no such file.png"] * 2, ["flat", "tall"], groups=groups)


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
