# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Gestures of both hands: trained, saved, recognised in clips and streams, in Python and on the command line."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray

import hri
import hri.studies
from hri.core.errors import InvalidArgument
from hri.features import pair_rows, track_rows
from hri.live import ClipSource, GestureRecorder, Watcher
from hri.media import write_video
from hri.vision import landmarks
from hri.vision.hands import find_hands

Frame = NDArray[np.uint8]
WALL, SKIN, SIDE = (165, 160, 150), (110, 135, 195), (120, 160)
LABELS = ("alone", "apart", "together")


def frame_of(left: float | None, right: float, rng: np.random.Generator) -> Frame:
    """A hand of four fingers in column `left`, if any, and one of two in column `right`."""
    picture = np.full((*SIDE, 3), WALL, np.uint8)
    for x, num_fingers in ((left, 4), (right, 2)):
        if x is None:
            continue
        cv2.circle(picture, (round(x), 80), 13, SKIN, -1)
        for angle in np.linspace(-0.7, 0.7, num_fingers):
            tip = (round(x + 31 * np.sin(angle)), round(80 - 31 * np.cos(angle)))
            cv2.line(picture, (round(x), 80), tip, SKIN, 6)
    return np.clip(picture + rng.normal(0, 2, picture.shape), 0, 255).astype(np.uint8)


def way(label: str, share: float, start: float) -> tuple[float | None, float]:
    if label == "together":
        return 28 + start + 24 * share, 132 + start - 24 * share
    return (58 + start - 24 * share if label == "apart" else None), 102 + start + 24 * share


def clip(label: str, start: float, rest: int = 4) -> list[Frame]:
    rng = np.random.default_rng(round(10 * start) + 100)
    shares = [0.0] * rest + list(np.linspace(0, 1, 12)) + [1.0] * rest
    return [frame_of(*way(label, share, start), rng) for share in shares]


@pytest.fixture(scope="module")
def trained() -> hri.GestureRecognizer:
    takes = [(clip(label, start), label) for start in (-3.0, 0.0, 3.0) for label in LABELS]
    return hri.GestureRecognizer(num_hands=2).fit([frames for frames, _ in takes], [label for _, label in takes])


def test_gestures_of_both_hands_and_of_one_are_told_apart(trained: hri.GestureRecognizer, tmp_path: Path) -> None:
    assert trained.is_dynamic
    trained.save(tmp_path / "pairs.hri")
    loaded = hri.GestureRecognizer.load(tmp_path / "pairs.hri")
    assert loaded.options.num_hands == 2
    for label in LABELS:
        frames = clip(label, 1.0)
        decision = trained.recognise(frames)
        assert decision.nbest[0].label == label
        assert decision.quality is not None and decision.quality > 0.3
        assert loaded.recognise(frames) == decision
        rows = trained.features(frames)
        sides = find_hands(frames, faces="never")
        np.testing.assert_array_equal(rows, trained.observation_features(sides["left"], sides["right"]))
        assert trained.recognise_features(rows).nbest[0].label == label
    assert trained.recognise([np.full((*SIDE, 3), WALL, np.uint8)] * 9).status == "no_input"


def test_a_stream_decides_as_the_file_does(trained: hri.GestureRecognizer) -> None:
    for label in LABELS:
        found = [
            event.decision.nbest[0].label
            for event in Watcher(trained).watch(ClipSource(clip(label, -1.0, rest=25), 20.0))
            if event.event == "decision" and event.decision is not None
        ]
        assert found and found[-1] == label


def test_what_is_wrong_is_said(trained: hri.GestureRecognizer) -> None:
    with pytest.raises(InvalidArgument, match="num_hands"):
        hri.GestureRecognizer(num_hands=3)
    hands = find_hands(clip("apart", 0.0), faces="never")
    with pytest.raises(InvalidArgument, match="right must be given"):
        trained.observation_features(hands["left"])
    with pytest.raises(InvalidArgument, match="right must be given"):
        hri.GestureRecognizer().observation_features(hands["left"], hands["right"])
    with pytest.raises(InvalidArgument, match="differ in number"):
        pair_rows(np.zeros((2, 5), np.float32), np.zeros((3, 5), np.float32), 1.0)
    with pytest.raises(InvalidArgument, match="max_hands"):
        GestureRecorder("nowhere", ["a", "b"], "asha", num_hands=3)


class FakeTracker:
    """Joints that lie on the drawn hands, in an order that changes from picture to picture."""

    def __init__(self, *, each_alone: bool = False, max_hands: int = 1) -> None:
        self._max_hands, self._count = max_hands, 0

    def __enter__(self) -> FakeTracker:
        return self

    def __exit__(self, *_: object) -> None:
        pass

    def find_all(self, frame: Frame) -> list[NDArray[np.float32]]:
        skin = (np.abs(frame.astype(int) - SKIN).sum(axis=2) < 30).astype(np.uint8)
        count, _, boxes, centres = cv2.connectedComponentsWithStats(skin)
        grid = np.array([(0.5, 1.0)] + [(f / 4, j / 4) for f in range(5) for j in range(4)]) - 0.5
        hands = [(centres[i] + grid * boxes[i, 2:4]).astype(np.float32) for i in range(1, count) if boxes[i, 4] > 200]
        self._count += 1
        return hands[:: (-1) ** self._count][: self._max_hands]


def test_landmarks_of_both_hands_go_the_same_way(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(landmarks, "LandmarkTracker", FakeTracker)
    monkeypatch.setattr("hri.live.watcher.LandmarkTracker", FakeTracker)
    takes = [(clip(label, start), label) for start in (-3.0, 0.0, 3.0) for label in LABELS]
    signs = hri.GestureRecognizer(num_hands=2, source="landmarks")
    signs.fit([frames for frames, _ in takes], [label for _, label in takes])
    for label in LABELS:
        assert signs.recognise(clip(label, 1.0)).nbest[0].label == label
        sides = landmarks.find_landmark_pairs(clip(label, 1.0))
        assert all((hand is None) == (label == "alone") for hand in sides["left"])
        events = list(Watcher(signs).watch(ClipSource(clip(label, -1.0, rest=25), 20.0)))
        decided = [e.decision.nbest[0].label for e in events if e.event == "decision" and e.decision is not None]
        assert decided and decided[-1] == label


def test_the_commands_record_train_and_recognise_both_hands(hri: Any, tmp_path: Path) -> None:
    data, model = tmp_path / "pairs", tmp_path / "pairs.hri"
    for label in LABELS:
        for take, start in enumerate((-3.0, 0.0, 3.0), 1):
            (data / label).mkdir(parents=True, exist_ok=True)
            write_video(data / label / f"asha_{take}.avi", clip(label, start), 20.0)
    pattern = "{label}/{person}_{take}.avi"
    done = hri("train", "gesture", "--data", data, "--pattern", pattern, "--hands", "both", "--out", model)
    assert done.code == 0, done.err
    video = tmp_path / "apart.avi"
    write_video(video, clip("apart", 1.0, rest=25), 20.0)
    lines = [json.loads(line) for line in hri("watch", "--model", model, "--json-lines", video).out.splitlines()]
    assert [line["nbest"][0]["label"] for line in lines if line["event"] == "decision"] == ["apart"]
    assert hri("train", "speech", "--data", data, "--hands", "both").code == 2
    kept = hri("record", "gesture", "apart", "--hands", "both", "--person", "ben", "--takes", 1, "--from", video,
               "--out", tmp_path / "shown")  # fmt: skip
    assert kept.code == 0 and (tmp_path / "shown" / "apart" / "ben_1.avi").is_file(), kept.err


def test_the_study_compares_both_hands_with_the_right_one(tmp_path: Path) -> None:
    folder = tmp_path / "asl_sentences"
    folder.mkdir()
    rng = np.random.default_rng(0)
    hands, words = [], []
    for video in range(10):  # two words that differ in the left hand alone
        for word, (name, step) in enumerate((("IN", 4), ("OUT", -4))):
            words.append(f"{video},a,{name},{10 * word},{10 * word + 9}")
            for t in range(10):
                x, y = 100 + step * t + rng.integers(-2, 3), 150 + rng.integers(-2, 3)
                hands.append(f"{video},{10 * word + t},{x},{y},200,{150 + rng.integers(-2, 3)},160,60")
    (folder / "hands.csv").write_text("video,frame,left-x,left-y,right-x,right-y,nose-x,nose-y\n" + "\n".join(hands))
    (folder / "words.csv").write_text("video,speaker,word,startframe,endframe\n" + "\n".join(words))
    (folder / "signers.csv").write_text("video,speaker\n" + "\n".join(f"{video},a" for video in range(10)))
    study = hri.studies.get_study("asl-gestures")
    result = hri.studies.run_study(study, tmp_path, lambda *_: None, {"model": ["trajectory"]})
    both, right = result["rows"]
    assert both["word_error_mean"] == 0 and right["word_error_mean"] > 0.2 and result["passed"]


def test_tracks_are_rows_as_recognisers_take_them() -> None:
    tracks = np.array([[90, 150, 110, 150, 100, 100]] * 3, np.float32)
    assert track_rows(tracks).shape == (3, 7) and track_rows(tracks, num_hands=1).shape == (3, 5)
    with pytest.raises(InvalidArgument, match="6 columns"):
        track_rows(tracks[:, :5])
