# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""How moving joints come to rest within their limits of position, speed and acceleration."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

_GENTLE = 0.4  # of the most acceleration, as long as no joint's limit is too near for it
_HALVINGS = 40


def brake(
    positions_rad: NDArray[np.float64],
    speeds_rad_s: NDArray[np.float64],
    limits_rad: NDArray[np.float64],
    max_speed_rad_s: float,
    max_acceleration_rad_s2: float,
    step_s: float,
) -> NDArray[np.float64]:
    """Bring every joint's speed to 0, from one step to the next by the same amount.

    A joint that came here within the limits can always stop within them.

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
    first = step_s * np.clip(speeds_rad_s, -max_speed_rad_s, max_speed_rad_s)
    steps = np.abs(first)
    room = np.where(first > 0.0, limits_rad[:, 1] - positions_rad, positions_rad - limits_rad[:, 0])
    gentle, hard = _GENTLE * max_acceleration_rad_s2, max_acceleration_rad_s2
    too_little, enough = np.full(len(steps), gentle), np.full(len(steps), hard)
    enough[_way(steps, gentle * step_s**2) <= room] = gentle
    for _ in range(_HALVINGS):
        middle = 0.5 * (too_little + enough)
        fits = _way(steps, middle * step_s**2) <= room
        too_little, enough = np.where(fits, too_little, middle), np.where(fits, middle, enough)
    shorter = enough * step_s**2
    count = max(1, int(np.ceil((steps / shorter).max(initial=0.0) - 1e-9)))
    ways = np.maximum(steps - np.arange(1, count + 1)[:, np.newaxis] * shorter, 0.0)
    rows = positions_rad + np.sign(first) * np.cumsum(ways, axis=0)
    low, high = np.minimum(limits_rad[:, 0], positions_rad), np.maximum(limits_rad[:, 1], positions_rad)
    return np.clip(rows, low, high)


def _way(steps: NDArray[np.float64], shorter: float | NDArray[np.float64]) -> NDArray[np.float64]:
    """The way of steps that are shorter by so much from one to the next, until they are 0; the first is not counted."""
    count = np.floor(steps / shorter)
    return np.asarray(count * steps - shorter * count * (count + 1.0) / 2.0)
