# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The person before the camera, for a robot that moves its arms as they do."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import InvalidArgument
from hri.features import HandPairTracker
from hri.robot import HOAP2, JointTable
from hri.robot.imitation import LiveImitation, SeenPerson
from hri.session.feeds import Recorder
from hri.vision.faces import face_finder

if TYPE_CHECKING:
    from hri.vision import Face

Frame = NDArray[np.uint8]

FACE_SIDE = 0.115
"""Side of the square around a face by OpenCV's frontal cascades, of a person's height: more than the face's width
(0.08), less than the head's height (0.13)."""
_FACE_INTERVAL = 5
_FACE_LOST_S = 1.0


class Faces(Protocol):
    """`hri.vision.FaceFinder`, or what finds faces in another way."""

    def find(self, bgr: Frame) -> Face | None: ...


class PersonTracker:
    """Follows a person's face and both hands from picture to picture.

    Parameters
    ----------
    faces : Faces, optional
        By default OpenCV's cascade.

    Raises
    ------
    InvalidArgument
        Where no cascade is installed.
    """

    def __init__(self, faces: Faces | None = None) -> None:
        found = faces if faces is not None else face_finder()
        if found is None:
            raise InvalidArgument("imitation needs OpenCV's cascade for faces: Debian's opencv-data has one")
        self._faces: Faces = found
        from hri.vision import PersonHands, PersonOptions  # which load OpenCV

        self._hands = PersonHands(PersonOptions(max_hands=2))
        self._pair = HandPairTracker()
        self._face: Face | None = None
        self._seen_s = -np.inf
        self._shape: tuple[int, ...] = ()
        self._until_next = 0

    def process(self, frame: Frame, time_s: float) -> SeenPerson | None:
        """The person in a picture (uint8, BGR); None where no face has been seen for a second."""
        if time_s < self._seen_s or frame.shape != self._shape:  # another stream
            self._face = None
        self._shape = frame.shape
        if self._until_next <= 0 or self._face is None:
            found = self._faces.find(frame)
            if found is not None:
                self._face, self._seen_s = found, time_s
            self._until_next = _FACE_INTERVAL
        self._until_next -= 1
        if self._face is None or time_s - self._seen_s > _FACE_LOST_S:
            self._face = None
            self._pair.reset()
            return None
        face = self._face
        mask = self._hands.extract(frame, face).mask
        scale = frame.shape[1] / mask.shape[1]
        # The person's right hand is on the left of the picture.
        right, left = (
            (scale * (hand.x_px + 0.5), scale * (hand.y_px + 0.5)) if hand.seen else None
            for hand in self._pair.push(mask)
        )
        centre = (face.left_px + 0.5 * face.side_px, face.top_px + 0.5 * face.side_px)
        return SeenPerson(left, right, centre, face.side_px / FACE_SIDE)


class Imitator:
    """Where the arms should be for the newest picture of a session; a tap of its pictures.

    Parameters
    ----------
    table : JointTable
        Of a robot with HOAP-2's arms.
    faces : Faces, optional
        See `PersonTracker`.
    """

    def __init__(self, table: JointTable = HOAP2, faces: Faces | None = None) -> None:
        self._person = PersonTracker(faces)
        self._arms = LiveImitation(table)

    @property
    def joint_names(self) -> tuple[str, ...]:
        """The joints that move."""
        return self._arms.joint_names

    def look(self, frame: Frame, time_s: float) -> None:
        """Take the next picture, of this time of the session."""
        self._arms.process(self._person.process(frame, time_s), time_s)

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
