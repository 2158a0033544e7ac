# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Walking so many steps: the centre of mass goes over one sole before the other foot leaves the floor.

Our own motion, statically stable and slow: nothing of it is recorded on a robot. Before every step the body moves until
the centre of mass, by the masses of the joint table, is over the sole that stays; the other foot then swings forward,
level. The last foot comes to stand beside the one before. Upright throughout, knees bent, arms at rest.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import InvalidArgument
from hri.robot.model.arm import SIDES
from hri.robot.model.joints import HOAP2, JointTable
from hri.robot.model.leg import leg_angles, leg_of
from hri.robot.model.mass_centre import MassCentre
from hri.robot.motion.gestures import minimum_jerk
from hri.robot.motion.trajectory import Trajectory

Floats = NDArray[np.float64]

MAX_STEPS = 20
MAX_STEP_M = 0.05
STEP_M = 0.04
_PERIOD_S = 0.01
_CROUCH_M = 0.02  # how much lower than with straight legs
_LIFT_M = 0.02  # of a foot in the air
_INSIDE_M = 0.006  # the centre of mass stays by this nearer to the other foot than the middle of the sole
_CROUCH_S = 1.2
_SHIFT_S = 0.9
_SWING_S = 0.9
_UPWARDS = 0.2  # part of a swing in which the foot rises without going anywhere; it comes down in as much
_PLACINGS = 4  # rounds until the body is where the centre of mass wants it


def walking_trajectory(num_steps: int, step_m: float = STEP_M, table: JointTable = HOAP2) -> Trajectory:
    """Walk from standing to standing.

    Parameters
    ----------
    num_steps : int
        1 to `MAX_STEPS`, the right foot first; then the foot behind comes beside the other.
    step_m : float
        How far the robot goes in a step, forward, or back below 0; at most `MAX_STEP_M`.
    table : JointTable

    Returns
    -------
    Trajectory
        Of all joints of the legs. For a robot that stands on its feet.

    Raises
    ------
    InvalidArgument
        For numbers out of range, and a robot without HOAP-2's legs.
    """
    if not 1 <= num_steps <= MAX_STEPS:
        raise InvalidArgument(f"num_steps is {num_steps}, must lie in 1..{MAX_STEPS}")
    if not 0.0 < abs(step_m) <= MAX_STEP_M:
        raise InvalidArgument(f"step_m is {step_m}, must lie in -{MAX_STEP_M}..{MAX_STEP_M} and not be 0")
    return _Walk(table).trajectory(num_steps, step_m)


class _Walk:
    """Key poses: when, and where the body and both ankles are, in the frame of the base as it stands first."""

    def __init__(self, table: JointTable) -> None:
        self._table = table
        self._legs = [leg_of(side, table) for side in SIDES]
        self._names = [name for leg in self._legs for name in leg.names]
        self._columns = [table.names.index(name) for name in self._names]
        self._rest = np.array([joint.rest_rad for joint in table.joints])
        self._mass = MassCentre(table)
        straight = np.array([0.0, 0.0, 2.0 * self._legs[0].bone_m])
        self._ankles = np.array([leg.hip_m - straight for leg in self._legs])
        self._body = np.array([0.0, 0.0, -_CROUCH_M])
        self._times = [0.0]
        self._keys = [self._key()]
        self._swings: list[tuple[float, int]] = []  # when the foot of this number begins to swing

    def trajectory(self, num_steps: int, step_m: float) -> Trajectory:
        """The whole walk."""
        for number in range(num_steps + 1):
            swinging = (number + 1) % 2  # the right foot first
            self._shift(self._over(1 - swinging))
            far = step_m * min(number + 1, num_steps)
            self._swing(swinging, self._legs[swinging].hip_m[0] + far)
        self._shift(self._middle())
        walk = self._rows()
        down = self._from_standing(walk[0])
        up = self._from_standing(walk[-1])[::-1]
        return Trajectory(self._names, _PERIOD_S, np.concatenate((down[:-1], walk, up[1:])))

    def _key(self) -> Floats:
        return np.concatenate((self._body, self._ankles.ravel()))

    def _add(self, seconds: float) -> None:
        self._times.append(self._times[-1] + seconds)
        self._keys.append(self._key())

    def _over(self, foot: int) -> Floats:
        """Where the centre of mass has to be, over the middle of a sole and a little inside; x and y."""
        inwards = np.sign(self._ankles[1 - foot][1] - self._ankles[foot][1])
        return self._sole(foot) + np.array([0.0, inwards * _INSIDE_M])

    def _middle(self) -> Floats:
        return 0.5 * (self._sole(0) + self._sole(1))

    def _sole(self, foot: int) -> Floats:
        """The middle of a sole, from the frame of its level foot; x and y."""
        box = min(self._table.links[self._table.feet[foot]].solid, key=lambda shape: shape.start[2])
        middle: Floats = self._ankles[foot][:2] + np.array(box.start[:2])
        return middle

    def _shift(self, target: Floats) -> None:
        self._place(target)
        self._add(_SHIFT_S)

    def _swing(self, foot: int, x: float) -> None:
        target = self._over(1 - foot)
        self._swings.append((self._times[-1], foot))
        self._add(_UPWARDS * _SWING_S)
        self._ankles[foot][0] = x
        self._place(target)
        self._add((1.0 - 2.0 * _UPWARDS) * _SWING_S)
        self._add(_UPWARDS * _SWING_S)

    def _place(self, target: Floats) -> None:
        """Move the body until the centre of mass is over a place."""
        for _ in range(_PLACINGS):
            positions = self._rest.copy()
            positions[self._columns] = self._angles(self._key()[np.newaxis])[0]
            corners = self._mass.soles_from_it(positions, np.eye(3))
            centre = self._sole(0) - corners[0].mean(axis=0)[:2]
            self._body[:2] += target - centre

    def _angles(self, keys: Floats) -> Floats:
        """Of both legs, shape (rows, 12)."""
        body = keys[:, :3]
        return np.concatenate(
            [leg_angles(leg, keys[:, 3 + 3 * foot : 6 + 3 * foot] - body) for foot, leg in enumerate(self._legs)],
            axis=1,
        )

    def _rows(self) -> Floats:
        times = _PERIOD_S * np.arange(round(self._times[-1] / _PERIOD_S) + 1, dtype=np.float64)
        keys = minimum_jerk(np.array(self._times), np.array(self._keys), times)
        for begin_s, foot in self._swings:
            part = np.clip((times - begin_s) / _SWING_S, 0.0, 1.0)
            keys[:, 5 + 3 * foot] += _LIFT_M * 16.0 * part**2 * (1.0 - part) ** 2
        return self._angles(keys)

    def _from_standing(self, crouched: Floats) -> Floats:
        """From straight legs to a pose, every joint by itself: the soles stay level."""
        times = _PERIOD_S * np.arange(round(_CROUCH_S / _PERIOD_S) + 1, dtype=np.float64)
        return minimum_jerk(np.array([0.0, _CROUCH_S]), np.stack((np.zeros_like(crouched), crouched)), times)
