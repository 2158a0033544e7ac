# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The skeleton of a right hand and the ten signs for the digits.

Units: the length of the hand, wrist to middle fingertip, is about 1. The palm faces the viewer
(+z), the wrist is at the origin, fingers point up (+y), the thumb is on the right (+x). Fingers
bend towards the viewer.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

INDEX, MIDDLE, RING, LITTLE = range(4)
_KNUCKLES = np.array([[0.150, 0.475], [0.050, 0.490], [-0.050, 0.470], [-0.145, 0.425]])
_PHALANGES = np.array([[0.235, 0.140, 0.105], [0.260, 0.160, 0.110], [0.240, 0.150, 0.108], [0.185, 0.110, 0.095]])
_THUMB_BASE = np.array([0.105, 0.095, 0.025])
_THUMB_BONES = np.array([0.225, 0.175, 0.130])
_FAN_DEG = np.array([7.0, 1.0, -6.0, -15.0])

_STRAIGHT = (4.0, 5.0, 3.0)
_FIST = (72.0, 102.0, 62.0)
_HALF = (22.0, 28.0, 16.0)


@dataclass(frozen=True)
class HandShape:
    """Proportions of one person's hand, as factors near 1."""

    finger_length: float = 1.0
    finger_width: float = 1.0
    palm_width: float = 1.0
    thumb_length: float = 1.0


@dataclass(frozen=True)
class Thumb:
    """Where the thumb goes.

    Attributes
    ----------
    target : (float, float, float)
        Of its tip; an offset when `finger` is set.
    finger : int, optional
        The finger that is touched.
    joint : float
        Where on that finger, in joints: 3 is the tip, 1.5 the middle of the middle bone.
    metacarpal : (float, float, float)
        Direction of its first bone.
    """

    target: tuple[float, float, float]
    finger: int | None = None
    joint: float = 3.0
    metacarpal: tuple[float, float, float] = (0.60, 0.75, 0.35)


@dataclass(frozen=True)
class HandPose:
    """Bend of the fingers (degrees at knuckle, middle, end joint), their fan, thumb, and a turn."""

    bends: tuple[tuple[float, float, float], ...]
    thumb: Thumb
    fan: float = 1.0
    turn_deg: float = 0.0  # about the forearm, before any jitter


@dataclass(frozen=True)
class Skeleton:
    """Joints in space.

    Attributes
    ----------
    fingers : (4, 4, 3)
        Knuckle, middle joint, end joint, tip, of index to little finger.
    thumb : (4, 3)
    palm_sides : (4, 3, 3)
        Unit vector out of the palm side of every finger bone.
    turn : (3, 3)
        Rotation that has been applied.
    """

    fingers: Array
    thumb: Array
    palm_sides: Array
    turn: Array

    def rotated(self, matrix: Array) -> Skeleton:
        """Turned about the wrist."""
        return Skeleton(
            self.fingers @ matrix.T,
            self.thumb @ matrix.T,
            self.palm_sides @ matrix.T,
            matrix @ self.turn,
        )


def _touching(finger: int, bend: tuple[float, float, float]) -> HandPose:
    bends = [_STRAIGHT] * 4
    bends[finger] = bend
    return HandPose(
        tuple(bends),
        Thumb((0.0, -0.02, 0.02), finger, 2.9, metacarpal=(0.45, 0.70, 0.55)),
        fan=1.15,
    )


_OUT = Thumb((0.475, 0.455, 0.06), metacarpal=(0.72, 0.66, 0.20))
_ACROSS = Thumb((-0.035, 0.335, 0.145), metacarpal=(0.42, 0.72, 0.55))
RELAXED = HandPose((_HALF,) * 4, Thumb((0.30, 0.48, 0.16)), fan=0.6)
DIGIT_POSES: dict[str, HandPose] = {
    "0": HandPose(
        ((48.0, 46.0, 30.0), (50.0, 46.0, 32.0), (48.0, 46.0, 32.0), (44.0, 46.0, 30.0)),
        Thumb((0.0, -0.045, 0.0), INDEX, 3.0, metacarpal=(0.25, 0.45, 0.85)),
        fan=0.35,
        turn_deg=72.0,
    ),
    "1": HandPose(
        (_STRAIGHT, _FIST, _FIST, _FIST),
        Thumb((-0.01, 0.0, 0.085), MIDDLE, 1.6, metacarpal=(0.40, 0.68, 0.60)),
    ),
    "2": HandPose(
        (_STRAIGHT, _STRAIGHT, _FIST, _FIST),
        Thumb((0.02, 0.0, 0.085), RING, 1.6, metacarpal=(0.35, 0.66, 0.66)),
        fan=1.7,
    ),
    "3": HandPose((_STRAIGHT, _STRAIGHT, _FIST, _FIST), _OUT, fan=1.5),
    "4": HandPose((_STRAIGHT,) * 4, _ACROSS, fan=1.2),
    "5": HandPose((_STRAIGHT,) * 4, _OUT, fan=1.6),
    "6": _touching(LITTLE, (58.0, 72.0, 34.0)),
    "7": _touching(RING, (60.0, 74.0, 36.0)),
    "8": replace(_touching(MIDDLE, (54.0, 74.0, 34.0)), turn_deg=12.0),
    "9": replace(_touching(INDEX, (40.0, 68.0, 30.0)), turn_deg=26.0),
}
"""The counting signs: 1 to 5 show as many fingers, 6 to 9 touch the thumb, little finger first."""


def varied(pose: HandPose, rng: np.random.Generator, amount_deg: float = 4.0) -> HandPose:
    """The pose as another person, or the same one at another time, would show it."""

    def moved(bend: tuple[float, float, float]) -> tuple[float, float, float]:
        knuckle, middle, end = np.maximum(np.add(bend, rng.normal(0, amount_deg, 3)), 0.0)
        return float(knuckle), float(middle), float(end)

    bends = tuple(moved(bend) for bend in pose.bends)
    turn = pose.turn_deg + rng.normal(0, 1.5 * amount_deg)
    return replace(pose, bends=bends, fan=pose.fan * rng.uniform(0.8, 1.2), turn_deg=turn)


def make_skeleton(pose: HandPose, shape: HandShape) -> Skeleton:
    """Place the joints."""
    fingers = np.zeros((4, 4, 3))
    sides = np.zeros((4, 3, 3))
    for finger in range(4):
        fan = np.deg2rad(_FAN_DEG[finger] * pose.fan)
        up = np.array([np.sin(fan), np.cos(fan), 0.0])
        front = np.array([0.0, 0.0, 1.0])
        fingers[finger, 0, :2] = _KNUCKLES[finger] * (shape.palm_width, 1.0)
        angles = np.cumsum(np.deg2rad(pose.bends[finger]))
        for bone, angle in enumerate(angles):
            direction = np.cos(angle) * up + np.sin(angle) * front
            sides[finger, bone] = np.cos(angle) * front - np.sin(angle) * up
            reach = _PHALANGES[finger, bone] * shape.finger_length
            fingers[finger, bone + 1] = fingers[finger, bone] + reach * direction
    thumb = _thumb_joints(pose.thumb, fingers, shape)
    skeleton = Skeleton(fingers, thumb, sides, np.eye(3))
    return skeleton.rotated(rotation(yaw_deg=pose.turn_deg))


def blend(first: Skeleton, second: Skeleton, amount: float) -> Skeleton:
    """Between two skeletons; 0 is the first, 1 the second."""

    def mix(a: Array, b: Array) -> Array:
        return (1.0 - amount) * a + amount * b

    left, _, right = np.linalg.svd(mix(first.turn, second.turn))
    return Skeleton(
        mix(first.fingers, second.fingers),
        mix(first.thumb, second.thumb),
        mix(first.palm_sides, second.palm_sides),
        left @ right,
    )


def _thumb_joints(thumb: Thumb, fingers: Array, shape: HandShape) -> Array:
    target = np.array(thumb.target)
    if thumb.finger is not None:
        low = min(int(thumb.joint), 2)
        part = thumb.joint - low
        chain = fingers[thumb.finger]
        target = target + (1 - part) * chain[low] + part * chain[low + 1]
    base = _THUMB_BASE * (shape.palm_width, 1.0, 1.0)
    bones = _THUMB_BONES * shape.thumb_length
    direction = np.array(thumb.metacarpal)
    knuckle = base + bones[0] * direction / np.linalg.norm(direction)
    # Two bones from the knuckle to the target; they stretch a little where it is out of reach.
    line = target - knuckle
    distance = float(np.linalg.norm(line))
    line /= distance
    total = bones[1] + bones[2]
    if distance >= 0.995 * total:
        bones = bones * (distance / total) * 1.005
    a, b = bones[1], bones[2]
    along = (a**2 - b**2 + distance**2) / (2 * distance)
    off = np.sqrt(max(a**2 - along**2, 0.0))
    pole = np.array([0.75, 0.45, 0.45])
    pole -= line * (pole @ line)
    pole /= np.linalg.norm(pole)
    return np.stack([base, knuckle, knuckle + along * line + off * pole, target])


def rotation(yaw_deg: float = 0.0, pitch_deg: float = 0.0, roll_deg: float = 0.0) -> Array:
    """Turn about y (yaw), then x (pitch), then z (roll), each seen against its axis."""
    yaw, pitch, roll = np.deg2rad([yaw_deg, pitch_deg, roll_deg])
    cy, sy, cp, sp, cr, sr = (
        *(np.cos(yaw), np.sin(yaw)),
        *(np.cos(pitch), np.sin(pitch)),
        *(np.cos(roll), np.sin(roll)),
    )
    about_y = np.array([[cy, 0, sy], [0, 1, 0], [-sy, 0, cy]])
    about_x = np.array([[1, 0, 0], [0, cp, -sp], [0, sp, cp]])
    about_z = np.array([[cr, -sr, 0], [sr, cr, 0], [0, 0, 1]])
    return np.asarray(about_z @ about_x @ about_y)
