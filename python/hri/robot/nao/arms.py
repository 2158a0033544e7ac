# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Arms of NAO that do what those of HOAP-2 do: inverse kinematics by damped least squares (Levenberg, 1944).

NAO's elbows bend by 88.5 degrees instead of 115, so that forearms cannot always point the same way. What counts in a
sign is where the hands are, from the shoulders and in proportion to the arm's length, then where forearm, palm and
upper arm point. Shoulder and elbow are found within their limits, from several beginnings; the wrist then turns the
palm. Of the solutions for successive key poses those near one another are taken. Arms at rest are where NAO's rest.

Everything is computed for left arms; a right arm is the mirror image of one.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from hri.robot.model.arm import arm_of, arm_points
from hri.robot.model.joints import NAO
from hri.robot.motion.gestures import Gesture, load_gestures

Floats = NDArray[np.float64]

NAO_LEFT_ARM = ("LShoulderPitch", "LShoulderRoll", "LElbowYaw", "LElbowRoll", "LWristYaw")
MARGIN_RAD = 1e-3
"""Room left to the limits."""
_HAND_M = 0.05775  # from the wrist to the middle of the hand, by the maker
_HOAP2_MIRROR = np.array([1.0, -1.0, -1.0, 1.0, -1.0])
# What weighs as much as what: 1 cm of the hand, 0.25 of the forearm's direction, 1 of the upper arm's.
_SCALES = np.array([0.01] * 3 + [0.25] * 3 + [1.0] * 3)
_PALM_WEIGHT, _DETOUR_WEIGHT = 8.0, 2.0
LEAST_APART_M = 0.1
"""Between the middles of the hands while they move as is not known in advance: they are 4 cm thick."""
_NUM_BEGINNINGS = 12
_ITERATIONS = 30
_LIVE_ITERATIONS = 10  # from a pose that is near
_STEP = 1e-6


def wanted_of(gesture: Gesture) -> Floats:
    """What both arms ought to do, each as a left arm; shape (2, keys, 16)."""
    return np.stack([_wanted(gesture.poses_rad[:, 0:5]), _wanted(gesture.poses_rad[:, 5:10] * _HOAP2_MIRROR)])


def _wanted(poses: Floats) -> Floats:
    """Hand, forearm and upper arm of HOAP-2 in NAO's size from the shoulder, the palm's normal, and like angles.

    Shape (keys, 16).
    """
    arm = arm_of("left")
    elbow, hand = arm_points(arm, poses[:, :4])
    pitch, out, twist, bend, turn = poses.T
    palm = _turn("y", pitch) @ _turn("z", out) @ _turn("x", twist) @ _turn("y", bend) @ _turn("x", turn)
    directions = ((hand - elbow) / arm.fore_m, elbow / arm.upper_m, -palm[:, :, 1])
    # HOAP-2's elbow bends about y, NAO's about z: a quarter turn of the upper arm takes one to the other.
    return np.hstack((hand * sum(_lengths_m()) / arm.reach_m, *directions, poses[:, :4] - (0.0, 0.0, np.pi / 2.0, 0.0)))


def apart(wanted: Floats, least_m: float) -> Floats:
    """With hands that are nearer to one another moved apart, each by half of it; the same object if none is."""
    shoulder = np.array(NAO["LShoulderPitch"].origin_m) * (0.0, 1.0, 0.0)
    left, right = wanted[0, :, :3] + shoulder, (wanted[1, :, :3] + shoulder) * (1.0, -1.0, 1.0)
    line = left - right
    distance = np.linalg.norm(line, axis=1)
    if distance.min() >= least_m:
        return wanted
    away = np.where(distance[:, np.newaxis] > 1e-3, line, (0.0, 1.0, 0.0))
    away = away / np.linalg.norm(away, axis=1, keepdims=True) * 0.5 * np.maximum(least_m - distance, 0.0)[:, np.newaxis]
    moved = wanted.copy()
    moved[0, :, :3] += away
    moved[1, :, :3] -= away * (1.0, -1.0, 1.0)
    return moved


def errors_of(arms: Floats, wanted: Floats) -> Floats:
    """Of the hand in metres, of forearm and palm in degrees; shape (2, keys, 3); none of arms at rest."""
    points, fore = _points(arms[..., :4])
    facing = -(fore @ _turn("x", arms[..., 4]))[..., 2]
    cosines = [(points[..., 3:6] * wanted[..., 3:6]).sum(axis=-1), (facing * wanted[..., 9:12]).sum(axis=-1)]
    degrees = [np.degrees(np.arccos(np.clip(cosine, -1.0, 1.0))) for cosine in cosines]
    errors = np.stack((np.linalg.norm(points[..., :3] - wanted[..., :3], axis=-1), *degrees), axis=-1)
    return np.where(_resting(wanted)[..., np.newaxis], 0.0, errors)


def _resting(wanted: Floats) -> NDArray[np.bool_]:
    rest = _wanted(load_gestures()["rest"].poses_rad[:1, 0:5])[0]
    return np.abs(wanted - rest).max(axis=-1) < 1e-9


def solved(gestures: Sequence[Floats]) -> list[Floats]:
    """The angles of NAO's left arm that come nearest to what is wanted, for each gesture of shape (2, keys, 5)."""
    wanted = np.concatenate([gesture.reshape(-1, gesture.shape[-1]) for gesture in gestures])
    unique, where = np.unique(wanted, axis=0, return_inverse=True)
    limits = _limits()
    seeds = np.random.default_rng(1).uniform(limits[:4, 0], limits[:4, 1], (_NUM_BEGINNINGS - 1, 4))
    alike = np.clip(unique[:, np.newaxis, 12:], limits[:4, 0], limits[:4, 1])
    begin = np.concatenate((alike, np.broadcast_to(seeds, (len(unique), *seeds.shape))), axis=1)
    found, costs = _least_squares(begin, unique[:, np.newaxis, :9], limits[:4])
    wrist, facing = _wrist(found, unique[:, np.newaxis, 9:12], limits[4])
    costs = costs + _PALM_WEIGHT * (1.0 - facing)
    arms = np.concatenate((found, wrist[..., np.newaxis]), axis=-1)
    rests = _resting(unique)
    arms[rests], costs[rests] = [NAO[name].rest_rad for name in NAO_LEFT_ARM], 0.0
    chosen, at = [], 0
    for gesture in gestures:
        num_keys = gesture.shape[1]
        rows = where.reshape(-1)[at : at + 2 * num_keys].reshape(2, num_keys)
        chosen.append(np.stack([_shortest(row, arms[row], costs[row]) for row in rows]))
        at += 2 * num_keys
    return chosen


def nearest(poses_rad: Floats, before_rad: Floats) -> Floats:
    """Angles of NAO's shoulders and elbows for one pose of HOAP-2's arms, near those before.

    Parameters
    ----------
    poses_rad : ndarray, shape (2, 4)
        Of HOAP-2, both as left arms.
    before_rad : ndarray, shape (2, 4)
        Of NAO, both as left arms.

    Returns
    -------
    ndarray of float64, shape (2, 4)
        Within NAO's limits.
    """
    rest = load_gestures()["rest"].poses_rad[0, 4]
    wanted = _wanted(np.column_stack((poses_rad, np.full(2, rest))))
    rests = _resting(wanted)
    wanted = apart(wanted[:, np.newaxis], LEAST_APART_M)[:, 0]
    limits = _limits()[:4]
    alike = np.clip(wanted[:, 12:], limits[:, 0], limits[:, 1])
    begin = np.stack((np.clip(before_rad, limits[:, 0], limits[:, 1]), alike), axis=1)
    found, costs = _least_squares(begin, wanted[:, np.newaxis, :9], limits, _LIVE_ITERATIONS)
    costs = costs + _DETOUR_WEIGHT * np.abs(found - before_rad[:, np.newaxis]).max(axis=-1)
    chosen = found[np.arange(2), costs.argmin(axis=1)]
    chosen[rests] = [NAO[name].rest_rad for name in NAO_LEFT_ARM[:4]]
    return chosen


def _shortest(rows: NDArray[np.intp], arms: Floats, costs: Floats) -> Floats:
    """Of the choices for each key those of the least cost that lie near one another (Viterbi); shape (keys, 5).

    Where `rows` repeats itself the arm is held.
    """
    total, came = costs[0], []
    for key in range(1, len(costs)):
        steps = np.abs(arms[key, :, np.newaxis, :4] - arms[key - 1, np.newaxis, :, :4]).max(axis=-1)
        if rows[key] == rows[key - 1]:
            steps[~np.eye(len(steps), dtype=bool)] = np.inf
        through = total + _DETOUR_WEIGHT * steps
        came.append(through.argmin(axis=1))
        total = through.min(axis=1) + costs[key]
    path = [int(total.argmin())]
    for back in reversed(came):
        path.append(int(back[path[-1]]))
    return arms[np.arange(len(costs)), path[::-1]]


def _points(angles: Floats) -> tuple[Floats, Floats]:
    """Hand, forearm and upper arm, shape (..., 9), and the forearm's frame, (..., 3, 3), of NAO's left arm."""
    pitch, roll, yaw, bend = np.moveaxis(angles, -1, 0)
    fore_m = _lengths_m()[1]
    shoulder = _turn("y", pitch) @ _turn("z", roll)
    fore = shoulder @ _turn("x", yaw) @ _turn("z", bend)
    elbow = shoulder @ np.array(NAO["LElbowYaw"].origin_m)
    hand = elbow + fore_m * fore[..., 0]
    return np.concatenate((hand, fore[..., 0], elbow / np.linalg.norm(elbow, axis=-1, keepdims=True)), axis=-1), fore


def _least_squares(
    begin: Floats, wanted: Floats, limits: Floats, iterations: int = _ITERATIONS
) -> tuple[Floats, Floats]:
    """Damped least squares within limits; angles of shape (keys, beginnings, 4), costs (keys, beginnings)."""
    low, high = limits[:, 0], limits[:, 1]

    def residuals(angles: Floats) -> Floats:
        return (_points(angles)[0] - wanted) / _SCALES

    found, damping = begin.copy(), np.full(begin.shape[:2], 1e-2)
    errors = residuals(found)
    costs = (errors**2).sum(axis=-1)
    for _ in range(iterations):
        slopes = np.stack([(residuals(found + _STEP * unit) - errors) / _STEP for unit in np.eye(4)], axis=-1)
        normal = np.swapaxes(slopes, -1, -2) @ slopes + damping[..., np.newaxis, np.newaxis] * np.eye(4)
        gradient = (np.swapaxes(slopes, -1, -2) @ errors[..., np.newaxis])[..., 0]
        # An angle at its limit that would go beyond stays, and the others are found without it.
        held = ((found <= low) & (gradient > 0.0)) | ((found >= high) & (gradient < 0.0))
        normal = np.where(held[..., np.newaxis] | held[..., np.newaxis, :], np.eye(4), normal)
        step = np.linalg.solve(normal, np.where(held, 0.0, -gradient)[..., np.newaxis])[..., 0]
        tried = np.clip(found + step, low, high)
        tried_errors = residuals(tried)
        tried_costs = (tried_errors**2).sum(axis=-1)
        better = tried_costs < costs
        found = np.where(better[..., np.newaxis], tried, found)
        errors = np.where(better[..., np.newaxis], tried_errors, errors)
        costs = np.where(better, tried_costs, costs)
        damping = np.clip(np.where(better, 0.3 * damping, 5.0 * damping), 1e-9, 1e9)
    return found, costs


def _wrist(angles: Floats, palms: Floats, limits: Floats) -> tuple[Floats, Floats]:
    """The turn of the wrist that brings the palm nearest to its normal, and the cosine of what is left.

    At zero NAO's palm faces down in the forearm's frame.
    """
    forearms = _points(angles)[1]
    across = (forearms[..., 1] * palms).sum(axis=-1)
    down = -(forearms[..., 2] * palms).sum(axis=-1)
    turn = np.clip(np.arctan2(across, down), limits[0], limits[1])
    return turn, np.sin(turn) * across + np.cos(turn) * down


def _limits() -> Floats:
    """Of the left arm, shape (5, 2), with a little room."""
    rows = NAO.limits_rad[[NAO.index(name) for name in NAO_LEFT_ARM]]
    return rows + np.array((MARGIN_RAD, -MARGIN_RAD))


def _lengths_m() -> tuple[float, float]:
    """From the shoulder to the elbow, and from there to the middle of the hand."""
    return float(np.linalg.norm(NAO["LElbowYaw"].origin_m)), NAO["LWristYaw"].origin_m[0] + _HAND_M


def _turn(axis: str, angle: Floats) -> Floats:
    """Rotation matrices, shape (..., 3, 3)."""
    c, s, zero, one = np.cos(angle), np.sin(angle), np.zeros_like(angle), np.ones_like(angle)
    rows = {
        "x": (one, zero, zero, zero, c, -s, zero, s, c),
        "y": (c, zero, s, zero, one, zero, -s, zero, c),
        "z": (c, -s, zero, s, c, zero, zero, zero, one),
    }[axis]
    return np.stack(rows, axis=-1).reshape(*np.shape(angle), 3, 3)
