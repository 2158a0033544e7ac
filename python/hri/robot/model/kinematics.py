# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Forward kinematics: where the links are for given joint positions."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from hri.robot.model.joints import HOAP2, JointTable

Pose = NDArray[np.float64]


def rotation_about(axis: NDArray[np.float64], angle_rad: float) -> NDArray[np.float64]:
    """Rotation matrix about a unit axis (Rodrigues' formula), shape (3, 3)."""
    x, y, z = axis
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.eye(3) + np.sin(angle_rad) * cross + (1.0 - np.cos(angle_rad)) * (cross @ cross)


def roll_pitch_yaw(rotation: Pose) -> tuple[float, float, float]:
    """Angles about the fixed axes x, y and z, in this order, that make a rotation matrix."""
    roll = np.arctan2(rotation[2, 1], rotation[2, 2])
    pitch = np.arctan2(-rotation[2, 0], np.hypot(rotation[2, 1], rotation[2, 2]))
    yaw = np.arctan2(rotation[1, 0], rotation[0, 0])
    return float(roll), float(pitch), float(yaw)


def link_poses(
    positions_rad: Mapping[str, float], base: Pose | None = None, table: JointTable = HOAP2
) -> dict[str, Pose]:
    """Poses of all links in the world.

    Parameters
    ----------
    positions_rad : mapping from joint name to float
        Joints that are not in it are at 0.
    base : ndarray of float64, shape (4, 4), optional
        Pose of the base link; the default is upright at its standing height.

    Returns
    -------
    dict from link name to ndarray of float64, shape (4, 4)
        Homogeneous transforms from link to world, metres.
    """
    if base is None:
        base = np.eye(4)
        base[2, 3] = table.standing_height_m
    poses = {table.base.name: base}
    for joint in table.joints:
        local = np.eye(4)
        local[:3, :3] = rotation_about(np.array(joint.axis), positions_rad.get(joint.name, 0.0))
        local[:3, 3] = joint.origin_m
        poses[joint.child] = poses[joint.parent] @ local
    return poses
