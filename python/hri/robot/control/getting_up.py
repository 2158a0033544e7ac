# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Moves the centre of mass of a robot that gets up from the floor over its feet.

Hands push it up until its feet carry it. The load on the hands shows how far the centre of mass is behind the feet;
leaning the upper body forward moves it over them. An ankle would do less: it tilts a foot that carries little.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from hri.robot.model.joints import Joint

_MOST_RAD = 0.3
_SPEED = 0.8  # rad/s
_CARRIED = (0.4, 0.8)  # share of the weight on the feet: below the first it leans in full, above the second not at all
_TOUCHING = 0.05  # share of the weight below which it sits or lies
_LEANING = 0.3  # sine of the pitch beyond which it is over its hands no more
_LYING_UP = 0.5  # cosine of the tilt that only a robot on the floor has
_STANDING_UP = 0.97
_STANDING_CARRIED = 0.9


class GettingUp:
    """Lean of the upper body, from when a robot lay until it stands.

    Parameters
    ----------
    legs : sequence of sequence of Joint
        From the base to each foot. What leans are the pitching joints that all legs share, the waist; a robot that has
        none gets no help.
    """

    def __init__(self, legs: Sequence[Sequence[Joint]]) -> None:
        shared = [joint for joint in legs[0] if all(joint in leg for leg in legs)] if legs else []
        # The base leans forward when what hangs on the joint turns backward, about -y.
        self._waist = [(joint, -float(joint.axis[1])) for joint in shared if abs(joint.axis[1]) == 1.0]
        self.start()

    def start(self) -> None:
        """Forget everything."""
        self._rising = False
        self._lean_rad = 0.0

    def corrections(
        self, sent_rad: Mapping[str, float], turn: NDArray[np.float64], carried: float, elapsed_s: float
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
        """
        up, pitch_sine = float(turn[2, 2]), -float(turn[2, 0])
        if up < _LYING_UP and carried < _STANDING_CARRIED:
            self._rising = True
        elif up > _STANDING_UP and carried > _STANDING_CARRIED:
            self._rising = False
        wanted = 0.0
        if self._rising and carried > _TOUCHING and pitch_sine > _LEANING:
            low, high = _CARRIED
            wanted = _MOST_RAD * min(max((high - carried) / (high - low), 0.0), 1.0)
        step = _SPEED * elapsed_s
        self._lean_rad += min(max(wanted - self._lean_rad, -step), step)
        found: dict[str, float] = {}
        for joint, sign in self._waist:
            sent = sent_rad.get(joint.name, 0.0)
            low, high = min(joint.lower_rad, sent), max(joint.upper_rad, sent)
            found[joint.name] = min(max(sent + sign * self._lean_rad, low), high) - sent
        return found
