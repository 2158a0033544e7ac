# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Arm poses for a hand path seen from the front.

A picture fixes a hand's place in two of three directions, and an arm of four joints can reach that place with many
poses: how far forward the hand is and how the elbow is turned are free. Of the poses within the joints' limits and
clear of the body the path with the least motion is found, by dynamic programming, from a coarse to a fine grid.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from hri.robot.model.arm import Arm, arm_angles, arm_of, arm_points
from hri.robot.model.clearance import (
    Body,
    arms_clearance,
    body_clearance,
    body_of,
    forearm_balls,
    mirrored_to_other,
)
from hri.robot.model.joints import JointTable

Floats = NDArray[np.float64]

MARGIN_RAD = np.radians(0.5)
"""Kept from the joints' limits."""
CLEARANCE_M = 0.004
"""Kept from the body and the other arm."""

DEPTH_M = 0.115
"""Of a signing hand before the shoulders, by preference."""

_DEPTHS_M = np.array([0.06, 0.075, 0.09, 0.105, 0.12, 0.135, 0.155, 0.18])
_SWIVELS_RAD = np.radians(np.arange(-40.0, 126.0, 11.0))
_DEPTH_SPREAD_M = 0.05
_SWIVEL_RAD, _SWIVEL_SPREAD_RAD = np.radians(25.0), np.radians(60.0)
_STEP_RAD = 0.06  # a change of all joints by this from frame to frame costs as much as one spread
_REFINEMENTS = (0.5, 0.25)
_BLOCKED = 1e6
_TOUCHING = 1e3
_NEAR = np.arange(-2.0, 3.0)
_GRID_M = 0.01


@dataclass(frozen=True)
class Path:
    """Poses of one arm.

    Attributes
    ----------
    angles_rad : ndarray of float64, shape (frames, 4)
        As for a left arm.
    hands_m : ndarray of float64, shape (frames, 3)
    reached : ndarray of bool, shape (frames,)
        Whether the target itself, not smoothed, is within reach; elsewhere the hand goes to the nearest place that is.
    """

    angles_rad: Floats
    hands_m: Floats
    reached: NDArray[np.bool_]


def find_path(arm: Arm, table: JointTable, targets_m: Floats, smooth_m: Floats, other: Floats | None = None) -> Path:
    """Poses whose hands, seen from the front, are at the targets.

    Parameters
    ----------
    targets_m : ndarray, shape (frames, 2)
        Outwards and up from the shoulder.
    smooth_m : ndarray, shape (frames, 2)
        The same, smoothed: where the hand is to go.
    other : ndarray, shape (frames, balls, 3), optional
        The other forearm, to stay clear of.
    """
    body = body_of(arm, table)
    reached = _reachable(arm, body, targets_m)
    targets = _within_reach(arm, table, body, smooth_m)
    depths, swivels = (grid.ravel() for grid in np.meshgrid(_DEPTHS_M, _SWIVELS_RAD, indexing="ij"))
    shape = (len(targets), len(depths))
    depth, swivel = _best(arm, body, targets, np.broadcast_to(depths, shape), np.broadcast_to(swivels, shape), other)
    for share in _REFINEMENTS:
        steps = share * np.arange(-2.0, 3.0)
        near = np.stack([grid.ravel() for grid in np.meshgrid(0.015 * steps, np.radians(11.0) * steps)], axis=1)
        around = np.stack((_smooth(depth), _smooth(swivel)), axis=1)[:, np.newaxis] + near
        # The pose found before stays a choice: it is known to be possible.
        depths = np.concatenate((around[:, :, 0], depth[:, np.newaxis]), axis=1)
        swivels = np.concatenate((around[:, :, 1], swivel[:, np.newaxis]), axis=1)
        depth, swivel = _best(arm, body, targets, depths, swivels, other)
    hands = np.column_stack((depth, targets))
    return Path(arm_angles(arm, hands, swivel), hands, reached)


def _within_reach(arm: Arm, table: JointTable, body: Body, targets_m: Floats) -> Floats:
    """The targets, those beyond reach moved to the nearest reachable place."""
    moved = targets_m.copy()
    beyond = np.flatnonzero(~_reachable(arm, body, targets_m))
    if len(beyond):
        places = _reachable_places(table)
        apart = np.linalg.norm(targets_m[beyond, np.newaxis] - places, axis=-1)
        near = places[np.argmin(apart, axis=1)]
        part, step = np.zeros(len(beyond)), 0.5
        for _ in range(4):  # towards the target as far as it goes
            tried = part + step
            ahead = near + tried[:, np.newaxis] * (targets_m[beyond] - near)
            part = np.where(_reachable(arm, body, ahead), tried, part)
            step /= 2.0
        moved[beyond] = near + part[:, np.newaxis] * (targets_m[beyond] - near)
    return moved


def _reachable(arm: Arm, body: Body, targets_m: Floats) -> NDArray[np.bool_]:
    depths, swivels = (grid.ravel() for grid in np.meshgrid(_DEPTHS_M, _SWIVELS_RAD))
    shape = (len(targets_m), len(depths))
    _, _, possible, _ = _poses(arm, body, targets_m, np.broadcast_to(depths, shape), np.broadcast_to(swivels, shape))
    return np.asarray(possible.any(axis=1))


@lru_cache(maxsize=4)
def _reachable_places(table: JointTable) -> Floats:
    """Places on a grid that the hand can reach, the same for both arms; shape (places, 2)."""
    arm = arm_of("left", table)
    line = np.arange(-arm.reach_m, arm.reach_m, _GRID_M)
    places = np.stack([grid.ravel() for grid in np.meshgrid(line, line)], axis=1)
    places = places[np.linalg.norm(places, axis=1) < arm.reach_m]
    return places[_reachable(arm, body_of(arm, table), places)]


def _poses(
    arm: Arm, body: Body, targets_m: Floats, depths_m: Floats, swivels_rad: Floats
) -> tuple[Floats, Floats, NDArray[np.bool_], Floats]:
    """Angles (frames, choices, 4), which are possible, and for those, in a row, clearance from the body and balls."""
    hands = np.concatenate(
        (depths_m[..., np.newaxis], np.broadcast_to(targets_m[:, np.newaxis], (*depths_m.shape, 2))), axis=-1
    )
    angles = arm_angles(arm, hands, swivels_rad)
    possible = arm.within(angles, MARGIN_RAD) & (np.linalg.norm(hands, axis=-1) < arm.reach_m - 1e-4)
    elbows, ends = arm_points(arm, angles[possible])
    balls, radii = forearm_balls(arm, elbows, ends)
    clearance = body_clearance(body, balls, radii)
    possible[possible] = clear = clearance > CLEARANCE_M
    return angles, clearance[clear], possible, balls[clear]


def _rated(
    arm: Arm, body: Body, targets_m: Floats, depths_m: Floats, swivels_rad: Floats, other: Floats | None
) -> tuple[Floats, Floats]:
    """Angles of every choice, shape (frames, choices, 4), and what each costs by itself, shape (frames, choices)."""
    angles, clearance, possible, balls = _poses(arm, body, targets_m, depths_m, swivels_rad)
    costs = ((depths_m - DEPTH_M) / _DEPTH_SPREAD_M) ** 2 + ((swivels_rad - _SWIVEL_RAD) / _SWIVEL_SPREAD_RAD) ** 2
    costs[~possible] += _BLOCKED
    if other is not None:
        frames = np.nonzero(possible)[0]
        radii = forearm_balls(arm, np.zeros(3), np.zeros(3))[1]
        clearance = np.minimum(clearance, arms_clearance(balls, radii, other[frames]))
    costs[possible] += np.maximum(0.0, 0.012 - clearance) / 0.004 + np.where(clearance < CLEARANCE_M, _TOUCHING, 0.0)
    return angles, costs


def _best(
    arm: Arm, body: Body, targets_m: Floats, depths_m: Floats, swivels_rad: Floats, other: Floats | None
) -> tuple[Floats, Floats]:
    """Depth and swivel of the cheapest path through the choices of every frame."""
    angles, costs = _rated(arm, body, targets_m, depths_m, swivels_rad, other)
    scaled = angles / _STEP_RAD
    chosen = np.zeros((len(costs), costs.shape[1]), dtype=np.intp)
    total = costs[0]
    for frame in range(1, len(costs)):
        before, now = scaled[frame - 1], scaled[frame]
        moves = (before**2).sum(axis=1)[:, np.newaxis] + (now**2).sum(axis=1) - 2.0 * before @ now.T
        sums = total[:, np.newaxis] + moves
        chosen[frame] = np.argmin(sums, axis=0)
        total = sums[chosen[frame], np.arange(sums.shape[1])] + costs[frame]
    path = np.empty(len(costs), dtype=np.intp)
    path[-1] = int(np.argmin(total))
    for frame in range(len(costs) - 1, 0, -1):
        path[frame - 1] = chosen[frame, path[frame]]
    rows = np.arange(len(costs))
    return depths_m[rows, path], swivels_rad[rows, path]


class PoseFinder:
    """Poses of one arm for places that come one by one; each is near the pose before.

    Parameters
    ----------
    arm : Arm
    table : JointTable
    rest_rad : ndarray, shape (4,)
        The pose without a place, as for a left arm.

    Attributes
    ----------
    angles_rad : ndarray of float64, shape (4,)
        The pose, as for a left arm.
    """

    def __init__(self, arm: Arm, table: JointTable, rest_rad: Floats) -> None:
        self._arm, self._table, self._rest = arm, table, rest_rad
        self._body = body_of(arm, table)
        self.angles_rad = rest_rad
        self._depth, self._swivel = DEPTH_M, float(_SWIVEL_RAD)

    @property
    def forearm_seen_by_other(self) -> Floats:
        """Balls of the forearm as the other arm sees them, shape (balls, 3)."""
        elbow, hand = arm_points(self._arm, self.angles_rad)
        return mirrored_to_other(self._arm, forearm_balls(self._arm, elbow, hand)[0])

    def move_to(self, target_m: Floats | None, other: Floats) -> None:
        """Bring the hand to a place, or near it; stays where no pose is possible.

        Parameters
        ----------
        target_m : ndarray, shape (2,), or None
            Outwards and up from the shoulder; None: to rest.
        other : ndarray, shape (balls, 3)
            The other forearm, to stay clear of.
        """
        if target_m is None:
            self.angles_rad = self._rest
            return
        target = _within_reach(self._arm, self._table, self._body, target_m[np.newaxis])
        depths, swivels = (grid.ravel() for grid in np.meshgrid(_DEPTHS_M, _SWIVELS_RAD, indexing="ij"))
        near = [grid.ravel() for grid in np.meshgrid(0.004 * _NEAR, np.radians(3.0) * _NEAR)]
        depths = np.concatenate((self._depth + near[0], depths))[np.newaxis]
        swivels = np.concatenate((self._swivel + near[1], swivels))[np.newaxis]
        angles, costs = _rated(self._arm, self._body, target, depths, swivels, other[np.newaxis])
        moved = ((angles[0] - self.angles_rad) / _STEP_RAD) ** 2
        best = int(np.argmin(costs[0] + 0.1 * moved.sum(axis=1)))
        if costs[0, best] < _TOUCHING:
            self.angles_rad = angles[0, best]
            self._depth, self._swivel = float(depths[0, best]), float(swivels[0, best])


def _smooth(values: Floats, reach: int = 3) -> Floats:
    """Weighted mean over frames to each side, ends held."""
    weights = np.hanning(2 * reach + 3)[1:-1]
    return np.convolve(np.pad(values, reach, mode="edge"), weights / weights.sum(), mode="valid")
