# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Samples on their way from the sound card's thread to ours."""

from __future__ import annotations

import threading

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import InvalidArgument


class SampleRing:
    """A ring of samples between one writer and one reader; the writer never waits.

    What does not fit is lost and counted: a late reader must not make the sound card wait.

    Parameters
    ----------
    capacity : int
        Samples, at least 1.
    """

    def __init__(self, capacity: int) -> None:
        if capacity < 1:
            raise InvalidArgument(f"capacity must be at least 1, got {capacity}")
        self._samples = np.zeros(capacity, dtype=np.float32)
        self._written = 0
        self._read = 0
        self._lost = 0
        self._ready = threading.Condition()

    @property
    def num_lost(self) -> int:
        """Samples that came when the ring was full."""
        return self._lost

    def write(self, samples: NDArray[np.float32]) -> None:
        """Put samples in, as many as fit."""
        with self._ready:
            free = len(self._samples) - (self._written - self._read)
            count = min(free, len(samples))
            self._lost += len(samples) - count
            at = self._written % len(self._samples)
            first = min(count, len(self._samples) - at)
            self._samples[at : at + first] = samples[:first]
            self._samples[: count - first] = samples[first:count]
            self._written += count
            self._ready.notify()

    def count_lost(self, num_samples: int) -> None:
        """Count samples that were lost before they could be written."""
        with self._ready:
            self._lost += num_samples

    def read(self, max_samples: int, timeout_s: float) -> NDArray[np.float32]:
        """Take out up to `max_samples`; waits for the first, and gives none when `timeout_s` has passed."""
        with self._ready:
            self._ready.wait_for(lambda: self._written > self._read, timeout_s)
            count = min(max_samples, self._written - self._read)
            at = self._read % len(self._samples)
            first = min(count, len(self._samples) - at)
            taken = np.concatenate([self._samples[at : at + first], self._samples[: count - first]])
            self._read += count
            return taken
