# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The robot's motion for a recognised digit or sign: key poses joined by minimum-jerk trajectories."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from importlib import resources
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.core.display import short_repr, shown
from hri.core.errors import FormatError, InvalidArgument
from hri.core.files import parse_toml
from hri.core.suggest import did_you_mean
from hri.robot.model.arm import MIRROR, arm_angles, arm_of, arm_points
from hri.robot.model.clearance import body_clearance, body_of, forearm_balls
from hri.robot.model.joints import HOAP2
from hri.robot.motion.toml_fields import field_of, number_in, numbers_of, only_fields
from hri.robot.motion.trajectory import Trajectory

Floats = NDArray[np.float64]

GESTURE_JOINTS = (
    *(f"larm_joint_{number}" for number in range(1, 6)),
    *(f"rarm_joint_{number}" for number in range(1, 6)),
    "head_joint_1",
    "head_joint_2",
)
_MIRROR = np.array([*MIRROR, -1.0])
_ELBOW_DEG = 25.0
_CLEARANCE_M = 0.001
_JERK_SPEED, _JERK_ACCELERATION = 1.875, 5.774  # of a least-jerk move of length and duration 1, at most
_ARM_FIELDS = {"at_cm", "elbow", "hand"}
_KEY_FIELDS = {"left", "right", "head", "hold_s", "slower"}
_GESTURE_FIELDS = {"name", "meaning", "lacks", "keys"}
_RATES = {  # and what they must be
    "period_s": (0.001, 1.0),
    "speed_rad_s": (0.01, 100.0),
    "acceleration_rad_s2": (0.01, 10_000.0),
    "least_move_s": (0.0, 60.0),
}


@dataclass(frozen=True)
class GestureRates:
    """How gestures move: period of the rows; speed and acceleration of the fastest joint, and the shortest move."""

    period_s: float
    speed_rad_s: float
    acceleration_rad_s2: float
    least_move_s: float


@dataclass(frozen=True)
@short_repr
class Gesture:
    """A motion from rest to rest.

    Attributes
    ----------
    name, meaning : str
    lacks : str
        What of the sign the robot cannot show; "" if nothing.
    times_s : ndarray of float64, shape (keys,)
        From 0, rising.
    poses_rad : ndarray of float64, shape (keys, joints)
        Of GESTURE_JOINTS; the robot stands still in each.
    period_s : float
        Of the trajectory.
    """

    name: str
    meaning: str
    lacks: str
    times_s: Floats
    poses_rad: Floats
    period_s: float

    def trajectory(self) -> Trajectory:
        """Join the key poses by minimum-jerk trajectories."""
        rows = round(self.times_s[-1] / self.period_s) + 1
        times_s = np.arange(rows) * self.period_s
        positions = minimum_jerk(self.times_s, self.poses_rad, times_s)
        return Trajectory(GESTURE_JOINTS, self.period_s, positions)


def minimum_jerk(key_times_s: Floats, keys: Floats, times_s: Floats) -> Floats:
    """Join keys by 10 s^3 - 15 s^4 + 6 s^5, at rest in each (Flash and Hogan, 1985).

    Parameters
    ----------
    key_times_s : ndarray, shape (keys,)
        Rising, at least two.
    keys : ndarray, shape (keys, joints)
    times_s : ndarray, shape (rows,)
        Before the first and after the last key its value is held.

    Returns
    -------
    ndarray of float64, shape (rows, joints)
    """
    segment = np.clip(np.searchsorted(key_times_s, times_s, "right") - 1, 0, len(key_times_s) - 2)
    begin, end = key_times_s[segment], key_times_s[segment + 1]
    part = np.clip((times_s - begin) / (end - begin), 0.0, 1.0)
    blend = part**3 * (10.0 - 15.0 * part + 6.0 * part**2)
    return keys[segment] + blend[:, np.newaxis] * (keys[segment + 1] - keys[segment])


@lru_cache(maxsize=1)
def load_gestures() -> dict[str, Gesture]:
    """All gestures of this package by name: the digits, words, namaste, wave, stop, rest; see gestures.toml."""
    return parse_gestures(resources.files("hri.robot.motion").joinpath("gestures.toml").read_text(encoding="utf-8"))


def parse_gestures(text: str) -> dict[str, Gesture]:
    """Read gestures from TOML, as the head of gestures.toml describes it.

    Raises
    ------
    InvalidArgument
        Names the gesture, the key and the arm: text that is no TOML, a field that is missing, unknown, of another kind
        or out of range, an unknown pose, a place that the arm cannot reach, an angle beyond its limit.
    """
    try:
        table = parse_toml(text, "gestures")
    except FormatError as error:
        raise InvalidArgument(str(error)) from error
    rates = GestureRates(**{name: number_in(table, name, "gestures", *ends) for name, ends in _RATES.items()})
    arms = field_of(table, "arms", dict, "gestures")
    gestures: dict[str, Gesture] = {}
    for number, entry in enumerate(field_of(table, "gesture", list, "gestures"), start=1):
        if not isinstance(entry, dict):
            raise InvalidArgument(f"gestures: gesture {number} is no table")
        gesture = _gesture(entry, arms, rates, f"gesture {number}")
        if gesture.name in gestures:
            raise InvalidArgument(f"gesture {gesture.name!r} is there twice")
        gestures[gesture.name] = gesture
    return gestures


def gesture_trajectory(name: str) -> Trajectory:
    """Motion of a gesture; InvalidArgument, with the known names, when there is none."""
    gestures = load_gestures()
    if name not in gestures:
        raise InvalidArgument(f"no gesture {name!r}; {did_you_mean(name, gestures)}")
    return gestures[name].trajectory()


def rest_positions() -> dict[str, float]:
    """Position of every joint at rest, in radians: standing, arms down."""
    positions = dict.fromkeys(HOAP2.names, 0.0)
    rest = load_gestures()["rest"].poses_rad[0]
    positions.update(zip(GESTURE_JOINTS, (float(value) for value in rest), strict=True))
    return positions


def _gesture(entry: dict[str, Any], arms: dict[str, Any], rates: GestureRates, where: str) -> Gesture:
    name = field_of(entry, "name", str, where)
    where = f"gesture {name!r}"
    only_fields(entry, _GESTURE_FIELDS, where)
    keys = field_of(entry, "keys", list, where)
    times_s, poses = [0.0], [_pose({}, arms, where)]
    for number, key in enumerate([*keys, {}], start=1):
        at = f"{where}, key {number}"
        if not isinstance(key, dict):
            raise InvalidArgument(f"{at}: is no table")
        only_fields(key, _KEY_FIELDS, at)
        pose = _pose(key, arms, at)
        slower = number_in(key, "slower", at, 0.0, 100.0, 1.0)
        distance = float(np.abs(pose - poses[-1]).max())
        if distance > 0.0:
            fastest_s = max(
                _JERK_SPEED * distance / rates.speed_rad_s,
                (_JERK_ACCELERATION * distance / rates.acceleration_rad_s2) ** 0.5,
                rates.least_move_s,
            )
            _add(times_s, poses, fastest_s * max(1.0, slower), pose, rates.period_s)
        hold_s = number_in(key, "hold_s", at, 0.0, 60.0, 0.0)
        if hold_s > 0.0:
            _add(times_s, poses, hold_s, pose, rates.period_s)
    if len(times_s) < 2:
        raise InvalidArgument(f"{where}: no key moves or holds anything")
    return Gesture(
        name=name,
        meaning=field_of(entry, "meaning", str, where),
        lacks=field_of(entry, "lacks", str, where) if "lacks" in entry else "",
        times_s=np.array(times_s),
        poses_rad=np.array(poses),
        period_s=rates.period_s,
    )


def _add(times_s: list[float], poses: list[Floats], duration_s: float, pose: Floats, period_s: float) -> None:
    """Append a pose after whole rows."""
    rows = round(times_s[-1] / period_s) + max(1, int(np.ceil(duration_s / period_s - 1e-9)))
    times_s.append(rows * period_s)
    poses.append(pose)


def _pose(key: dict[str, Any], arms: dict[str, Any], where: str) -> Floats:
    left = _arm(key.get("left", "down"), arms, f"{where}, left")
    right = _arm(key.get("right", "down"), arms, f"{where}, right") * _MIRROR
    head = np.radians(numbers_of(key.get("head", [0, 0]), (2,), f"{where}, head"))
    pose = np.concatenate((left, right, head))
    limits = HOAP2.limits_rad[[HOAP2.index(name) for name in GESTURE_JOINTS]]
    beyond = np.flatnonzero((pose < limits[:, 0]) | (pose > limits[:, 1]))
    if len(beyond):
        angle = np.degrees(pose[beyond[0]])
        raise InvalidArgument(f"{where}: {GESTURE_JOINTS[beyond[0]]} would be at {angle:.1f} degrees, beyond its limit")
    return pose


def _arm(value: Any, arms: dict[str, Any], where: str) -> Floats:
    """Five angles of a left arm."""
    if isinstance(value, str):
        if value not in arms:
            raise InvalidArgument(f"{where}: no arm pose {shown(value)}")
        value = arms[value]
    if isinstance(value, dict):
        return _placed(value, where)
    angles = numbers_of(value, (4, 5), where)
    return np.radians(np.append(angles, 0.0)[:5])


def _placed(value: dict[str, Any], where: str) -> Floats:
    """Angles that bring the hand to a place given from the middle between the shoulders."""
    only_fields(value, _ARM_FIELDS, where)
    at_cm = numbers_of(field_of(value, "at_cm", list, where), (3,), f"{where}, at_cm")
    arm = arm_of("left")
    place = at_cm / 100.0 - (0.0, abs(arm.shoulder_m[1]), 0.0)
    elbows = number_in(value, "elbow", where, -360.0, 360.0, _ELBOW_DEG) + np.array(sorted(range(-180, 180), key=abs))
    choices = arm_angles(arm, np.broadcast_to(place, (len(elbows), 3)), np.radians(elbows))
    possible = arm.within(choices) & (np.linalg.norm(place) <= arm.reach_m)
    clear = body_clearance(body_of(arm), *forearm_balls(arm, *arm_points(arm, choices))) > _CLEARANCE_M
    if not (possible & clear).any():
        why = "only through the body" if possible.any() else "not at all"
        raise InvalidArgument(f"{where}: the arm reaches {value['at_cm']} cm {why}")
    hand = np.radians(number_in(value, "hand", where, -360.0, 360.0, 0.0))
    return np.append(choices[np.flatnonzero(possible & clear)[0]], hand)
