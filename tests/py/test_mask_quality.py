# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The quality of silhouettes: what raises and lowers it, and the study that compares it with joints."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray

import hri.studies
from hri import _native_vision
from hri.media import write_video
from hri.studies import mask_quality, webcam
from hri.vision import landmarks

Frame = NDArray[np.uint8]
WALL, SKIN = (165, 160, 150), (110, 135, 195)


def picture(x: int, wall: tuple[int, ...] = WALL, skin: tuple[int, ...] = SKIN, noise: float = 2.0) -> Frame:
    frame = np.full((240, 320, 3), wall, np.uint8)
    cv2.circle(frame, (x, 140), 42, skin, -1)
    for tip in (-30, 0, 30):
        cv2.line(frame, (x, 140), (x + tip, 80), skin, 24)
    rng = np.random.default_rng(x)
    return np.clip(frame + rng.normal(0, noise, frame.shape), 0, 255).astype(np.uint8)


def quality(frame: Frame) -> float:
    return float(_native_vision.SilhouetteExtractor().extract(frame).quality)


def test_what_can_be_trusted_less_has_less_quality() -> None:
    clear = quality(picture(160))
    assert clear > 0.9
    assert clear > quality(picture(160, noise=20.0)) > quality(picture(160, noise=40.0)) + 0.02
    near = tuple(w + (s - w) // 5 for w, s in zip(WALL, SKIN, strict=True))
    assert quality(picture(160, skin=near, noise=6.0)) < clear - 0.04
    small = np.full((240, 320, 3), WALL, np.uint8)
    cv2.circle(small, (160, 120), 14, SKIN, -1)
    assert 0.2 < quality(small) < 0.8
    walled = picture(160)
    walled[:, :40] = walled[:40] = walled[:, 280:] = SKIN
    walled[130:150, :160] = SKIN  # one region with the hand
    assert quality(walled) < 0.1
    assert quality(np.full((240, 320, 3), WALL, np.uint8)) == 0.0


def test_colours_of_a_clip_have_a_quality_in_every_frame() -> None:
    clip = [picture(100 + 10 * t) for t in range(10)]
    colours = _native_vision.HandColours.learn(clip)
    found = [colours.extract(frame).quality for frame in clip]
    blurred = colours.extract(cv2.GaussianBlur(clip[5], (0, 0), 9)).quality
    assert min(found) > blurred + 0.03 and blurred > 0
    assert colours.extract(np.full((240, 320, 3), WALL, np.uint8)).quality == 0.0


class Tracker:
    """Stands for MediaPipe: 21 points of the hull of the hand, found by its red."""

    def __init__(self, static_image_mode: bool, **_: object) -> None:
        assert static_image_mode

    def __enter__(self) -> Tracker:
        return self

    def __exit__(self, *_: object) -> None: ...

    def process(self, rgb: Frame) -> SimpleNamespace:
        red = cv2.erode((rgb[..., 0].astype(int) - rgb[..., 2] > 90).astype(np.uint8), np.ones((9, 9), np.uint8))
        if not red.any():
            return SimpleNamespace(multi_hand_landmarks=None)
        hull = cv2.convexHull(cv2.findNonZero(red)).reshape(-1, 2)
        chosen = hull[np.linspace(0, len(hull) - 1, 21).astype(int)]
        points = [SimpleNamespace(x=x / red.shape[1], y=y / red.shape[0]) for x, y in chosen]
        return SimpleNamespace(multi_hand_landmarks=[SimpleNamespace(landmark=points)])


def test_the_study_compares_quality_with_joints(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    mediapipe = SimpleNamespace(solutions=SimpleNamespace(hands=SimpleNamespace(Hands=Tracker)))
    monkeypatch.setattr(landmarks, "import_optional", lambda *_: mediapipe)
    monkeypatch.setattr(mask_quality, "_STEP", 2)
    for label in ("swipeLeft", "swipeRight"):
        (tmp_path / webcam.FOLDER / label).mkdir(parents=True)
        clip = [picture(60 + 6 * t, skin=(90, 120, 215)) for t in range(10)]
        if label == "swipeRight":  # by HSV bounds, the wood on which the hand rests is skin too
            for frame in clip:
                frame[:170, 190:] = frame[170:, :] = (120, 140, 180)
        write_video(tmp_path / webcam.FOLDER / label / "t1.m4v", clip, 12.0)
    study = hri.studies.get_study("mask-quality")
    result = hri.studies.run_study(study, tmp_path, lambda *_: None, {"way": ("learned", "hsv_wide")})
    learned, hsv, every = result["rows"]
    assert [row["way"] for row in result["rows"]] == ["learned", "hsv_wide", "all"]
    assert learned["counts"]["masks"] == 10 and learned["shared_mean"] > 0.5 and learned["quality_mean"] > 0.8
    assert (
        hsv["shared_mean"] < learned["shared_mean"]
        and every["counts"]["masks"] == learned["counts"]["masks"] + hsv["counts"]["masks"]
    )
    assert every["separated_mean"] > 0.85 and result["passed"]
