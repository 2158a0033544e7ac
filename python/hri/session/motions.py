# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What a robot does for each label, checked before a session begins."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from os import PathLike, fspath
from pathlib import Path
from typing import Any

from hri.core.errors import FormatError, InvalidArgument, IoError
from hri.core.files import read_toml
from hri.core.phrases import phrase, phrase_of
from hri.robot import (
    HOAP2,
    MOTION_SUFFIXES,
    NAO,
    JointTable,
    Robot,
    Trajectory,
    command_trajectory,
    gesture_trajectory,
    load_gestures,
    nao_gesture_trajectory,
    needs_feet,
    read_motion,
    require_safe,
)
from hri.session.mover import Motion


class LabelMotions(dict[str, Trajectory]):
    """Motions of some labels; a label that is not among them has what it has without them."""


def read_motions(path: str | PathLike[str], table: JointTable = HOAP2) -> LabelMotions:
    """Read which motion the robot makes for which label.

    Parameters
    ----------
    path : path-like
        TOML, a line a label: ``pinch = "small"``, a gesture by its name, or ``next = "motions/next.csv"``, a file with
        a motion (.csv, .json, .mcap), from the folder of this one.
    table : JointTable
        The robot.

    Returns
    -------
    LabelMotions
        For ``Session(motions=)``. Each motion has passed the check.

    Raises
    ------
    FormatError
        Names the file and the label: what is neither a gesture's name nor a file, a gesture that there is not or that
        the robot cannot make, a motion that the check finds errors in.
    IoError
        For a file that cannot be read.
    """
    found = LabelMotions()
    for label, value in read_toml(path).items():
        where = f"{fspath(path)}: {label}"
        if not isinstance(value, str) or not value:
            raise FormatError(f'{where}: must be the name of a gesture or of a file, as in {label} = "wave"')
        try:
            if Path(value).suffix.lower() in MOTION_SUFFIXES:
                place = Path(path).parent / value
                motion = read_motion(place, table)
                require_safe(motion, table, fspath(place))
            else:
                motion = _own_gesture(value, table)
        except (FormatError, InvalidArgument) as error:
            raise FormatError(f"{where}: {error}") from error
        except IoError as error:
            raise IoError(f"{where}: {error}") from error
        found[label] = motion
    if not found:
        raise FormatError(f"{fspath(path)}: names no label")
    return found


def prepared_motions(
    robot: Robot,
    labels: Collection[str],
    given: Mapping[str, Motion] | None,
    slots: Mapping[str, Mapping[str, str]],
) -> tuple[dict[str, Motion], dict[str, str]]:
    """Motions by label, and why the others have none.

    Parameters
    ----------
    robot : Robot
    labels : collection of str
    given : mapping of str to Trajectory or Guided, optional
        In place of what `slots` say and of gestures of the same name; `LabelMotions` for their labels only.
    slots : mapping of str to mapping
        Of labels that are commands of several words.
    """
    found: dict[str, Motion] = {}
    refused: dict[str, str] = {}
    chosen: Mapping[str, Motion] = given if given is not None else {}
    by_name = given is None or isinstance(given, LabelMotions)
    for label in sorted(labels):
        if label not in chosen and not by_name:
            refused[label] = phrase("in_no_motion")
        elif label not in chosen and not slots.get(label) and label not in load_gestures():
            refused[label] = phrase("no_gesture_of_name")
        else:
            try:
                motion = chosen[label] if label in chosen else _own_motion(label, robot, slots)
                if isinstance(motion, Trajectory):
                    if needs_feet(motion) and not robot.on_feet:
                        raise InvalidArgument(phrase("torso_held"))
                    robot.prepare(motion)
                found[label] = motion
            except (FormatError, InvalidArgument) as error:
                refused[label] = phrase_of(error)
    return found, refused


def _own_motion(label: str, robot: Robot, slots: Mapping[str, Mapping[str, str]]) -> Trajectory:
    """By the slots of a command, or the gesture of this name."""
    filled = slots.get(label)
    if filled:
        return command_trajectory(filled, robot.table, lambda name: _own_gesture(name, robot.table))
    return _own_gesture(label, robot.table)


def _own_gesture(name: str, table: JointTable) -> Trajectory:
    """As this robot makes it."""
    return nao_gesture_trajectory(name) if table.name == NAO.name else gesture_trajectory(name)


def vocabulary_of(*recognisers: Any) -> set[str]:
    """The labels of all recognisers that are there."""
    return {str(label) for one in recognisers if one is not None for label in one.classes_}
