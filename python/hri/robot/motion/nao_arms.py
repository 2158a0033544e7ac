# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Motions of HOAP-2's arms as NAO makes them: upper arms and forearms point the same way."""

from __future__ import annotations

import numpy as np

from hri.core.errors import InvalidArgument
from hri.robot.model.joints import HOAP2
from hri.robot.motion.trajectory import Trajectory

# NAO's elbow bends about z, HOAP-2's about y: a quarter turn of the upper arm takes one to the other.
_QUARTER = np.pi / 2.0
_SAME = {
    "larm_joint_1": ("LShoulderPitch", 1.0, 0.0),
    "larm_joint_2": ("LShoulderRoll", 1.0, 0.0),
    "larm_joint_3": ("LElbowYaw", 1.0, -_QUARTER),
    "larm_joint_4": ("LElbowRoll", 1.0, 0.0),
    "larm_joint_5": ("LWristYaw", 1.0, 0.0),
    "rarm_joint_1": ("RShoulderPitch", 1.0, 0.0),
    "rarm_joint_2": ("RShoulderRoll", 1.0, 0.0),
    "rarm_joint_3": ("RElbowYaw", 1.0, _QUARTER),
    "rarm_joint_4": ("RElbowRoll", -1.0, 0.0),
    "rarm_joint_5": ("RWristYaw", 1.0, 0.0),
    "head_joint_1": ("HeadYaw", 1.0, 0.0),
    "head_joint_2": ("HeadPitch", 1.0, 0.0),
}


def with_nao_arms(trajectory: Trajectory) -> Trajectory:
    """Give a motion of HOAP-2's arms and head to NAO's joints.

    Nothing is kept within NAO's limits: `check_trajectory(found, NAO)` reports whether NAO can make the motion, whose
    elbows bend less (88.5 degrees instead of 115) and arms rise less far to the side.

    Parameters
    ----------
    trajectory : Trajectory

    Raises
    ------
    InvalidArgument
        For a joint of HOAP-2's legs or waist, or another that HOAP-2 does not have.
    """
    strange = [name for name in trajectory.joint_names if name not in _SAME]
    for name in strange:
        HOAP2.index(name)
        raise InvalidArgument(f"{name} is no joint of an arm or the head")
    found = [_SAME[name] for name in trajectory.joint_names]
    signs = np.array([sign for _, sign, _ in found])
    turns = np.array([turn for _, _, turn in found])
    return Trajectory([name for name, _, _ in found], trajectory.period_s, trajectory.positions_rad * signs + turns)
