# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""How moving joints come to rest within their limits of position, speed and acceleration."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

_GENTLE = 0.4  # of the most acceleration, as long as no joint's limit is too near for it


def brake(
    positions_rad: NDArray[np.float64],
    speeds_rad_s: NDArray[np.float64],
    limits_rad: NDArray[np.float64],
    max_speed_rad_s: float,
    max_acceleration_rad_s2: float,
    step_s: float,
) -> NDArray[np.float64]:
    """Bring every joint's speed to 0 evenly.

    Parameters
    ----------
    positions_rad, speeds_rad_s : ndarray, shape (joints,)
        Where the joints are; speeds above the limit are clipped to it.
    limits_rad : ndarray, shape (joints, 2)
        A joint brakes harder where it would pass one, up to the most acceleration.
    max_speed_rad_s, max_acceleration_rad_s2, step_s : float

    Returns
    -------
    ndarray of float64, shape (steps, joints)
        Positions a step apart, the last held.
    """
    speeds = np.clip(speeds_rad_s, -max_speed_rad_s, max_speed_rad_s)
    room = np.where(speeds > 0.0, limits_rad[:, 1] - positions_rad, positions_rad - limits_rad[:, 0])
    needed = speeds**2 / (2.0 * np.maximum(room, 1e-9))
    acceleration = np.clip(needed, _GENTLE * max_acceleration_rad_s2, max_acceleration_rad_s2)
    durations_s = np.abs(speeds) / acceleration
    steps = max(1, int(np.ceil(durations_s.max(initial=0.0) / step_s - 1e-9)))
    times_s = np.minimum(step_s * np.arange(1, steps + 1)[:, np.newaxis], durations_s)
    rows = positions_rad + speeds * times_s - 0.5 * np.sign(speeds) * acceleration * times_s**2
    low, high = np.minimum(limits_rad[:, 0], positions_rad), np.maximum(limits_rad[:, 1], positions_rad)
    return np.clip(rows, low, high)
