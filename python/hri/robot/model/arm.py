# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""One arm of HOAP-2 in closed form: where its hand is, and the joint angles that bring it to a place.

Everything is computed for the left arm; the right arm is its mirror image. Places are in metres from the
shoulder: x forward, y outwards (away from the body), z up. Arrays of any leading shape go through at once.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import InvalidArgument
from hri.robot.model.joints import HOAP2, JointTable

Floats = NDArray[np.float64]
Side = Literal["left", "right"]
SIDES: tuple[Side, Side] = ("left", "right")

HAND_M = 0.03
"""From the wrist to the middle of the hand, on the forearm's line: turning the hand does not move it."""
MIRROR = np.array([1.0, -1.0, -1.0, 1.0])
"""Angles of the right arm by those of the left arm that is its mirror image."""
_AXES = ((0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0))


@dataclass(frozen=True)
class Arm:
    """Lengths and limits of an arm.

    Attributes
    ----------
    names : tuple of str
        Shoulder pitch, shoulder abduction, twist of the upper arm, elbow.
    shoulder_m : ndarray of float64, shape (3,)
        In the frame of the robot's base (y to the left).
    upper_m, fore_m : float
        Shoulder to elbow, elbow to the middle of the hand.
    limits_rad : ndarray of float64, shape (4, 2)
        As for a left arm.
    """

    names: tuple[str, ...]
    shoulder_m: Floats
    upper_m: float
    fore_m: float
    limits_rad: Floats

    @property
    def reach_m(self) -> float:
        """Length of the straight arm."""
        return self.upper_m + self.fore_m

    def within(self, angles_rad: Floats, margin_rad: float = 0.0) -> NDArray[np.bool_]:
        """Whether all four angles keep this margin from their limits; the last axis goes."""
        low, high = self.limits_rad[:, 0] + margin_rad, self.limits_rad[:, 1] - margin_rad
        return np.all((angles_rad >= low) & (angles_rad <= high), axis=-1)


def arm_of(side: Side, table: JointTable = HOAP2) -> Arm:
    """Read an arm off the joint table.

    Raises
    ------
    InvalidArgument
        For a robot whose arms are built otherwise: the formulas here would not hold.
    """
    letter = side[0]
    names = tuple(f"{letter}arm_joint_{number}" for number in range(1, 5))
    wrist_name = f"{letter}arm_joint_5"
    if not {*names, wrist_name}.issubset(table.names):
        raise InvalidArgument(f"{table.name}'s arms are not built as HOAP-2's: it cannot move them as a person does")
    joints = [table[name] for name in names]
    wrist = table[wrist_name]
    if tuple(joint.axis for joint in joints) != _AXES or joints[3].origin_m[1:] != (0.0, 0.0):
        raise InvalidArgument(f"the {side} arm of {table.name} does not turn about y, z, x, y")
    limits = np.array([(joint.lower_rad, joint.upper_rad) for joint in joints])
    if side == "right":
        limits = np.sort(limits * MIRROR[:, np.newaxis], axis=1)
    return Arm(names, np.array(joints[0].origin_m), joints[3].origin_m[0], wrist.origin_m[0] + HAND_M, limits)


def arm_points(arm: Arm, angles_rad: Floats) -> tuple[Floats, Floats]:
    """Elbow and hand for angles of shape (..., 4); each of shape (..., 3)."""
    pitch, out, twist, bend = (angles_rad[..., i] for i in range(4))
    elbow = arm.upper_m * _turned(np.cos(out), np.sin(out), np.zeros_like(out), pitch)
    # The forearm in the upper arm's frame before the shoulder turns it.
    along, across = np.cos(bend), -np.sin(bend)
    side, up = -np.sin(twist) * across, np.cos(twist) * across
    x, y = np.cos(out) * along - np.sin(out) * side, np.sin(out) * along + np.cos(out) * side
    return elbow, elbow + arm.fore_m * _turned(x, y, up, pitch)


def arm_angles(arm: Arm, hand_m: Floats, swivel_rad: Floats) -> Floats:
    """Angles that bring the hand to a place, the elbow turned about the line from shoulder to hand.

    Parameters
    ----------
    hand_m : ndarray, shape (..., 3)
        Beyond the arm's reach the arm points there, straight; nearer than it can bend, the elbow angle
        is beyond its limit.
    swivel_rad : ndarray, shape (...)
        0 with the elbow below that line, a quarter turn with it outwards.

    Returns
    -------
    ndarray of float64, shape (..., 4)
    """
    distance = np.linalg.norm(hand_m, axis=-1)
    line = hand_m / np.maximum(distance, 1e-9)[..., np.newaxis]
    reached = np.clip(distance, abs(arm.upper_m - arm.fore_m) + 1e-9, arm.reach_m)
    along = (arm.upper_m**2 - arm.fore_m**2 + reached**2) / (2.0 * reached)
    height = np.sqrt(np.maximum(arm.upper_m**2 - along**2, 0.0))
    below = np.stack((line[..., 0] * line[..., 2], line[..., 1] * line[..., 2], line[..., 2] ** 2 - 1.0), axis=-1)
    below /= np.maximum(np.linalg.norm(below, axis=-1, keepdims=True), 1e-9)
    outwards = np.cross(line, below)
    turned = np.cos(swivel_rad)[..., np.newaxis] * below + np.sin(swivel_rad)[..., np.newaxis] * outwards
    elbow = along[..., np.newaxis] * line + height[..., np.newaxis] * turned
    return angles_of_points(arm, elbow, reached[..., np.newaxis] * line)


def angles_of_points(arm: Arm, elbow_m: Floats, hand_m: Floats) -> Floats:
    """Angles for an elbow and a hand that lie the arm's lengths apart; shape (..., 4)."""
    pitch = np.arctan2(-elbow_m[..., 2], elbow_m[..., 0])
    flat = np.hypot(elbow_m[..., 0], elbow_m[..., 2])
    out = np.arctan2(elbow_m[..., 1], flat)
    fore = (hand_m - elbow_m) / arm.fore_m
    x = np.cos(pitch) * fore[..., 0] - np.sin(pitch) * fore[..., 2]
    z = np.sin(pitch) * fore[..., 0] + np.cos(pitch) * fore[..., 2]
    side = -np.sin(out) * x + np.cos(out) * fore[..., 1]
    along = np.cos(out) * x + np.sin(out) * fore[..., 1]
    across = np.hypot(side, z)
    return np.stack((pitch, out, np.arctan2(-side, z), -np.arctan2(across, along)), axis=-1)


def _turned(x: Floats, y: Floats, z: Floats, pitch: Floats) -> Floats:
    """Turn vectors about y, x towards -z."""
    return np.stack((np.cos(pitch) * x + np.sin(pitch) * z, y, np.cos(pitch) * z - np.sin(pitch) * x), axis=-1)
