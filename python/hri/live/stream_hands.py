# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Hands in a stream: every picture by itself, or by the colours that hand and background have in this stream."""

from __future__ import annotations

from collections import deque
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from hri.live.frames import Frame

_SAMPLE_S = 0.25
_NUM_SAMPLES = 8
_FEWEST_SAMPLES = 4
_LEARN_S = 1.0
_ALIKE = 0.9
"""Outlines that share so much are of the same colours."""
_MOVED = 0.3
"""Outlines that differ by so much are of something that moves, as hands do and furniture does not."""
_SURER = 0.05


class HandFinder(Protocol):
    """Finds the hand in the pictures of a stream, one after the other."""

    def find(self, frame: Frame, time_s: float, moving: bool) -> Any:
        """The silhouette (`hri._native_vision.Silhouette`) in the next picture; `moving` in a movement."""
        ...

    def renewed(self) -> bool:
        """Whether hands look different since the last picture, although nothing moved."""
        ...


class PlainHands:
    """Every picture by itself.

    Parameters
    ----------
    silhouette : hri._native_vision.SilhouetteOptions, optional
    """

    def __init__(self, silhouette: Any = None) -> None:
        from hri import _native_vision

        self._extractor = _native_vision.SilhouetteExtractor(silhouette or _native_vision.SilhouetteOptions())

    def find(self, frame: Frame, time_s: float, moving: bool) -> Any:
        """The silhouette in this picture."""
        return self._extractor.extract(np.ascontiguousarray(frame))

    def renewed(self) -> bool:
        """Never."""
        return False


class StreamHands:
    """By the colours of hand and background, learned as clips are (`HandColours`), from the last two seconds.

    They are learned after the first second and looked after once a second, but never again in the middle of a movement:
    new ones are taken when they show something that moves and the old ones do not, or show it more clearly. Until there
    are any, every picture is looked at by itself.
    """

    def __init__(self) -> None:
        from hri import _native_vision

        self._learn = _native_vision.HandColours.learn
        self._plain = PlainHands()
        self._colours: Any = None
        self._samples: deque[Frame] = deque(maxlen=_NUM_SAMPLES)
        self._sampled_s = -np.inf
        self._tried_s: float | None = None
        self._renewed = False

    def find(self, frame: Frame, time_s: float, moving: bool) -> Any:
        """The silhouette in this picture."""
        picture = np.ascontiguousarray(frame)
        self._renewed = False
        if self._samples and self._samples[0].shape != picture.shape:
            self._samples.clear()
        if time_s - self._sampled_s >= _SAMPLE_S:
            self._samples.append(picture)
            self._sampled_s = time_s
        if self._tried_s is None:
            self._tried_s = time_s
        may_change = self._colours is None or not moving
        if may_change and len(self._samples) >= _FEWEST_SAMPLES and time_s - self._tried_s >= _LEARN_S:
            self._tried_s = time_s
            self._look_after(self._learn(list(self._samples)))
        if self._colours is None:
            return self._plain.find(picture, time_s, moving)
        return self._colours.extract(picture)

    def renewed(self) -> bool:
        """Whether other colours were taken with the last picture."""
        return self._renewed

    def _look_after(self, found: Any) -> None:
        if found is None:
            return
        if self._colours is not None:
            old, new = self._outlines(self._colours), self._outlines(found)
            if _shared(old[-1], new[-1]) >= _ALIKE:
                return
            old_moves, new_moves = _differ(old), _differ(new)
            surer = found.quality > self._colours.quality + _SURER and bool(old[-1].any())
            if not (new_moves > _MOVED > old_moves or (surer and new_moves >= old_moves)):
                return
        self._colours, self._renewed = found, True

    def _outlines(self, colours: Any) -> list[NDArray[np.bool_]]:
        return [colours.extract(self._samples[i]).mask > 0 for i in (0, len(self._samples) // 2, -1)]


def _shared(first: NDArray[np.bool_], second: NDArray[np.bool_]) -> float:
    """What both cover, as a share of what either does, 0..1; 1 where neither covers anything."""
    either = int(np.count_nonzero(first | second))
    return int(np.count_nonzero(first & second)) / either if either else 1.0


def _differ(outlines: list[NDArray[np.bool_]]) -> float:
    return 1.0 - min(_shared(outlines[0], outlines[1]), _shared(outlines[1], outlines[2]))
