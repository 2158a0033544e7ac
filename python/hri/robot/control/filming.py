# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Pictures of a motion at a fixed rate."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import InvalidArgument

Image = NDArray[np.uint8]
OnFrame = Callable[[Image, float], None]


class Film:
    """Hands on a picture whenever one is due.

    Parameters
    ----------
    on_frame : callable of (image, time_s), optional
        Gets the pictures; None makes none.
    fps : float
        Above 0.
    size : width and height in pixels
    """

    def __init__(self, on_frame: OnFrame | None, fps: float, size: tuple[int, int]) -> None:
        if not 0.0 < fps < np.inf:
            raise InvalidArgument(f"fps is {fps}, must be above 0 and finite")
        self._on_frame = on_frame
        self._fps = fps
        self._size = size
        self._frames = 0

    def show(self, render: Callable[[int, int], Image], time_s: float, end_s: float) -> None:
        """Take the picture that is due at this time, if any; none is due before 0 or after the end.

        Where more than one is, it is handed on so often, so that a film keeps the time.
        """
        if self._on_frame is None or self._frames > min(time_s, end_s) * self._fps + 1e-9:
            return
        image = render(*self._size)
        while self._frames <= min(time_s, end_s) * self._fps + 1e-9:
            self._frames += 1
            self._on_frame(image, time_s)
