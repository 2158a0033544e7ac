# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The robot's motion for a recognised digit or sign: key poses joined by minimum-jerk trajectories."""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from functools import lru_cache
from importlib import resources
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.core.display import short_repr
from hri.core.errors import InvalidArgument
from hri.core.suggest import did_you_mean
from hri.robot.model.arm import MIRROR, arm_angles, arm_of, arm_points
from hri.robot.model.clearance import body_clearance, body_of, forearm_balls
from hri.robot.model.joints import HOAP2
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
        Names the gesture, the key and the arm: an unknown pose or field, a place that the arm cannot reach, an angle
        beyond its limit.
    """
    try:
        table = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise InvalidArgument(f"gestures: {error}") from error
    gestures = [_gesture(entry, table) for entry in table["gesture"]]
    return {gesture.name: gesture for gesture in gestures}


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


def _gesture(entry: dict[str, Any], table: dict[str, Any]) -> Gesture:
    times_s, poses = [0.0], [_pose({}, table, entry["name"])]
    for number, key in enumerate([*entry["keys"], {}], start=1):
        where = f"gesture {entry['name']!r}, key {number}"
        unknown = set(key) - _KEY_FIELDS
        if unknown:
            raise InvalidArgument(f"{where}: no field {', '.join(sorted(unknown))}")
        pose = _pose(key, table, where)
        distance = float(np.abs(pose - poses[-1]).max())
        if distance > 0.0:
            fastest_s = max(
                _JERK_SPEED * distance / table["speed_rad_s"],
                (_JERK_ACCELERATION * distance / table["acceleration_rad_s2"]) ** 0.5,
                table["least_move_s"],
            )
            _add(times_s, poses, fastest_s * max(1.0, key.get("slower", 1.0)), pose, table["period_s"])
        if key.get("hold_s", 0.0) > 0.0:
            _add(times_s, poses, key["hold_s"], pose, table["period_s"])
    return Gesture(
        name=entry["name"],
        meaning=entry["meaning"],
        lacks=entry.get("lacks", ""),
        times_s=np.array(times_s),
        poses_rad=np.array(poses),
        period_s=table["period_s"],
    )


def _add(times_s: list[float], poses: list[Floats], duration_s: float, pose: Floats, period_s: float) -> None:
    """Append a pose after whole rows."""
    rows = round(times_s[-1] / period_s) + max(1, int(np.ceil(duration_s / period_s - 1e-9)))
    times_s.append(rows * period_s)
    poses.append(pose)


def _pose(key: dict[str, Any], table: dict[str, Any], where: str) -> Floats:
    left = _arm(key.get("left", "down"), table["arms"], f"{where}, left")
    right = _arm(key.get("right", "down"), table["arms"], f"{where}, right") * _MIRROR
    head = np.radians(np.array(key.get("head", (0.0, 0.0)), dtype=np.float64))
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
            raise InvalidArgument(f"{where}: no arm pose {value!r}")
        value = arms[value]
    if isinstance(value, dict):
        return _placed(value, where)
    if len(value) not in (4, 5):
        raise InvalidArgument(f"{where}: {len(value)} angles, must be 4 or 5")
    return np.radians(np.array([*value, 0.0][:5], dtype=np.float64))


def _placed(value: dict[str, Any], where: str) -> Floats:
    """Angles that bring the hand to a place given from the middle between the shoulders."""
    if "at_cm" not in value or set(value) - _ARM_FIELDS:
        raise InvalidArgument(f"{where}: fields {', '.join(sorted(value))}, must be at_cm, and may be elbow and hand")
    arm = arm_of("left")
    place = np.array(value["at_cm"], dtype=np.float64) / 100.0 - (0.0, abs(arm.shoulder_m[1]), 0.0)
    elbows = value.get("elbow", _ELBOW_DEG) + np.array(sorted(range(-180, 180), key=abs))
    choices = arm_angles(arm, np.broadcast_to(place, (len(elbows), 3)), np.radians(elbows))
    possible = arm.within(choices) & (np.linalg.norm(place) <= arm.reach_m)
    clear = body_clearance(body_of(arm), *forearm_balls(arm, *arm_points(arm, choices))) > _CLEARANCE_M
    if not (possible & clear).any():
        why = "only through the body" if possible.any() else "not at all"
        raise InvalidArgument(f"{where}: the arm reaches {value['at_cm']} cm {why}")
    return np.append(choices[np.flatnonzero(possible & clear)[0]], np.radians(value.get("hand", 0.0)))
