# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Hands in clips: colours learned from the clip, landmarks, movements as paths, and the studies of webcam clips."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray

import hri
import hri.studies
from hri import _native_vision
from hri.core.errors import InvalidArgument
from hri.evaluation import expose, gamma, tint
from hri.media import write_video
from hri.studies import webcam
from hri.synthetic.signer import draw_clip, make_signer
from hri.vision import hands, landmarks

Frame = NDArray[np.uint8]
DARK_CLOTH, DIM_SKIN = (14, 20, 15), (70, 45, 80)


def film(moves_right: bool, take: int = 0, num_frames: int = 16) -> list[Frame]:
    """A hand of two fingers that goes right or down in dim violet light."""
    rng = np.random.default_rng(take)
    frames = []
    for t in range(num_frames):
        picture = np.full((120, 160, 3), DARK_CLOTH, np.uint8)
        way = 2 * t + take
        x, y = (50 + way, 70) if moves_right else (70, 50 + way)
        cv2.circle(picture, (x, y), 16, DIM_SKIN, -1)
        cv2.line(picture, (x - 6, y), (x - 12, y - 34), DIM_SKIN, 7)
        cv2.line(picture, (x + 6, y), (x + 14, y - 32), DIM_SKIN, 7)
        frames.append(np.clip(picture + rng.normal(0, 1.5, picture.shape), 0, 255).astype(np.uint8))
    return frames


def test_colours_of_the_clip_find_the_hand_in_any_light() -> None:
    clip = film(True)
    for frames in (clip, expose(clip, 2.5), gamma(clip, 0.6), tint(clip, (0.6, 0.6, 1.0)), tint(clip, (1.0, 0.6, 0.6))):
        found = hands.find_silhouettes(frames)
        truth = [np.abs(f.astype(int) - frames[0][0, 0].astype(int)).sum(axis=2) > 45 for f in frames]
        for silhouette, wanted in zip(found, truth, strict=True):
            mask = silhouette.mask > 0
            assert (mask & wanted).sum() > 0.8 * (mask | wanted).sum()
            assert silhouette.quality > 0.3


def test_a_wall_has_no_hand_colours() -> None:
    wall = [frame for frame in (np.full((120, 160, 3), 90, np.uint8),) for _ in range(10)]
    assert _native_vision.HandColours.learn(wall) is None
    assert all((s.mask == 0).all() for s in hands.find_silhouettes(wall))
    with pytest.raises(InvalidArgument, match="frame 1"):
        _native_vision.HandColours.learn([wall[0], wall[0][:, :, :1]])


def test_the_hand_of_a_person_is_found_and_not_the_face() -> None:
    clip = draw_clip(make_signer(2), "2")
    raised = [np.asarray(s.mask) > 0 for s in hands.find_silhouettes(clip)[12:24]]
    assert all(mask.any() and mask[:, :65].sum() > 0.9 * mask.sum() for mask in raised)
    anything = _native_vision.HandColours.learn(clip, _native_vision.HandColourOptions(remove_still=False))
    face = np.asarray(anything.extract(clip[18]).mask) > 0
    assert face[:, :65].sum() < 0.1 * face.sum()


def test_movements_are_told_apart_and_the_model_chosen(tmp_path: Path) -> None:
    clips = [film(right, take) for take in range(4) for right in (True, False)]
    labels = ["right", "down"] * 4
    signs = hri.GestureRecognizer().fit(clips, labels)
    assert signs._trained.options.model == "trajectory"
    slow = [frame for frame in film(True, 9) for _ in range(2)]
    assert list(signs.predict([slow, film(False, 9)])) == ["right", "down"]
    signs.save(tmp_path / "signs.hri")
    again = hri.GestureRecognizer.load(tmp_path / "signs.hri")
    assert again.recognise(clips[0]) == signs.recognise(clips[0])


def hand_at(x: float, y: float, spread: float, turn: float = 0.0) -> NDArray[np.float32]:
    """21 joints: a wrist, and five straight fingers `spread` apart."""
    points = [(0.0, 0.0)]
    for finger in range(5):
        angle = turn + spread * (finger - 2)
        points += [(r * np.sin(angle), -r * np.cos(angle)) for r in (30, 50, 65, 75)]
    return np.asarray(points, np.float32) + np.array([x, y], np.float32)


def test_landmarks_feed_the_same_recognisers() -> None:
    size = (640, 480)

    def rows(way: float, take: int) -> NDArray[np.float32]:
        joints = [hand_at(300 + take, 300, 0.2, way * t / 12) for t in range(12)]
        return landmarks.landmark_features(joints, size)

    x = [rows(way, take) for take in range(4) for way in (0.8, -0.8)]
    signs = hri.GestureRecognizer(source="landmarks").fit_features(x, ["clockwise", "back"] * 4)
    assert signs.recognise_features(rows(0.8, 9)).nbest[0].label == "clockwise"
    assert signs.recognise_features(rows(-0.8, 9)).nbest[0].label == "back"
    none = landmarks.landmark_features([None, None], size)
    assert none.shape == (0, x[0].shape[1]) and signs.recognise_features(none).status == "no_input"


def test_the_shape_of_landmarks_does_not_depend_on_place_and_size() -> None:
    one = landmarks.landmark_features([hand_at(300, 300, 0.2)], (640, 480))[0]
    other = landmarks.landmark_features([2 * hand_at(150, 200, 0.2)], (1280, 960))[0]
    np.testing.assert_allclose(one[:-3], other[:-3], atol=1e-5)
    assert one[-3] != other[-3]


def test_a_tracker_that_is_missing_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(__import__("sys").modules, "mediapipe", None)
    with pytest.raises(ImportError, match=r"libhri\[mediapipe\]"):
        hri.GestureRecognizer(source="landmarks").features(film(True))


def test_how_hands_are_found_is_saved_with_the_model(tmp_path: Path) -> None:
    """A recogniser that is loaded segments as it was trained to."""
    clips = [film(right, take) for take in range(3) for right in (True, False)]
    found = {"learning": "never", "silhouette": {"max_side_px": 64, "blur_px": 3}}
    signs = hri.GestureRecognizer(hands=found, min_quality=0.0).fit(clips, ["right", "down"] * 3)
    signs.save(tmp_path / "signs.hri")
    again = hri.GestureRecognizer.load(tmp_path / "signs.hri")
    assert again.options.hands == signs.options.hands and again.options.min_quality == 0.0
    fresh = film(True, 9)
    np.testing.assert_array_equal(again.features(fresh), signs.features(fresh))
    assert again.recognise(fresh) == signs.recognise(fresh)
    assert hri.GestureRecognizer().features(fresh).shape != signs.features(fresh).shape or not np.array_equal(
        hri.GestureRecognizer().features(fresh), signs.features(fresh)
    )


def test_one_call_gives_what_its_steps_give() -> None:
    clips = [film(right, take) for take in range(3) for right in (True, False)]
    signs = hri.GestureRecognizer().fit(clips, ["right", "down"] * 3)
    fresh = film(False, 9)
    seen = hands.find_silhouettes(fresh)
    rows = signs.observation_features(seen)
    np.testing.assert_array_equal(rows, signs.features(fresh))
    assert signs.recognise_features(rows) == signs.recognise(fresh)
    centre = hands.hand_place(seen[3].mask)
    assert centre is not None
    np.testing.assert_allclose(rows[3, -3:-1], centre[:2], rtol=1e-6)


def test_made_up_light() -> None:
    frame = np.array([[[0, 128, 255]]], np.uint8)
    assert gamma([frame], 2.0)[0].ravel().tolist() == [0, 64, 255]
    assert tint([frame], (1.0, 0.5, 2.0))[0].ravel().tolist() == [0, 64, 255]
    with pytest.raises(InvalidArgument, match="gamma"):
        gamma([frame], 9.0)
    with pytest.raises(InvalidArgument, match="gains"):
        tint([frame], (1.0, 0.0, 1.0))


@pytest.fixture(scope="module")
def webcam_dir(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Clips with names that the label file knows."""
    folder = tmp_path_factory.mktemp("webcam")
    for label, right in (("swipeRight", True), ("swipeDown", False)):
        (folder / webcam.FOLDER / label).mkdir(parents=True)
        for take in range(1, 6):
            write_video(folder / webcam.FOLDER / label / f"t{take}.m4v", film(right, take, 10), 12.0)
    return folder


def test_the_studies_of_webcam_clips_run_whole(webcam_dir: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(webcam, "ANGLES", (0.0, 30.0))
    monkeypatch.setattr(webcam, "NUM_SPLITS", 2)

    def run(name: str, **only: tuple[str, ...]) -> dict:
        return hri.studies.run_study(hri.studies.get_study(name), webcam_dir, lambda *_: None, only)

    nested = run("webcam-gestures", source=("silhouettes",))
    assert nested["rows"][-1]["left out"] == "all clips" and nested["rows"][-1]["accuracy_mean"] == 1.0
    assert nested["passed"] and len(nested["rows"]) > 3
    assert set(nested["chosen_degrees"].values()) <= {0.0, 30.0}
    curve = run("webcam-conditions", source=("silhouettes",))
    assert [row["trained on"] for row in curve["rows"]] == [3, 5, 7]
    assert all(len(row["per_fold"]) == 2 for row in curve["rows"])
    light = run("webcam-light", light=("gamma 2",))
    assert set(light["drops"]) == {"as recorded", "gamma 2"}


def test_every_clip_is_in_one_condition() -> None:
    assert webcam.read_conditions(["pinch/t1", "zoom/t2"]) == ["violet on black", "white wall"]
    with pytest.raises(InvalidArgument, match="wave/t1"):
        webcam.read_conditions(["wave/t1"])


def test_clips_of_ones_own_get_conditions_of_ones_own(tmp_path: Path) -> None:
    table = tmp_path / "conditions.toml"
    table.write_text('[[condition]]\nname = "garden"\nclips = ["wave/t1"]\n')
    assert webcam.read_conditions(["wave/t1"], table) == ["garden"]
    with pytest.raises(InvalidArgument, match=r"wave/t2.*webcam_gestures/conditions\.toml"):
        webcam.read_conditions(["wave/t2"], table)
    table.write_text("[condition]\nname = 3\n")
    with pytest.raises(InvalidArgument, match="no table of conditions"):
        webcam.read_conditions(["wave/t1"], table)
