# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Wavelet transforms of signals and pictures, by PyWavelets' names and equal to it.

Arrays of float32 stay float32, everything else becomes float64. Borders are named as PyWavelets' modes: symmetric,
zero, constant, periodic, reflect, periodization, smooth, antisymmetric, antireflect.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

from hri import _native
from hri._native import Border, frequency_order, max_dwt_level, wavelet_names
from hri.core.errors import InvalidArgument

__all__ = [
    "WaveletStream",
    "best_basis",
    "dwt",
    "dwt2",
    "frequency_order",
    "idwt",
    "idwt2",
    "max_dwt_level",
    "wavedec",
    "wavedec2",
    "wavelet_names",
    "wavelet_packets",
    "waverec",
    "waverec2",
    "waverec_packets",
]

Array = NDArray[Any]
Details = tuple[Array, Array, Array]
"""Horizontal, vertical and diagonal details of one level."""

_BORDERS: dict[str, Border] = dict(Border.__members__)
_WHOLE = 2**62


def dwt(x: ArrayLike, wavelet: str, border: str = "symmetric") -> tuple[Array, Array]:
    """One level of a signal.

    Parameters
    ----------
    x : array_like, shape (num_samples,)
        Not empty.
    wavelet : str
        One of `wavelet_names()`.
    border : str
        What stands beyond the ends.

    Returns
    -------
    approximation, detail : ndarray
        (num_samples + taps - 1) // 2 values each; for ``periodization`` half of num_samples, rounded up.

    Raises
    ------
    InvalidArgument
        For an unknown wavelet or border, and for an empty signal.
    """
    return _native.dwt(_real(x), wavelet, _border(border))


def idwt(approximation: ArrayLike, detail: ArrayLike, wavelet: str, border: str = "symmetric") -> Array:
    """The inverse of `dwt`: a signal of even length, one sample too long where the original was odd."""
    return _native.idwt(_real(approximation), _real(detail), wavelet, _border(border))


def wavedec(x: ArrayLike, wavelet: str, border: str = "symmetric", num_levels: int = 1) -> list[Array]:
    """Several levels of a signal.

    Parameters
    ----------
    x, wavelet, border
        As for `dwt`.
    num_levels : int
        1..62; beyond `max_dwt_level(num_samples, wavelet)` every coefficient depends on the border.

    Returns
    -------
    list of ndarray
        Approximation, then details from coarse to fine.
    """
    return _native.wavedec(_real(x), wavelet, _border(border), num_levels)


def waverec(
    coefficients: Sequence[ArrayLike], wavelet: str, border: str = "symmetric", num_samples: int | None = None
) -> Array:
    """The inverse of `wavedec`.

    Parameters
    ----------
    coefficients : sequence of array_like
        As `wavedec` gives them.
    wavelet, border
        As given to `wavedec`.
    num_samples : int, optional
        Length of the signal; without it a signal of odd length comes back one sample too long.

    Raises
    ------
    InvalidArgument
        For coefficients that no signal has.
    """
    bands = [_real(c) for c in coefficients]
    return _native.waverec(bands, wavelet, _border(border), _WHOLE if num_samples is None else num_samples)


def dwt2(image: ArrayLike, wavelet: str, border: str = "symmetric") -> tuple[Array, Details]:
    """One level of a picture of shape (height, width): (approximation, (horizontal, vertical, diagonal)).

    Horizontal details answer to horizontal edges.
    """
    return _native.dwt2(_real(image), wavelet, _border(border))


def idwt2(level: tuple[ArrayLike, Sequence[ArrayLike]], wavelet: str, border: str, shape: tuple[int, int]) -> Array:
    """The inverse of `dwt2` for a picture of this (height, width)."""
    approximation, details = level
    horizontal, vertical, diagonal = map(_real, details)
    return _native.idwt2(_real(approximation), horizontal, vertical, diagonal, wavelet, _border(border), shape)


def wavedec2(
    image: ArrayLike, wavelet: str, border: str = "symmetric", num_levels: int = 1
) -> tuple[Array, list[Details]]:
    """Several levels of a picture: (approximation, details of every level from coarse to fine)."""
    approximation, *details = _native.wavedec2(_real(image), wavelet, _border(border), num_levels)
    return approximation, details


def waverec2(
    levels: tuple[ArrayLike, Sequence[Sequence[ArrayLike]]], wavelet: str, border: str, shape: tuple[int, int]
) -> Array:
    """The inverse of `wavedec2` for a picture of this (height, width)."""
    approximation, details = levels
    bands = [list(map(_real, level)) for level in details]
    return _native.waverec2(_real(approximation), bands, wavelet, _border(border), shape)


def wavelet_packets(x: ArrayLike, wavelet: str, border: str = "symmetric", num_levels: int = 1) -> list[Array]:
    """Wavelet packets: details are split as approximations are.

    Parameters
    ----------
    x, wavelet, border
        As for `dwt`.
    num_levels : int
        1..20.

    Returns
    -------
    list of ndarray
        Item l has a row for each of the 2**l nodes of level l; item 0 is the signal. Rows stand in natural order:
        the binary digits of an index are the way from the top, 1 for the detail. ``packets[l][frequency_order(l)]``
        has them by rising frequency.
    """
    return _native.wavelet_packets(_contiguous(x), wavelet, _border(border), num_levels)


def best_basis(packets: Sequence[ArrayLike]) -> list[tuple[int, int]]:
    """The nodes (level, index) that together describe the signal with the least Shannon entropy of energy."""
    return _native.best_basis([_contiguous(level) for level in packets])


def waverec_packets(
    packets: Sequence[ArrayLike], basis: Sequence[tuple[int, int]], wavelet: str, border: str = "symmetric"
) -> Array:
    """The signal from the nodes (level, index) of `basis` alone, which cover the signal exactly once.

    Raises
    ------
    InvalidArgument
        For nodes that do not, and for packets that no signal has.
    """
    levels = [_contiguous(level) for level in packets]
    return _native.reconstruct_packets(levels, list(basis), wavelet, _border(border))


class WaveletStream:
    """The transform of a signal that arrives in pieces.

    All coefficients together, after `finish`, are those of ``wavedec(x, wavelet, "zero", num_levels)``, to the bit.

    Parameters
    ----------
    wavelet : str
    num_levels : int
        1..30.
    dtype : dtype
        float32 or float64: of samples and coefficients.
    """

    def __init__(self, wavelet: str, num_levels: int, dtype: DTypeLike = np.float32) -> None:
        self.dtype = np.dtype(dtype)
        if self.dtype.char not in "fd":
            raise InvalidArgument(f"dtype must be float32 or float64, got {self.dtype}")
        kind = _native.WaveletStream32 if self.dtype.char == "f" else _native.WaveletStream64
        self._stream = kind(_native.WaveletStreamOptions(wavelet=wavelet, num_levels=num_levels))

    def push(self, samples: ArrayLike) -> list[Array]:
        """The coefficients that have become final, in the order of `wavedec`; each array may be empty."""
        return self._stream.push(np.ascontiguousarray(samples, dtype=self.dtype))

    def finish(self) -> list[Array]:
        """The rest, as if zeros followed; then the stream starts anew."""
        return self._stream.finish()

    def reset(self) -> None:
        """Forget what was pushed."""
        self._stream.reset()


def _border(name: str) -> Border:
    try:
        return _BORDERS[name]
    except (KeyError, TypeError):
        raise InvalidArgument(f"no border {name!r}; there are: {', '.join(_BORDERS)}") from None


def _real(values: ArrayLike) -> Array:
    """As an array of float32 or float64; complex numbers and text are refused."""
    array = np.asarray(values)
    return array if array.dtype.char in "fd" else array.astype(np.float64, casting="safe")


def _contiguous(values: ArrayLike) -> Array:
    return np.ascontiguousarray(_real(values))
