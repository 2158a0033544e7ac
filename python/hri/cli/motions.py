# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Motions as the commands of ``hri robot`` name them: gestures, and files of every form."""

from __future__ import annotations

from pathlib import Path

import click

from hri.core.errors import InvalidArgument
from hri.media import kind_of_file
from hri.robot.model.joints import HOAP2, ROBOTS, JointTable
from hri.robot.motion.checks import check_pulse_csv, check_trajectory, require_safe
from hri.robot.motion.gestures import gesture_trajectory, load_gestures
from hri.robot.motion.joint_trajectory import SUFFIXES as MESSAGE_SUFFIXES
from hri.robot.motion.joint_trajectory import read_joint_trajectory
from hri.robot.motion.pulse_csv import read_pulse_csv
from hri.robot.motion.short_csv import check_short_csv, is_short_csv, read_short_csv, require_safe_short_csv
from hri.robot.motion.trajectory import Finding, Trajectory
from hri.robot.nao.gestures import nao_gesture_trajectory

robot_option = click.option(
    "--robot",
    "table",
    type=click.Choice(tuple(ROBOTS)),
    default="hoap2",
    show_default=True,
    callback=lambda context, option, name: ROBOTS[name],
    help="NAO makes the gestures with its own arms, and motions in the short form.",
)


def is_message(path: str | Path) -> bool:
    """Whether a file is a JointTrajectory of ROS 2, by its suffix."""
    return Path(path).suffix.lower() in MESSAGE_SUFFIXES


def is_file(motion: str) -> bool:
    """Whether a motion is a file, and no name of a gesture."""
    suffixes = (".csv", ".tsv", *MESSAGE_SUFFIXES)
    return motion not in load_gestures() and (Path(motion).suffix.lower() in suffixes or Path(motion).is_file())


def findings_of(motion: str, table: JointTable) -> list[Finding]:
    """What is amiss in a motion, with the rows and columns of its file. Raises as `read_motion` does."""
    if not is_file(motion) or is_message(motion):
        return check_trajectory(read_motion(motion, table), table)
    if is_short_csv(motion):
        return check_short_csv(motion, table)
    require_pulses(motion, table)
    return check_pulse_csv(motion)


def require_pulses(file: str | Path, table: JointTable) -> None:
    """Raise InvalidArgument for a robot whose motions are no pulses."""
    if table is not HOAP2:
        raise InvalidArgument(f"{file}: pulses are HOAP-2's, {table.name} has the short form")


def read_motion(motion: str, table: JointTable) -> Trajectory:
    """The gesture of that name, or the motion in a file.

    Raises
    ------
    InvalidArgument
        For a name that is no gesture, and a recording.
    FormatError, IoError
        For a file that holds no motion, or cannot be read.
    """
    kind = kind_of_file(Path(motion)) if motion not in load_gestures() else ""
    if kind:
        raise InvalidArgument(
            f"{motion} is {kind}, and no motion: a gesture's name, or a file .csv, .tsv, .json or .mcap"
        )
    if is_file(motion):
        if is_message(motion):
            return read_joint_trajectory(motion)
        if is_short_csv(motion):
            return read_short_csv(motion, table)
        require_pulses(motion, table)
        return read_pulse_csv(motion)
    return gesture_trajectory(motion) if table is HOAP2 else nao_gesture_trajectory(motion)  # errors name the gestures


def require_safe_motion(trajectory: Trajectory, table: JointTable, motion: str) -> None:
    """As `require_safe`; the short form has rows and columns of its own."""
    if is_file(motion) and not is_message(motion) and is_short_csv(motion):
        require_safe_short_csv(motion, table)
    require_safe(trajectory, table, motion)
