# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Drawn people who perform eight moving gestures of one hand: close-ups of the hand, or persons with face and sleeves.

The gestures are pinch, zoom, two rotations and four swipes. Each begins with an open palm, takes a first pose and
goes over to a second one, while the arm hardly moves.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import InvalidArgument
from hri.core.optional import import_opencv
from hri.synthetic.drawing.hand import draw_hand
from hri.synthetic.drawing.hand_pose import (
    DIGIT_POSES,
    HandPose,
    Skeleton,
    Thumb,
    blend,
    make_skeleton,
    rotation,
    varied,
)
from hri.synthetic.drawing.height_field import HeightField, View
from hri.synthetic.drawing.light import Image, over, photograph, shade
from hri.synthetic.drawing.options import num_clip_frames
from hri.synthetic.drawing.room import draw_room, draw_wall
from hri.synthetic.drawing.scene import RAISED_ELBOW, Scene, arm_look
from hri.synthetic.drawing.signer import Signer

Frame = NDArray[np.uint8]
Angles = tuple[float, float, float]

VIEWS = ("hand", "person")
_CLIP_S = 3.6
_FIRST, _SECOND = (0.36, 0.45), (0.70, 0.82)
"""Parts of the clip in which the hand goes over to the first and to the second pose."""

_BENT = DIGIT_POSES["1"].bends[3]
_STRAIGHT = DIGIT_POSES["1"].bends[0]
_PALM = HandPose((_STRAIGHT,) * 4, Thumb((0.36, 0.50, 0.05), metacarpal=(0.66, 0.70, 0.25)), fan=0.3)
_SPREAD = DIGIT_POSES["5"]
_TWO = replace(DIGIT_POSES["3"], fan=0.2)
_FIST = HandPose((_BENT,) * 4, Thumb((0.30, 0.46, 0.12), metacarpal=(0.60, 0.72, 0.35)))
_CORNER = HandPose((_STRAIGHT, _BENT, _BENT, _BENT), _SPREAD.thumb)
_PINCHED = replace(DIGIT_POSES["9"], bends=(DIGIT_POSES["9"].bends[0], _BENT, _BENT, _BENT), turn_deg=0.0)


@dataclass(frozen=True)
class _Gesture:
    """Two poses of the hand, and how the second is turned: yaw, pitch and roll in degrees."""

    first: HandPose
    second: HandPose
    turn_deg: Angles = (0.0, 0.0, 0.0)


_GESTURES: dict[str, _Gesture] = {
    "pinch": _Gesture(_CORNER, _PINCHED),
    "zoom": _Gesture(_PINCHED, _CORNER),
    "rotateCW": _Gesture(_SPREAD, _SPREAD, (0.0, 0.0, 38.0)),
    "rotateCCW": _Gesture(_SPREAD, _SPREAD, (0.0, 0.0, -38.0)),
    "swipeUp": _Gesture(_FIST, _TWO),
    "swipeDown": _Gesture(_TWO, _FIST),
    "swipeLeft": _Gesture(_TWO, _TWO, (62.0, 0.0, -10.0)),
    "swipeRight": _Gesture(_TWO, _TWO, (0.0, 0.0, 45.0)),
}
GESTURES = tuple(_GESTURES)
"""The labels that can be drawn; rotations and swipes are named as those who perform them see them."""


def draw_gesture(
    signer: Signer,
    label: str,
    take: int = 0,
    seed: int = 0,
    view: str = "person",
    size_px: tuple[int, int] = (320, 240),
    num_frames: int | None = None,
) -> list[Frame]:
    """The signer performs the gesture with the right hand; equal arguments give equal pixels.

    Parameters
    ----------
    signer : Signer
        From `make_signer`, whose options say how long the sleeves are.
    label : str
        One of `GESTURES`.
    take : int
        Repetitions differ in poses, place and noise.
    seed : int
    view : "person" or "hand"
        The signer in a room, with face; or a close-up of the hand before a wall.
    size_px : (int, int)
        Width and height, at least 64 each; 4:3 looks best.
    num_frames : int, optional
        At least 3, at the signer's rate; by default 3.6 s at the usual tempo.

    Returns
    -------
    list of ndarray of uint8, shape (height, width, 3), BGR

    Raises
    ------
    InvalidArgument
        For a label or view that there is not, or a size or length too small.
    """
    if label not in _GESTURES:
        raise InvalidArgument(f"label {label!r} cannot be drawn; known are {', '.join(GESTURES)}")
    if view not in VIEWS:
        raise InvalidArgument(f"view is {view!r}, must be 'hand' or 'person'")
    width, height = size_px
    if num_frames is None:
        num_frames = num_clip_frames(_CLIP_S, signer.options)
    if width < 64 or height < 64 or num_frames < 3:
        raise InvalidArgument(f"size_px is {size_px} and num_frames {num_frames}, must be at least (64, 64) and 3")
    cv2 = import_opencv("to draw signs")
    rng = np.random.default_rng([seed, take, 3, *signer.name.encode(), *label.encode()])
    sharp = 2 if height <= 300 else 1
    make = _Close if view == "hand" else _Person
    scene = make(signer, height * sharp, width * sharp, rng, cv2)
    gesture = _GESTURES[label]
    poses = [make_skeleton(varied(pose, rng), signer.hand_shape) for pose in (_PALM, gesture.first, gesture.second)]
    lean = rng.normal(0, (4.0, 3.0, 4.0))
    asked = np.array(gesture.turn_deg) * rng.uniform(0.85, 1.15)
    sway = rng.uniform(0, 2 * np.pi, size=4)
    delay = rng.normal(0, 0.02, size=2)
    frames = []
    for index in range(num_frames):
        moment = index / (num_frames - 1)
        first, second = (_between(moment + late, *part) for late, part in zip(delay, (_FIRST, _SECOND), strict=True))
        wobble = np.sin(2 * np.pi * 0.6 * index / signer.options.fps + sway)
        yaw, pitch, roll = lean + (2.0, 1.5, 1.5) * wobble[:3] + second * asked
        turn = rotation(yaw, pitch, roll)
        shown = blend(blend(poses[0], poses[1], first), poses[2], second)
        picture = scene.with_hand(shown.rotated(turn), turn, 0.02 * float(wobble[3]))
        if sharp > 1:
            picture = cv2.resize(picture, size_px, interpolation=cv2.INTER_AREA)
        frames.append(photograph(picture, signer.camera, rng, cv2))
    return frames


def _between(moment: float, start: float, end: float) -> float:
    """0 before `start`, 1 after `end`, smooth between."""
    share = float(np.clip((moment - start) / (end - start), 0.0, 1.0))
    return share * share * (3.0 - 2.0 * share)


class _Person:
    """The signer with the forearm up beside the head."""

    def __init__(self, signer: Signer, height: int, width: int, rng: np.random.Generator, cv2: Any) -> None:
        self._scene = Scene(signer, height, width, rng, cv2)
        self._elbow = RAISED_ELBOW * (signer.build, 1, 1)
        self._still = rotation()

    def with_hand(self, skeleton: Skeleton, turn: NDArray[np.float64], drift: float) -> Image:
        """The picture with the hand; the forearm follows a third of its turn."""
        along = self._still + (turn - self._still) / 3
        return self._scene.with_arm(skeleton, self._elbow + np.array([drift, 0.0, 0.0]), along)


class _Close:
    """The hand and what is seen of its arm, before a wall."""

    def __init__(self, signer: Signer, height: int, width: int, rng: np.random.Generator, cv2: Any) -> None:
        self._signer, self._cv2, self._size = signer, cv2, (height, width)
        self._origin = (width * rng.uniform(0.44, 0.54), height * rng.uniform(0.78, 0.84))
        self._scale = height * rng.uniform(0.56, 0.64)
        if signer.options.background is None:
            self._wall = draw_wall(height, width, signer.wall, rng)
        else:
            self._wall = draw_room(height, width, signer.wall, signer.background, rng, cv2)

    def with_hand(self, skeleton: Skeleton, turn: NDArray[np.float64], drift: float) -> Image:
        """The picture with the hand, moved by `drift` hand lengths to the side."""
        field = HeightField(*self._size)
        view = View((self._origin[0] + drift * self._scale, self._origin[1]), self._scale)
        draw_hand(field, view, skeleton, self._signer.hand_shape, arm_look(self._signer), self._cv2)
        lit = shade(field, self._signer.light, 0.02 * self._scale, self._cv2)
        return over(self._wall, lit, field.part > 0)
