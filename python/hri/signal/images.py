# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Wavelet transforms of pictures, by PyWavelets' names and equal to it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hri import _native
from hri.core.errors import InvalidArgument
from hri.signal.arrays import as_mode, as_real
from hri.signal.filters import Wavelet, dwt_max_level, name_of

Array = NDArray[Any]
Details = tuple[Array, Array, Array]
"""Horizontal, vertical and diagonal details of one level; horizontal ones answer to horizontal edges."""


def dwt2(image: ArrayLike, wavelet: str | Wavelet, mode: str = "symmetric") -> tuple[Array, Details]:
    """One level of a picture.

    Parameters
    ----------
    image : array_like, shape (height, width)
    wavelet : str or Wavelet
    mode : str
        What stands beyond the borders, one of `MODES`.

    Returns
    -------
    cA : ndarray
        Approximation.
    (cH, cV, cD) : tuple of ndarray
        Horizontal, vertical and diagonal details.
    """
    return _native.dwt2(as_real(image), name_of(wavelet), as_mode(mode))


def idwt2(
    coeffs: tuple[ArrayLike, Sequence[ArrayLike]],
    wavelet: str | Wavelet,
    mode: str = "symmetric",
    *,
    shape: tuple[int, int] | None = None,
) -> Array:
    """The inverse of `dwt2`.

    Parameters
    ----------
    coeffs : (cA, (cH, cV, cD))
    wavelet, mode
        As given to `dwt2`.
    shape : tuple of int, optional
        Height and width of the picture; without it odd ones come back one pixel too large, as from PyWavelets.
    """
    approximation, details = coeffs
    horizontal, vertical, diagonal = map(as_real, details)
    whole = shape or _whole(horizontal, wavelet, mode)
    return _native.idwt2(as_real(approximation), horizontal, vertical, diagonal, name_of(wavelet), as_mode(mode), whole)


def wavedec2(image: ArrayLike, wavelet: str | Wavelet, mode: str = "symmetric", level: int | None = None) -> list[Any]:
    """Several levels of a picture.

    Parameters
    ----------
    image, wavelet, mode
        As for `dwt2`.
    level : int, optional
        By default `dwt_max_level` of the shorter side.

    Returns
    -------
    list
        ``[cA_n, (cH_n, cV_n, cD_n), ..., (cH_1, cV_1, cD_1)]``
    """
    values = as_real(image)
    if values.ndim != 2:
        raise InvalidArgument(f"image must have two dimensions, got shape {values.shape}")
    if level is None:
        level = dwt_max_level(min(values.shape), wavelet)
    if level == 0:
        return [values.copy()]
    return list(_native.wavedec2(values, name_of(wavelet), as_mode(mode), level))


def waverec2(
    coeffs: Sequence[Any],
    wavelet: str | Wavelet,
    mode: str = "symmetric",
    *,
    shape: tuple[int, int] | None = None,
) -> Array:
    """The inverse of `wavedec2`; `shape` as for `idwt2`."""
    if not len(coeffs):
        raise InvalidArgument("there are no coefficients")
    approximation, *levels = coeffs
    if not levels:
        return np.array(as_real(approximation))
    bands = [list(map(as_real, details)) for details in levels]
    whole = shape or _whole(bands[-1][0], wavelet, mode)
    return _native.waverec2(as_real(approximation), bands, name_of(wavelet), as_mode(mode), whole)


def _whole(details: Array, wavelet: str | Wavelet, mode: str) -> tuple[int, int]:
    """The largest picture with finest details of this shape."""
    if details.ndim != 2:
        raise InvalidArgument(f"details must have two dimensions, got shape {details.shape}")
    lost = 0 if mode == "periodization" else Wavelet(name_of(wavelet)).rec_len - 2
    height, width = (2 * int(n) - lost for n in details.shape)
    return height, width
