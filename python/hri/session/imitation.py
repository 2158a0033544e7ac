# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The person before the camera, for a robot that moves its arms as they do."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.robot import HOAP2, JointTable
from hri.robot.imitation import SeenPerson
from hri.robot.nao.imitation import live_imitation
from hri.session.feeds import Recorder
from hri.vision.persons import Faces, PersonTracker

Frame = NDArray[np.uint8]

FACE_SIDE = 0.115
"""Side of the square around a face by OpenCV's frontal cascades, of a person's height: more than the face's width
(0.08), less than the head's height (0.13)."""


class Imitator:
    """Where the arms should be for the newest picture of a session; a tap of its pictures.

    Parameters
    ----------
    table : JointTable
        Of a HOAP-2 or a NAO.
    faces : Faces, optional
        See `hri.vision.PersonTracker`.

    Raises
    ------
    InvalidArgument
        For a robot with other arms, and where no faces can be found.
    """

    def __init__(self, table: JointTable = HOAP2, faces: Faces | None = None) -> None:
        self._faces = faces
        self._person = PersonTracker(faces)
        self._arms = live_imitation(table)

    @property
    def joint_names(self) -> tuple[str, ...]:
        """The joints that move."""
        return self._arms.joint_names

    def reset(self) -> None:
        """Forget all pictures: another session begins."""
        self._person = PersonTracker(self._faces)
        self._arms.reset()

    def look(self, frame: Frame, time_s: float) -> None:
        """Take the next picture, of this time of the session."""
        person = self._person.process(frame, time_s)
        seen = None
        if person is not None:
            seen = SeenPerson(person.left_px, person.right_px, person.face_px, person.face_side_px / FACE_SIDE)
        self._arms.process(seen, time_s)

    def target_at(self, time_s: float) -> NDArray[np.float64] | None:
        """Positions in rad of the joints at a time of the session; None where there are no pictures any more."""
        return self._arms.target_at(time_s)


class ImitatingTap:
    """Hands the pictures of a session on to an imitator, and everything to the recorder, if there is one."""

    def __init__(self, imitator: Imitator, recorder: Recorder | None) -> None:
        self._imitator = imitator
        self._recorder = recorder

    def sound(self, samples: Any, sample_rate_hz: int, stream_s: float, offset_s: float, stream: int) -> None:
        """As of `Recorder`."""
        if self._recorder is not None:
            self._recorder.sound(samples, sample_rate_hz, stream_s, offset_s, stream)

    def picture(self, frame: Any, stream_s: float, offset_s: float, stream: int) -> None:
        """As of `Recorder`."""
        self._imitator.look(frame, stream_s + offset_s)
        if self._recorder is not None:
            self._recorder.picture(frame, stream_s, offset_s, stream)
