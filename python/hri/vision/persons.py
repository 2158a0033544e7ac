# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The person before a camera: the face and both hands, from picture to picture."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

import numpy as np
from numpy.typing import NDArray

from hri.features import HandPairTracker
from hri.vision.faces import face_finder

if TYPE_CHECKING:
    from hri._native import HandObservation
    from hri._native_vision import Face

Frame = NDArray[np.uint8]
Point = tuple[float, float]

_FACE_INTERVAL = 5


class Faces(Protocol):
    """`hri.vision.FaceFinder`, or what finds faces in another way."""

    def find(self, bgr: Frame) -> Face | None: ...


@dataclass(frozen=True)
class TrackedPerson:
    """A person in one picture, as a camera before the person sees them.

    Attributes
    ----------
    left_px, right_px : (x, y) or None
        The person's own left and right hand; None for one that is not seen.
    face_px : (x, y)
        The middle of the face.
    face_side_px : float
        Of the square around it.
    hands : HandObservation
        Whose mask, which may be smaller than the picture, is of both hands.
    """

    left_px: Point | None
    right_px: Point | None
    face_px: Point
    face_side_px: float
    hands: HandObservation


class PersonTracker:
    """Follows a person's face and both hands from picture to picture.

    Parameters
    ----------
    faces : Faces, optional
        By default OpenCV's cascade.
    face_lost_s : float
        For how long a face that is not seen, as behind a hand, is where it was.

    Raises
    ------
    InvalidArgument
        Where no cascade is installed.
    """

    def __init__(self, faces: Faces | None = None, face_lost_s: float = 1.0) -> None:
        self._faces: Faces = face_finder(required=True) if faces is None else faces
        self._face_lost_s = face_lost_s
        from hri._native_vision import PersonHands, PersonOptions  # which load OpenCV

        self._hands = PersonHands(PersonOptions(max_hands=2))
        self._pair = HandPairTracker()
        self._face: Face | None = None
        self._seen_s = -np.inf
        self._shape: tuple[int, ...] = ()
        self._until_next = 0

    def process(self, frame: Frame, time_s: float) -> TrackedPerson | None:
        """The person in a picture (uint8, BGR); None where no face has been seen for `face_lost_s`."""
        if time_s < self._seen_s or frame.shape != self._shape:  # another stream
            self._face = None
        self._shape = frame.shape
        if self._until_next <= 0 or self._face is None:
            found = self._faces.find(frame)
            if found is not None:
                self._face, self._seen_s = found, time_s
            self._until_next = _FACE_INTERVAL
        self._until_next -= 1
        if self._face is None or time_s - self._seen_s > self._face_lost_s:
            self._face = None
            self._pair.reset()
            return None
        face = self._face
        hands = self._hands.extract(frame, face)
        scale = frame.shape[1] / hands.mask.shape[1]
        # The person's right hand is on the left of the picture.
        right, left = (
            (scale * (hand.x_px + 0.5), scale * (hand.y_px + 0.5)) if hand.seen else None
            for hand in self._pair.push(hands.mask)
        )
        centre = (face.left_px + 0.5 * face.side_px, face.top_px + 0.5 * face.side_px)
        return TrackedPerson(left, right, centre, face.side_px, hands)
