# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Movements in poor light are watched as they were learned from files: the same colours, the same answers."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray

import hri
import hri.studies
from hri import _native_vision
from hri.live import ClipSource, VideoSource, Watcher
from hri.media import read_frames, write_video

Frame = NDArray[np.uint8]
FPS = 20.0
CLOTH, SKIN = (14, 20, 15), (70, 45, 80)
"""Violet light: what is segmented by chroma alone flickers."""
FAR = {"right": (30, 0), "left": (-30, 0), "down": (0, 24), "up": (0, -24)}


def picture(x: float, y: float, rng: np.random.Generator) -> Frame:
    """A hand of two fingers at a place."""
    frame = np.full((120, 160, 3), CLOTH, np.uint8)
    at = (round(x), round(y))
    cv2.circle(frame, at, 16, SKIN, -1)
    cv2.line(frame, (at[0] - 6, at[1]), (at[0] - 12, at[1] - 34), SKIN, 7)
    cv2.line(frame, (at[0] + 6, at[1]), (at[0] + 14, at[1] - 32), SKIN, 7)
    return np.clip(frame + rng.normal(0, 1.5, frame.shape), 0, 255).astype(np.uint8)


def clip(label: str, take: int) -> list[Frame]:
    """The hand rests, moves, and rests."""
    rng = np.random.default_rng([take, *label.encode()])
    far, start = np.array(FAR[label]), np.array((80, 70)) - np.array(FAR[label]) / 2 + rng.normal(0, 2, 2)
    way = [*[0.0] * 26, *np.linspace(0, 1, 10 + take % 3), *[1.0] * 16]
    return [picture(*(start + share * far), rng) for share in way]


@pytest.fixture(scope="module")
def movements() -> hri.GestureRecognizer:
    named = [(label, take) for label in FAR for take in range(4)]
    return hri.GestureRecognizer().fit([clip(*one) for one in named], [label for label, _ in named])


def test_a_file_gives_the_same_label_whether_watched_or_recognised(
    movements: hri.GestureRecognizer, tmp_path: Path
) -> None:
    assert movements.starts_at_rest and not movements.pauses
    for label in FAR:
        path = tmp_path / f"{label}.avi"
        write_video(path, clip(label, 9), FPS)
        recognised = movements.recognise(read_frames(path).frames)
        events = list(Watcher(movements).watch(VideoSource(path)))
        decided = [event.decision for event in events if event.event == "decision"]
        assert [d.nbest[0].label for d in decided if d] == [recognised.nbest[0].label] == [label]
        dropped = [event.fields["reason"] for event in events if event.event == "gesture_dropped"]
        assert dropped == ["arrived"]  # the hand was there, and rested
        again = movements.recognise(read_frames(path).frames)
        assert again.score == recognised.score


def test_what_begins_at_rest_is_kept_in_the_model_file(movements: hri.GestureRecognizer, tmp_path: Path) -> None:
    movements.save(tmp_path / "m.hri")
    assert hri.GestureRecognizer.load(tmp_path / "m.hri").starts_at_rest
    moving = [frames[26:38] for frames in (clip(label, take) for label in FAR for take in range(3))]
    labels = [label for label in FAR for _ in range(3)]
    assert not hri.GestureRecognizer().fit(moving, labels).starts_at_rest


def test_a_gesture_that_pauses_is_known_by_its_last_movement_too() -> None:
    """Who is watched may have made the first movement long before; the second alone looks like the other's first."""

    def paused(label: str, take: int) -> list[Frame]:
        rng = np.random.default_rng([take, 5, *label.encode()])
        first, then = {"right, down": ((50, 0), (0, 40)), "down, right": ((0, 40), (50, 0))}[label]
        shares = [*[0.0] * 8, *np.linspace(0, 1, 8), *[1.0] * 12]
        places = [np.array((50, 55)) + share * np.array(first) for share in shares]
        places += [places[-1] + share * np.array(then) for share in (*np.linspace(0, 1, 8), *[1.0] * 6)]
        return [picture(x + rng.normal(0, 0.3), y, rng) for x, y in places]

    labels = ("right, down", "down, right")
    named = [(label, take) for label in labels for take in range(3)]
    known = hri.GestureRecognizer().fit([paused(*one) for one in named], [label for label, _ in named])
    for label in labels:
        whole = paused(label, 7)
        assert known.recognise(whole).nbest[0].label == label
        assert known.recognise(whole[24:]).nbest[0].label == label
    assert known.pauses

    # Live, the second stroke is decided by itself and together with the first, and the surer answer stands. Both are
    # preliminary: what is obeyed comes when nothing else follows.
    gained = []
    for label in labels:
        whole = paused(label, 8)
        stream = [*[whole[0]] * 30, *whole[:24], *[whole[23]] * 12, *whole[24:], *[whole[-1]] * 14]
        both, alone = (
            list(Watcher(known, max_pause_s=pause_s).watch(ClipSource(stream, FPS))) for pause_s in (2.5, 0.0)
        )
        first, second = (e.decision for e in both if e.event == "preliminary")
        final = [e.decision for e in both if e.event == "decision"]
        assert final == [second] and second is not None and second.nbest[0].label == label
        each = [e.decision for e in alone if e.event == "preliminary"]
        assert first is not None and each[0] is not None and first.score == each[0].score
        assert each[1] is not None
        gained.append(second.score - each[1].score)
        partial = [e for e in both if e.event == "preliminary"]
        assert all(e.fields["final"] == "" and e.fields["last_s"] > e.fields["first_s"] for e in partial)
    assert min(gained) >= 0 and max(gained) > 0


def test_colours_are_learned_from_the_stream_and_kept_when_the_hand_is_away() -> None:
    rng = np.random.default_rng(0)
    hands = _native_vision.HandFinder().stream()
    times = iter(np.arange(0, 1000, 1 / FPS))
    wall = [picture(80, 400, rng) for _ in range(20)]
    coming = [picture(80, y, rng) for y in np.linspace(160, 70, 12)]
    there = [picture(80 + 5 * np.sin(t), 70, rng) for t in range(40)]
    for frame in (*wall, *coming, *there):
        found = hands.push(frame, float(next(times)))
    truth = np.abs(there[-1].astype(int) - np.array(CLOTH)).sum(axis=2) > 45
    shared = ((found.mask > 0) & truth).sum() / ((found.mask > 0) | truth).sum()
    assert shared > 0.85 and found.quality > 0.3
    for frame in wall * 4:
        assert not hands.push(frame, float(next(times))).mask.any()
    back = hands.push(there[-1], float(next(times)))
    np.testing.assert_array_equal(back.mask, found.mask)


def test_a_hand_that_looks_different_has_not_moved() -> None:
    """Better colours found in a stream are no movement of the hand."""
    rng = np.random.default_rng(1)
    still = [picture(80, 70, rng) for _ in range(120)]
    named = [(label, take) for label in FAR for take in range(3)]
    known = hri.GestureRecognizer().fit([clip(*one) for one in named], [label for label, _ in named])
    reported = [event.event for event in Watcher(known).watch(ClipSource(still, FPS))]
    assert "decision" not in reported and reported.count("gesture_start") <= 1


def test_the_study_of_live_clips_runs_whole(tmp_path: Path) -> None:
    for label in ("left", "down"):
        (tmp_path / "webcam_gestures" / label).mkdir(parents=True)
        for take in range(6):
            write_video(tmp_path / "webcam_gestures" / label / f"t{take}.m4v", clip(label, take), FPS)
    study = hri.studies.get_study("webcam-live")
    result = hri.studies.run_study(study, tmp_path, lambda *_: None, {})
    means = {row["clips"]: row["accuracy_mean"] for row in result["rows"]}
    assert set(means) == {"file", "live", "agree"} and min(means.values()) > 0.9 and result["passed"]
    assert result["decisions_a_clip"] == 1.0 and result["median_compute_ms"] > 0
    assert result["wrong_decisions_a_clip"] == 0.0 and 0.0 <= result["preliminary_a_clip"] <= 1.0
