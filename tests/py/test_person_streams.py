# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Hands of persons whose face is seen, in streams and recognisers; and landmarks where they are found."""

from __future__ import annotations

from copy import copy
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray

import hri
from hri.core.errors import FormatError, InvalidArgument
from hri.live import ClipSource, Watcher
from hri.recognition.gesture import recognizer as module
from hri.training import hand_source
from hri.vision import FaceFinder, FaceFinderOptions, HandFinder, PersonHands

Frame = NDArray[np.uint8]
SKIN, WALL, SHIRT = (125, 150, 200), (170, 185, 190), (40, 35, 35)
# One stump that every window passes which is not of one grey: it has no notion of faces, but a place for one.
CASCADE = """<?xml version="1.0"?><opencv_storage><cascade type_id="opencv-cascade-classifier">
<stageType>BOOST</stageType><featureType>HAAR</featureType><height>20</height><width>20</width>
<stageParams><maxWeakCount>1</maxWeakCount></stageParams><featureParams><maxCatCount>0</maxCatCount></featureParams>
<stageNum>1</stageNum><stages><_><maxWeakCount>1</maxWeakCount><stageThreshold>-1.</stageThreshold><weakClassifiers><_>
<internalNodes>0 -1 0 0.</internalNodes><leafValues>0. 0.</leafValues></_></weakClassifiers></_></stages>
<features><_><rects><_>0 0 20 20 -1.</_><_>5 5 10 10 4.</_></rects><tilted>0</tilted></_></features>
</cascade></opencv_storage>"""


def finder_of(folder: Path, min_side: float) -> FaceFinder:
    (folder / "any.xml").write_text(CASCADE)
    return FaceFinder(folder / "any.xml", FaceFinderOptions(min_side=min_side, scale_step=2.0))


def room(x: int, noise: int = 2) -> Frame:
    """A person who holds a hand in column `x`; without noise, a wall of one grey."""
    frame = np.full((240, 320, 3), WALL, np.uint8)
    if noise:
        frame[98:, 112:200] = SHIRT
        cv2.ellipse(frame, (156, 78), (15, 19), 0, 0, 360, SKIN, -1)
        cv2.circle(frame, (x, 120), 11, SKIN, -1)
        cv2.line(frame, (x, 120), (x + 4, 96), SKIN, 5)
    return np.clip(frame + np.random.default_rng(x).normal(0, noise, frame.shape), 0, 255).astype(np.uint8)


def test_a_stream_looks_where_the_face_is_and_as_before_where_there_is_none(tmp_path: Path) -> None:
    finder = finder_of(tmp_path, 0.6)
    empty, shown = room(80, noise=0), room(80)
    assert finder.find(empty) is None
    face = finder.find(shown)
    assert face is not None
    for dynamic in (False, True):
        stream, plain = HandFinder(faces=finder).stream(dynamic), HandFinder().stream(dynamic)
        for t in range(12):
            frame = empty if t < 6 else room(80, noise=0)
            found, expected = stream.push(frame, t / 10), plain.push(frame, t / 10)
            np.testing.assert_array_equal(found.mask, expected.mask)
            assert not stream.renewed
    expected = PersonHands().extract(shown, face)
    renewed = []
    for t in range(12, 52):
        found = stream.push(shown, t / 10, in_gesture=t < 36)
        renewed.append(stream.renewed)
        by_person = np.array_equal(found.mask, expected.mask)
        assert by_person == (t >= 36), t  # not within a gesture
    assert renewed[24] and sum(renewed[24:]) == 1
    first = HandFinder(faces=finder).stream(True, 2).push(shown, 0.0)
    assert np.asarray(first.mask).shape == np.asarray(expected.mask).shape  # from the first picture on
    with pytest.raises(InvalidArgument, match="picture"):
        stream.push(np.zeros((4, 4), np.uint8), 9.0)


def test_recognisers_look_for_faces_where_they_are_told_to(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    finder = finder_of(tmp_path, 0.25)
    clips = [[room(60 + step * t + d) for t in range(9)] for step in (2, 0) for d in (0, 3)]
    monkeypatch.setattr(
        module, "face_finder", lambda faces="auto", required=False: None if faces == "never" else finder
    )
    signs = hri.GestureRecognizer(use_faces=True, min_quality=0.0, model="trajectory")
    hands = HandFinder(faces=finder).find(clips[0])
    np.testing.assert_array_equal(signs.features(clips[0]), signs.observation_features(hands))
    alone = hri.GestureRecognizer(min_quality=0.0).features(clips[0])
    assert not np.array_equal(alone, signs.features(clips[0]))
    signs.fit(clips, ["right", "right", "still", "still"])
    by_face = signs.recognise(clips[0]).nbest
    assert by_face[0].label == "right"
    seen: list[Any] = []
    for faces in (None, "never"):
        signs.faces = faces
        assert copy(signs).faces == faces
        stream = signs.stream()
        stream.push(clips[0][0], 0.0)
        seen.append(np.asarray(stream.hand.mask).shape)
    assert seen[0] != seen[1]
    shapes: list[Any] = []
    watcher = Watcher(signs, on_result=lambda result, _: shapes.append(result.mask))
    list(watcher.watch(ClipSource(clips[0], 15.0)))
    assert {mask.shape for mask in shapes if mask is not None} >= {seen[1]}
    assert signs.recognise(clips[0]).nbest != by_face
    signs.save(tmp_path / "m.hri")
    assert hri.GestureRecognizer.load(tmp_path / "m.hri").faces is None
    with pytest.raises(FormatError, match="faces"):
        signs.__setstate__({**signs.__getstate__(), "faces": 1})
    monkeypatch.undo()
    monkeypatch.setattr("hri.vision.faces.find_cascade", lambda: None)
    signs.faces = None
    with pytest.raises(InvalidArgument, match="opencv-data"):
        signs.features(clips[0])


def test_landmarks_are_taken_where_they_are_found(hri: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    class Tracker:
        finds = True

        def __init__(self, **_: object) -> None: ...
        def __enter__(self) -> Tracker:
            return self

        def __exit__(self, *_: object) -> None: ...
        def find(self, _: Frame) -> Any:
            return np.zeros((21, 2), np.float32) if self.finds else None

    for x in range(30):
        cv2.imwrite(str(tmp_path / f"{x}.png"), room(60 + x))
    dataset: Any = SimpleNamespace(samples=[SimpleNamespace(path=tmp_path / f"{x}.png") for x in range(30)])
    monkeypatch.setattr(hand_source, "LandmarkTracker", Tracker)
    monkeypatch.setattr(hand_source, "find_spec", lambda _: None)
    assert hand_source.choose_source(dataset)[0] == "silhouettes"
    monkeypatch.setattr(hand_source, "find_spec", lambda _: object())
    source, why = hand_source.choose_source(dataset)
    assert source == "landmarks" and "12 of 12" in why
    Tracker.finds = False
    source, why = hand_source.choose_source(dataset)
    assert source == "silhouettes" and "0 of 12" in why
    assert hri("train", "speech", "--data", tmp_path, "--source", "landmarks").code == 2
    for label in ("left", "right"):
        (tmp_path / "data" / label).mkdir(parents=True)
        for take in range(3):
            x = 60 + take + (40 if label == "right" else 0)
            cv2.imwrite(str(tmp_path / "data" / label / f"asha_{take}.png"), room(x))
    done = hri("train", "gesture", "--data", tmp_path / "data", "--pattern", "{label}/{person}_{take}.png", "--out",
               tmp_path / "m.hri")  # fmt: skip
    assert done.code == 0 and "source: silhouettes, as MediaPipe finds a hand in 0 of 6" in done.err, done.err


def test_a_single_picture_is_searched_at_twice_its_size_where_few_windows_agree(tmp_path: Path) -> None:
    (tmp_path / "any.xml").write_text(CASCADE)
    frame = np.full((24, 26, 3), 128, np.uint8)
    frame[10:14, 12:16] = np.random.default_rng(0).integers(0, 255, (4, 4, 3))
    sides = {}
    for sure in (0, 1, 1000):
        options = FaceFinderOptions(min_side=0.05, scale_step=2.0, min_neighbours=1, sure_neighbours=sure)
        finder = FaceFinder(tmp_path / "any.xml", options)
        plain, still = finder.find(frame), finder.find_in_still(frame)
        assert plain is not None and still is not None
        for face in (plain, still):  # what was found is what stands out of the grey
            assert abs(face.left_px + face.side_px / 2 - 14) < 5 and abs(face.top_px + face.side_px / 2 - 12) < 5
        sides[sure] = plain.side_px, still.side_px
        assert finder.find_in_still(np.full_like(frame, 128)) is None
    assert sides[0][1] == sides[0][0] and sides[1][1] == sides[1][0], "never, and one window is enough"
    assert sides[1000][0] == sides[0][0] and sides[1000][1] < sides[0][0], (
        "windows of twice the picture are half as wide"
    )
