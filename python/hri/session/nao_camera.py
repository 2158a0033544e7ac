# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What NAO sees, as a source of pictures: ALVideoDevice, by the extra "nao"."""

from __future__ import annotations

import time
from typing import Any

import numpy as np

from hri.core.errors import Error, InvalidArgument
from hri.live.frames import Frame, TimedFrame
from hri.live.sources import Stalled, require_positive
from hri.robot import NAO
from hri.robot.nao.link import NaoqiLink

_RESOLUTIONS = {(160, 120): 0, (320, 240): 1, (640, 480): 2}
_BGR = 13
_POLL_S = 0.005


class NaoCamera:
    """A camera of NAO as a stream.

    Parameters
    ----------
    url : str
        tcp://HOST or tcp://HOST:PORT, as of `hri.robot.NaoqiRobot`.
    camera : str
        "CameraTop", which sees a person who stands before it, or "CameraBottom".
    size : width and height in pixels
        640 x 480, 320 x 240 or 160 x 120.
    fps : int
        Pictures a second that NAO is asked for, 1 to 30. Uncompressed they are 0.9 MB each at 640 x 480.
    stall_s : float
        How long no new picture may come.

    Raises
    ------
    InvalidArgument
        For another value.
    IoError
        When no NAO answers there.
    Error
        When it gives no camera.
    ImportError
        Without qi.
    """

    def __init__(
        self,
        url: str,
        camera: str = "CameraTop",
        size: tuple[int, int] = (640, 480),
        fps: int = 15,
        stall_s: float = 2.0,
    ) -> None:
        require_positive("stall_s", stall_s)
        names = [entry.name for entry in NAO.cameras]
        if camera not in names:
            raise InvalidArgument(f"camera is {camera!r}, must be {' or '.join(names)}")
        if tuple(size) not in _RESOLUTIONS:
            known = ", ".join(f"{width} x {height}" for width, height in _RESOLUTIONS)
            raise InvalidArgument(f"size is {size}, must be one of {known}")
        if not (isinstance(fps, int) and 1 <= fps <= 30):
            raise InvalidArgument(f"fps is {fps}, must be 1 to 30")
        self.fps = float(fps)
        self.num_lost = 0
        self._size = (size[0], size[1])
        self._asked = (names.index(camera), _RESOLUTIONS[self._size], _BGR, fps)
        self._stall_s = stall_s
        self._closed = False
        self._first_s: float | None = None
        self._last_s = 0.0
        self._taken_s = -1.0
        self._link = NaoqiLink(url, stall_s)
        self.name = f"{camera} of NAO at {self._link.url}"
        try:
            self._handle = self._subscribed()
        except BaseException:
            self._link.close()
            raise

    def read(self) -> TimedFrame | None:
        """The next picture. Raises Stalled when none comes for `stall_s`, or the connection breaks."""
        ends_s = time.monotonic() + self._stall_s
        while not self._closed:
            try:
                frame, taken_s = self._picture(self._link.call("ALVideoDevice", "getImageRemote", self._handle))
                self._link.call("ALVideoDevice", "releaseImage", self._handle)
            except Error as error:
                raise Stalled(f"{self.name}: {error}") from error
            if taken_s != self._taken_s:
                return frame, self._time_of(taken_s)
            if time.monotonic() >= ends_s:
                raise Stalled(f"{self.name}: the same picture for {self._stall_s:g} s")
            time.sleep(_POLL_S)
        return None

    def reconnect(self) -> bool:
        """Subscribe again, over a new connection; True when NAO gives pictures."""
        if self._closed:
            return False
        try:
            self._link.reconnect()
            self._handle = self._subscribed()
        except Error:
            return False
        return True

    def close(self) -> None:
        """Give the camera back; one that is gone makes this wait for `stall_s` at most."""
        if not self._closed:
            self._closed = True
            try:
                self._link.call("ALVideoDevice", "unsubscribe", self._handle)
            except Error:
                pass  # it is gone
            finally:
                self._link.close()

    def _subscribed(self) -> str:
        handle = self._link.call("ALVideoDevice", "subscribeCamera", "hri", *self._asked)
        if not isinstance(handle, str) or not handle:
            raise Error(f"{self.name} cannot be subscribed to: another program may have taken all 8 places")
        return handle

    def _picture(self, answer: Any) -> tuple[Frame, float]:
        """BGR pixels, and the camera's time in seconds."""
        try:
            width, height, layers, colours, seconds, microseconds, pixels = answer[:7]
            if (width, height, layers, colours) != (*self._size, 3, _BGR):
                raise ValueError(f"{width} x {height} x {layers}, colours {colours}")
            frame = np.frombuffer(pixels, dtype=np.uint8).reshape(height, width, 3)
            return frame, float(seconds) + 1e-6 * float(microseconds)
        except (TypeError, ValueError) as error:
            raise Error(f"what came is no picture of {self._size[0]} x {self._size[1]}: {error}") from error

    def _time_of(self, taken_s: float) -> float:
        """Since the first picture, never falling; a robot that was switched on again has a new time."""
        step_s = taken_s - self._taken_s
        if self._first_s is None:
            self._first_s, step_s = taken_s, 0.0
        elif not 0.0 < step_s < self._stall_s + 1.0:
            step_s = 1.0 / self.fps
        self.num_lost += max(0, round(step_s * self.fps) - 1)
        self._taken_s = taken_s
        self._last_s += step_s
        return self._last_s
