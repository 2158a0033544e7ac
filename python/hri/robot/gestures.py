# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What the robot shows for a recognised digit or sign: key poses, joined with least jerk."""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from functools import lru_cache
from importlib import resources
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.errors import InvalidArgument
from hri.robot.joints import HOAP2
from hri.robot.trajectory import Trajectory

GESTURE_JOINTS = (
    *(f"larm_joint_{number}" for number in range(1, 5)),
    *(f"rarm_joint_{number}" for number in range(1, 5)),
    "head_joint_1",
    "head_joint_2",
)
_MIRROR = np.array([1.0, -1.0, -1.0, 1.0])


@dataclass(frozen=True)
class Gesture:
    """A motion from rest to rest.

    Attributes
    ----------
    name, meaning : str
    times_s : ndarray of float64, shape (keys,)
        From 0, rising.
    poses_rad : ndarray of float64, shape (keys, joints)
        Of GESTURE_JOINTS; the robot stands still in each.
    period_s : float
        Of the trajectory.
    """

    name: str
    meaning: str
    times_s: NDArray[np.float64]
    poses_rad: NDArray[np.float64]
    period_s: float

    def trajectory(self) -> Trajectory:
        """Join the key poses with least jerk."""
        rows = round(self.times_s[-1] / self.period_s) + 1
        times_s = np.arange(rows) * self.period_s
        positions = minimum_jerk(self.times_s, self.poses_rad, times_s)
        return Trajectory(GESTURE_JOINTS, self.period_s, positions)


def minimum_jerk(
    key_times_s: NDArray[np.float64], keys: NDArray[np.float64], times_s: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Go from key to key along 10 s^3 - 15 s^4 + 6 s^5, at rest in each (Flash and Hogan, 1985).

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
    """All gestures of this package by name: "0" to "9", namaste, wave, stop, rest."""
    text = resources.files("hri.robot").joinpath("gestures.toml").read_text(encoding="utf-8")
    table = tomllib.loads(text)
    return {entry["name"]: _gesture(entry, table) for entry in table["gesture"]}


def gesture_trajectory(name: str) -> Trajectory:
    """Motion of a gesture; InvalidArgument, with the known names, when there is none."""
    gestures = load_gestures()
    if name not in gestures:
        raise InvalidArgument(f"no gesture {name!r}; there are {', '.join(gestures)}")
    return gestures[name].trajectory()


def rest_positions() -> dict[str, float]:
    """Position of every joint at rest, in radians: standing, arms down."""
    positions = dict.fromkeys(HOAP2.names, 0.0)
    rest = load_gestures()["rest"].poses_rad[0]
    positions.update(zip(GESTURE_JOINTS, (float(value) for value in rest), strict=True))
    return positions


def _gesture(entry: dict[str, Any], table: dict[str, Any]) -> Gesture:
    keys = entry["keys"]
    if keys[0]["time_s"] > 0.0:
        keys = [{"time_s": 0.0}, *keys]
    arms = table["arms"]
    poses = []
    for key in keys:
        left = np.array(arms[key.get("left", "down")], dtype=np.float64)
        right = np.array(arms[key.get("right", "down")], dtype=np.float64) * _MIRROR
        poses.append(np.concatenate((left, right, key.get("head", (0.0, 0.0)))))
    return Gesture(
        name=entry["name"],
        meaning=entry["meaning"],
        times_s=np.array([key["time_s"] for key in keys]),
        poses_rad=np.radians(poses),
        period_s=table["period_s"],
    )
