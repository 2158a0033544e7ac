# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The hands of a person whose face is seen: options, the cascade, drawn rooms, and the study on photos."""

from __future__ import annotations

import os
import warnings
from pathlib import Path
from types import SimpleNamespace

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray

from hri import studies
from hri.core.errors import FormatError, InvalidArgument, IoError
from hri.media import read_image
from hri.studies import hands_in_rooms
from hri.vision import Face, FaceFinder, FaceFinderOptions, HandFinder, PersonHands, PersonOptions, faces, find_cascade
from hri.vision.hands import find_silhouettes

Frame = NDArray[np.uint8]
SKIN, WALL, WOOD, SHIRT = (125, 150, 200), (170, 185, 190), (60, 100, 165), (40, 35, 35)
FACE = Face(140, 60, 32)


def room(hand: tuple[int, int] | None) -> tuple[Frame, NDArray[np.bool_]]:
    """A person beside wood, before a wall; and where the hand is."""
    frame = np.full((240, 320, 3), WALL, np.uint8)
    frame[90:, 240:] = WOOD
    frame[98:, 112:200] = SHIRT
    cv2.ellipse(frame, (156, 78), (15, 19), 0, 0, 360, SKIN, -1)
    mask = np.zeros(frame.shape[:2], np.uint8)
    if hand is not None:
        cv2.circle(mask, hand, 11, 1, -1)
        for tip in (-9, 0, 9):
            cv2.line(mask, hand, (hand[0] + tip, hand[1] - 22), 1, 5)
    frame[mask > 0] = SKIN
    noise = np.random.default_rng(7).normal(0, 2, frame.shape)
    return np.clip(frame + noise, 0, 255).astype(np.uint8), mask > 0


def test_the_hand_is_found_and_neither_face_nor_wood() -> None:
    frame, hand = room((80, 120))
    found = PersonHands().extract(frame, FACE)
    mask = np.asarray(found.mask) > 0
    assert (mask & hand).sum() > 0.75 * (mask | hand).sum()
    assert 0.5 < found.quality <= 1
    empty = PersonHands().extract(room(None)[0], FACE)
    assert not np.asarray(empty.mask).any() and empty.quality == 0


@pytest.mark.parametrize("cast", [(1.0, 1.0, 1.0), (1.15, 1.0, 0.85), (0.5, 0.5, 0.5)])
def test_the_face_shows_what_light_does_to_skin(cast: tuple[float, float, float]) -> None:
    frame, hand = room((80, 120))
    lit = np.clip(frame * np.array(cast), 0, 255).astype(np.uint8)
    mask = np.asarray(PersonHands().extract(lit, FACE).mask) > 0
    assert (mask & hand).sum() > 0.75 * (mask | hand).sum()


def test_options_are_validated() -> None:
    with pytest.raises(InvalidArgument, match="reach"):
        PersonOptions(reach=0.1)
    with pytest.raises(InvalidArgument, match="min_area must not exceed max_area"):
        PersonOptions(min_area=3.0)
    with pytest.raises(InvalidArgument, match="scale_step"):
        FaceFinderOptions(scale_step=1.0)
    with pytest.raises(InvalidArgument, match="centre of the face"):
        PersonHands().extract(room(None)[0], Face(400, 60, 32))


def test_a_file_that_is_no_cascade_is_refused(tmp_path: Path) -> None:
    with pytest.raises(IoError, match=r"absent\.xml"):
        FaceFinder(tmp_path / "absent.xml")
    for text in ("", "no XML", "<opencv_storage><cascade>1</cascade></opencv_storage>"):
        (tmp_path / "cascade.xml").write_text(text)
        with pytest.raises(FormatError, match=r"cascade\.xml"):
            FaceFinder(tmp_path / "cascade.xml")


def test_a_cascade_is_named_by_the_environment(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(faces.VARIABLE, str(tmp_path / "mine.xml"))
    assert find_cascade() == str(tmp_path / "mine.xml")
    frame = room((80, 120))[0]
    with pytest.raises(IoError, match=r"mine\.xml"):
        find_silhouettes([frame])
    assert find_silhouettes([frame], faces="never")[0].mask.any()
    monkeypatch.delenv(faces.VARIABLE)
    monkeypatch.setattr(faces, "_FOLDERS", (str(tmp_path),))
    monkeypatch.setattr(faces, "find_spec", lambda _: SimpleNamespace(origin=str(tmp_path / "__init__.py")))
    assert find_cascade() is None
    with pytest.warns(UserWarning, match="most hands are missed: install Debian's package opencv-data"):
        assert find_silhouettes([frame])[0].mask.any()
    with pytest.raises(InvalidArgument, match="nothing here finds faces: install Debian's package opencv-data"):
        faces.face_finder(required=True)
    with pytest.raises(InvalidArgument, match="never"):
        faces.face_finder("never", required=True)
    with warnings.catch_warnings():  # who wants none misses none
        warnings.simplefilter("error")
        assert faces.face_finder("never") is None
    (tmp_path / faces.CASCADE).write_text("")
    assert find_cascade() == str(tmp_path / faces.CASCADE)


def test_the_command_line_refuses_faces_beside_another_way(hri, tmp_path: Path) -> None:  # type: ignore[no-untyped-def]
    path = tmp_path / "room.png"
    cv2.imwrite(str(path), room((80, 120))[0])
    for options in (["--method", "hsv_wide"], ["--background", "clip"], ["--source", "landmarks"]):
        result = hri("hands", path, "--faces", "cascade.xml", *options)
        assert result.code == 2 and "--faces" in result.err
    absent = hri("hands", path, "--faces", tmp_path / "absent.xml")
    assert absent.code != 0 and "absent.xml" in absent.err
    assert hri("hands", path, "--faces", "never").code == 0


@pytest.fixture
def photos() -> list[Path]:
    found = sorted((Path(os.environ["HRI_DATA"]) / "people" / "hand").glob("*/*.jpg"))
    if not found or find_cascade() is None:
        pytest.skip("no photos of people, or no cascade")
    return found


@pytest.mark.data
def test_photos_show_a_face_and_one_hand(photos: list[Path]) -> None:
    finder = FaceFinder(str(find_cascade()))
    frame = read_image(photos[0])
    face = finder.find(frame)
    assert face is not None and face.side_px > 0.03 * frame.shape[1]
    (found,) = HandFinder(faces=finder).find([frame])
    assert 0.001 < (np.asarray(found.mask) > 0).mean() < 0.05 and found.quality > 0.25
    left, right = HandFinder(faces=finder).find_pair([frame])
    assert np.asarray(left[0].mask).any() or np.asarray(right[0].mask).any()


def test_the_study_compares_masks_with_joints(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for place, count in (("hand/palm", 5), ("hand/no_class", 2), ("body/left", 3)):
        folder = tmp_path / hands_in_rooms.DATA / place
        folder.mkdir(parents=True, exist_ok=True)
        for number in range(count):
            frame = room((80, 120))[0]
            frame[:20, :20] = 0 if number == 1 else 255
            cv2.imwrite(str(folder / f"{number}.jpg"), frame)
    hand = np.array([(80 + x, 112 + y) for x in (-10, 0, 10) for y in range(-18, 18, 5)][:21], np.float32)

    class Tracker:
        def __init__(self, **_: object) -> None: ...
        def __enter__(self) -> Tracker:
            return self

        def __exit__(self, *_: object) -> None: ...
        def find_all(self, frame: Frame) -> list[NDArray[np.float32]]:
            face = np.array([FACE.left_px, FACE.top_px], np.float32) + np.float32(0.5 * FACE.side_px)
            taken_for_a_hand = hand - hand.mean(axis=0) + face
            return [hand + np.float32(60), taken_for_a_hand, hand] if frame[:10, :10].mean() > 128 else []

    class Faces:
        def find_in_still(self, _: Frame) -> Face:
            return FACE

    def find_hands(frames: list[Frame], max_hands: int, faces: object) -> dict[str, list[object]]:
        nothing = SimpleNamespace(mask=np.zeros((240, 320), np.uint8))
        if faces == "never":
            return {"hand": [nothing]}
        found = PersonHands().extract(frames[0], FACE)
        return {"hand": [found]} if max_hands == 1 else {"left": [found], "right": [nothing]}

    monkeypatch.setattr(hands_in_rooms, "LandmarkTracker", Tracker)
    monkeypatch.setattr(hands_in_rooms, "face_finder", lambda required: Faces())
    monkeypatch.setattr(hands_in_rooms, "find_hands", find_hands)
    study = studies.get_study("hands-in-rooms")
    result = studies.run_study(study, tmp_path, lambda *_: None)
    rows = {(row["signs"], row["pictures"], row["way"]): row for row in result["rows"]}
    # The first two of seven pictures show no sign; that at 4 chooses, that at 3 has no joints.
    chosen, others = (rows["hand", part, "with-face"] for part in ("chosen on", "others"))
    assert chosen["counts"] == {"pictures": 1, "hands": 1, "without joints": 0, "joints on a face": 1}
    assert others["counts"] == {"pictures": 3, "hands": 3, "without joints": 1, "joints on a face": 3}
    assert others["found_mean"] == 1 and others["shared_mean"] > 0.4 and others["face_mean"] == 1
    assert rows["hand", "others", "without-face"]["found_mean"] == 0
    assert rows["hand", "all", "landmarks"]["found_mean"] == 4 / 5, "of all pictures with a sign"
    both = {"pictures": 2, "hands": 4, "without joints": 1, "joints on a face": 2}
    assert rows["body", "chosen on", "with-face"]["counts"] == both
    assert rows["body", "all", "landmarks"]["counts"] == {"pictures": 3, "hands": 4, "without joints": 1}
    assert rows["body", "all", "landmarks"]["found_mean"] == 2 / 3
    met = result["passed_by"]
    assert met.keys() == {
        *(f"{signs}, {what}" for signs in ("hand", "body") for what in ("with-face, found", "with-face, shared")),
        *(f"{signs}, landmarks, found" for signs in ("hand", "body")),
    }
    assert met["hand, with-face, found"] and not met["hand, landmarks, found"]
    assert not met["body, with-face, found"] and result["passed"] is False, "half of both hands is missed"
    alone = studies.run_study(study, tmp_path, lambda *_: None, {"signs": ("hand",), "way": ("without-face",)})
    assert alone["passed"] is None and {row["way"] for row in alone["rows"]} == {"without-face"}
    monkeypatch.undo()
    monkeypatch.setattr(faces, "find_cascade", lambda: None)
    with pytest.raises(InvalidArgument, match="opencv-data"):
        studies.run_study(study, tmp_path, lambda *_: None)
