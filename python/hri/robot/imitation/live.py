# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Where a robot's arms should be for where a person's hands are: one picture at a time, without what comes after."""

from __future__ import annotations

import threading
from collections import deque
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import InvalidArgument
from hri.robot.imitation.body import MIN_HEIGHT_PX, NOSE_ABOVE_SHOULDERS, REACH, SHOULDER_WIDTH
from hri.robot.imitation.search import PoseFinder
from hri.robot.model.arm import MIRROR, SIDES, arm_of
from hri.robot.model.joints import HOAP2, JointTable
from hri.robot.motion.gestures import rest_positions

Floats = NDArray[np.float64]

_SMOOTHING_S = 0.1
_REST_AFTER_S = 1.5
_OUT_OF_DATE_S = 1.0
_KEPT = 256


@dataclass(frozen=True)
class SeenPerson:
    """A person in one picture, as a camera before the person sees them; None for a hand that is not seen.

    Attributes
    ----------
    left_px, right_px : (x, y) or None
        The person's own left and right hand.
    nose_px : (x, y)
        The middle of the face.
    height_px : float
        Of the person, standing.
    """

    left_px: tuple[float, float] | None
    right_px: tuple[float, float] | None
    nose_px: tuple[float, float]
    height_px: float


class LiveImitation:
    """Poses of both arms for a person who moves before a camera.

    Every hand keeps its direction and its share of the arm's length from its own shoulder, as `imitate` has it, or is
    at the nearest place within reach. Of the poses that bring it there, clear of the body and of the other arm, one
    near the pose before is taken. A hand that is not seen stays where it was, and goes down to rest after 1.5 s.

    One thread may call `process` and another one `target_at`.

    Parameters
    ----------
    table : JointTable
        Of a robot with HOAP-2's arms.

    Attributes
    ----------
    joint_names : tuple of str
        The eight joints of both arms, in the order of poses.

    Raises
    ------
    InvalidArgument
        For a robot whose arms are built otherwise.
    """

    def __init__(self, table: JointTable = HOAP2) -> None:
        self._arms = tuple(arm_of(side, table) for side in SIDES)
        self.joint_names = tuple(name for arm in self._arms for name in arm.names)
        rest = rest_positions()
        self._rest = [
            np.array([rest[name] for name in arm.names]) * sign
            for arm, sign in zip(self._arms, (np.ones(4), MIRROR), strict=True)
        ]
        self._finders = [PoseFinder(arm, table, rest) for arm, rest in zip(self._arms, self._rest, strict=True)]
        self._turn = threading.Lock()
        self._poses: deque[tuple[float, Floats]] = deque(maxlen=_KEPT)
        self.reset()

    def reset(self) -> None:
        """Forget all pictures; there is no target until the next one."""
        self._centre: Floats | None = None
        self._height_px = 0.0
        self._places: list[Floats | None] = [None, None]
        self._seen_s = [-np.inf, -np.inf]
        self._time_s = -np.inf
        with self._turn:
            self._poses.clear()

    def process(self, person: SeenPerson | None, time_s: float) -> None:
        """Take the next picture.

        Parameters
        ----------
        person : SeenPerson or None
            None where no person is seen.
        time_s : float
            Earlier than before: another stream has begun.

        Raises
        ------
        InvalidArgument
            For a height below 20 pixels, or a place that is not finite.
        """
        passed_s = time_s - self._time_s
        share = 1.0 if not 0.0 <= passed_s < 1.0 else 1.0 - np.exp(-passed_s / _SMOOTHING_S)
        if passed_s < 0.0:
            self._seen_s = [time_s if np.isfinite(seen) else seen for seen in self._seen_s]
            with self._turn:
                self._poses.clear()
        self._time_s = time_s
        places: list[Floats | None] = [None, None] if person is None else self._scaled(person, share)
        for i, place in enumerate(places):
            if place is not None:
                before = self._places[i]
                self._places[i] = place if before is None else before + share * (place - before)
                self._seen_s[i] = time_s
            elif time_s - self._seen_s[i] > _REST_AFTER_S:
                self._places[i] = None
        for i, place in enumerate(places):
            if place is not None or self._places[i] is None:
                self._finders[i].move_to(self._places[i], self._finders[1 - i].forearm_seen_by_other)
        with self._turn:
            self._poses.append((time_s, self._pose()))

    def target_at(self, time_s: float) -> Floats | None:
        """The pose for the newest picture that is not later, shape (8,); None where that is older than a second."""
        with self._turn:
            newest = next(((at_s, pose) for at_s, pose in reversed(self._poses) if at_s <= time_s), None)
        return None if newest is None or time_s - newest[0] > _OUT_OF_DATE_S else newest[1]

    def _pose(self) -> Floats:
        return np.concatenate((self._finders[0].angles_rad, self._finders[1].angles_rad * MIRROR))

    def _scaled(self, person: SeenPerson, share: float) -> list[Floats | None]:
        """Places of the hands from their own shoulders, outwards and up, in metres of the robot."""
        values = [*person.nose_px, *(person.left_px or ()), *(person.right_px or ()), person.height_px]
        if not np.isfinite(values).all() or person.height_px < MIN_HEIGHT_PX:
            raise InvalidArgument(f"{person}: places must be finite, the height at least {MIN_HEIGHT_PX:g} pixels")
        x_px, y_px = person.nose_px
        centre = np.array((x_px, y_px + NOSE_ABOVE_SHOULDERS * person.height_px))
        if self._centre is None or share == 1.0:
            self._centre, self._height_px = centre, person.height_px
        else:  # a face is found now a little larger, now a little smaller
            self._centre = self._centre + share * (centre - self._centre)
            self._height_px += 0.3 * share * (person.height_px - self._height_px)
        metres_per_px = self._arms[0].reach_m / (REACH * self._height_px)
        shoulder_m = 0.5 * SHOULDER_WIDTH * self._height_px * metres_per_px
        places: list[Floats | None] = []
        for pixels, outwards in ((person.left_px, 1.0), (person.right_px, -1.0)):
            if pixels is None:
                places.append(None)
                continue
            offset = metres_per_px * (np.array(pixels) - self._centre)
            places.append(np.array((outwards * offset[0] - shoulder_m, -offset[1])))
        return places
