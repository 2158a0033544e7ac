# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Joints that follow targets which are not known in advance, and can always come to rest in time."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
from numpy.typing import NDArray

from hri.robot.control.playing import running_mean
from hri.robot.model.joints import JointTable
from hri.robot.motion.rates import SMOOTHING_S
from hri.robot.motion.self_collision import self_collisions
from hri.robot.motion.trajectory import Trajectory

Floats = NDArray[np.float64]
IsClear = Callable[[Floats], bool]

_TICK_S = 0.01
_ROUNDING = 1.0 + 1e-9


class JointFollower:
    """Goes towards the newest target, within limits of position, speed and acceleration.

    What is sent is a plan, smoothed by the mean over 50 ms taken twice, as motions are (`control.playing`), and so
    50 ms late. At every tick the plan goes on only if everything that would still be sent is clear, should it brake
    right after; else it brakes now, along a way that was found clear at the tick before. So nothing is sent that is
    not clear, whatever the targets are.

    Parameters
    ----------
    begin_rad : ndarray, shape (joints,)
        Where the joints are, at rest.
    limits_rad : ndarray, shape (joints, 2)
        A target beyond them is taken as the limit.
    max_speed_rad_s, max_acceleration_rad_s2 : float
        Of every joint.
    step_s : float
        From one command to the next.
    is_clear : callable of ndarray of shape (rows, joints)
        Whether the joints may go through these positions, a tick apart.

    Attributes
    ----------
    tick_s : float
        From one decision to the next: about 10 ms, a multiple of `step_s`.
    """

    def __init__(
        self,
        begin_rad: Floats,
        limits_rad: Floats,
        max_speed_rad_s: float,
        max_acceleration_rad_s2: float,
        step_s: float,
        is_clear: IsClear,
    ) -> None:
        self._steps = max(1, round(_TICK_S / step_s))
        self.tick_s = self._steps * step_s
        # A joint that begins beyond a limit, by as little as is allowed, must not have to jump.
        self._low = np.minimum(limits_rad[:, 0], begin_rad)
        self._high = np.maximum(limits_rad[:, 1], begin_rad)
        self._most = max_speed_rad_s * self.tick_s
        self._change = max_acceleration_rad_s2 * self.tick_s**2
        self._is_clear = is_clear
        self._window = max(1, round(SMOOTHING_S / self.tick_s))
        self._plan = np.tile(begin_rad, (2 * self._window + 2, 1))  # as much as what is sent next is made of
        self._way = np.zeros(len(begin_rad))  # of the last tick

    @property
    def rests(self) -> bool:
        """Whether everything has been sent."""
        return not self._way.any() and bool((self._plan == self._plan[-1]).all())

    def tick(self, target_rad: Floats | None) -> Floats:
        """What is sent in the next `tick_s`.

        Parameters
        ----------
        target_rad : ndarray, shape (joints,), or None
            None: come to rest.

        Returns
        -------
        ndarray of float64, shape (tick_s / step_s, joints)
        """
        way = self._braked(self._way)
        if target_rad is not None:
            wanted = self._towards(target_rad)
            if self._is_clear(self._smoothed(np.vstack((self._plan, self._until_rest(wanted))))):
                way = wanted
        self._way = way
        self._plan = np.vstack((self._plan[1:], self._plan[-1] + way))
        fine = np.arange(self._steps * (len(self._plan) - 1) + 1) / self._steps
        row = np.minimum(fine.astype(np.intp), len(self._plan) - 2)
        part = (fine - row)[:, np.newaxis]
        rows = (1.0 - part) * self._plan[row] + part * self._plan[row + 1]
        window = self._steps * self._window
        return running_mean(running_mean(rows, window), window)[-self._steps :]

    def _towards(self, target_rad: Floats) -> Floats:
        """The longest ways of a tick after which joints can still rest at the target, and before their limits."""
        here = self._plan[-1]
        left = np.clip(target_rad, self._low, self._high) - here
        way = np.sign(left) * np.minimum(longest_way(np.abs(left), self._change), self._most)
        way = np.clip(way, self._way - self._change, self._way + self._change)
        # A joint that has to turn round first goes on a while, and must not meet its limit.
        room = np.maximum(np.where(way > 0.0, self._high - here, here - self._low), 0.0)
        way = np.sign(way) * np.minimum(np.abs(way), longest_way(room, self._change))
        return np.where(np.abs(way - self._way) <= self._change * _ROUNDING, way, self._braked(self._way))

    def _braked(self, way: Floats) -> Floats:
        return np.asarray(np.sign(way) * np.maximum(np.abs(way) - self._change, 0.0))

    def _until_rest(self, way: Floats) -> Floats:
        """The plan after this tick, all joints braking, until what is sent rests."""
        rows = [self._plan[-1] + way]
        while way.any():
            way = self._braked(way)
            rows.append(rows[-1] + way)
        return np.vstack((rows, np.tile(rows[-1], (2 * self._window, 1))))

    def _smoothed(self, plan: Floats) -> Floats:
        return running_mean(running_mean(plan, self._window), self._window)


def clear_of_itself(joint_names: tuple[str, ...], table: JointTable, others_rad: Mapping[str, float]) -> IsClear:
    """Whether no links overlap while these joints go through positions and the others stay where they are."""

    def is_clear(rows: Floats) -> bool:
        return not self_collisions(Trajectory(joint_names, _TICK_S, rows), table, others_rad, moved_alone=True)

    return is_clear


def longest_way(room: Floats, change: float) -> Floats:
    """The longest way of a tick after which ways that are shorter by `change` each end within the room, it included.

    n ways of change, 2 change, ..., n change are n (n + 1) / 2 change long; from a room of (n - 1) n / 2 change on
    there are n ways, of which the mean is the longest less (n - 1) / 2 change.
    """
    count = np.maximum(np.ceil(np.sqrt(0.25 + 2.0 * room / change) - 0.5 - 1e-12), 1.0)
    return np.asarray(room / count + change * (count - 1.0) / 2.0)
