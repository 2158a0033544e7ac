# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The hand as it is found in the camera's pictures, small enough to be sent with each of them."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.features import resample_contour, trace_contour
from hri.live import FrameResult
from hri.recognition import Decision

MAX_OUTLINE = 60
MAX_TRACK = 30
_DIGITS = 3


class SeenHands:
    """Makes a message for the page of what is found, twelve times a second at most.

    Parameters
    ----------
    publish : callable
        Gets the message.
    """

    _INTERVAL_S = 1.0 / 12.0

    def __init__(self, publish: Callable[[dict[str, Any]], None]) -> None:
        self._publish = publish
        self._next_s = -math.inf

    def heed(self, result: FrameResult, decision: Decision | None = None) -> None:
        """What was found in a picture, by the thread that watches."""
        if result.frame is None or result.time_s < self._next_s:
            return
        self._next_s = result.time_s + self._INTERVAL_S
        self._publish(seen_message(result))


def seen_message(result: FrameResult) -> dict[str, Any]:
    """Outline of the largest part of the hand, and its track.

    Returns
    -------
    dict
        "outline": at most `MAX_OUTLINE` points, "track": the last `MAX_TRACK` of two seconds, both as [x, y] in shares
        of the picture's width and height; "in_gesture".
    """
    track = [[round(x, _DIGITS), round(y, _DIGITS)] for x, y in result.track[-MAX_TRACK:]]
    outline = _outline(result)
    return {"type": "seen", "passing": True, "outline": outline, "track": track, "in_gesture": result.in_gesture}


def _outline(result: FrameResult) -> list[list[float]]:
    mask = result.mask
    if mask is None or min(mask.shape) < 2 or not mask.any():
        return []
    contour = trace_contour(mask)
    if len(contour) < 3:
        return []
    points: NDArray[Any] = contour if len(contour) <= MAX_OUTLINE else resample_contour(contour, MAX_OUTLINE)
    height, width = mask.shape
    shares = (points + 0.5) / (width, height)
    return [[round(x, _DIGITS), round(y, _DIGITS)] for x, y in np.clip(shares, 0.0, 1.0).tolist()]
