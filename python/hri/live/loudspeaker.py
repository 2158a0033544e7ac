# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Loudspeakers, by the sounddevice library (the extra "live")."""

from __future__ import annotations

import threading

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import IoError
from hri.live.microphone import import_sounddevice
from hri.signal import resample

_HELP = "connect a loudspeaker or headphones"
_BLOCK_S = 0.1


class Loudspeaker:
    """Plays samples, one recording after the other.

    Parameters
    ----------
    device : int or str, optional
        Number or part of the name; the system's default by default.

    Raises
    ------
    ImportError
        Without sounddevice.
    IoError
        Without PortAudio, and without a loudspeaker.
    """

    def __init__(self, device: int | str | None = None) -> None:
        self._sounddevice = import_sounddevice("to use a loudspeaker")
        self._device = device
        self._closed = threading.Event()
        try:
            info = self._sounddevice.query_devices(device, "output")
            self.name, self._rate_hz = str(info["name"]), int(info["default_samplerate"])
            self._sounddevice.check_output_settings(device=device, channels=1, samplerate=self._rate_hz)
        except (self._sounddevice.PortAudioError, ValueError) as error:
            raise IoError(f"no loudspeaker can be used ({error}): {_HELP}") from error

    def play(self, samples: NDArray[np.float32], sample_rate_hz: int) -> None:
        """Play samples, shape (num_samples,), and return when they have been played, or `close` was called.

        Raises IoError when the loudspeaker has vanished.
        """
        played = samples if sample_rate_hz == self._rate_hz else resample(samples, sample_rate_hz, self._rate_hz)
        played = np.ascontiguousarray(np.clip(played, -1.0, 1.0), dtype=np.float32)
        block = max(1, round(_BLOCK_S * self._rate_hz))
        try:
            with self._sounddevice.OutputStream(
                device=self._device, samplerate=self._rate_hz, channels=1, dtype="float32"
            ) as stream:  # which plays what is left before it is closed
                for begin in range(0, len(played), block):
                    if self._closed.is_set():
                        return
                    stream.write(played[begin : begin + block, np.newaxis])
        except (self._sounddevice.PortAudioError, ValueError) as error:
            raise IoError(f"{self.name} plays nothing ({error}): {_HELP}") from error

    def close(self) -> None:
        """Play nothing more; may be called by any thread."""
        self._closed.set()
