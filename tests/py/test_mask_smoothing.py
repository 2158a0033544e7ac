# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Masks that jump for a frame or two are repaired by the frames around them, in clips of any length."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray

from hri import _native_vision
from hri.core.errors import InvalidArgument
from hri.media import Clip, write_video
from hri.vision.hands import find_hands, find_silhouettes
from hri.vision.report import inspect_hands

Frame = NDArray[np.uint8]
SHORT = 6  # too short to learn colours from
WALL, SKIN = (165, 160, 150), (110, 135, 195)


def picture(x: int) -> Frame:
    frame = np.full((240, 320, 3), WALL, np.uint8)
    cv2.circle(frame, (x, 140), 40, SKIN, -1)
    cv2.line(frame, (x, 140), (x, 50), SKIN, 16)
    return np.clip(frame + np.random.default_rng(x).normal(0, 2, frame.shape), 0, 255).astype(np.uint8)


def flashed(x: int) -> Frame:
    """No hand, and a faint red shine on the other side of the wall."""
    frame = picture(x)
    frame[:, :200] = np.where(
        np.abs(frame[:, :200].astype(int) - SKIN).sum(axis=2)[..., None] < 60, WALL, frame[:, :200]
    )
    shine = np.zeros((240, 320), np.float32)
    cv2.circle(shine, (260, 120), 30, 1.0, -1)
    shine = cv2.GaussianBlur(shine, (0, 0), 9)[..., None] * np.random.default_rng(x).uniform(0, 2, (240, 320, 1))
    return np.clip(frame + shine * (-20, -10, 20), 0, 255).astype(np.uint8)


def clip(jumping: tuple[int, ...] = ()) -> list[Frame]:
    return [flashed(100 + 2 * t) if t in jumping else picture(100 + 2 * t) for t in range(SHORT)]


def shared(mask: Frame, t: int) -> float:
    truth = np.abs(picture(100 + 2 * t).astype(int) - WALL).sum(axis=2) > 45
    found = cv2.resize(np.asarray(mask), (320, 240), interpolation=cv2.INTER_NEAREST) > 0
    return float((found & truth).sum() / (found | truth).sum())


@pytest.mark.parametrize("jumping", [(2,), (2, 3)])
def test_masks_that_jump_are_mended(jumping: tuple[int, ...]) -> None:
    plain = find_silhouettes(clip(jumping), smooth=False)
    found = find_silhouettes(clip(jumping))
    for t in range(SHORT):
        assert found[t].repaired == (t in jumping) and not plain[t].repaired
        assert shared(found[t].mask, t) > 0.8
        assert (shared(plain[t].mask, t) < 0.3) == (t in jumping)
    assert all(found[t].quality < min(found[0].quality, found[-1].quality) for t in jumping)


def test_a_hand_that_is_missed_for_a_frame_is_there() -> None:
    frames = clip()
    frames[3] = np.full_like(frames[0], WALL)
    assert not find_silhouettes(frames, smooth=False)[3].mask.any()
    assert shared(find_silhouettes(frames)[3].mask, 3) > 0.8


def test_steady_clips_and_ends_stay_as_they_are() -> None:
    for frames in (clip(), clip((0, SHORT - 1)), clip((1, 2, 3))[:4], [picture(100)]):
        for found, plain in zip(find_silhouettes(frames), find_silhouettes(frames, smooth=False), strict=True):
            np.testing.assert_array_equal(found.mask, plain.mask)
            assert found.quality == plain.quality and not found.repaired


def test_options_say_how_much_is_mended() -> None:
    plain = find_silhouettes(clip((2, 3)), smooth=False)
    options = _native_vision.MaskSmoothingOptions
    assert [s.repaired for s in _native_vision.smooth_masks(plain, options(max_gap=1))] == [False] * SHORT
    assert sum(s.repaired for s in _native_vision.smooth_masks(plain, options(max_gap=2))) == 2
    assert not any(s.repaired for s in plain)  # those given stay
    with pytest.raises(InvalidArgument, match="max_gap"):
        _native_vision.smooth_masks(plain, options(max_gap=99))


def test_reports_and_pairs_tell_what_was_mended(hri, tmp_path: Path) -> None:
    frames = clip((2,))
    report = inspect_hands(Clip(frames, [t / 15 for t in range(SHORT)], Path("x.avi")))
    assert [hand.repaired for hand in report.hands["hand"]] == [t == 2 for t in range(SHORT)]
    assert any(hand.repaired for hands in find_hands(frames).values() for hand in hands)
    write_video(tmp_path / "x.avi", frames, 15.0)
    for more, repaired in ((), 1), (("--as-found",), 0):
        assert hri("hands", tmp_path / "x.avi", "-o", tmp_path / "x.csv", *more).code == 0
        assert np.genfromtxt(tmp_path / "x.csv", delimiter=",", names=True)["repaired"].sum() == repaired
