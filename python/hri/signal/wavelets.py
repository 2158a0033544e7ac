# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Wavelet transforms of signals, by PyWavelets' names and equal to it.

Arrays of float32 stay float32, everything else that is real becomes float64.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hri import _native
from hri.core.errors import InvalidArgument
from hri.signal.arrays import as_mode, as_real
from hri.signal.filters import Wavelet, dwt_max_level, name_of

Array = NDArray[Any]
_WHOLE = 2**62


def dwt(data: ArrayLike, wavelet: str | Wavelet, mode: str = "symmetric", axis: int = -1) -> tuple[Array, Array]:
    """One level of a signal.

    Parameters
    ----------
    data : array_like
        Not empty. Of more than one dimension, every line along `axis` is a signal.
    wavelet : str or Wavelet
        One of `wavelist()`.
    mode : str
        What stands beyond the ends, one of `MODES`.
    axis : int

    Returns
    -------
    approximation, detail : ndarray
        (num_samples + taps - 1) // 2 values each; for ``periodization`` half of num_samples, rounded up.

    Raises
    ------
    InvalidArgument
        For an unknown wavelet or mode, and for an empty signal.
    """
    name, border = name_of(wavelet), as_mode(mode)
    approximation, detail = _along([as_real(data)], axis, lambda x: _native.dwt(x, name, border))
    return approximation, detail


def idwt(
    cA: ArrayLike | None, cD: ArrayLike | None, wavelet: str | Wavelet, mode: str = "symmetric", axis: int = -1
) -> Array:
    """The inverse of `dwt`: signals of even length, one sample too long where the original was odd.

    Parameters
    ----------
    cA, cD : array_like or None
        Approximation and detail; None, for one of them, stands for zeros.
    wavelet, mode, axis
        As given to `dwt`.
    """
    if cA is None and cD is None:
        raise InvalidArgument("cA and cD cannot both be None")
    high = None if cD is None else as_real(cD)
    low = np.zeros_like(high) if cA is None else as_real(cA)
    high = np.zeros_like(low) if high is None else high
    low, high = _of_one_type(low, high)
    name, border = name_of(wavelet), as_mode(mode)
    (signal,) = _along([low, high], axis, lambda a, d: [_native.idwt(a, d, name, border)])
    return signal


def wavedec(
    data: ArrayLike, wavelet: str | Wavelet, mode: str = "symmetric", level: int | None = None, axis: int = -1
) -> list[Array]:
    """Several levels of a signal.

    Parameters
    ----------
    data, wavelet, mode, axis
        As for `dwt`.
    level : int, optional
        0..62; by default `dwt_max_level`. Beyond that every coefficient depends on the border.

    Returns
    -------
    list of ndarray
        Approximation, then details from coarse to fine.
    """
    name, border = name_of(wavelet), as_mode(mode)
    if level is None:
        data = as_real(data)
        level = dwt_max_level(data.shape[_axis(data, axis)], wavelet)
    if level and axis in (-1, 0):
        # A signal of either type, as it mostly is; to find that out here would take long beside the transform.
        try:
            bands: list[Array] = _native.wavedec(data, name, border, level)  # type: ignore[call-overload]
            return bands
        except TypeError:
            pass
    values = as_real(data)
    if level == 0:
        return [values.copy()]
    return _along([values], axis, lambda x: _native.wavedec(x, name, border, level))


def waverec(
    coeffs: Sequence[ArrayLike],
    wavelet: str | Wavelet,
    mode: str = "symmetric",
    axis: int = -1,
    *,
    num_samples: int | None = None,
) -> Array:
    """The inverse of `wavedec`.

    Parameters
    ----------
    coeffs : sequence of array_like
        As `wavedec` gives them.
    wavelet, mode, axis
        As given to `wavedec`.
    num_samples : int, optional
        Length of the signal; without it a signal of odd length comes back one sample too long, as from PyWavelets.

    Raises
    ------
    InvalidArgument
        For coefficients that no signal has.
    """
    if not coeffs:
        raise InvalidArgument("there are no coefficients")
    name, border, count = name_of(wavelet), as_mode(mode), _WHOLE if num_samples is None else num_samples
    if axis in (-1, 0) and len(coeffs) > 1:
        # Signals of one type, as they mostly are; to find that out here would take long beside the transform.
        try:
            line: Array = _native.waverec(coeffs, name, border, count)  # type: ignore[call-overload]
            return line
        except TypeError:
            pass
    bands = [as_real(band) for band in coeffs]
    if len(bands) == 1:
        return bands[0].copy()
    bands = _of_one_type(*bands)
    (signal,) = _along(bands, axis, lambda *lines: [_native.waverec(list(lines), name, border, count)])
    return signal


def swt_max_level(input_len: int) -> int:
    """Levels of the stationary transform: how often the length can be halved."""
    if input_len < 1:
        return 0
    return (input_len & -input_len).bit_length() - 1


def swt(
    data: ArrayLike, wavelet: str | Wavelet, level: int | None = None, axis: int = -1, trim_approx: bool = False
) -> list[Any]:
    """Stationary wavelet transform: no level is decimated, so that a shift of the signal shifts its coefficients.

    Parameters
    ----------
    data : array_like
        Its length must be a multiple of 2**level; it is taken as periodic.
    wavelet : str or Wavelet
    level : int, optional
        By default `swt_max_level`.
    axis : int
    trim_approx : bool
        Leave out the approximations of all levels but the highest.

    Returns
    -------
    list
        ``[(cA_n, cD_n), ..., (cA_1, cD_1)]``; with `trim_approx` ``[cA_n, cD_n, ..., cD_1]``. All as long as `data`.

    Raises
    ------
    InvalidArgument
        For a length that does not allow the levels.
    """
    values = as_real(data)
    count = swt_max_level(values.shape[_axis(values, axis)]) if level is None else level
    name = name_of(wavelet)
    bands = _along(
        [values], axis, lambda x: [row for pair in _native.swt(np.ascontiguousarray(x), name, count) for row in pair]
    )
    approximations, details = bands[:count][::-1], bands[count:][::-1]
    if trim_approx:
        return [approximations[0], *details]
    return list(zip(approximations, details, strict=True))


def iswt(coeffs: Sequence[Any], wavelet: str | Wavelet, axis: int = -1) -> Array:
    """The inverse of `swt`, from either structure that it gives."""
    if not coeffs:
        raise InvalidArgument("there are no coefficients")
    pairs = isinstance(coeffs[0], tuple | list)
    parts = [coeffs[0][0], *(detail for _, detail in coeffs)] if pairs else coeffs
    bands = _of_one_type(*map(as_real, parts))
    if len(bands) < 2:
        raise InvalidArgument("there are no details")
    if len({band.shape for band in bands}) != 1:
        raise InvalidArgument("the coefficients of all levels must be of one shape")
    name = name_of(wavelet)
    (signal,) = _along(bands, axis, lambda a, *d: [_native.iswt(np.ascontiguousarray(a), np.stack(d[::-1]), name)])
    return signal


def _axis(values: Array, axis: int) -> int:
    if not -values.ndim <= axis < values.ndim:
        raise InvalidArgument(f"axis {axis} does not exist in an array of {values.ndim} dimensions")
    return axis % values.ndim


def _of_one_type(*arrays: Array) -> list[Array]:
    """The arrays as float32 where all are, else as float64."""
    dtype = np.result_type(*arrays)
    return [array.astype(dtype, copy=False) for array in arrays]


def _along(arrays: Sequence[Array], axis: int, transform: Callable[..., Sequence[Array]]) -> list[Array]:
    """`transform` of the lines of all arrays along `axis`; what it gives stands along that axis again."""
    if axis in (-1, 0) and all(array.ndim == 1 for array in arrays):
        return list(transform(*arrays))
    axis = _axis(arrays[0], axis)
    moved = [np.moveaxis(array, axis, -1) for array in arrays]
    shape = moved[0].shape[:-1]
    if any(array.shape[:-1] != shape for array in moved):
        raise InvalidArgument("coefficients differ in shape beside the axis")
    if not np.prod(shape):
        raise InvalidArgument(f"data is empty: shape {arrays[0].shape}")
    lines = [transform(*(np.ascontiguousarray(array[i]) for array in moved)) for i in np.ndindex(shape)]
    return [np.moveaxis(np.stack(band).reshape(*shape, -1), -1, axis) for band in zip(*lines, strict=True)]
