# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Joint angles per frame made into a smooth motion that no joint's speed or acceleration limit cuts into.

Only the time is stretched, and only where it must be: the path stays as it is.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

_FINE = 8  # samples per frame when speeds are looked at
_LEVELLING_S = 0.2  # over this the pace changes
_LOCAL_ROUNDS = 8


@dataclass(frozen=True)
class Paced:
    """A motion.

    Attributes
    ----------
    positions_rad : ndarray of float64, shape (rows, joints)
    frame_times_s : ndarray of float64, shape (frames,)
        When the motion passes the frames of the track.
    """

    positions_rad: Floats
    frame_times_s: Floats


def spline(values: Floats, places: Floats) -> Floats:
    """Cubic B-spline with the rows as control points, at places counted in rows.

    It bends smoothly (its second derivative is continuous) and never leaves the range of its control points,
    so that angles within limits stay within them. The end rows count as repeated.
    """
    padded = np.concatenate((values[:1], values[:1], values, values[-1:], values[-1:]))
    whole = np.clip(np.floor(places).astype(np.intp), -1, len(values) - 1)
    part = np.clip(places - whole, 0.0, 1.0)[:, np.newaxis]
    first = whole + 1
    weights = (
        (1.0 - part) ** 3,
        3.0 * part**3 - 6.0 * part**2 + 4.0,
        -3.0 * part**3 + 3.0 * part**2 + 3.0 * part + 1.0,
        part**3,
    )
    return np.asarray(sum(weight * padded[first + i] for i, weight in enumerate(weights))) / 6.0


def pace(
    angles_rad: Floats,
    fps: float,
    period_s: float,
    max_speed_rad_s: float,
    max_acceleration_rad_s2: float,
) -> Paced:
    """Play frames at their own rate, slower where a limit asks for it.

    Parameters
    ----------
    angles_rad : ndarray, shape (frames, joints)
    fps : float
    period_s : float
        Of the rows of the motion.
    max_speed_rad_s, max_acceleration_rad_s2 : float
        Of every joint, from row to row.
    """
    last = len(angles_rad)  # half of the spline's run to a stop lies beyond the last row
    places = np.linspace(-1.0, last, _FINE * (last + 1) + 1)
    path = spline(angles_rad, places)
    step_s = (places[1] - places[0]) / fps
    speeds = np.abs(np.gradient(path, step_s, axis=0)).max(axis=1)
    bends = np.abs(np.gradient(np.gradient(path, step_s, axis=0), step_s, axis=0)).max(axis=1)
    slower = np.maximum(1.0, np.maximum(speeds / max_speed_rad_s, np.sqrt(bends / max_acceleration_rad_s2)))
    slower = _levelled(slower, round(_LEVELLING_S / step_s))
    rounds = 0
    while True:
        times_s = np.concatenate(([0.0], np.cumsum((slower[1:] + slower[:-1]) / 2.0 * step_s)))
        rows_s = np.arange(int(np.ceil(times_s[-1] / period_s)) + 1) * period_s
        positions = spline(angles_rad, np.interp(rows_s, times_s, places))
        excess = _excess(positions, period_s, max_speed_rad_s, max_acceleration_rad_s2)
        if excess.max() <= 1.0:
            break
        rounds += 1
        if rounds < _LOCAL_ROUNDS:
            wanted = np.maximum(1.0, 1.02 * np.interp(times_s, rows_s, excess))
            slower *= _levelled(wanted, round(_LEVELLING_S / step_s))
        else:  # a change of pace takes acceleration itself; slowing everything down always helps
            slower *= 1.01 * excess.max()
    frame_times = np.interp(np.arange(len(angles_rad)), places, times_s)
    return Paced(positions, frame_times)


def _excess(positions: Floats, period_s: float, max_speed: float, max_acceleration: float) -> Floats:
    """By what factor each row would have to be slower."""
    padded = np.concatenate((positions[:1], positions, positions[-1:]))
    steps = np.abs(np.diff(padded, axis=0)).max(axis=1) / period_s
    bends = np.abs(np.diff(padded, 2, axis=0)).max(axis=1) / period_s**2
    return np.maximum(np.maximum(steps[1:], steps[:-1]) / max_speed, np.sqrt(bends / max_acceleration))


def _levelled(values: Floats, reach: int) -> Floats:
    """Nowhere below `values`, and changing slowly: the running maximum, then its running mean."""
    padded = np.pad(values, reach, mode="edge")
    windows = np.lib.stride_tricks.sliding_window_view(padded, 2 * reach + 1).max(axis=1)
    weights = np.hanning(2 * reach + 3)[1:-1]
    return np.convolve(np.pad(windows, reach, mode="edge"), weights / weights.sum(), mode="valid")
