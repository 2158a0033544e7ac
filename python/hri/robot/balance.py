# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Keeps a robot upright and on its course while it follows a motion that knows nothing of the floor.

A motion recorded on one robot, played on another whose joints are a degree off, ends in a fall. What is missing is what
the robot's gyroscope tells: how the base leans and turns beyond what the joints make it. The ankles of the loaded foot
lean the robot back in proportion to lean and its rate, the hip of the loaded leg turns it back to its heading.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from hri.robot.joints import Joint, JointTable
from hri.robot.kinematics import rotation_about

Vector3 = NDArray[np.float64]

_LEAN = 0.5  # rad of an ankle per rad of lean
_LEAN_RATE_S = 0.05  # rad of an ankle per rad/s of lean
_HEADING = 0.8  # rad of the hip per rad off the course
_HEADING_PER_S = 0.3  # and per rad s: what turns the robot at every step is not left over
_MOST_ANKLE_RAD = 0.12
_MOST_HIP_RAD = 0.4
_MOST_ANKLE_SPEED = 2.0  # rad/s
_MOST_HIP_SPEED = 1.0
_LEAST_LOAD_N = 5.0
_LEAST_UP = 0.2  # cosine of the lean beyond which soles do not hold a robot
_LEAST_UP_FOR_HEADING = 0.9


class Balance:
    """Corrections to the legs' joints.

    Parameters
    ----------
    table : JointTable
    follow_per_s : float
        How fast joints go to where they are sent: at this many times their distance, per second.
    """

    def __init__(self, table: JointTable, follow_per_s: float) -> None:
        self._follow_per_s = follow_per_s
        self._legs = [_chain(table, foot) for foot in table.feet]
        joints = {joint.name: joint for leg in self._legs for joint in leg}
        self._place = {name: place for place, name in enumerate(joints)}
        self._axes = [np.array(joint.axis) for joint in joints.values()]
        self._limits = np.array([(joint.lower_rad, joint.upper_rad) for joint in joints.values()])
        # Of every leg the lowest joint that rolls, pitches and turns: places in what is corrected.
        self._hands_on = [[_lowest(leg, axis, self._place) for axis in np.eye(3)] for leg in self._legs]
        most = np.array([_MOST_ANKLE_RAD, _MOST_ANKLE_RAD, _MOST_HIP_RAD])
        self._most = np.tile(most, (len(self._legs), 1))
        self._most_speed = np.tile([_MOST_ANKLE_SPEED, _MOST_ANKLE_SPEED, _MOST_HIP_SPEED], (len(self._legs), 1))
        self._most[np.array([[place is None for place in leg] for leg in self._hands_on])] = 0.0
        self._positions: NDArray[np.float64] | None = None
        self._given = np.zeros_like(self._most)
        self._course: float | None = None
        self._sum_off = 0.0  # rad s

    def start(self, positions_rad: Mapping[str, float]) -> None:
        """Forget everything; joints are at these positions."""
        self._positions = np.array([positions_rad.get(name, 0.0) for name in self._place])
        self._given = np.zeros_like(self._most)
        self._course, self._sum_off = None, 0.0

    def corrections(
        self,
        sent_rad: Mapping[str, float],
        turn: NDArray[np.float64],
        rate_rad_s: Vector3,
        loads_n: Sequence[float],
        elapsed_s: float,
    ) -> dict[str, float]:
        """What to add to positions that are sent to joints.

        Parameters
        ----------
        sent_rad : mapping of joint name to float
            Where the motion sends the joints.
        turn : ndarray, shape (3, 3)
            From the base's frame to the world.
        rate_rad_s : ndarray, shape (3,)
            Angular velocity of the base, in the world.
        loads_n : sequence of float
            Force on each foot.
        elapsed_s : float
            Since the last call.
        """
        goal = np.array([sent_rad.get(name, 0.0) for name in self._place])
        if self._positions is None:
            self._positions = goal
        followed = 1.0 - (1.0 - self._follow_per_s * 0.001) ** (1000.0 * elapsed_s)
        speeds = self._follow_per_s * (goal - self._positions) * (1.0 - 0.5 * followed)
        self._positions = self._positions + followed * (goal - self._positions)
        load = float(sum(loads_n))
        up = turn[2]
        wanted = np.zeros_like(self._most)
        if up[2] < _LEAST_UP_FOR_HEADING:
            self._course, self._sum_off = None, 0.0
        if load >= _LEAST_LOAD_N and up[2] >= _LEAST_UP:  # between two steps there may be no load for a moment
            shares = np.array(loads_n) / load
            soles, rates = zip(*(self._base_over(leg, speeds) for leg in self._legs), strict=True)
            lean = -np.cross(shares @ np.array(soles), up)
            own_rate = shares @ np.array(rates)
            lean_rate = rate_rad_s @ turn - own_rate
            back = _LEAN * lean[:2] + _LEAN_RATE_S * lean_rate[:2]
            wanted[:, :2] = shares[:, np.newaxis] * back
            off = self._off_course(turn, self._own_turn(shares, speeds), elapsed_s)
            wanted[:, 2] = shares * (_HEADING * off + _HEADING_PER_S * self._sum_off)
        wanted = np.clip(wanted, -self._most, self._most)
        speed = np.clip((wanted - self._given) / elapsed_s, -self._most_speed, self._most_speed)
        self._given = self._given + elapsed_s * speed
        return self._by_name(goal, self._given + speed / self._follow_per_s)  # joints follow late: lead by that

    def _own_turn(self, shares: NDArray[np.float64], speeds: NDArray[np.float64]) -> float:
        """Rate at which the motion's loaded hips turn the base; other joints sway it, which would add up to a drift."""
        hips = [leg[2] for leg in self._hands_on]
        return -sum(share * speeds[hip] for share, hip in zip(shares.tolist(), hips, strict=True) if hip is not None)

    def _off_course(self, turn: NDArray[np.float64], own_turn: float, elapsed_s: float) -> float:
        """Angle from where the motion would have turned the base to where it points."""
        if turn[2, 2] < _LEAST_UP_FOR_HEADING:
            self._course, self._sum_off = None, 0.0
            return 0.0
        heading = float(np.arctan2(turn[1, 0], turn[0, 0]))
        if self._course is None:
            self._course, self._sum_off = heading, 0.0
        self._course += elapsed_s * own_turn
        off = float((heading - self._course + np.pi) % (2.0 * np.pi) - np.pi)
        most = _MOST_HIP_RAD / _HEADING_PER_S
        self._sum_off = min(max(self._sum_off + elapsed_s * off, -most), most)
        return off

    def _base_over(self, leg: Sequence[Joint], speeds: NDArray[np.float64]) -> tuple[Vector3, Vector3]:
        """The sole's z axis, and the angular velocity of the base if the sole stays; in the base's frame."""
        assert self._positions is not None
        turn, rate = np.eye(3), np.zeros(3)
        for joint in leg:
            place = self._place[joint.name]
            rate -= speeds[place] * (turn @ self._axes[place])
            turn = turn @ rotation_about(self._axes[place], self._positions[place])
        return turn[:, 2], rate

    def _by_name(self, goal: NDArray[np.float64], given: NDArray[np.float64]) -> dict[str, float]:
        names = list(self._place)
        found: dict[str, float] = {}
        for leg, values in zip(self._hands_on, given.tolist(), strict=True):
            for place, value in zip(leg, values, strict=True):
                if place is not None:
                    low, high = self._limits[place]
                    low, high = min(low, goal[place]), max(high, goal[place])
                    found[names[place]] = min(max(goal[place] + value, low), high) - goal[place]
        return found


def _chain(table: JointTable, link: str) -> list[Joint]:
    """The joints from the base to a link."""
    carriers = {joint.child: joint for joint in table.joints}
    joints: list[Joint] = []
    while link in carriers:
        joints.insert(0, carriers[link])
        link = carriers[link].parent
    return joints


def _lowest(leg: Sequence[Joint], axis: Vector3, places: Mapping[str, int]) -> int | None:
    """Place of the joint nearest to the foot that turns about an axis; None when there is none."""
    found = [places[joint.name] for joint in leg if np.array_equal(joint.axis, axis)]
    return found[-1] if found else None
