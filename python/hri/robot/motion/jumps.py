# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Jumps to a single row, as a dropped sample or a bad reading of an encoder makes them in a recorded motion."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hri.robot.model.joints import JointTable
from hri.robot.motion.rates import SHORT_S

Floats = NDArray[np.float64]

_HELD_S = 0.003  # a motion recorded every 3 ms at the most speed, each sample held, is no row of jumps
_CAUGHT_UP_S = 0.025  # a jump may be as far as the most speed goes in this time
_TOGETHER_S = 0.005  # a reading that is wrong and right again is one glitch
_APART_S = 0.05
_FEW, _FEW_S = 2, 0.5


@dataclass(frozen=True)
class Jump:
    """Steps from row to row of one joint that belong together.

    Attributes
    ----------
    joint : int
        Place among the joints.
    first, last : int
        Steps: step n leads to row n + 1, rows counted from 0.
    size_rad : float
        Of the largest step, with its sign.
    why_not : str
        Why it is more than a glitch; "" for one that is isolated and small.
    """

    joint: int
    first: int
    last: int
    size_rad: float
    why_not: str


def find_jumps(positions_rad: Floats, period_s: float, table: JointTable) -> list[Jump]:
    """Find steps that the most speed cannot explain even where samples were held for 3 ms.

    Parameters
    ----------
    positions_rad : ndarray, shape (joints, rows)
        Finite.
    period_s : float
        Rows 10 ms apart or more have no jumps: there a step is a speed.
    table : JointTable

    Returns
    -------
    list of Jump
        By joint, then by row.
    """
    if period_s >= SHORT_S or positions_rad.shape[1] < 2:
        return []
    steps = np.diff(positions_rad)
    joints, places = np.nonzero(np.abs(steps) > table.max_speed_rad_s * max(_HELD_S, period_s))
    found: list[Jump] = []
    for joint in np.unique(joints).tolist():
        rows = places[joints == joint]
        groups = np.split(rows, np.flatnonzero(np.diff(rows) * period_s > _TOGETHER_S) + 1)
        ends = [(int(group[0]), int(group[-1])) for group in groups]
        for number, (first, last) in enumerate(ends):
            largest = first + int(np.argmax(np.abs(steps[joint, first : last + 1])))
            size = float(steps[joint, largest])
            why_not = _why_not(ends, number, abs(size), period_s, table)
            found.append(Jump(joint, first, last, size, why_not))
    return found


def without_jumps(positions_rad: Floats, period_s: float, jumps: list[Jump]) -> Floats:
    """The motion as if each glitch had been a step like the mean of those within 10 ms; what follows is moved."""
    glitches = [jump for jump in jumps if not jump.why_not]
    if not glitches:
        return positions_rad
    steps = np.diff(positions_rad, prepend=0.0)
    reach = round(SHORT_S / period_s)
    for jump in glitches:
        first, last = jump.first + 1, jump.last + 1
        near = np.concatenate((steps[jump.joint, max(1, first - reach) : first], steps[jump.joint, last + 1 :][:reach]))
        steps[jump.joint, first : last + 1] = near.mean() if len(near) else 0.0
    return np.cumsum(steps, axis=1)


def _why_not(ends: list[tuple[int, int]], number: int, size_rad: float, period_s: float, table: JointTable) -> str:
    first, last = ends[number]
    if (last - first) * period_s > _TOGETHER_S:
        return "in one row after another"
    before = ends[number - 1][1] if number else -np.inf
    after = ends[number + 1][0] if number + 1 < len(ends) else np.inf
    if min(first - before, after - last) * period_s < _APART_S:
        return f"with another within {1000.0 * _APART_S:g} ms"
    begins = [begin for begin, _ in ends[max(0, number - _FEW) : number + _FEW + 1]]
    if any((late - early) * period_s < _FEW_S for early, late in zip(begins, begins[_FEW:], strict=False)):
        return f"one of more than {_FEW} within {_FEW_S:g} s"
    most = table.max_speed_rad_s * _CAUGHT_UP_S
    if size_rad > most:
        return f"further than {np.degrees(most):.1f} deg"
    return ""
