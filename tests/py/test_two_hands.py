# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Both hands of drawn clips: in any light, apart, touching and crossing, in Python and on the command line."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray

import hri.studies
from hri import _native, _native_vision
from hri.core.errors import InvalidArgument
from hri.evaluation import expose, gamma, tint
from hri.media import Clip, read_frames, write_video
from hri.vision.film import HandFilm
from hri.vision.hands import find_hands, find_silhouettes
from hri.vision.report import inspect_hands

Frame = NDArray[np.uint8]
Place = tuple[float, float]
WALL, SKIN = (165, 160, 150), (110, 135, 195)


def draw_hand(picture: Frame, place: Place, num_fingers: int, colour: tuple[int, ...]) -> None:
    x, y = round(place[0]), round(place[1])
    cv2.circle(picture, (x, y), 26, colour, -1)
    for finger in range(num_fingers):
        angle = -0.7 + 1.4 * finger / max(1, num_fingers - 1)
        tip = (round(x + 62 * np.sin(angle)), round(y - 62 * np.cos(angle)))
        cv2.line(picture, (x, y), tip, colour, 11)


def film(left: Callable[[float], Place], right: Callable[[float], Place], count: int = 30) -> list[Frame]:
    """A hand of four fingers and, before it, one of two, in 320 x 240."""
    rng = np.random.default_rng(1)
    frames = []
    for t in np.linspace(0, 1, count):
        picture = np.full((240, 320, 3), WALL, np.uint8)
        draw_hand(picture, left(t), 4, SKIN)
        draw_hand(picture, right(t), 2, SKIN)
        frames.append(np.clip(picture + rng.normal(0, 2, picture.shape), 0, 255).astype(np.uint8))
    return frames


def middles(hands: list) -> NDArray[np.float64]:
    return np.array([np.nonzero(hand.mask)[1].mean() / hand.mask.shape[1] * 320 for hand in hands])


def crossing(t: float) -> tuple[Place, Place]:
    return (60 + 200 * t, 140), (260 - 200 * t, 146)


def test_both_hands_are_found_in_any_light() -> None:
    clip = film(lambda t: (80, 130 + 30 * t), lambda t: (240, 160 - 30 * t), 10)
    truths = []
    for fingers, x in ((4, 80), (2, 240)):
        truth = np.zeros((240, 320), np.uint8)
        draw_hand(truth, (x, 145), fingers, (255,))
        truths.append(truth > 0)
    for frames in (clip, expose(clip, 0.4), gamma(clip, 2.0), tint(clip, (0.6, 0.6, 1.0)), tint(clip, (1.0, 0.6, 0.6))):
        sides = find_hands(frames)
        assert list(sides) == ["left", "right"]
        for hands, column in zip(sides.values(), (80, 240), strict=True):
            assert np.abs(middles(hands) - column).max() < 8
            assert all(hand.quality > 0.3 and not hand.touching for hand in hands)
        # One hand alone would have been the larger one.
        assert np.abs(middles(find_silhouettes(frames)) - 80).max() < 10
    middle = find_hands(clip[4:6])  # too short to learn colours from
    for hands, truth in zip(middle.values(), truths, strict=True):
        mask = cv2.resize(np.asarray(hands[0].mask), (320, 240), interpolation=cv2.INTER_NEAREST) > 0
        assert (mask & truth).sum() > 0.75 * (mask | truth).sum()


def test_labels_stay_with_hands_that_cross_or_turn_back() -> None:
    sides = find_hands(film(lambda t: crossing(t)[0], lambda t: crossing(t)[1]))
    left, right = middles(sides["left"]), middles(sides["right"])
    assert left[0] < 80 and right[0] > 240 and left[-1] > 240 and right[-1] < 80
    assert any(hand.touching for hand in sides["left"]) and not sides["left"][-1].touching
    there = lambda t: 1 - abs(2 * t - 1)  # noqa: E731
    sides = find_hands(film(lambda t: (60 + 78 * there(t), 140), lambda t: (260 - 78 * there(t), 146)))
    left, right = middles(sides["left"]), middles(sides["right"])
    assert (left < right).all() and left[-1] < 80 and right[-1] > 240
    assert any(hand.touching for hand in sides["left"])


def test_one_hand_is_what_is_found_without_the_other() -> None:
    clip = film(lambda t: (80, 130), lambda t: (240, 160), 9)
    alone = find_hands(clip, 1)
    assert list(alone) == ["hand"]
    for hand, expected in zip(alone["hand"], find_silhouettes(clip), strict=True):
        np.testing.assert_array_equal(hand.mask, expected.mask)
    with pytest.raises(InvalidArgument, match="max_hands is 3"):
        find_hands(clip, 3)
    asked = _native_vision.SilhouetteOptions(method="hsv_wide")
    assert all(h.mask.any() for hands in find_hands(clip, 2, asked).values() for h in hands)


def test_of_two_hands_and_a_face_the_face_is_left_out() -> None:
    clip = film(lambda t: (60, 160), lambda t: (260, 160), 2)
    for frame in clip:
        cv2.ellipse(frame, (160, 60), (28, 38), 0, 0, 360, SKIN, -1)
    sides = find_hands(clip)
    assert np.abs(middles(sides["left"]) - 60).max() < 8 and np.abs(middles(sides["right"]) - 260).max() < 8


def test_masks_from_anywhere_are_told_apart() -> None:
    tracker = _native.HandPairTracker(_native.HandPairOptions(num_kept_frames=3))
    mask = np.zeros((60, 80), np.uint8)
    mask[20:40, 10:25] = mask[20:40, 50:70] = 1
    left, right = tracker.push(mask)
    assert left.seen and right.seen and left.x_px == pytest.approx(17, abs=0.5)
    np.testing.assert_array_equal((left.mask > 0) | (right.mask > 0), mask > 0)
    mask[:, :30] = 0
    left, right = tracker.push(mask)
    assert not left.seen and right.seen
    tracker.reset()
    mask = np.roll(mask, -40, axis=1)
    assert tracker.push(mask)[0].seen
    with pytest.raises(InvalidArgument, match="min_share"):
        _native.HandPairTracker(_native.HandPairOptions(min_share=2.0))
    with pytest.raises(InvalidArgument, match="2 dimensions"):
        tracker.push(np.zeros((4, 4, 3), np.uint8))


def test_the_command_reports_both_hands(hri, tmp_path: Path) -> None:
    frames = film(lambda t: crossing(t)[0], lambda t: crossing(t)[1], 20)
    video, table, seen = tmp_path / "cross.avi", tmp_path / "cross.csv", tmp_path / "seen.avi"
    write_video(video, frames, 15.0)
    reported = hri("hands", video, "--max-hands", 2, "-o", table, "--video", seen, "--option", "delta_orders=0")
    assert reported.code == 0 and "a left hand in 20 of 20 frames" in reported.err, reported.err
    rows = np.genfromtxt(table, delimiter=",", names=True, dtype=None, encoding="utf-8")
    left = rows[rows["hand"] == "left"]
    assert len(rows) == 40 and left["centre_x"][0] < 0.3 and left["centre_x"][-1] > 0.7
    assert len(read_frames(seen).frames) == 20
    assert hri("hands", video, "--max-hands", 2, "--source", "landmarks").code == 2
    report = inspect_hands(Clip(frames, [t / 15 for t in range(20)], video), max_hands=2)
    drawn = HandFilm(report).draw(0)[: 2 * 240]
    tinted = [drawn[280, x].astype(int) - np.array(SKIN) for x in (120, 520)]
    assert tinted[0][1] > 10 and tinted[1][0] > 10  # green, and blue


def test_the_study_follows_hands_along_the_ways_of_sentences(tmp_path: Path) -> None:
    folder = tmp_path / "asl_sentences"
    folder.mkdir()
    rows = []
    for t in range(31):  # in sentence 1 the hands cross, in sentence 2 they touch and part again
        near = 15 - abs(t - 15)
        rows.append(f"1,{t},{230 - 5 * t},150,{80 + 5 * t},154,160,60")
        rows.append(f"2,{t},{220 - 3 * near},150,{100 + 3 * near},154,160,60")
    (folder / "hands.csv").write_text("video,frame,left-x,left-y,right-x,right-y,nose-x,nose-y\n" + "\n".join(rows))
    (folder / "words.csv").write_text("video,speaker,word,startframe,endframe\n1,a,GO,0,1\n2,a,GO,0,1\n")
    (folder / "signers.csv").write_text("video,speaker\n1,a\n2,a\n")
    result = hri.studies.run_study(hri.studies.get_study("hand-pairs"), tmp_path, lambda *_: None, {})
    tracker, by_place = result["rows"]
    assert tracker["whole_mean"] == tracker["kept_mean"] == 1.0 and tracker["counts"]["swaps"] == 0 and result["passed"]
    assert tracker["counts"]["times parted"] == 2
    assert by_place["whole_mean"] == 0.5 and by_place["counts"]["swaps"] == 1 and by_place["kept_mean"] < 0.9
