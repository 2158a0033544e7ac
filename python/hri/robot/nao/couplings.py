# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Limits of NAO that concern two joints: the shell keeps the head from nodding when turned; the hips' yaw is one."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from importlib import resources

import numpy as np
from numpy.typing import NDArray

from hri.core.files import parse_toml
from hri.robot.motion.checks import LIMIT_TOLERANCE_RAD
from hri.robot.motion.trajectory import Finding, Trajectory

_HIPS = ("LHipYawPitch", "RHipYawPitch")
COUPLED_JOINTS = frozenset(("HeadYaw", "HeadPitch", *_HIPS))


def head_pitch_range(yaw_rad: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The least and the greatest HeadPitch where HeadYaw is this."""
    yaws, least, most = _head_limits_rad().T
    return np.interp(yaw_rad, yaws, least), np.interp(yaw_rad, yaws, most)


@lru_cache(maxsize=1)
def _head_limits_rad() -> NDArray[np.float64]:
    text = resources.files("hri.robot.nao").joinpath("head.toml").read_text(encoding="utf-8")
    return np.radians(np.array(parse_toml(text, "head.toml")["pitch_limits_deg"], dtype=np.float64))


def coupling_findings(trajectory: Trajectory, others_rad: Mapping[str, float]) -> list[Finding]:
    """Errors of a motion of NAO that the limits of single joints do not show.

    Parameters
    ----------
    trajectory : Trajectory
    others_rad : mapping of joint name to float
        Where joints are that the motion does not name; a joint that is in neither is not looked at.

    Returns
    -------
    list of Finding
        The first row of each kind of fault.
    """
    found = []
    yaw, pitch = (_positions(trajectory, name, others_rad) for name in ("HeadYaw", "HeadPitch"))
    if yaw is not None and pitch is not None and {"HeadYaw", "HeadPitch"} & set(trajectory.joint_names):
        least, most = head_pitch_range(yaw)
        outside = np.flatnonzero((pitch < least - LIMIT_TOLERANCE_RAD) | (pitch > most + LIMIT_TOLERANCE_RAD))
        if len(outside):
            row = int(outside[0])
            turned, nods, low, high = np.degrees((yaw[row], pitch[row], least[row], most[row]))
            message = f"{nods:.1f} deg is outside {low:.1f} to {high:.1f} deg, where HeadYaw is {turned:.1f} deg"
            found.append(Finding(row + 1, "", "HeadPitch", f"{nods:.1f} deg", message))
    hips = [_positions(trajectory, name, others_rad) for name in _HIPS]
    if hips[0] is not None and hips[1] is not None and set(_HIPS) & set(trajectory.joint_names):
        apart = np.flatnonzero(np.abs(hips[0] - hips[1]) > LIMIT_TOLERANCE_RAD)
        if len(apart):
            row = int(apart[0])
            value = f"{np.degrees(hips[1][row] - hips[0][row]):.1f} deg"
            message = f"{_HIPS[1]} is {value} from {_HIPS[0]}, and one motor moves both"
            found.append(Finding(row + 1, "", _HIPS[1], value, message))
    return found


def _positions(trajectory: Trajectory, name: str, others_rad: Mapping[str, float]) -> NDArray[np.float64] | None:
    if name in trajectory.joint_names:
        return trajectory.positions_rad[:, trajectory.joint_names.index(name)]
    return np.full(len(trajectory), others_rad[name]) if name in others_rad else None
