# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What a robot is sent, step by step, to carry out a motion: the approach to its first row, then it, both smoothed.

The mean over a window of 50 ms is taken twice. With that a motion between rows by straight lines has no corners, and
speed and acceleration at any moment are those that the check measures over 50 ms (`hri.robot.motion.rates`).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hri.robot.model.joints import JointTable
from hri.robot.motion.gestures import minimum_jerk
from hri.robot.motion.rates import SMOOTHING_S
from hri.robot.motion.trajectory import Trajectory

Floats = NDArray[np.float64]

_THERE_RAD = 1e-6
_FINEST_S = 0.001
_CHUNK = 512


@dataclass(frozen=True)
class Playback:
    """A motion from where the joints are.

    Attributes
    ----------
    begin_rad : ndarray, shape (joints,)
        Where they are.
    approach : Trajectory or None
        Leads to the motion's first row.
    trajectory : Trajectory
    """

    begin_rad: Floats
    approach: Trajectory | None
    trajectory: Trajectory

    @property
    def lead_s(self) -> float:
        """The joints begin to move this long before the unsmoothed motion does, and come to rest as long after it."""
        return SMOOTHING_S

    @property
    def approach_s(self) -> float:
        """From the begin of the approach to the motion's; between them is a rest, so that no smoothing reaches both."""
        return self.approach.duration_s + 2.0 * SMOOTHING_S if self.approach is not None else 0.0

    @property
    def duration_s(self) -> float:
        """Of approach and motion."""
        return self.approach_s + self.trajectory.duration_s

    def rows(self, step_s: float) -> Iterator[list[float]]:
        """Positions at every step, worked out in chunks: long motions need no memory, short ones no time."""
        finer = int(np.ceil(step_s / _FINEST_S - 1e-9))
        fine_s = step_s / finer
        window = max(1, round(SMOOTHING_S / fine_s))
        steps = int(np.ceil((self.duration_s + 2.0 * self.lead_s) / step_s - 1e-9)) + 1
        for first in range(0, steps, _CHUNK):
            last = min(first + _CHUNK, steps) - 1
            fine = np.arange(first * finer - window + 1, last * finer + window, dtype=np.float64)
            positions = self._unsmoothed(fine_s * fine - self.lead_s)
            yield from running_mean(running_mean(positions, window), window)[::finer].tolist()

    def _unsmoothed(self, times_s: Floats) -> Floats:
        rows = self.trajectory.at(times_s - self.approach_s)
        if self.approach is None:
            rows[times_s < 0.0] = self.begin_rad
        elif times_s[0] < self.approach_s:
            early = times_s < self.approach_s
            rows[early] = self.approach.at(times_s[early])
        return rows


def approach_to(trajectory: Trajectory, begin_rad: Floats, table: JointTable) -> Trajectory | None:
    """Go to the first row at no more than half the motors' speed and acceleration; None when the joints are there."""
    keys = np.stack((begin_rad, trajectory.positions_rad[0]))
    distance = float(np.abs(keys[1] - keys[0]).max())
    if distance < _THERE_RAD:
        return None
    fastest_s = 1.875 * distance / (0.5 * table.max_speed_rad_s)
    gentlest_s = np.sqrt(5.78 * distance / (0.5 * table.max_acceleration_rad_s2))
    duration_s = max(0.2, fastest_s, gentlest_s)
    times_s = 0.01 * np.arange(int(duration_s / 0.01) + 2, dtype=np.float64)
    positions = minimum_jerk(np.array([0.0, times_s[-1]]), keys, times_s)
    return Trajectory(trajectory.joint_names, 0.01, positions)


def running_mean(values: Floats, count: int) -> Floats:
    """Means of so many rows in succession."""
    sums = np.cumsum(np.vstack((np.zeros(values.shape[1]), values - values[0])), axis=0)
    means: Floats = values[0] + (sums[count:] - sums[:-count]) / count
    return means
