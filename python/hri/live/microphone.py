# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Microphones, by the sounddevice library (the extra "live")."""

from __future__ import annotations

import threading
import time
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import IoError
from hri.core.optional import import_optional
from hri.live.ring import SampleRing
from hri.live.sources import BLOCK_S, Stalled, require_positive

_HELP = "connect a microphone, see 'hri listen --list-devices', or give a recording instead"
_CLOSE_S = 2.0


@dataclass(frozen=True)
class Microphone:
    """An input device: its number, name, channels and usual rate."""

    index: int
    name: str
    num_channels: int
    sample_rate_hz: int
    is_default: bool


def import_sounddevice(purpose: str) -> Any:
    """Import sounddevice. Raises ImportError, or IoError without the library behind it, that name the `purpose`."""
    try:
        return import_optional("sounddevice", "live", purpose)
    except OSError as error:  # the Python package is there, the library behind it is not
        raise IoError(
            f"{purpose} the library PortAudio is needed: install the package libportaudio2 "
            f"(apt install libportaudio2, dnf install portaudio, brew install portaudio) ({error})"
        ) from error


def list_microphones() -> list[Microphone]:
    """Every input device. Raises ImportError or IoError when the libraries for it are not installed."""
    sounddevice = import_sounddevice("to use a microphone")
    try:
        devices = list(sounddevice.query_devices())
        default = int(sounddevice.default.device[0])
    except sounddevice.PortAudioError as error:
        raise IoError(f"sound devices cannot be listed: {error}") from error
    return [
        Microphone(index, str(d["name"]), int(d["max_input_channels"]), int(d["default_samplerate"]), index == default)
        for index, d in enumerate(devices)
        if int(d["max_input_channels"]) > 0
    ]


class MicrophoneSource:
    """A microphone as a stream, with a watchdog: unplugging it raises `Stalled` rather than giving silence.

    Parameters
    ----------
    device : int or str, optional
        Number or part of the name; the system's default by default.
    sample_rate_hz : int, optional
        The device's usual rate by default.
    stall_s : float
        Longest time without a sample.
    buffer_s : float
        Size of the buffer; a reader that falls further behind loses samples, which are counted.

    Raises
    ------
    ImportError
        Without sounddevice.
    IoError
        Without PortAudio, without a microphone, or when it cannot be opened; the message says what to do.
    """

    def __init__(
        self,
        device: int | str | None = None,
        sample_rate_hz: int | None = None,
        stall_s: float = 2.0,
        buffer_s: float = 5.0,
    ) -> None:
        require_positive("stall_s", stall_s)
        require_positive("buffer_s", buffer_s)
        sounddevice = import_sounddevice("to use a microphone")
        try:
            info = sounddevice.query_devices(device, "input")
            self.name = str(info["name"])
            self.sample_rate_hz = int(sample_rate_hz or info["default_samplerate"])
            self._ring = SampleRing(max(1, round(buffer_s * self.sample_rate_hz)))
            self._block = max(1, round(BLOCK_S * self.sample_rate_hz))
            self._stall_s = stall_s
            self._closed = False
            self._stream = sounddevice.InputStream(
                device=device,
                samplerate=self.sample_rate_hz,
                channels=1,
                dtype="float32",
                blocksize=self._block,
                callback=self._receive,
            )
            self._stream.start()
        except (sounddevice.PortAudioError, ValueError) as error:
            raise IoError(f"no microphone can be opened ({error}): {_HELP}") from error

    @property
    def num_lost(self) -> int:
        """Samples lost because the reader was late, or by the sound card itself."""
        return self._ring.num_lost

    def _receive(self, samples: NDArray[np.float32], count: int, _time: Any, status: Any) -> None:
        # In the sound card's thread: copy and go.
        if status and getattr(status, "input_overflow", False):
            self._ring.count_lost(count)  # the card does not say how many; a block at least
        self._ring.write(samples[:, 0])

    def read(self) -> NDArray[np.float32] | None:
        """The next samples. Raises Stalled when none come for `stall_s`."""
        waited_until = time.monotonic() + self._stall_s
        while not self._closed:
            samples = self._ring.read(self._block * 8, min(0.1, self._stall_s))
            if len(samples):
                return samples
            if time.monotonic() >= waited_until:
                raise Stalled(f"{self.name}: no sound for {self._stall_s:g} s; is the microphone still connected?")
        return None

    def close(self) -> None:
        """Release the microphone; returns in time even if the device is gone."""
        if self._closed:
            return
        self._closed = True

        def stop() -> None:
            self._stream.abort()
            self._stream.close()

        closer = threading.Thread(target=stop, daemon=True, name="hri-close-microphone")
        closer.start()
        closer.join(_CLOSE_S)
