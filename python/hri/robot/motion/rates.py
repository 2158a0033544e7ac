# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""How fast, hard and rough a motion is, measured against the limits of the motors.

Over 50 ms: what the robot does. It is sent the motion smoothed by two windows of 50 ms (`control.playing`), so its
speed is never above the largest mean speed over 50 ms, and its acceleration is the change of that mean within 50 ms.
Over 10 ms and less: what the motion asks for. A vibration that the smoothing would swallow is an error all the same.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hri.robot.model.joints import JointTable

Floats = NDArray[np.float64]

SMOOTHING_S = 0.05
SHORT_S = 0.01
_ROUGH_S = 0.1
_BACK_AND_FORTH = 0.2  # of the most speed


@dataclass(frozen=True)
class Measure:
    """One measure of a motion over all joints.

    Attributes
    ----------
    text : str
        What was measured, with a place for the value.
    unit : str
    values : ndarray, shape (joints, windows)
        Should not be above `limit` in size.
    limit : float
    order : int
        Of the derivative: a motion at half the pace has values 2 ** order times as small.
    first_row : int
        The row of the motion, from 0, to which the first window belongs; below 0 before the begin.
    """

    text: str
    unit: str
    values: Floats
    limit: float
    order: int
    first_row: int


def smoothed_measures(positions_rad: Floats, period_s: float, table: JointTable) -> Iterator[Measure]:
    """Speed and acceleration over 50 ms of a motion that is held before its first row and after its last.

    Parameters
    ----------
    positions_rad : ndarray, shape (joints, rows)
        Finite.
    period_s : float
    table : JointTable
    """
    speed = ("a speed of {} over 50 ms", "rad/s")
    acceleration = ("an acceleration of {} over 50 ms", "rad/s2")
    limits = table.max_speed_rad_s, table.max_acceleration_rad_s2
    window = round(SMOOTHING_S / period_s)
    if abs(window * period_s - SMOOTHING_S) < 1e-9:
        speeds, changes = _differences(positions_rad, window, SMOOTHING_S, SMOOTHING_S)
        yield Measure(*speed, speeds, limits[0], 1, -window)
        yield Measure(*acceleration, changes, limits[1], 2, -window)
        return
    # Both are straight between the times at which a window begins, has its middle, or ends in a row: there they peak.
    rows = positions_rad.shape[1]
    held = _held(positions_rad, 1)
    shifts = np.arange(-2, 3)[:, np.newaxis] * (SMOOTHING_S / period_s)
    places = np.clip(1.0 + np.arange(rows) + shifts, 0.0, rows + 1.0)
    row = np.minimum(places.astype(np.intp), rows)
    part = places - row
    shifted = (1.0 - part) * held[:, row] + part * held[:, row + 1]  # joints, shifts, rows
    for values in np.moveaxis(np.diff(shifted[:, 1:4], axis=1) / SMOOTHING_S, 1, 0):
        yield Measure(*speed, values, limits[0], 1, 0)
    for values in np.moveaxis(np.diff(shifted, 2, axis=1) / SMOOTHING_S**2, 1, 0):
        yield Measure(*acceleration, values, limits[1], 2, 0)


def short_measures(positions_rad: Floats, period_s: float, table: JointTable) -> Iterator[Measure]:
    """Speed, acceleration and jerk over 10 ms (or from row to row where these are further apart), and roughness.

    Parameters
    ----------
    positions_rad : ndarray, shape (joints, rows)
        Finite; held before the first row and after the last. Single jumps should have been taken out.
    period_s : float
    table : JointTable
    """
    window = max(1, round(SHORT_S / period_s))
    span_s = window * period_s
    turn_s = span_s if period_s < SHORT_S else SHORT_S  # within which the speed may change
    fastest, hardest = table.max_speed_rad_s, table.peak_acceleration_rad_s2
    speeds, changes = _differences(positions_rad, window, span_s, turn_s)
    yield Measure("a speed of {} over 10 ms", "rad/s", speeds, fastest, 1, -window)
    if window > 1:
        steps = np.abs(np.diff(_held(positions_rad, window)))
        rms = np.sqrt(_sums(steps**2, window) / window) / period_s
        yield Measure("a speed of {} RMS over 10 ms", "rad/s", rms, fastest, 1, 0)
        wasted = _sums(steps, window) / span_s - np.abs(speeds[:, window:-window])
        yield Measure("moving to and fro at {} within 10 ms", "rad/s", wasted, _BACK_AND_FORTH * fastest, 1, 0)
    yield Measure("an acceleration of {} over 10 ms", "rad/s2", changes, hardest, 2, -window)
    count = max(1, round(_ROUGH_S / period_s))
    rough = np.sqrt(_sums(changes**2, count) * (min(period_s, SHORT_S) / _ROUGH_S))
    text = "an acceleration of {} RMS over 100 ms"
    yield Measure(text, "rad/s2", rough, table.max_acceleration_rad_s2, 2, count // 2 - window)
    if period_s < 2.0 * SHORT_S:  # else no two changes of speed are that near to one another
        jerks = (changes[:, window:] - changes[:, :-window]) / turn_s
        yield Measure("a jerk of {} over 10 ms", "rad/s3", jerks, hardest / SHORT_S, 3, 0)


def calm_joints(positions_rad: Floats, period_s: float, table: JointTable) -> NDArray[np.bool_]:
    """Joints of which no measure can be above its limit, as these two are not; quick, for long motions.

    The speed from row to row bounds the other speeds and moving to and fro; the acceleration over 10 ms bounds its own
    RMS, that over 50 ms, which is a mean of such, and half the jerk.
    """
    window = round(SHORT_S / period_s)
    even = window >= 1 and abs(window * period_s - SHORT_S) < 1e-9
    if not even or table.peak_acceleration_rad_s2 < 2.0 * table.max_acceleration_rad_s2 or positions_rad.shape[1] < 2:
        return np.zeros(len(positions_rad), dtype=bool)
    slow = np.abs(np.diff(positions_rad)).max(axis=1) <= _BACK_AND_FORTH * table.max_speed_rad_s * period_s
    for place in np.flatnonzero(slow).tolist():
        _, changes = _differences(positions_rad[place : place + 1], window, SHORT_S, SHORT_S)
        slow[place] = np.abs(changes).max() <= table.max_acceleration_rad_s2
    return np.asarray(slow)


def excess(positions_rad: Floats, period_s: float, table: JointTable) -> float:
    """How many times slower a motion must be played, by its worst measure; shape (joints, rows)."""
    worst = 0.0
    for measured in (smoothed_measures, short_measures):
        for found in measured(positions_rad, period_s, table):
            largest = float(np.abs(found.values).max(initial=0.0))
            worst = max(worst, (largest / found.limit) ** (1.0 / found.order))
    return worst


def _held(positions: Floats, rows: int) -> Floats:
    return np.pad(positions, ((0, 0), (rows, rows)), mode="edge")


def _differences(positions: Floats, window: int, span_s: float, turn_s: float) -> tuple[Floats, Floats]:
    """Mean speeds over a window of rows, and how they change from one window to the next."""
    held = _held(positions, 2 * window)
    speeds = (held[:, window:] - held[:, :-window]) / span_s
    return speeds, (speeds[:, window:] - speeds[:, :-window]) / turn_s


def _sums(values: Floats, count: int) -> Floats:
    """Sums of so many values in succession, of not negative ones; of all where there are fewer."""
    totals = np.zeros((len(values), values.shape[1] + 1))
    np.cumsum(values, axis=1, out=totals[:, 1:])
    if totals.shape[1] <= count:
        return totals[:, -1:]
    return np.maximum(totals[:, count:] - totals[:, :-count], 0.0)
