# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Drawn people who perform moving gestures, and the study of them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from hri import studies
from hri.core.errors import InvalidArgument
from hri.features import shape_moments
from hri.studies import drawn_gestures
from hri.synthetic.gestures import GESTURES, draw_gesture
from hri.synthetic.signer import SignerOptions, make_signer
from hri.vision.faces import face_finder
from hri.vision.hands import find_silhouettes

SMALL = {"size_px": (160, 120), "num_frames": 9}


def ends_of(label: str, signer: int = 0) -> list[np.ndarray]:
    """The masks of the hand at the beginning, in the first pose and in the second."""
    frames = draw_gesture(make_signer(signer), label, view="hand", **SMALL)
    masks = [np.asarray(found.mask) for found in find_silhouettes(frames, faces="never")]
    assert all(mask.any() for mask in masks)
    return [masks[0], masks[5], masks[8]]


def test_equal_arguments_give_equal_frames_and_takes_differ() -> None:
    signer = make_signer(1, options=SignerOptions(fps=5.0))
    for view in ("hand", "person"):
        frames = draw_gesture(signer, "zoom", view=view, **SMALL)
        again = draw_gesture(signer, "zoom", view=view, **SMALL)
        other = draw_gesture(signer, "zoom", 1, view=view, **SMALL)
        assert len(frames) == 9 and all(f.shape == (120, 160, 3) and f.dtype == np.uint8 for f in frames)
        assert all(np.array_equal(a, b) for a, b in zip(frames, again, strict=True))
        assert any(not np.array_equal(a, b) for a, b in zip(frames, other, strict=True))
    assert len(draw_gesture(signer, "pinch", view="hand", size_px=(64, 64))) == 18  # 3.6 s


def test_hands_open_and_close() -> None:
    def share(mask: np.ndarray) -> float:
        return shape_moments(mask)["m00"] / mask.size

    palm, two, fist = (share(mask) for mask in ends_of("swipeDown"))
    assert palm > 1.1 * fist and two > 1.05 * fist
    palm, fist, two = (share(mask) for mask in ends_of("swipeUp"))
    assert palm > 1.1 * fist and two > 1.05 * fist
    palm, corner, pinched = (share(mask) for mask in ends_of("pinch"))
    assert corner > 1.05 * pinched


def test_rotations_turn_to_opposite_sides() -> None:
    def lean_deg(mask: np.ndarray) -> float:
        """Of the line from the lower to the upper part of the hand, to the left of upright."""
        ys, xs = np.nonzero(mask)
        top = ys < np.quantile(ys, 0.3)
        return float(np.rad2deg(np.arctan2(xs[~top].mean() - xs[top].mean(), ys[~top].mean() - ys[top].mean())))

    _, before, after = ends_of("rotateCW")
    assert lean_deg(after) > lean_deg(before) + 10
    _, before, after = ends_of("rotateCCW")
    assert lean_deg(after) < lean_deg(before) - 10


def test_a_person_has_a_face_and_a_close_up_none() -> None:
    try:
        finder = face_finder(required=True)
    except (InvalidArgument, ImportError) as missing:
        pytest.skip(str(missing))
    signer = make_signer(0, options=SignerOptions(sleeve="short"))
    person = draw_gesture(signer, "pinch", view="person", size_px=(416, 312), num_frames=3)
    close = draw_gesture(signer, "pinch", view="hand", size_px=(416, 312), num_frames=3)
    assert finder.find(person[0]) is not None
    assert finder.find(close[0]) is None


def test_what_cannot_be_drawn_is_refused() -> None:
    signer = make_signer(0)
    with pytest.raises(InvalidArgument, match=r"'wave' cannot be drawn; known are pinch, zoom"):
        draw_gesture(signer, "wave")
    with pytest.raises(InvalidArgument, match="view is 'room'"):
        draw_gesture(signer, "pinch", view="room")
    with pytest.raises(InvalidArgument, match="num_frames 2"):
        draw_gesture(signer, "pinch", num_frames=2)


def test_study_leaves_the_tested_signer_out(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(drawn_gestures, "NUM_SIGNERS", 2)
    monkeypatch.setattr(drawn_gestures, "FPS", 5.0)
    monkeypatch.setattr(drawn_gestures, "SIZE_PX", (160, 120))
    fitted: list[int] = []
    fit = drawn_gestures._fit

    def counted(use_faces: bool, clips: drawn_gestures.Labelled) -> object:
        fitted.append(len(clips[0]))
        return fit(use_faces, clips)

    monkeypatch.setattr(drawn_gestures, "_fit", counted)
    (tmp_path / "webcam_gestures").mkdir()
    study = studies.get_study("drawn-gestures")
    only = {"trained_on": ["drawn hands"], "pictures": ["hand alone"], "faces": ["never"]}
    result = studies.run_study(study, tmp_path, lambda *progress: None, only)
    (row,) = result["rows"]
    assert fitted == [len(GESTURES)] * 2
    assert list(row["per_fold"]) == ["signer 1", "signer 2"] and result["synthetic"] is True
    assert row["accuracy_mean"] > 3 / len(GESTURES)
