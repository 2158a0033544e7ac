# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The gestures as NAO makes them: its hands go where those of HOAP-2 are, as near as its joints allow.

A gesture that departs further from the original than the tolerances below, or whose motion does not pass the check, is
none that NAO makes.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from hri.core.display import short_repr
from hri.core.errors import InvalidArgument
from hri.core.suggest import did_you_mean
from hri.robot.model.arm import SIDES
from hri.robot.model.joints import NAO
from hri.robot.motion.checks import check_trajectory
from hri.robot.motion.gestures import Gesture, load_gestures, minimum_jerk
from hri.robot.motion.trajectory import Trajectory
from hri.robot.nao.arms import MARGIN_RAD, NAO_LEFT_ARM, apart, errors_of, solved, wanted_of
from hri.robot.nao.couplings import coupling_findings, head_pitch_range

Floats = NDArray[np.float64]

HAND_TOLERANCE_M = 0.03
FOREARM_TOLERANCE_DEG = 35.0
PALM_TOLERANCE_DEG = 45.0
HEAD_TOLERANCE_DEG = 15.0

NAO_GESTURE_JOINTS = (
    *NAO_LEFT_ARM,
    *(f"R{name[1:]}" for name in NAO_LEFT_ARM),
    "HeadYaw",
    "HeadPitch",
)
_MIRROR = np.array([1.0, -1.0, -1.0, -1.0, -1.0])
_APART_M = (0.0, 0.06, 0.07, 0.08, 0.09, 0.1, 0.105)
_HANDS = "l_wrist and r_wrist"


@dataclass(frozen=True)
@short_repr
class NaoGesture:
    """A gesture of NAO, or why there is none.

    Attributes
    ----------
    name : str
    why_not : str
        Why NAO cannot make it; "" when it can.
    times_s : ndarray of float64, shape (keys,)
        Of the key poses.
    trajectory : Trajectory
        Of NAO_GESTURE_JOINTS; not safe where there is a `why_not`.
    hand_m, forearm_deg, palm_deg, head_deg : float
        By how much it departs from the original, at most of all key poses.
    """

    name: str
    why_not: str
    times_s: Floats
    trajectory: Trajectory
    hand_m: float
    forearm_deg: float
    palm_deg: float
    head_deg: float


@lru_cache(maxsize=256)
def nao_gesture(name: str) -> NaoGesture:
    """The gesture of this name as NAO makes it; InvalidArgument, with the known names, when there is none."""
    gestures = load_gestures()
    if name not in gestures:
        raise InvalidArgument(f"no gesture {name!r}; {did_you_mean(name, gestures)}")
    gesture = gestures[name]
    wanted = wanted_of(gesture)
    head, head_deg = _head_poses(gesture.poses_rad[:, 10:12])
    made: list[NaoGesture] = []
    for least_m in _APART_M:
        # NAO's hands are thicker: where they meet they are kept apart, and no further than needed.
        aims = apart(wanted, least_m)
        arms = _plain()[name] if aims is wanted else solved([aims])[0]
        times_s, trajectory = _joined(gesture, np.hstack((arms[0], arms[1] * _MIRROR, head)))
        errors = errors_of(arms, wanted).max(axis=1)
        faults = _faults(trajectory)
        why_not = "; ".join((*_departures(errors, head_deg), *faults))
        hand_m, forearm_deg, palm_deg = errors.max(axis=0).tolist()
        made.append(NaoGesture(name, why_not, times_s, trajectory, hand_m, forearm_deg, palm_deg, head_deg))
        if not faults or _HANDS not in faults[0]:
            break
    return next((one for one in made if not one.why_not), made[-1])


def nao_gesture_trajectory(name: str) -> Trajectory:
    """Motion of a gesture for NAO; InvalidArgument when there is none of this name, or when NAO cannot make it."""
    gesture = nao_gesture(name)
    if gesture.why_not:
        raise InvalidArgument(f"NAO cannot make {name!r}: {gesture.why_not}")
    return gesture.trajectory


def _departures(errors: Floats, head_deg: float) -> Iterator[str]:
    for side, (hand_m, forearm_deg, palm_deg) in zip(SIDES, errors, strict=True):
        if hand_m > HAND_TOLERANCE_M:
            yield f"the {side} hand stays {100.0 * hand_m:.1f} cm from its place"
        if forearm_deg > FOREARM_TOLERANCE_DEG:
            yield f"the {side} forearm points {forearm_deg:.0f} deg elsewhere"
        if palm_deg > PALM_TOLERANCE_DEG:
            yield f"the {side} palm is turned by {palm_deg:.0f} deg"
    if head_deg > HEAD_TOLERANCE_DEG:
        yield f"the head stays {head_deg:.0f} deg from its place"


def _faults(trajectory: Trajectory) -> list[str]:
    findings = check_trajectory(trajectory, NAO) + coupling_findings(trajectory, {})
    return [finding.message for finding in findings if finding.severity == "error"][:1]


def _joined(gesture: Gesture, poses: Floats) -> tuple[Floats, Trajectory]:
    """The key poses joined by minimum-jerk trajectories, no faster than the original."""
    theirs, ours = (np.abs(np.diff(rows, axis=0)).max(axis=1) for rows in (gesture.poses_rad, poses))
    slower = np.maximum(1.0, ours / np.maximum(theirs, 1e-9))
    rows = np.ceil(np.diff(gesture.times_s) * slower / gesture.period_s - 1e-6)
    key_times_s = gesture.period_s * np.concatenate(([0.0], np.cumsum(rows)))
    times_s = gesture.period_s * np.arange(round(key_times_s[-1] / gesture.period_s) + 1)
    return key_times_s, Trajectory(NAO_GESTURE_JOINTS, gesture.period_s, minimum_jerk(key_times_s, poses, times_s))


def _head_poses(poses: Floats) -> tuple[Floats, float]:
    """Yaw and pitch as near as the shell allows, and how far off in degrees at most; shape (keys, 2)."""
    yaw = np.clip(poses[:, 0], NAO["HeadYaw"].lower_rad + MARGIN_RAD, NAO["HeadYaw"].upper_rad - MARGIN_RAD)
    least, most = head_pitch_range(yaw)
    found = np.stack((yaw, np.clip(poses[:, 1], least + MARGIN_RAD, most - MARGIN_RAD)), axis=1)
    return found, float(np.degrees(np.abs(found - poses).max()))


@lru_cache(maxsize=1)
def _plain() -> dict[str, Floats]:
    """Arms of all gestures, worked out together."""
    gestures = load_gestures()
    wanted = {name: wanted_of(gesture) for name, gesture in gestures.items()}
    return dict(zip(wanted, solved(list(wanted.values())), strict=True))
