# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What NAO hears, as a source of sound: ALAudioDevice, by the extra "nao"."""

from __future__ import annotations

import contextlib
import os
import time
import uuid

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import Error
from hri.live.ring import SampleRing
from hri.live.sources import BLOCK_S, Stalled, require_positive
from hri.robot.nao.link import NaoqiLink

_RATE_HZ = 16000
_FRONT = 3
_INTERLEAVED = 0


class NaoMicrophone:
    """NAO's front microphone as a stream of 16 kHz.

    NAO calls back, so that it has to reach this computer, which listens for it at the address by which it reaches NAO.
    NAO hears itself speak.

    Parameters
    ----------
    url : str
        tcp://HOST or tcp://HOST:PORT, as of `hri.robot.NaoqiRobot`.
    stall_s : float
        Longest time without a sample.
    buffer_s : float
        Size of the buffer; a reader that falls further behind loses samples, which are counted.

    Raises
    ------
    InvalidArgument
        For another address or value.
    IoError
        When no NAO answers there, or this computer cannot listen.
    Error
        When NAO gives no sound.
    ImportError
        Without qi.
    """

    def __init__(self, url: str, stall_s: float = 2.0, buffer_s: float = 5.0) -> None:
        require_positive("stall_s", stall_s)
        require_positive("buffer_s", buffer_s)
        self.sample_rate_hz = _RATE_HZ
        self._ring = SampleRing(max(1, round(buffer_s * _RATE_HZ)))
        self._stall_s = stall_s
        self._closed = False
        self._nonsense = ""
        self._service = f"hri_{os.getpid()}_{uuid.uuid4().hex[:8]}"
        self._link = NaoqiLink(url, stall_s)
        self.name = f"microphone of NAO at {self._link.url}"
        try:
            self._link.serve_buffers(self._service, "processRemote", self._receive)
            self._link.call("ALAudioDevice", "setClientPreferences", self._service, _RATE_HZ, _FRONT, _INTERLEAVED)
            self._link.call("ALAudioDevice", "subscribe", self._service)
        except BaseException:
            self._link.close()
            raise

    @property
    def num_lost(self) -> int:
        """Samples lost because the reader was late."""
        return self._ring.num_lost

    def _receive(self, num_channels: int, num_samples: int, buffer: bytes) -> None:
        # In a thread of qi: copy and go.
        if num_channels != 1 or len(buffer) != 2 * num_samples:
            self._nonsense = f"{len(buffer)} bytes for {num_samples} samples of {num_channels} channels"
            return
        self._ring.write(np.frombuffer(buffer, dtype="<i2").astype(np.float32) / 32768.0)

    def read(self) -> NDArray[np.float32] | None:
        """The next samples. Raises Stalled when none come for `stall_s`, or what comes is no sound."""
        waited_until = time.monotonic() + self._stall_s
        while not self._closed:
            samples = self._ring.read(round(8 * BLOCK_S * _RATE_HZ), min(0.1, self._stall_s))
            if len(samples):
                return samples
            if self._nonsense:
                raise Stalled(f"{self.name}: what came is no sound: {self._nonsense}")
            if time.monotonic() >= waited_until:
                raise Stalled(f"{self.name}: no sound for {self._stall_s:g} s; is it switched off?")
        return None

    def close(self) -> None:
        """Give the microphone back; one that is gone makes this wait for `stall_s` at most."""
        if not self._closed:
            self._closed = True
            with contextlib.suppress(Error):  # it is gone
                self._link.call("ALAudioDevice", "unsubscribe", self._service)
            self._link.close()
