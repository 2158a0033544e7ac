# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Frames of speech: filter banks, cepstra from linear prediction, time normalisation."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hri import _native
from hri._native import FilterBankOptions


def filter_bank(options: FilterBankOptions, sample_rate_hz: int, fft_size: int) -> NDArray[np.float32]:
    """Weights of a filter bank.

    Parameters
    ----------
    options : FilterBankOptions
    sample_rate_hz : int
    fft_size : int

    Returns
    -------
    ndarray of float32, shape (num_filters, fft_size / 2 + 1)
    """
    return _native.filter_bank(options, sample_rate_hz, fft_size)


def filter_edges(options: FilterBankOptions, sample_rate_hz: int) -> NDArray[np.float64]:
    """Low, centre and high frequency of every filter in Hz, shape (num_filters, 3)."""
    return _native.filter_edges(options, sample_rate_hz)


def lpc_cepstrum(a: ArrayLike, gain: float, num_cepstra: int) -> NDArray[np.float64]:
    """Cepstrum of a prediction filter.

    Parameters
    ----------
    a : array_like, shape (order,)
        As `hri.signal.linear_prediction` gives it.
    gain : float
        Above 0.
    num_cepstra : int

    Returns
    -------
    ndarray of float64, shape (num_cepstra + 1,)
        c_0 .. c_num of the log spectrum ln(gain / |A|^2) = c_0 + 2 sum of c_n cos(n w).
    """
    return _native.lpc_cepstrum(np.asarray(a, np.float64), gain, num_cepstra)


def spectral_envelope(cepstra: ArrayLike, num_bins: int) -> NDArray[np.float32]:
    """The smooth spectrum that cepstra describe (thesis eq. 3.34-3.36).

    Parameters
    ----------
    cepstra : array_like, shape (num_frames, num_cepstra)
        c_1, c_2, ... of every frame.
    num_bins : int

    Returns
    -------
    ndarray of float32, shape (num_frames, num_bins)
        exp(sum of c_i cos(pi i t / num_bins)), t = 1 .. num_bins.
    """
    return _native.spectral_envelope(np.asarray(cepstra, np.float32), num_bins)


def normalise_time(frames: ArrayLike, num_rows: int) -> NDArray[np.float32]:
    """Frames stretched or squeezed to `num_rows` rows by linear interpolation.

    Parameters
    ----------
    frames : array_like, shape (num_frames, num_features)
    num_rows : int

    Returns
    -------
    ndarray of float32, shape (num_rows, num_features)
    """
    return _native.normalise_time(np.asarray(frames, np.float32), num_rows)
