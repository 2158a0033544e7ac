# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The wavelet transform of a signal that arrives in pieces."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

from hri import _native
from hri.core.errors import InvalidArgument
from hri.signal.filters import Wavelet, name_of


class WaveletStream:
    """The transform of a signal that arrives in pieces.

    All coefficients together, after `finish`, are those of ``wavedec(x, wavelet, "zero", level)``, to the bit.

    Parameters
    ----------
    wavelet : str or Wavelet
    level : int
        1..30.
    dtype : dtype
        float32 or float64: of samples and coefficients.
    """

    def __init__(self, wavelet: str | Wavelet, level: int, dtype: DTypeLike = np.float32) -> None:
        self.dtype = np.dtype(dtype)
        if self.dtype.char not in "fd":
            raise InvalidArgument(f"dtype must be float32 or float64, got {self.dtype}")
        kind = _native.WaveletStream32 if self.dtype.char == "f" else _native.WaveletStream64
        self._stream = kind(_native.WaveletStreamOptions(wavelet=name_of(wavelet), num_levels=level))

    def push(self, samples: ArrayLike) -> list[NDArray[Any]]:
        """The coefficients that have become final, in the order of `wavedec`; each array may be empty."""
        return self._stream.push(np.ascontiguousarray(samples, dtype=self.dtype))

    def finish(self) -> list[NDArray[Any]]:
        """The rest, as if zeros followed; then the stream starts anew."""
        return self._stream.finish()

    def reset(self) -> None:
        """Forget what was pushed."""
        self._stream.reset()
