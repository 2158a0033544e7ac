# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Balance and heading control of a robot on its feet, for motions recorded without feedback.

A motion recorded on one robot, played on another whose joints have an offset of a degree, ends in a fall. The feedback
is the gyroscope's: tilt and heading of the base beyond what the joint angles imply.

- Ankle strategy: the ankles of loaded feet counteract tilt and tilt rate proportionally.
- Integral correction: the joint offset of a leg is observed whenever it stands alone with its sole flat; its ankle
  corrects it, in the swing phase too, so that the foot lands as flat as the motion intends.
- An ankle does not tilt a sole that stands on an edge any further: that moves the foot, not the robot, until it falls
  over that edge.
- Heading: the yaw joints of loaded hips correct the heading error, and return while their foot is in the air; with two
  feet on the floor both turn alike, as feet that twist against one another slip.

Nothing acts before the feet alone carry the robot: while it sits and pushes itself up with its hands, an ankle only
tilts its foot onto an edge; see `getting_up`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from hri.robot.control.getting_up import GettingUp
from hri.robot.control.soles import Soles
from hri.robot.model.joints import Joint, JointTable

Floats = NDArray[np.float64]

_LEAN = 0.5  # rad of an ankle per rad of lean
_LEAN_RATE_S = 0.05  # rad of an ankle per rad/s of lean
_HEADING_PER_S = 3.0  # rad/s of a loaded hip per rad of heading error
_BACK_PER_S = 8.0  # a hip without load turns back at this many times its turn, per second
_MOST_ANKLE_RAD = 0.12
_MOST_HIP_RAD = 0.4
_MOST_ANKLE_SPEED = 2.0  # rad/s
_MOST_HIP_SPEED = 1.0
_LEARN_PER_S = 1.0  # gain of the integral correction of a leg's joint offset
_MOST_LEARNED_RAD = 0.07
_ALONE = (0.5, 0.9)  # share of the load from which a leg's offset is observed, and fully
_FLAT = (1.0, 0.7)  # centre of pressure, 1 at the sole's edge: the same
_EDGE = (0.6, 0.95)  # from which an ankle does not tilt the sole further about this edge, or not at all
_LOADED = 0.3  # share of the load with which a leg counts in full
_CARRY_S = 0.1  # the mean over about this time says whether feet carry the robot
_CARRIED = (0.7, 0.9)  # share of the weight on the feet: below the first it lies or sits, above the second it stands
_LEAST_UP = 0.2  # cosine of the lean beyond which soles do not hold a robot
_LEAST_UP_FOR_HEADING = 0.9


class Balance:
    """Corrections to the joints of legs and waist.

    Parameters
    ----------
    table : JointTable
    follow_per_s : float
        How fast joints go to where they are sent: at this many times their distance, per second.
    """

    def __init__(self, table: JointTable, follow_per_s: float) -> None:
        self._follow_per_s = follow_per_s
        legs = [_chain(table, foot) for foot in table.feet]
        joints = {joint.name: joint for leg in legs for joint in leg}
        self._place = {name: place for place, name in enumerate(joints)}
        limits = np.array([(joint.lower_rad, joint.upper_rad) for joint in joints.values()])
        self._low, self._high = limits.T
        self._weight_n = 9.81 * sum(link.mass_kg for link in table.links.values())
        self._legs = _Legs(legs, self._place)
        self._soles = Soles(table)
        self._getting_up = GettingUp(legs, table)
        # Of every leg the lowest joint that rolls, pitches and turns: places in what is corrected.
        self._hands_on = [[_lowest(leg, axis, self._place) for axis in np.eye(3)] for leg in legs]
        self._hips = np.array([leg[2] if leg[2] is not None else -1 for leg in self._hands_on])
        most = np.array([_MOST_ANKLE_RAD, _MOST_ANKLE_RAD, _MOST_HIP_RAD])
        self._most = np.tile(most, (len(legs), 1))
        self._most_speed = np.tile([_MOST_ANKLE_SPEED, _MOST_ANKLE_SPEED, _MOST_HIP_SPEED], (len(legs), 1))
        self._most[np.array([[place is None for place in leg] for leg in self._hands_on])] = 0.0
        self.start({})

    @property
    def rising(self) -> bool:
        """Whether the robot lay and does not stand yet."""
        return self._getting_up.rising

    def start(self, positions_rad: Mapping[str, float]) -> None:
        """Forget everything; joints are at these positions."""
        self._getting_up.start()
        self._positions = np.array([positions_rad.get(name, 0.0) for name in self._place])
        self._given = np.zeros_like(self._most)
        self._learned = np.zeros((len(self._most), 2))
        self._soles.start()
        self._carried_n = 0.0
        self._course: float | None = None

    def corrections(
        self,
        sent_rad: Mapping[str, float],
        turn: Floats,
        rate_rad_s: Floats,
        pressures: Floats,
        elapsed_s: float,
        joints_rad: Mapping[str, float] | None = None,
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
        pressures : ndarray, shape (feet, 3)
            Force on each foot, and x and y of its centre in the frame of the foot's link.
        elapsed_s : float
            Since the last call.
        joints_rad : mapping of joint name to float, optional
            Where all joints are; needed while `rising` alone.
        """
        goal = np.array([sent_rad.get(name, 0.0) for name in self._place])
        followed = 1.0 - (1.0 - self._follow_per_s * 0.001) ** (1000.0 * elapsed_s)
        speeds = self._follow_per_s * (goal - self._positions) * (1.0 - 0.5 * followed)
        self._positions = self._positions + followed * (goal - self._positions)
        self._soles.feel(pressures, elapsed_s)
        load = max(float(self._soles.loads_n.sum()), 1e-9)
        self._carried_n += (1.0 - np.exp(-elapsed_s / _CARRY_S)) * (float(pressures[:, 0].sum()) - self._carried_n)
        share_carried = self._carried_n / self._weight_n
        carried = _ramp(share_carried, _CARRIED)
        up = turn[2]
        wanted = (1.0 - elapsed_s * _BACK_PER_S) * self._given
        if carried == 0.0 or up[2] < _LEAST_UP_FOR_HEADING:
            self._course = None
        if carried > 0.0 and up[2] >= _LEAST_UP:
            shares = self._soles.loads_n / load
            soles, rates = self._legs.base_over(self._positions, speeds)
            a, b, c = up.tolist()
            leans = np.array([(z * b - y * c, x * c - z * a) for x, y, z in soles.tolist()])  # up x sole
            lean_rate = (rate_rad_s @ turn - shares @ rates)[:2]
            wanted[:, :2] = carried * self._ankles(leans, lean_rate, shares, elapsed_s * carried)
            off = self._off_course(turn, -float(shares @ np.where(self._hips >= 0, speeds[self._hips], 0.0)), elapsed_s)
            loaded = carried * np.minimum(1.0, shares / _LOADED)
            wanted[:, 2] += elapsed_s * loaded * (_HEADING_PER_S * off + _BACK_PER_S * self._given[:, 2])
        wanted = np.minimum(np.maximum(wanted, -self._most), self._most)
        speed = np.minimum(np.maximum((wanted - self._given) / elapsed_s, -self._most_speed), self._most_speed)
        self._given = self._given + elapsed_s * speed
        found = self._by_name(goal, self._given + speed / self._follow_per_s)  # joints follow late: lead by that
        return found | self._getting_up.corrections(sent_rad, turn, share_carried, elapsed_s, joints_rad)

    def _ankles(self, leans: Floats, lean_rate: Floats, shares: Floats, learning_s: float) -> Floats:
        """Where ankles should be turned: legs by roll and pitch; `leans` is how the base leans as each leg sees it."""
        answers = (_LEAN * (shares @ leans) + _LEAN_RATE_S * lean_rate).tolist()
        ankles, given = np.empty_like(leans), self._given[:, :2]
        for leg, (share, off_middle) in enumerate(zip(shares.tolist(), self._soles.off_middle, strict=True)):
            alone, loaded = _ramp(share, _ALONE), min(1.0, share / _LOADED)
            flattening = (off_middle[1], -off_middle[0])  # sign of the turn that would lay the sole flat
            rows = zip(leans[leg].tolist(), given[leg].tolist(), self._learned[leg].tolist(), flattening, strict=True)
            for axis, (lean, at, learned, flat) in enumerate(rows):
                sure = alone * _ramp(abs(flat), _FLAT)
                # A flat sole that leans the base although its ankle gives something is off by both.
                learned += learning_s * _LEARN_PER_S * sure * (lean + at - learned)
                learned = min(max(learned, -_MOST_LEARNED_RAD), _MOST_LEARNED_RAD)
                self._learned[leg, axis] = learned
                turning = learned + share * answers[axis] - at
                if turning * flat < 0.0:
                    turning *= 1.0 - loaded * _ramp(abs(flat), _EDGE)
                ankles[leg, axis] = at + turning
        return ankles

    def _off_course(self, turn: Floats, own_turn: float, elapsed_s: float) -> float:
        """Angle from where the motion would have turned the base to where it points.

        Only the motion's loaded hips turn the base; other joints sway it, which would add up to a drift.
        """
        if turn[2, 2] < _LEAST_UP_FOR_HEADING:
            return 0.0
        heading = float(np.arctan2(turn[1, 0], turn[0, 0]))
        if self._course is None:
            self._course = heading
        self._course += elapsed_s * own_turn
        return float((heading - self._course + np.pi) % (2.0 * np.pi) - np.pi)

    def _by_name(self, goal: Floats, given: Floats) -> dict[str, float]:
        names = list(self._place)
        found: dict[str, float] = {}
        for leg, values in zip(self._hands_on, given.tolist(), strict=True):
            for place, value in zip(leg, values, strict=True):
                if place is not None:
                    at = float(goal[place])
                    low, high = min(self._low[place], at), max(self._high[place], at)
                    found[names[place]] = float(min(max(at + value, low), high)) - at
        return found


class _Legs:
    """Turns the joints of all legs at once."""

    def __init__(self, legs: Sequence[Sequence[Joint]], places: Mapping[str, int]) -> None:
        longest = max(map(len, legs))
        self._places = np.zeros((longest, len(legs)), dtype=np.intp)
        self._axes = np.zeros((longest, len(legs), 3))  # a leg with fewer joints ends with some that do not turn
        for column, leg in enumerate(legs):
            for row, joint in enumerate(leg):
                self._places[row, column] = places[joint.name]
                self._axes[row, column] = joint.axis
        x, y, z = np.moveaxis(self._axes, 2, 0)
        none = np.zeros_like(x)
        crosses = np.stack((none, -z, y, z, none, -x, -y, x, none), axis=-1).reshape(longest, len(legs), 3, 3)
        self._crosses, self._squares = crosses, crosses @ crosses

    def base_over(self, positions: Floats, speeds: Floats) -> tuple[Floats, Floats]:
        """Of every leg the sole's z axis, and the base's angular velocity if the sole stays; in the base's frame."""
        angles = positions[self._places][:, :, np.newaxis, np.newaxis]
        turns = np.eye(3) + np.sin(angles) * self._crosses + (1.0 - np.cos(angles)) * self._squares
        spins = speeds[self._places][:, :, np.newaxis] * self._axes
        turn = turns[0]
        rate = -spins[0]
        for row in range(1, len(turns)):
            rate -= (turn @ spins[row][:, :, np.newaxis])[:, :, 0]
            turn = turn @ turns[row]
        return turn[:, :, 2], rate


def _ramp(value: float, ends: tuple[float, float]) -> float:
    """0 at the first end, 1 at the second, linear between them."""
    return min(max((value - ends[0]) / (ends[1] - ends[0]), 0.0), 1.0)


def _chain(table: JointTable, link: str) -> list[Joint]:
    """The joints from the base to a link."""
    carriers = {joint.child: joint for joint in table.joints}
    joints: list[Joint] = []
    while link in carriers:
        joints.insert(0, carriers[link])
        link = carriers[link].parent
    return joints


def _lowest(leg: Sequence[Joint], axis: Floats, places: Mapping[str, int]) -> int | None:
    """Place of the joint nearest to the foot that turns about an axis; None when there is none."""
    found = [places[joint.name] for joint in leg if np.array_equal(joint.axis, axis)]
    return found[-1] if found else None
