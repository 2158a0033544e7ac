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
from numpy.typing import ArrayLike, NDArray

from hri import _native
from hri._native import Border, max_dwt_level, wavelet_names
from hri.errors import InvalidArgument

__all__ = [
    "dwt",
    "dwt2",
    "idwt",
    "idwt2",
    "max_dwt_level",
    "wavedec",
    "wavedec2",
    "wavelet_names",
    "waverec",
    "waverec2",
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


def _border(name: str) -> Border:
    try:
        return _BORDERS[name]
    except (KeyError, TypeError):
        raise InvalidArgument(f"no border {name!r}; there are: {', '.join(_BORDERS)}") from None


def _real(values: ArrayLike) -> Array:
    """As an array of float32 or float64; complex numbers and text are refused."""
    array = np.asarray(values)
    return array if array.dtype.char in "fd" else array.astype(np.float64, casting="safe")
