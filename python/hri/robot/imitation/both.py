# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Paths of both arms that keep apart."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hri.robot.imitation.pacing import spline
from hri.robot.imitation.search import CLEARANCE_M, Path, find_path
from hri.robot.model.arm import Arm, arm_points
from hri.robot.model.clearance import arms_clearance, body_clearance, body_of, forearm_balls, mirrored_to_other
from hri.robot.model.joints import JointTable

Floats = NDArray[np.float64]
Arms = tuple[Arm, Arm]

_ENOUGH_M = 0.75 * CLEARANCE_M  # on the curve between the frames
_FINE = 4
_TURNS = 4
_PUSHES = 4
_SIDES_APART_M = (0.05, 0.07, 0.09, 0.11)
_PUSH_FRAMES = 5  # to each side, over which a push comes and goes


def find_both(arms: Arms, table: JointTable, wanted_m: Floats, smooth_m: Floats) -> list[Path]:
    """Left and right path, the hands at their places; where the arms would touch, as far aside as it takes.

    Each arm in turn gives way to the other with the pose that it reaches its place with. Where that is not enough, both
    hands are moved apart; where that is not enough either, as with hands that pass through each other, each keeps to
    its own side.

    Parameters
    ----------
    wanted_m, smooth_m : ndarray, shape (2, frames, 2)
        Places, and the same smoothed: see `find_path`.
    """
    places = smooth_m
    best: tuple[float, list[Path]] | None = None
    crossed = np.zeros(wanted_m.shape[1])
    for attempt in range(_PUSHES + len(_SIDES_APART_M)):
        paths = _in_turns(arms, table, wanted_m, places)
        between = _on_the_way(arms, np.concatenate([path.angles_rad for path in paths], axis=1))
        if best is None or between.min() > best[0]:
            best = float(between.min()), paths
        if best[0] >= _ENOUGH_M:
            break
        if attempt >= _PUSHES:
            crossed = np.maximum(crossed, _widened(np.where(between < _ENOUGH_M, 1.0, 0.0)))
            places = _on_own_sides(arms, smooth_m, crossed, _SIDES_APART_M[attempt - _PUSHES])
            continue
        push_m = _widened(np.maximum(0.0, CLEARANCE_M + 0.002 - between))
        # From where the hands are: a place beyond reach would only be pushed farther beyond.
        there = np.stack([path.hands_m[:, 1:] for path in paths])
        places = _pushed(arms, np.where(push_m[:, np.newaxis] > 0.0, there, places), push_m)
    assert best is not None  # the loop ran
    return best[1]


def _on_the_way(arms: Arms, angles_rad: Floats) -> Floats:
    """Distance between the forearms about each frame, on the curve that the motion will take."""
    frames = len(angles_rad)
    curve = spline(angles_rad, np.arange(-_FINE // 2, _FINE * frames - _FINE // 2) / _FINE)
    return arms_apart(arms, curve).reshape(frames, _FINE).min(axis=1)


def arms_apart(arms: Arms, angles_rad: Floats) -> Floats:
    """Distance between the forearms in every row; angles of two left arms, shape (rows, 8)."""
    left, radii = _balls(arms[0], angles_rad[:, :4])
    right, _ = _balls(arms[1], angles_rad[:, 4:])
    return arms_clearance(right, radii, mirrored_to_other(arms[0], left))


def least_clearance_m(arms: Arms, table: JointTable, angles_rad: Floats) -> float:
    """Least distance of a forearm from the body or the other forearm, below 0 if they touch; angles as above."""
    body = body_of(arms[0], table)
    trunk = [body_clearance(body, *_balls(arm, angles_rad[:, 4 * i : 4 * i + 4])).min() for i, arm in enumerate(arms)]
    return float(min(*trunk, arms_apart(arms, angles_rad).min()))


def _in_turns(arms: Arms, table: JointTable, wanted_m: Floats, smooth_m: Floats) -> list[Path]:
    left = find_path(arms[0], table, wanted_m[0], smooth_m[0])
    paths = [left, left]
    best: tuple[float, list[Path]] | None = None
    for turn in range(1, 2 + _TURNS):
        i = turn % 2
        other = mirrored_to_other(arms[1 - i], _balls(arms[1 - i], paths[1 - i].angles_rad)[0])
        paths[i] = find_path(arms[i], table, wanted_m[i], smooth_m[i], other)
        apart = float(arms_apart(arms, np.concatenate([path.angles_rad for path in paths], axis=1)).min())
        if best is None or apart > best[0]:
            best = apart, list(paths)
        if apart >= CLEARANCE_M:
            break
    assert best is not None  # the loop ran
    return best[1]


def _pushed(arms: Arms, places_m: Floats, apart_m: Floats) -> Floats:
    """Places, both hands moved from each other by half of `apart_m` along the line between them."""
    inwards = np.array([-1.0, 1.0])  # the right arm's outwards is the left arm's inwards
    gap = (places_m[0] + (abs(arms[0].shoulder_m[1]), 0.0)) - (
        places_m[1] + (abs(arms[1].shoulder_m[1]), 0.0)
    ) * inwards
    length = np.linalg.norm(gap, axis=1, keepdims=True)
    line = np.where(length > 1e-3, gap / np.maximum(length, 1e-9), (1.0, 0.0))
    move = 0.5 * apart_m[:, np.newaxis] * line
    return np.stack((places_m[0] + move, places_m[1] - move * inwards))


def _on_own_sides(arms: Arms, places_m: Floats, share: Floats, apart_m: float) -> Floats:
    """Places, the left hand kept to the left of the right one, by so much, in a share of each frame."""
    shoulder = abs(arms[0].shoulder_m[1])
    left, right = places_m[0, :, 0] + shoulder, -(places_m[1, :, 0] + shoulder)
    middle = np.clip((left + right) / 2.0, -0.02, 0.02)
    moved = places_m.copy()
    moved[0, :, 0] += share * np.maximum(0.0, middle + 0.5 * apart_m - left)
    moved[1, :, 0] += share * np.maximum(0.0, right - middle + 0.5 * apart_m)
    return moved


def _widened(values: Floats) -> Floats:
    """At least `values` about each frame, coming and going over some frames."""
    reach = _PUSH_FRAMES
    most = np.lib.stride_tricks.sliding_window_view(np.pad(values, reach, mode="edge"), 2 * reach + 1).max(axis=1)
    weights = np.hanning(2 * reach + 3)[1:-1]
    return np.convolve(np.pad(most, reach, mode="edge"), weights / weights.sum(), mode="valid")


def _balls(arm: Arm, angles_rad: Floats) -> tuple[Floats, Floats]:
    return forearm_balls(arm, *arm_points(arm, angles_rad))
