# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Where live sound comes from: the interface, and recordings played as a stream."""

from __future__ import annotations

import time
from os import PathLike
from pathlib import Path
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import InvalidArgument, IoError
from hri.media import read_audio

BLOCK_S = 0.02


class Stalled(IoError):
    """A source gave no samples for longer than it may."""


class AudioSource(Protocol):
    """A stream of mono samples.

    Attributes
    ----------
    name : str
        What people call it.
    sample_rate_hz : int
    num_lost : int
        Samples that were lost on the way so far.
    """

    name: str
    sample_rate_hz: int

    @property
    def num_lost(self) -> int: ...

    def read(self) -> NDArray[np.float32] | None:
        """The next samples, at least one; None when the stream has ended. Raises Stalled when none come in time."""
        ...

    def close(self) -> None:
        """Give the device back; returns in bounded time, also when the device is gone."""
        ...


class ArraySource:
    """Samples as a stream.

    Parameters
    ----------
    samples : float32 array, shape (num_samples,)
    sample_rate_hz : int
    name : str
    paced : bool
        As fast as they would be spoken; otherwise as fast as they are read.
    """

    def __init__(
        self, samples: NDArray[np.float32], sample_rate_hz: int, name: str = "samples", paced: bool = False
    ) -> None:
        self.name = name
        self.sample_rate_hz = sample_rate_hz
        self.num_lost = 0
        self._samples = samples
        self._paced = paced
        self._at = 0
        self._started_s: float | None = None

    def read(self) -> NDArray[np.float32] | None:
        """The next 20 ms."""
        block = self._samples[self._at : self._at + max(1, round(BLOCK_S * self.sample_rate_hz))]
        if not len(block):
            return None
        self._at += len(block)
        if self._paced:
            if self._started_s is None:
                self._started_s = time.monotonic()
            time.sleep(max(0.0, self._started_s + self._at / self.sample_rate_hz - time.monotonic()))
        return block

    def close(self) -> None:
        """What has not been read is dropped."""
        self._at = len(self._samples)


class FileSource(ArraySource):
    """A recording as a stream: what `hri.read_audio` reads.

    Attributes
    ----------
    notes : list of str
        What is wrong with the file, or was changed, as of `Audio`.
    """

    def __init__(self, path: str | PathLike[str], paced: bool = False) -> None:
        audio = read_audio(path)
        super().__init__(audio.samples, audio.sample_rate_hz, Path(path).name, paced)
        self.notes = audio.notes


def require_positive(name: str, value: float) -> None:
    """Raise InvalidArgument unless `value` is above 0."""
    if not value > 0:
        raise InvalidArgument(f"{name} must be above 0, got {value}")
