# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What a robot does for a command with slots: a gesture, by this arm and so many times, or a walk of so many steps."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TypeVar

import numpy as np

from hri.core.errors import InvalidArgument
from hri.core.suggest import did_you_mean
from hri.robot.model.arm import MIRROR, SIDES
from hri.robot.model.joints import HOAP2, JointTable
from hri.robot.motion.gestures import gesture_trajectory
from hri.robot.motion.trajectory import Trajectory
from hri.robot.motion.walking import STEP_M, walking_trajectory

GESTURE, SIDE, TIMES, WALK, STEPS = "gesture", "side", "times", "walk", "steps"
SLOTS = {GESTURE: (GESTURE, SIDE, TIMES), WALK: (WALK, STEPS)}
"""By what there is to do: the slots that may stand beside it."""
MAX_TIMES = 10
_WAYS = {"forward": STEP_M, "backward": -STEP_M}
_STILL_RAD = 1e-3
T = TypeVar("T")


def command_trajectory(
    slots: Mapping[str, str],
    table: JointTable = HOAP2,
    gestures: Callable[[str], Trajectory] = gesture_trajectory,
) -> Trajectory:
    """The motion for the slots of a command.

    Parameters
    ----------
    slots : mapping of str to str
        ``gesture``, the name of a gesture, and if wanted ``side``, "left" or "right": which arm makes one that needs a
        single arm, and ``times``, 1 to `MAX_TIMES`. Or ``walk``, "forward" or "backward", and if wanted ``steps``, 1
        to 20. Other slots are refused.
    table : JointTable
        Only HOAP-2 walks and takes a side.
    gestures : callable of str
        The motion of a gesture; for NAO `nao_gesture_trajectory`.

    Raises
    ------
    InvalidArgument
        For slots that say nothing to do, or what cannot be done.
    """
    kind = next((name for name in SLOTS if name in slots), None)
    if kind is None:
        raise InvalidArgument(f"a command needs the slot '{GESTURE}' or '{WALK}', and has {', '.join(slots) or 'none'}")
    for slot in slots:
        if slot not in SLOTS[kind]:
            raise InvalidArgument(f"the slot '{slot}' says nothing about a {kind}; {did_you_mean(slot, SLOTS[kind])}")
    if kind == WALK:
        return walking_trajectory(_count(slots, STEPS), _one_of(slots, WALK, _WAYS), table)
    once = gestures(slots[GESTURE])
    if SIDE in slots:
        if table.name != HOAP2.name:
            raise InvalidArgument(f"the slot '{SIDE}' is for {HOAP2.name} alone")
        once = _by_arm(once, _one_of(slots, SIDE, {side: side for side in SIDES}), slots[GESTURE])
    times = _count(slots, TIMES)
    if times > MAX_TIMES:
        raise InvalidArgument(f"the slot '{TIMES}' is {times}, must lie in 1..{MAX_TIMES}")
    return Trajectory(once.joint_names, once.period_s, np.tile(once.positions_rad, (times, 1)))


def needs_feet(trajectory: Trajectory) -> bool:
    """Whether a motion moves legs: it makes sense only for a robot that stands on its feet."""
    return any("leg_" in name for name in trajectory.joint_names)


def mirrored(trajectory: Trajectory) -> Trajectory:
    """A motion of HOAP-2's arms and head with left and right exchanged."""
    names = trajectory.joint_names
    signs = {f"joint_{number}": sign for number, sign in enumerate([*MIRROR, -1.0], start=1)}
    columns = {}
    for name in names:
        limb, _, joint = name.partition("_")
        other = {"larm": "rarm", "rarm": "larm"}.get(limb, limb)
        if limb not in ("larm", "rarm", "head"):
            raise InvalidArgument(f"joint {name} is neither of an arm nor of the head")
        sign = signs[joint] if limb != "head" else {"joint_1": -1.0}.get(joint, 1.0)
        columns[f"{other}_{joint}"] = sign * trajectory.positions_rad[:, names.index(name)]
    ordered = names if set(names) == set(columns) else tuple(columns)
    return Trajectory(ordered, trajectory.period_s, np.stack([columns[name] for name in ordered], axis=1))


def _by_arm(trajectory: Trajectory, side: str, gesture: str) -> Trajectory:
    spans = dict(zip(trajectory.joint_names, np.ptp(trajectory.positions_rad, axis=0).tolist(), strict=True))
    moving = {own for own in SIDES if any(s > _STILL_RAD for n, s in spans.items() if n.startswith(f"{own[0]}arm_"))}
    if len(moving) != 1:
        raise InvalidArgument(f"the gesture '{gesture}' is not made by one arm: it has no side")
    return trajectory if side in moving else mirrored(trajectory)


def _one_of(slots: Mapping[str, str], slot: str, values: Mapping[str, T]) -> T:
    value = slots[slot]
    if value not in values:
        raise InvalidArgument(f"the slot '{slot}' is {value!r}, must be {' or '.join(values)}")
    return values[value]


def _count(slots: Mapping[str, str], slot: str) -> int:
    """A number that a slot holds; 1 without the slot."""
    text = slots.get(slot, "1")
    if not (text.isascii() and text.isdecimal() and len(text) <= 4 and int(text) >= 1):
        raise InvalidArgument(f"the slot '{slot}' is {text!r}, must be a whole number from 1")
    return int(text)
