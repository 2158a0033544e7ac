# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What a robot does for each label, checked before a session begins."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import Any

from hri.core.errors import FormatError, InvalidArgument
from hri.core.phrases import phrase, phrase_of
from hri.robot import (
    NAO,
    Robot,
    Trajectory,
    command_trajectory,
    gesture_trajectory,
    load_gestures,
    nao_gesture_trajectory,
    needs_feet,
)
from hri.session.mover import Motion


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
        In place of what `slots` say and of gestures of the same name.
    slots : mapping of str to mapping
        Of labels that are commands of several words.
    """
    found: dict[str, Motion] = {}
    refused: dict[str, str] = {}
    for label in sorted(labels):
        if given is None and not slots.get(label) and label not in load_gestures():
            refused[label] = phrase("no_gesture_of_name")
        elif given is not None and label not in given:
            refused[label] = phrase("in_no_motion")
        else:
            try:
                motion = given[label] if given is not None else _own_motion(label, robot, slots)
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
    own = nao_gesture_trajectory if robot.table.name == NAO.name else gesture_trajectory
    filled = slots.get(label)
    return command_trajectory(filled, robot.table, own) if filled else own(label)


def vocabulary_of(*recognisers: Any) -> set[str]:
    """The labels of all recognisers that are there."""
    return {str(label) for one in recognisers if one is not None for label in one.classes_}
