# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Signals of speech: where a clip holds speech, change of sampling rate, linear prediction."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hri import _native
from hri._native import ActivityOptions


def find_speech(
    audio: ArrayLike, sample_rate_hz: int, options: ActivityOptions | None = None
) -> tuple[int, int] | None:
    """Where a clip holds speech.

    Parameters
    ----------
    audio : array_like, shape (num_samples,)
        Mono, -1 to 1.
    sample_rate_hz : int
    options : ActivityOptions, optional

    Returns
    -------
    (first, last) : tuple of int, or None
        First sample of the utterance and the one behind its last; None without speech.
    """
    found: tuple[int, int] | None = _native.find_speech(
        np.asarray(audio, np.float32), sample_rate_hz, options or ActivityOptions()
    )
    return found


def activity_frames(
    audio: ArrayLike, sample_rate_hz: int, options: ActivityOptions | None = None
) -> NDArray[np.float32]:
    """What end points are found from.

    Parameters
    ----------
    audio, sample_rate_hz, options
        As for `find_speech`.

    Returns
    -------
    ndarray of float32, shape (num_frames, 2 + num_bands)
        Level in dB, voicing (0..1), then the level of each band in dB.
    """
    return _native.activity_frames(np.asarray(audio, np.float32), sample_rate_hz, options or ActivityOptions())


def resample(samples: ArrayLike, from_hz: int, to_hz: int) -> NDArray[np.float32]:
    """Another sampling rate, band-limited.

    Parameters
    ----------
    samples : array_like, shape (num_samples,)
    from_hz, to_hz : int

    Returns
    -------
    ndarray of float32
        num_samples * to_hz / from_hz values, rounded up.
    """
    return _native.resample(np.asarray(samples, np.float32), from_hz, to_hz)


def linear_prediction(frame: ArrayLike, order: int) -> tuple[NDArray[np.float64], float]:
    """Linear prediction by the autocorrelation method (Levinson and Durbin).

    Parameters
    ----------
    frame : array_like, shape (num_samples,)
        Windowed samples.
    order : int

    Returns
    -------
    a : ndarray of float64, shape (order,)
        x[n] is predicted as -a[0] x[n-1] - a[1] x[n-2] - ...
    gain : float
        Energy of the prediction error.
    """
    return _native.linear_prediction(np.asarray(frame, np.float64), order)
