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
from hri.robot.motion.reading import MOTION_SUFFIXES, read_motion, require_pulses
from hri.robot.motion.short_csv import check_short_csv, is_short_csv, require_safe_short_csv
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
    suffix = Path(motion).suffix.lower()
    return motion not in load_gestures() and (suffix in MOTION_SUFFIXES or Path(motion).is_file())


def findings_of(motion: str, table: JointTable) -> list[Finding]:
    """What is amiss in a motion, with the rows and columns of its file. Raises as `named_motion` does."""
    if not is_file(motion) or is_message(motion):
        return check_trajectory(named_motion(motion, table), table)
    if is_short_csv(motion):
        return check_short_csv(motion, table)
    require_pulses(motion, table)
    return check_pulse_csv(motion)


def named_motion(motion: str, table: JointTable) -> Trajectory:
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
        return read_motion(motion, table)
    return gesture_trajectory(motion) if table is HOAP2 else nao_gesture_trajectory(motion)  # errors name the gestures


def require_safe_motion(trajectory: Trajectory, table: JointTable, motion: str) -> None:
    """As `require_safe`; the short form has rows and columns of its own."""
    if is_file(motion) and not is_message(motion) and is_short_csv(motion):
        require_safe_short_csv(motion, table)
    require_safe(trajectory, table, motion)
