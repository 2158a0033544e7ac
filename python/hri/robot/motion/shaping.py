# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Motions from motions: another rate, a spline through key poses, smoother, slower, one after another."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hri.core.errors import InvalidArgument
from hri.robot.model.joints import HOAP2, JointTable
from hri.robot.motion.gestures import minimum_jerk
from hri.robot.motion.rates import excess
from hri.robot.motion.trajectory import Trajectory

Floats = NDArray[np.float64]
_SLOWEST = 1000.0
_MOST_VALUES = 25_000_000
_BEYOND_REASON_RAD = 1e6
_FASTEST_OF_MINIMUM_JERK, _HARDEST_OF_MINIMUM_JERK = 1.875, 5.7736


def resample(trajectory: Trajectory, period_s: float) -> Trajectory:
    """The same motion with another period, between rows by straight lines; what is left of a last period is held."""
    _above_zero("period_s", period_s)
    rows = int(np.ceil(trajectory.duration_s / period_s - 1e-9)) + 1
    return Trajectory(trajectory.joint_names, period_s, trajectory.at(period_s * np.arange(rows, dtype=np.float64)))


def spline(
    joint_names: Sequence[str], key_times_s: ArrayLike, keys_rad: ArrayLike, period_s: float = 0.01
) -> Trajectory:
    """Pass through key poses along cubic pieces with continuous acceleration, at rest at both ends.

    Unlike minimum-jerk motion from key to key (`minimum_jerk`) the joints do not stop at the keys between.

    Parameters
    ----------
    joint_names : sequence of str
    key_times_s : array_like, shape (keys,)
        From 0, rising, at least two.
    keys_rad : array_like, shape (keys, joints)
    period_s : float
    """
    times, keys = np.asarray(key_times_s, dtype=np.float64), np.asarray(keys_rad, dtype=np.float64)
    _above_zero("period_s", period_s)
    if times.ndim != 1 or len(times) < 2 or times[0] != 0.0 or not (np.diff(times) > 0.0).all():
        raise InvalidArgument("key_times_s must be two or more times that rise from 0")
    if keys.shape != (len(times), len(joint_names)):
        raise InvalidArgument(f"keys_rad has shape {keys.shape}, must be ({len(times)}, {len(joint_names)})")
    speeds = _spline_speeds(times, keys)
    at = np.minimum(period_s * np.arange(int(np.ceil(times[-1] / period_s - 1e-9)) + 1), times[-1])
    piece = np.clip(np.searchsorted(times, at, "right") - 1, 0, len(times) - 2)
    length = (times[piece + 1] - times[piece])[:, np.newaxis]
    part = (at - times[piece])[:, np.newaxis] / length
    rows = (
        keys[piece] * (1 + 2 * part) * (1 - part) ** 2
        + keys[piece + 1] * part**2 * (3 - 2 * part)
        + length * part * (1 - part) * (speeds[piece] * (1 - part) - speeds[piece + 1] * part)
    )
    return Trajectory(joint_names, period_s, rows)


def _spline_speeds(times: Floats, keys: Floats) -> Floats:
    """Speeds at the keys for which the accelerations of adjoining pieces agree; 0 at both ends."""
    lengths = np.diff(times)
    matrix = np.eye(len(times))
    wanted = np.zeros_like(keys)
    slopes = np.diff(keys, axis=0) / lengths[:, np.newaxis]
    for key in range(1, len(times) - 1):
        before, after = 1.0 / lengths[key - 1], 1.0 / lengths[key]
        matrix[key, key - 1 : key + 2] = before, 2.0 * (before + after), after
        wanted[key] = 3.0 * (slopes[key - 1] * before + slopes[key] * after)
    return np.linalg.solve(matrix, wanted).astype(np.float64)


def smooth(trajectory: Trajectory, window_s: float) -> Trajectory:
    """Mean over a window about each row that narrows towards both ends, which stay as they are."""
    _above_zero("window_s", window_s)
    half = round(0.5 * window_s / trajectory.period_s)
    count = len(trajectory)
    rows = np.arange(count)
    reach = np.minimum(half, np.minimum(rows, count - 1 - rows))
    sums = np.concatenate((np.zeros((1, len(trajectory.joint_names))), np.cumsum(trajectory.positions_rad, axis=0)))
    means = (sums[rows + reach + 1] - sums[rows - reach]) / (2 * reach + 1)[:, np.newaxis]
    return Trajectory(trajectory.joint_names, trajectory.period_s, means)


def slow_to_limits(trajectory: Trajectory, table: JointTable = HOAP2) -> Trajectory:
    """Play the whole motion so much slower that no joint is too fast or accelerates too hard, as the check has it.

    The period stays; a motion within the limits comes back as it is.

    Raises
    ------
    InvalidArgument
        When a position is not finite, where the motion would take more than 1000 times as long, and for too many rows.
    """
    if not np.isfinite(trajectory.positions_rad).all():
        raise InvalidArgument("the motion cannot be slowed to the limits: a position is not finite")
    factor = 1.0
    slower = trajectory
    reasonable = np.clip(trajectory.positions_rad, -_BEYOND_REASON_RAD, _BEYOND_REASON_RAD)
    beyond = excess(reasonable.T, trajectory.period_s, table)
    while beyond > 1.0 + 1e-9:
        factor *= max(beyond, 1.001)
        if factor > _SLOWEST:
            raise InvalidArgument(
                f"the motion is too rough: within the limits it would last {factor:.0f} times as long"
            )
        rows = int(np.ceil(trajectory.duration_s * factor / trajectory.period_s - 1e-9)) + 1
        if rows * len(trajectory.joint_names) > _MOST_VALUES:
            raise InvalidArgument(f"the motion is too rough: within the limits it would have {rows} rows")
        times = trajectory.period_s / factor * np.arange(rows, dtype=np.float64)
        slower = Trajectory(trajectory.joint_names, trajectory.period_s, trajectory.at(times))
        beyond = excess(slower.positions_rad.T, slower.period_s, table)
    return slower


def concatenate(trajectories: Sequence[Trajectory], blend_s: float = 0.5, table: JointTable = HOAP2) -> Trajectory:
    """Play motions one after another; from the end of each a minimum-jerk blend leads to the begin of the next.

    Parameters
    ----------
    trajectories : sequence of Trajectory
        At least one, all of the same joints in any order; the first one's period is used for all.
    blend_s : float
        Longer where the limits of speed and acceleration need it, none where the poses are the same.
    table : JointTable
    """
    if not trajectories:
        raise InvalidArgument("there are no trajectories")
    if not 0.0 <= blend_s < np.inf:
        raise InvalidArgument(f"blend_s is {blend_s}, must be 0 or more and finite")
    names, period_s = trajectories[0].joint_names, trajectories[0].period_s
    parts: list[Floats] = []
    for number, trajectory in enumerate(trajectories, start=1):
        if set(trajectory.joint_names) != set(names):
            raise InvalidArgument(f"trajectory {number} has other joints than the first")
        rows = resample(trajectory, period_s).positions_rad
        rows = rows[:, [trajectory.joint_names.index(name) for name in names]]
        if parts:
            rows = np.concatenate((_blend(parts[-1][-1], rows[0], blend_s, period_s, table), rows[1:]))
        parts.append(rows)
    return Trajectory(names, period_s, np.concatenate(parts))


def _blend(begin: Floats, end: Floats, blend_s: float, period_s: float, table: JointTable) -> Floats:
    """Rows after `begin` up to and with `end`."""
    distance = float(np.abs(end - begin).max())
    if distance == 0.0:
        return np.empty((0, len(begin)))
    fastest_s = _FASTEST_OF_MINIMUM_JERK * distance / table.max_speed_rad_s
    hardest_s = float(np.sqrt(_HARDEST_OF_MINIMUM_JERK * distance / table.max_acceleration_rad_s2))
    rows = int(np.ceil(max(blend_s, fastest_s, hardest_s, period_s) / period_s - 1e-9))
    times = period_s * np.arange(1, rows + 1, dtype=np.float64)
    return minimum_jerk(np.array([0.0, times[-1]]), np.stack((begin, end)), times)


def _above_zero(name: str, value: float) -> None:
    if not 0.0 < value < np.inf:
        raise InvalidArgument(f"{name} is {value}, must be above 0 and finite")
