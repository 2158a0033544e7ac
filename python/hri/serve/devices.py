# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The camera and the microphone of a page as sources of a session."""

from __future__ import annotations

import math
import threading
import time
from collections import deque
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import FormatError, IoError
from hri.core.phrases import phrase
from hri.live import SampleRing, Stalled
from hri.live.frames import TimedFrame
from hri.media import decode_image
from hri.serve.messages import Media

_BUFFER_S = 5.0
_WAIT_S = 0.1
_MOST_WAITING = 6
_MOST_KNOWN = 64


class _Device:
    """Whether a device of the page gives anything; a source that is read finds out, and ends."""

    def __init__(self, name: str, what: str, stall_s: float) -> None:
        self.name = name
        self._what = what
        self._stall_s = stall_s
        self._came_s = -math.inf
        self._gone = False
        self._opened = False

    def lose(self) -> None:
        """The page is gone: who reads is not kept waiting."""
        self._gone = True

    def expect(self) -> None:
        """The next source waits for the device, as a new session begins."""
        self._opened = False

    def _comes(self) -> None:
        self._came_s = time.monotonic()
        self._gone = False

    def _open(self) -> None:
        """Raise IoError for a device that gave nothing lately, unless it is waited for."""
        if self._opened and (self._gone or time.monotonic() - self._came_s > self._stall_s):
            raise IoError(f"{self.name}: the page sends no {self._what}")
        self._opened = True
        self._gone = False

    def _require(self, since_s: float) -> None:
        """Raise Stalled for a device that has given nothing for too long."""
        if self._gone:
            raise Stalled(phrase("page_gone", device=self.name))
        if time.monotonic() - max(self._came_s, since_s) > self._stall_s:
            raise Stalled(phrase(f"no_{self._what}", seconds=f"{self._stall_s:g}"))


class PageMicrophone(_Device):
    """What the page hears.

    Parameters
    ----------
    stall_s : float
        Longest time without a sample.
    """

    def __init__(self, stall_s: float) -> None:
        super().__init__("microphone", "sound", stall_s)
        self.sample_rate_hz = 16000
        self._ring: SampleRing | None = None
        self._silent = False

    def start(self, sample_rate_hz: int) -> None:
        """A page says at which rate it sends; a source that is open ends where that was another."""
        if sample_rate_hz != self.sample_rate_hz:
            self.lose()
            self._ring = None
            self.sample_rate_hz = sample_rate_hz

    def put(self, samples: NDArray[np.float32]) -> None:
        """Samples as they come, by the server's thread."""
        self._comes()
        ring = self._ring
        if ring is not None:
            ring.write(samples)

    def stream(self) -> PageSound:
        """A source for a session. Raises IoError while nothing comes, except after `expect`."""
        self._open()
        ring = self._ring = SampleRing(round(_BUFFER_S * self.sample_rate_hz))

        def require(since_s: float) -> None:
            if ring is not self._ring:  # else it would wait for ever, as sound of the new rate comes
                raise Stalled(phrase("other_rate", device=self.name))
            self._require(since_s)

        return PageSound(self, ring, require)


class PageSound:
    """A stream of the page's samples, from when it was opened."""

    def __init__(self, device: PageMicrophone, ring: SampleRing, require: Callable[[float], None]) -> None:
        self.name, self.sample_rate_hz = device.name, device.sample_rate_hz
        self._ring = ring
        self._require = require
        self._since_s = time.monotonic()
        self._closed = False

    @property
    def num_lost(self) -> int:
        """Samples lost because the reader was late."""
        return self._ring.num_lost

    def read(self) -> NDArray[np.float32] | None:
        """The next samples. Raises Stalled when none come."""
        while not self._closed:
            samples = self._ring.read(self.sample_rate_hz // 5, _WAIT_S)
            if len(samples):
                return samples
            self._require(self._since_s)
        return None

    def close(self) -> None:
        """Read no more."""
        self._closed = True


class PageCamera(_Device):
    """What the page sees.

    Parameters
    ----------
    stall_s : float
        Longest time without a picture.
    on_refused : callable of str, optional
        Gets what is wrong with a picture that cannot be decoded; it is left out.
    """

    def __init__(self, stall_s: float, on_refused: Callable[[str], None] | None = None) -> None:
        super().__init__("camera", "picture", stall_s)
        self.num_lost = 0
        self._on_refused = on_refused
        self._waiting: deque[tuple[Media, float]] = deque(maxlen=_MOST_WAITING)
        self._known: deque[tuple[float, float]] = deque(maxlen=_MOST_KNOWN)
        self._ready = threading.Condition()

    def put(self, picture: Media) -> None:
        """A picture as it comes, by the server's thread; the oldest is lost when too many wait."""
        self._comes()
        with self._ready:
            self.num_lost += len(self._waiting) == self._waiting.maxlen
            self._waiting.append((picture, self._came_s))
            self._ready.notify()

    def sent_ms(self, at_s: float) -> float | None:
        """The page's time of the last picture that had come by this time of the monotonic clock."""
        return next((sent_ms for came_s, sent_ms in reversed(self._known.copy()) if came_s <= at_s), None)

    def stream(self) -> PagePictures:
        """A source for a session. Raises IoError while nothing comes, except after `expect`."""
        self._open()
        with self._ready:
            self._waiting.clear()
        return PagePictures(self)

    def take(self, since_s: float) -> tuple[NDArray[np.uint8], float] | None:
        """The oldest picture and when it came, None when none came for a while. Raises Stalled."""
        with self._ready:
            self._ready.wait_for(lambda: len(self._waiting) > 0, _WAIT_S)
            if not self._waiting:
                self._require(since_s)
                return None
            picture, came_s = self._waiting.popleft()
        try:
            frame = decode_image(picture.data, "picture.jpg")
        except FormatError:
            if self._on_refused is not None:
                self._on_refused(phrase("picture_damaged"))
            return None
        self._known.append((came_s, picture.sent_ms))
        return frame, came_s


class PagePictures:
    """A stream of the page's pictures, from when it was opened."""

    def __init__(self, device: PageCamera) -> None:
        self.name, self.fps = device.name, 15.0
        self._device = device
        self._since_s = time.monotonic()
        self._lost_before = device.num_lost
        self._closed = False

    @property
    def num_lost(self) -> int:
        """Pictures lost because the reader was late."""
        return self._device.num_lost - self._lost_before

    def read(self) -> TimedFrame | None:
        """The next picture and when it came. Raises Stalled when none comes."""
        while not self._closed:
            taken = self._device.take(self._since_s)
            if taken is not None:
                frame, came_s = taken
                return frame, max(0.0, came_s - self._since_s)
        return None

    def reconnect(self) -> bool:
        """Never: the session opens another source."""
        return False

    def close(self) -> None:
        """Read no more."""
        self._closed = True
