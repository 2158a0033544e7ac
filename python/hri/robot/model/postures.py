# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""How the base must be turned, and how high it must be, for a robot to stand or lie on the floor."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from hri.core.errors import InvalidArgument
from hri.robot.model.joints import JointTable, Shape
from hri.robot.model.kinematics import Pose, link_poses, rotation_about

POSTURES = ("standing", "back", "front")
_CORNERS = np.array([(x, y, z) for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])


def require_posture(posture: str) -> None:
    """Raise InvalidArgument for a posture that is none of POSTURES."""
    if posture not in POSTURES:
        raise InvalidArgument(f"posture is {posture!r}, must be one of {', '.join(POSTURES)}")


def base_pose(positions_rad: Mapping[str, float], posture: str, table: JointTable) -> Pose:
    """Pose of the base link with which the robot rests on the floor, z = 0.

    Parameters
    ----------
    positions_rad : mapping of joint name to float
        Joints that are not in it are at 0.
    posture : "standing", "back" or "front"
        On its soles, which lie as flat as both can at once; or lying on its back or front.

    Returns
    -------
    ndarray of float64, shape (4, 4)
        Above the origin, facing along x; on the back the feet point there, on the front the head.
    """
    require_posture(posture)
    poses = link_poses(positions_rad, np.eye(4), table)
    base = np.eye(4)
    if posture == "standing":
        up = np.sum([poses[foot][:3, 2] for foot in table.feet], axis=0)
        base[:3, :3] = _turning_upright(up / np.linalg.norm(up))
    else:
        base[:3, :3] = rotation_about(np.array([0.0, 1.0, 0.0]), np.pi / (-2.0 if posture == "back" else 2.0))
    base[2, 3] = -min(_lowest(shape, base @ poses[name]) for name, link in table.links.items() for shape in link.solid)
    return base


def _turning_upright(up: Pose) -> Pose:
    """The smallest rotation that takes a unit vector to z."""
    axis = np.cross(up, (0.0, 0.0, 1.0))
    sine = float(np.linalg.norm(axis))
    if sine < 1e-12:
        return np.eye(3) if up[2] > 0.0 else rotation_about(np.array([1.0, 0.0, 0.0]), np.pi)
    return rotation_about(axis / sine, float(np.arctan2(sine, up[2])))


def _lowest(shape: Shape, pose: Pose) -> float:
    """Height of the lowest point of a shape."""
    points = np.array((shape.start, shape.end)) if shape.kind != "box" else shape.start + _CORNERS * shape.size
    return float((points @ pose[2, :3]).min() + pose[2, 3]) - shape.radius
