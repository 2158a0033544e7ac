# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""One leg of HOAP-2 in closed form: the joint angles that hold its sole level, below an upright body, at a place."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import InvalidArgument
from hri.robot.model.arm import Side
from hri.robot.model.joints import HOAP2, JointTable

Floats = NDArray[np.float64]

_NUMBERS = (1, 3, 2, 4, 5, 6)
"""Of the joints from the hip down: hip yaw, pitch and roll, knee, ankle pitch and roll."""
_AXES = ((0.0, 0.0, 1.0), (0.0, 1.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 1.0, 0.0), (1.0, 0.0, 0.0))


@dataclass(frozen=True)
class Leg:
    """Lengths of a leg.

    Attributes
    ----------
    names : tuple of str
        Hip yaw, pitch and roll, knee, ankle pitch and roll.
    hip_m : ndarray of float64, shape (3,)
        In the frame of the robot's base, while the waist is at 0.
    bone_m : float
        Of thigh and shin alike.
    """

    names: tuple[str, ...]
    hip_m: Floats
    bone_m: float


def leg_of(side: Side, table: JointTable = HOAP2) -> Leg:
    """Read a leg off the joint table.

    Raises
    ------
    InvalidArgument
        For a robot whose legs are built otherwise: the formulas here would not hold.
    """
    names = tuple(f"{side[0]}leg_joint_{number}" for number in _NUMBERS)
    if any(name not in table.names for name in names):
        raise InvalidArgument(f"{table.name} has no legs of HOAP-2's kind")
    joints = [table[name] for name in names]
    bones = {-joints[3].origin_m[2], -joints[4].origin_m[2]}
    if tuple(joint.axis for joint in joints) != _AXES or len(bones) != 1:
        raise InvalidArgument(f"the {side} leg of {table.name} does not turn about z, y, x, y, y, x")
    return Leg(names, np.array(joints[0].origin_m), bones.pop())


def leg_angles(leg: Leg, ankle_m: Floats) -> Floats:
    """Angles for an ankle at a place in the frame of the base, the sole parallel to the base and as it is turned.

    Parameters
    ----------
    ankle_m : ndarray, shape (..., 3)
        Below the hip.

    Returns
    -------
    ndarray of float64, shape (..., 6)
        In the order of ``leg.names``.

    Raises
    ------
    InvalidArgument
        For a place out of reach.
    """
    x, y, z = np.moveaxis(leg.hip_m - ankle_m, -1, 0)  # from the ankle to the hip
    distance = np.sqrt(x**2 + y**2 + z**2)
    if not (np.all(z > 0.0) and np.all(distance <= 2.0 * leg.bone_m + 1e-9)):
        raise InvalidArgument(f"the foot is out of reach: {distance.max():.3f} m from the hip")
    knee = 2.0 * np.arccos(np.minimum(distance / (2.0 * leg.bone_m), 1.0))
    roll = np.arctan2(y, z)  # the shin over the sole
    pitch = -0.5 * knee - np.arctan2(x, np.hypot(y, z))
    # The thigh is turned by -roll about x, then by -(knee + pitch) about y: the hip's yaw, pitch and roll make it.
    back = knee + pitch
    sin_roll, cos_roll, sin_back, cos_back = np.sin(roll), np.cos(roll), np.sin(back), np.cos(back)
    hip_yaw = np.arctan2(sin_roll * sin_back, cos_back)
    hip_pitch = -np.arcsin(cos_roll * sin_back)
    hip_roll = np.arctan2(-sin_roll, cos_roll * cos_back)
    return np.stack((hip_yaw, hip_pitch, hip_roll, knee, pitch, roll), axis=-1)
