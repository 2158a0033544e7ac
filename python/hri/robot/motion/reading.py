# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Motions in files of every form that hri reads."""

from __future__ import annotations

from os import PathLike, fspath
from pathlib import Path

from hri.core.errors import InvalidArgument
from hri.robot.model.joints import HOAP2, JointTable
from hri.robot.motion.joint_trajectory import SUFFIXES as MESSAGE_SUFFIXES
from hri.robot.motion.joint_trajectory import read_joint_trajectory
from hri.robot.motion.pulse_csv import read_pulse_csv
from hri.robot.motion.short_csv import is_short_csv, read_short_csv
from hri.robot.motion.trajectory import Trajectory

MOTION_SUFFIXES = (".csv", ".tsv", *MESSAGE_SUFFIXES)


def read_motion(path: str | PathLike[str], table: JointTable = HOAP2) -> Trajectory:
    """Read a motion of a robot: pulses or the short form (.csv, .tsv), or a message of ROS (.json, .mcap).

    It is read, and not checked: `require_safe` does that.

    Raises
    ------
    InvalidArgument
        For pulses of another robot than HOAP-2.
    TrajectoryError, FormatError, IoError
        As of `read_pulse_csv`, `read_short_csv` and `read_joint_trajectory`.
    """
    if Path(path).suffix.lower() in MESSAGE_SUFFIXES:
        return read_joint_trajectory(path)
    if is_short_csv(path):
        return read_short_csv(path, table)
    require_pulses(path, table)
    return read_pulse_csv(path)


def require_pulses(path: str | PathLike[str], table: JointTable) -> None:
    """Raise InvalidArgument for a file of pulses where the robot is not HOAP-2."""
    if table is not HOAP2:
        raise InvalidArgument(f"{fspath(path)}: pulses are HOAP-2's, {table.name} has the short form")
