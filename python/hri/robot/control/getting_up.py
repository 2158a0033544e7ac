# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Moves the centre of mass of a robot that gets up from the floor over its feet.

Hands push it up until its feet carry it. When they leave the floor before the centre of mass is over the soles, it
falls back. The upper body leans forward by how far the capture point (over which the centre of mass comes to rest,
Pratt et al., 2006) is behind the middle of the soles. The load on the feet is no sign of that: they carry everything,
too, in the moment in which the robot falls back over its heels. Nor do ankles help: they tilt a foot that carries
little.

A robot whose centre of mass is before its feet, as that of one who gets up from its belly, is not made to lean.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from hri.robot.model.joints import Joint, JointTable
from hri.robot.model.mass_centre import MassCentre

_MOST_RAD = 0.3
_LEAN_PER_M = 10.0  # rad at the waist for a metre that the capture point is behind the soles' middle
_SPEED = 0.8  # rad/s
_SMOOTH_S = 0.03  # of the speed of the centre of mass
_TOUCHING = 0.05  # share of the weight below which it sits or lies
_LEANING = 0.3  # sine of the pitch beyond which it does not sit any more
_LYING_UP = 0.5  # cosine of the tilt that only a robot on the floor has
_STANDING_RAD = 0.25  # tilt, but for what it was made to lean
_STANDING_CARRIED = 0.9


class GettingUp:
    """Lean of the upper body, from when a robot lay until it stands.

    Parameters
    ----------
    legs : sequence of sequence of Joint
        From the base to each foot. What leans are the pitching joints that all legs share, the waist; a robot that has
        none gets no help.
    table : JointTable
    """

    def __init__(self, legs: Sequence[Sequence[Joint]], table: JointTable) -> None:
        shared = [joint for joint in legs[0] if all(joint in leg for leg in legs)] if legs else []
        # The base leans forward when what hangs on the joint turns backward, about -y.
        self._waist = [(joint, -float(joint.axis[1])) for joint in shared if abs(joint.axis[1]) == 1.0]
        self._names = table.names
        self._mass_centre = MassCentre(table)
        self.start()

    @property
    def rising(self) -> bool:
        """Whether it lay and does not stand yet."""
        return self._rising and bool(self._waist)

    def start(self) -> None:
        """Forget everything."""
        self._rising = False
        self._lean_rad = 0.0
        self._behind_m: float | None = None
        self._falling_back_m_s = 0.0

    def corrections(
        self,
        sent_rad: Mapping[str, float],
        turn: NDArray[np.float64],
        carried: float,
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
        carried : float
            Share of the weight on the feet.
        elapsed_s : float
            Since the last call.
        joints_rad : mapping of joint name to float, optional
            Where all joints are; without, it does not lean.
        """
        up, pitch_sine = float(turn[2, 2]), -float(turn[2, 0])
        if up < _LYING_UP and carried < _STANDING_CARRIED:
            self._rising = True
        elif np.arccos(min(up, 1.0)) < _STANDING_RAD + self._lean_rad and carried > _STANDING_CARRIED:
            self._rising = False
        wanted = 0.0
        if self.rising and joints_rad is not None and carried > _TOUCHING and pitch_sine > _LEANING:
            behind_m = self._capture_point_behind(np.array([joints_rad[name] for name in self._names]), turn, elapsed_s)
            wanted = min(max(_LEAN_PER_M * behind_m, 0.0), _MOST_RAD)
        else:
            self._behind_m = None
        step = _SPEED * elapsed_s
        self._lean_rad += min(max(wanted - self._lean_rad, -step), step)
        found: dict[str, float] = {}
        for joint, sign in self._waist:
            sent = sent_rad.get(joint.name, 0.0)
            low, high = min(joint.lower_rad, sent), max(joint.upper_rad, sent)
            found[joint.name] = min(max(sent + sign * self._lean_rad, low), high) - sent
        return found

    def _capture_point_behind(
        self, positions_rad: NDArray[np.float64], turn: NDArray[np.float64], elapsed_s: float
    ) -> float:
        """How far the capture point is behind the middle of the soles."""
        soles = self._mass_centre.soles_from_it(positions_rad, turn)
        to_the_left = turn[:2, 1] / max(float(np.hypot(turn[0, 1], turn[1, 1])), 1e-6)
        forward = np.array([to_the_left[1], -to_the_left[0]])
        behind_m = float((soles[:, :, :2] @ forward).mean())
        if self._behind_m is None:
            self._falling_back_m_s = 0.0
        else:
            speed = (behind_m - self._behind_m) / elapsed_s
            self._falling_back_m_s += (1.0 - np.exp(-elapsed_s / _SMOOTH_S)) * (speed - self._falling_back_m_s)
        self._behind_m = behind_m
        height_m = max(-float(soles[:, :, 2].min()), 0.0)
        return behind_m + self._falling_back_m_s * float(np.sqrt(height_m / 9.81))
