# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What a robot is sent, step by step, to carry out a motion: first the approach to its first row."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from hri.robot.model.joints import JointTable
from hri.robot.motion.gestures import minimum_jerk
from hri.robot.motion.trajectory import Trajectory

Floats = NDArray[np.float64]

_NEAR_RAD = 0.01
_CHUNK = 512


def approach_to(trajectory: Trajectory, begin: Floats, table: JointTable) -> Trajectory | None:
    """Go to the first row at no more than half the motors' speed and acceleration; None when the joints are there."""
    keys = np.stack((begin, trajectory.positions_rad[0]))
    distance = float(np.abs(keys[1] - keys[0]).max())
    if distance < _NEAR_RAD:
        return None
    fastest_s = 1.875 * distance / (0.5 * table.max_speed_rad_s)
    gentlest_s = np.sqrt(5.78 * distance / (0.5 * table.max_acceleration_rad_s2))
    duration_s = max(0.2, fastest_s, gentlest_s)
    times_s = 0.01 * np.arange(int(duration_s / 0.01) + 2, dtype=np.float64)
    positions = minimum_jerk(np.array([0.0, times_s[-1]]), keys, times_s)
    return Trajectory(trajectory.joint_names, 0.01, positions)


def rows_to_send(approach: Trajectory | None, trajectory: Trajectory, step_s: float) -> Iterator[list[float]]:
    """Positions at every step, worked out in chunks: long motions need no memory, short ones no time."""
    approach_s = approach.duration_s if approach is not None else 0.0
    steps = round((approach_s + trajectory.duration_s) / step_s) + 1
    for first in range(0, steps, _CHUNK):
        times_s = step_s * np.arange(first, min(first + _CHUNK, steps), dtype=np.float64)
        rows = trajectory.at(times_s - approach_s)
        if approach is not None and times_s[0] < approach_s:
            rows = np.where((times_s < approach_s)[:, np.newaxis], approach.at(times_s), rows)
        yield from rows.tolist()
