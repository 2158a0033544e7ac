# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What pictures lack for a sign to be seen: light, a face, a hand; and how to say so to the person."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from hri.core.phrases import LANGUAGES, in_language
from hri.live.frames import Frame

LIGHT, FACE, HAND = "light", "face", "hand"
MISSING_TEXTS: dict[str, dict[str, str]] = {
    missing: {language: in_language(f"missing_{missing}", language) for language in LANGUAGES}
    for missing in (LIGHT, FACE, HAND)
}
"""For people, by what is missing and the language."""

_DARK, _LIT = 40.0, 55.0
"""Of 255, the brightest colour that nine tenths of the picture stay below. A hand in a dark room that recognisers still
find makes it 60 to 75."""
_BRIGHT_SHARE = 90
_LEFT_OUT = 8
"""Every eighth row and column says how bright a picture is."""
_FACE_INTERVAL_S = 0.5
_LOST, _FOUND, _SURELY = 0.2, 0.6, 0.9
_HAND_FALL_S, _FACE_FALL_S = 2.5, 2.0
_MAX_STEP_S = 0.5


@dataclass
class _Seen:
    """Whether something is seen for the most part; one picture, or one now and then, changes nothing.

    `share` is a moving average that falls with `fall_s` and rises with `rise_s`.
    """

    fall_s: float
    rise_s: float = 0.5
    share: float = 1.0
    seen: bool = True

    def push(self, seen: bool, step_s: float) -> None:
        constant_s = self.rise_s if seen else self.fall_s
        self.share += (float(seen) - self.share) * -math.expm1(-step_s / constant_s)
        self.seen = self.share > (_LOST if self.seen else _FOUND)


class Visibility:
    """Says what is missing in a stream of pictures, without flicker.

    A hand is missing after 4 s in which it was not seen, a face after 3 s, and found again after half a second; both
    later where they are seen now and then. Darkness is reported only where something else is missing, too: hands that
    are found in the dark need no light.

    Parameters
    ----------
    faces : FaceFinder, optional
        By which hands are found; looked for twice a second, where `push` does not get whether a face was seen, and
        only while it matters. Without one, and without that, no face is missed.
    needs_face : bool
        A face that is not seen is reported also while a hand is found, as what is found without it may be anything of
        the colour of skin. Otherwise only where no hand is found.
    """

    def __init__(self, faces: Any = None, needs_face: bool = False) -> None:
        self._faces, self._needs_face = faces, needs_face
        self.reset()

    def reset(self) -> None:
        """Another stream begins: nothing is missing yet."""
        self._hand, self._face = _Seen(_HAND_FALL_S), _Seen(_FACE_FALL_S)
        self._dark = False
        self._time_s: float | None = None
        self._looked_s = -math.inf
        self.missing = ""

    def push(self, frame: Frame, time_s: float, hand_seen: bool, face_seen: bool | None = None) -> str:
        """What is missing with the next picture.

        Parameters
        ----------
        frame : ndarray of uint8, shape (height, width, 3), BGR
        time_s : float
            Never falling.
        hand_seen : bool
        face_seen : bool, optional
            None where that is not known.

        Returns
        -------
        str
            "light", "face", "hand", or "" where nothing is.
        """
        step_s = 0.0 if self._time_s is None else min(_MAX_STEP_S, max(0.0, time_s - self._time_s))
        self._time_s = time_s
        self._hand.push(hand_seen, step_s)
        if face_seen is not None:
            self._face.push(face_seen, step_s)
        else:
            self._look_for_face(frame, time_s)
        lacking = ""
        if not self._face.seen and (self._needs_face or not self._hand.seen):
            lacking = FACE
        elif not self._hand.seen:
            lacking = HAND
        if lacking:
            bright = float(np.percentile(frame[::_LEFT_OUT, ::_LEFT_OUT].max(axis=2), _BRIGHT_SHARE))
            self._dark = bright < (_LIT if self._dark else _DARK)
        else:
            self._dark = False
        self.missing = LIGHT if self._dark else lacking
        return self.missing

    def _look_for_face(self, frame: Frame, time_s: float) -> None:
        if self._faces is None:
            return
        if not self._needs_face and self._hand.share > _SURELY:
            self._face, self._looked_s = _Seen(_FACE_FALL_S), time_s
            return
        if time_s - self._looked_s >= _FACE_INTERVAL_S:
            self._face.push(self._faces.find(frame) is not None, min(2 * _FACE_INTERVAL_S, time_s - self._looked_s))
            self._looked_s = time_s


def missing_text(missing: str, separator: str = " ") -> str:
    """What to say to the person, in English and in Hindi; "" where nothing is missing."""
    return separator.join(MISSING_TEXTS[missing].values()) if missing else ""
