# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""From pictures to the frames that a `SentenceRecognizer` takes: tracks of both hands and the head, or rows of features
of one hand."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import InvalidArgument
from hri.live.frames import Frame
from hri.recognition import GestureRecognizer, StreamedSign
from hri.recognition.decision import UNKNOWN as REJECTED
from hri.recognition.sentence.transcript import UNKNOWN
from hri.vision.faces import face_finder
from hri.vision.persons import Faces, PersonTracker

if TYPE_CHECKING:
    from hri.vision import HandObservation, HandStream

Row = NDArray[np.float32]
Place = tuple[float, float, float]

FACE_LOST_S = 5.0
"""Hands hide the face of a person who signs, who stays where she is."""
_MASK_SHAPE = (1, 1)


class HandFrames(Protocol):
    """Looks at one stream of pictures after the other."""

    @property
    def num_columns(self) -> int | None:
        """Values of a row; None where that depends on what is given."""
        ...

    @property
    def hand(self) -> HandObservation:
        """What was found in the last picture."""
        ...

    @property
    def place(self) -> Place | None:
        """x, y and area of the hand in shares of the picture; None without one."""
        ...

    def reset(self) -> None:
        """Another stream begins."""
        ...

    def push(self, frame: Frame, time_s: float, in_sentence: bool) -> Row:
        """The row of the next picture (uint8, BGR), NaN for what is not seen."""
        ...

    def name(self, sign: StreamedSign) -> str:
        """What a word is, where that is better known than the recogniser of sentences does."""
        ...

    def keep(self, num_rows: int) -> None:
        """Older rows than the last so many are not needed any more."""
        ...


def _no_hand() -> HandObservation:
    from hri.vision import HandObservation

    nothing = np.zeros(_MASK_SHAPE, np.uint8)
    return HandObservation(nothing, nothing, 0.0)


class PersonTracks:
    """Tracks of the left hand, the right hand and the head of the person whose face is seen, in pixels.

    Left and right are the person's own, who stands before the camera; a picture that is mirrored swaps them.

    Parameters
    ----------
    faces : Faces, optional
        By default OpenCV's cascade.

    Raises
    ------
    InvalidArgument
        Where no cascade is installed.
    """

    num_columns = 6

    def __init__(self, faces: Faces | None = None) -> None:
        self._faces = faces
        self.reset()

    def reset(self) -> None:
        """Another stream begins."""
        self._person = PersonTracker(self._faces, FACE_LOST_S)
        self.hand = _no_hand()
        self.place: Place | None = None

    def push(self, frame: Frame, time_s: float, in_sentence: bool) -> Row:
        """The row of the next picture; all NaN without a face."""
        row = np.full(self.num_columns, np.nan, np.float32)
        person = self._person.process(frame, time_s)
        self.hand, self.place = _no_hand() if person is None else person.hands, None
        if person is None:
            return row
        row[4:] = person.face_px
        height, width = frame.shape[:2]
        for first, hand_px in ((0, person.left_px), (2, person.right_px)):
            if hand_px is not None:
                row[first : first + 2] = hand_px
                # Of both hands the right one, which is the second.
                self.place = (hand_px[0] / width, hand_px[1] / height, float((self.hand.mask > 0).mean()))
        return row

    def name(self, sign: StreamedSign) -> str:
        """As it was recognised."""
        return sign.label

    def keep(self, num_rows: int) -> None:
        """Nothing is kept."""


class GestureRows:
    """Rows of the features of one hand, as a `GestureRecognizer` computes them.

    Parameters
    ----------
    gestures : GestureRecognizer
        Of silhouettes of one hand. It need not be trained, unless it names words.
    project : callable, optional
        From rows of the recogniser's features, shape (num_rows, num_features), to those that the `SentenceRecognizer`
        was trained on, such as principal components; by default they are the same.
    names : bool
        Each word that the `SentenceRecognizer` finds is named by `gestures`, which sees the whole of it.
    reject_unknown : bool
        With `names`: a word that `gestures` rejects is ``<unk>``, as a word is that `ConnectedWordRecognizer` does not
        know; otherwise it has the name of the gesture that it is most like. Known words are lost for it, too.
    faces : "auto", "never", a path of a cascade, or hri.vision.FaceFinder
        Whether the hand is that of the person whose face is seen, where one is.

    Raises
    ------
    InvalidArgument
        For a recogniser of landmarks or of both hands.
    NotFittedError
        With `names`, for one that is not trained.
    """

    num_columns = None

    def __init__(
        self,
        gestures: GestureRecognizer,
        project: Callable[[Row], Row] | None = None,
        *,
        names: bool = False,
        reject_unknown: bool = False,
        faces: Any = "auto",
    ) -> None:
        if gestures.options.source != "silhouettes" or gestures.options.num_hands != 1:
            raise InvalidArgument("GestureRows needs a recogniser of the silhouettes of one hand")
        if names:
            _ = gestures.is_dynamic  # refuses one that is not trained now
        from hri.vision import HandFinder

        self._gestures, self._project, self._names = gestures, project, names
        self._reject_unknown = reject_unknown
        self.faces = face_finder(faces)
        """What finds faces; None where hands are found without."""
        self._finder = HandFinder(gestures.options.hands, faces=self.faces)
        self.reset()

    def reset(self) -> None:
        """Another stream begins."""
        self._stream: HandStream = self._finder.stream(dynamic=True)
        self.hand = _no_hand()
        self._width: int | None = None
        self._rows: deque[Row | None] = deque()
        self._num_rows = 0

    @property
    def place(self) -> Place | None:
        """The middle of the mask, and its area."""
        mask = self.hand.mask
        ys, xs = np.nonzero(mask)
        if not len(xs):
            return None
        return float(xs.mean() / mask.shape[1]), float(ys.mean() / mask.shape[0]), len(xs) / mask.size

    def push(self, frame: Frame, time_s: float, in_sentence: bool) -> Row:
        """The row of the next picture; all NaN where the hand is not seen, or not well enough."""
        self.hand = self._stream.push(frame, time_s, in_sentence)
        found = self._gestures.observation_features([self.hand])
        self._rows.append(found[0] if len(found) else None)
        self._num_rows += 1
        if len(found):
            row = np.asarray(found if self._project is None else self._project(found), np.float32)[0]
            self._width = len(row)
            return row
        return np.full(self._width or 0, np.nan, np.float32)

    def name(self, sign: StreamedSign) -> str:
        """The best of the gestures for the frames of a word, or ``<unk>``."""
        if not self._names:
            return sign.label
        first = self._num_rows - len(self._rows)
        part = [
            self._rows[i - first] for i in range(max(first, sign.first_frame), min(self._num_rows, sign.last_frame))
        ]
        seen = [row for row in part if row is not None]
        if not seen:
            return sign.label
        found = self._gestures.recognise_features(np.stack(seen))
        if self._reject_unknown and found.status == REJECTED:
            return UNKNOWN
        return found.nbest[0].label if found.nbest else sign.label

    def keep(self, num_rows: int) -> None:
        """Forget older rows."""
        while len(self._rows) > num_rows:
            self._rows.popleft()
