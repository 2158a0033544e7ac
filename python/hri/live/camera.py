# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Cameras, by OpenCV (the extra "video"), watched: one that is unplugged is reported, and opened again."""

from __future__ import annotations

import logging
import threading
import time
from collections import deque
from pathlib import Path
from weakref import WeakValueDictionary

import numpy as np

from hri.core.errors import InvalidArgument, IoError
from hri.core.optional import import_opencv
from hri.live.frames import Frame, TimedFrame
from hri.live.sources import Stalled, require_positive

_HELP = "connect a camera, or give a video instead"
_IN_USE = "it is there, but does not open; another program may use it: close that"
_log = logging.getLogger(__name__)
_RETRY_S = 0.02
_CLOSE_S = 2.0
_in_use: WeakValueDictionary[str, CameraSource] = WeakValueDictionary()
"""Cameras of this computer that this program has open, by address."""
_taking = threading.Lock()


class FrameQueue:
    """The newest pictures between the camera's thread and ours; the camera never waits.

    When it is full the oldest picture is lost and counted: what a robot answers to should be what is shown now.
    """

    def __init__(self, capacity: int) -> None:
        if capacity < 1:
            raise InvalidArgument(f"capacity must be at least 1, got {capacity}")
        self._frames: deque[TimedFrame] = deque(maxlen=capacity)
        self._lost = 0
        self._ready = threading.Condition()

    @property
    def num_lost(self) -> int:
        """Pictures that were not fetched in time."""
        return self._lost

    def put(self, frame: Frame, time_s: float) -> None:
        """Put a picture in, in place of the oldest if need be."""
        with self._ready:
            self._lost += len(self._frames) == self._frames.maxlen
            self._frames.append((frame, time_s))
            self._ready.notify()

    def get(self, timeout_s: float) -> TimedFrame | None:
        """Take the oldest picture; None when there is none for `timeout_s`."""
        with self._ready:
            self._ready.wait_for(lambda: len(self._frames) > 0, _bounded(timeout_s))
            return self._frames.popleft() if self._frames else None


class _Grabber:
    """One opened camera with its thread. A driver may block for ever in opening or reading, so that the thread is left
    behind then; it gives the camera back if it ever comes back itself."""

    def __init__(self, device: int | str, capacity: int) -> None:
        self.frames = FrameQueue(capacity)
        self.is_open = False
        self.fps = 0.0
        self._device = device
        self._cv2 = import_opencv("to watch a camera")
        self._tried = threading.Event()
        self._stopped = threading.Event()
        self._thread = threading.Thread(target=self._run, daemon=True, name="hri-camera")
        self._thread.start()

    def wait_open(self, timeout_s: float) -> bool:
        """Whether the camera could be opened."""
        self._tried.wait(_bounded(timeout_s))
        return self.is_open

    def stop(self, timeout_s: float) -> None:
        """Ask the thread to end, and wait a little for it."""
        self._stopped.set()
        self._thread.join(timeout_s)

    def _run(self) -> None:
        capture = None
        try:
            capture = self._cv2.VideoCapture(self._device)
            self.fps = float(capture.get(self._cv2.CAP_PROP_FPS))
            self.is_open = bool(capture.isOpened())
            self._tried.set()
            while self.is_open and not self._stopped.is_set():
                got, frame = capture.read()
                if got:
                    self.frames.put(np.asarray(frame, dtype=np.uint8), time.monotonic())
                else:
                    self._stopped.wait(_RETRY_S)  # a hiccup, or unplugged: the reader's clock decides
        except self._cv2.error as error:  # the reader, who waits, raises
            _log.info("camera %s: %s", self._device, error)
        finally:
            self._tried.set()
            if capture is not None:
                capture.release()


class CameraSource:
    """A camera as a stream.

    Parameters
    ----------
    device : int or str
        Number of the camera, or an address that OpenCV opens.
    stall_s : float
        How long no picture, or the same picture over and over, may come. Drivers do either when a camera is unplugged;
        a sensor never gives the same noise twice.
    buffer_frames : int
        How far the reader may fall behind before pictures are lost (and counted).

    Raises
    ------
    ImportError
        Without OpenCV.
    IoError
        When the camera cannot be opened, or another source of this program has it open; the message says what to do.
    """

    def __init__(self, device: int | str = 0, stall_s: float = 2.0, buffer_frames: int = 32) -> None:
        require_positive("stall_s", stall_s)
        self.name = f"camera {device}" if isinstance(device, int) else device
        self._device = device
        self._address = _address_of(device)
        self._stall_s = stall_s
        self._capacity = buffer_frames
        self._lost_before = 0
        self._closed = False
        self._last: Frame | None = None
        self._started_s = self._changed_s = time.monotonic()
        self._take()
        grabber: _Grabber | None = None
        try:
            grabber = _Grabber(device, buffer_frames)
            if not grabber.wait_open(max(5.0, stall_s)):
                there = self._address and Path(self._address).is_char_device()
                raise IoError(f"{self.name} cannot be opened: {_IN_USE if there else _HELP}")
        except BaseException:
            if grabber is not None:
                grabber.stop(_CLOSE_S)
            self._give_back()
            raise
        self._grabber = grabber
        self._changed_s = time.monotonic()
        self.fps = self._grabber.fps if 1.0 <= self._grabber.fps <= 240.0 else 15.0

    @property
    def num_lost(self) -> int:
        """Pictures lost because the reader was late."""
        return self._lost_before + self._grabber.frames.num_lost

    def read(self) -> TimedFrame | None:
        """The next picture. Raises Stalled when none comes, or none that differs from the last, for `stall_s`."""
        waited_until = time.monotonic() + self._stall_s
        while not self._closed:
            timed = self._grabber.frames.get(min(0.1, self._stall_s))
            if timed is not None:
                frame, time_s = timed
                if self._last is None or not np.array_equal(frame, self._last):
                    self._changed_s = time_s
                self._last = frame
                if time_s - self._changed_s >= self._stall_s:
                    raise Stalled(f"{self.name}: the same picture for {self._stall_s:g} s; is it still connected?")
                return frame, time_s - self._started_s
            if time.monotonic() >= waited_until:
                raise Stalled(f"{self.name}: no picture for {self._stall_s:g} s; is it still connected?")
        return None

    def reconnect(self) -> bool:
        """Open the camera again; True once it gives a picture."""
        if self._closed:
            return False
        self._grabber.stop(0.1)
        self._lost_before += self._grabber.frames.num_lost
        self._grabber = _Grabber(self._device, self._capacity)
        if not self._grabber.wait_open(self._stall_s):
            return False
        first = self._grabber.frames.get(self._stall_s)
        if first is None or (self._last is not None and np.array_equal(first[0], self._last)):
            return False
        self._changed_s = time.monotonic()
        return True

    def close(self) -> None:
        """Give the camera back; one that is gone cannot make this wait for long."""
        if not self._closed:
            self._closed = True
            self._grabber.stop(_CLOSE_S)
            self._give_back()

    def _take(self) -> None:
        with _taking:
            if self._address in _in_use:
                raise IoError(f"{self.name} is in use: another session of this program has it open; end that first")
            if self._address:
                _in_use[self._address] = self

    def _give_back(self) -> None:
        with _taking:
            if _in_use.get(self._address) is self:
                del _in_use[self._address]


def _bounded(timeout_s: float) -> float:
    """What locks take: they raise OverflowError where it is longer."""
    return min(timeout_s, threading.TIMEOUT_MAX)


def _address_of(device: int | str) -> str:
    """Of a camera of this computer, which one program at a time may open; "" for any other address."""
    if isinstance(device, int):
        return f"/dev/video{device}"
    return device if device.startswith("/dev/") else ""
