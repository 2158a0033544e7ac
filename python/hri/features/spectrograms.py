# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Spectrograms, cepstra and deltas by librosa's names, defaults and shapes: features x frames."""

from __future__ import annotations

from math import factorial
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hri._native import CepstraComputer, CepstraOptions, FilterBankOptions
from hri.core.errors import InvalidArgument
from hri.features.frames import filter_bank


def melspectrogram(
    y: ArrayLike,
    sr: int = 22050,
    *,
    n_fft: int = 2048,
    hop_length: int = 512,
    n_mels: int = 128,
    fmin: float = 0.0,
    fmax: float | None = None,
    power: float = 2.0,
) -> NDArray[np.float32]:
    """Energy of mel filters, as ``librosa.feature.melspectrogram`` gives it.

    Parameters
    ----------
    y : array_like, shape (num_samples,)
        Mono, -1 to 1.
    sr : int
        Sampling rate in Hz.
    n_fft, hop_length : int
        Samples of a frame (Hann window, zeros around the signal) and between frames.
    n_mels : int
        Filters of Slaney's scale, of equal area, from `fmin` to `fmax` (default: half of `sr`) in Hz.
    power : float
        Exponent of the magnitude: 2 for energy.

    Returns
    -------
    ndarray of float32, shape (n_mels, 1 + num_samples // hop_length)

    Raises
    ------
    InvalidArgument
        For an empty signal, a sample that is not finite, or an option out of range.
    """
    samples = _samples(y)
    if hop_length < 1 or n_fft < 2 or n_fft % 2 or power <= 0:
        raise InvalidArgument("n_fft must be even, hop_length at least 1 and power above 0")
    bank = FilterBankOptions(
        num_filters=n_mels, low_hz=fmin, high_hz=fmax or 0.0, mel_scale="slaney", axis="hz", unit_area=True
    )
    padded = np.pad(samples, n_fft // 2)
    frames = np.lib.stride_tricks.sliding_window_view(padded, n_fft)[::hop_length]
    window = (0.5 - 0.5 * np.cos(2 * np.pi * np.arange(n_fft) / n_fft)).astype(np.float32)
    weights = filter_bank(bank, sr, n_fft)
    blocks = np.array_split(np.arange(len(frames)), max(1, len(frames) // 256))  # bounds memory
    spectra = (np.abs(np.fft.rfft(frames[block] * window)).astype(np.float32) ** np.float32(power) for block in blocks)
    return np.concatenate([weights @ spectrum.T for spectrum in spectra], axis=1)


def mfcc(
    y: ArrayLike,
    sr: int = 22050,
    *,
    n_mfcc: int = 20,
    n_fft: int = 2048,
    hop_length: int = 512,
    n_mels: int = 128,
    fmin: float = 0.0,
    fmax: float | None = None,
) -> NDArray[np.float32]:
    """Mel-frequency cepstra, as ``librosa.feature.mfcc`` gives them; `hri.features.cepstra` has more options.

    Parameters
    ----------
    n_mfcc : int
        Cepstra with c0, 2..n_mels.
    y, sr, n_fft, hop_length, n_mels, fmin, fmax
        As for `melspectrogram`.

    Returns
    -------
    ndarray of float32, shape (n_mfcc, 1 + num_samples // hop_length)
    """
    preset: dict[str, Any] = CepstraOptions.librosa(sr).as_dict()
    preset |= {
        "frame_length_ms": 1000 * n_fft / sr,
        "frame_shift_ms": 1000 * hop_length / sr,
        "fft_size": n_fft,
        "num_cepstra": n_mfcc - 1,
        "num_filters": n_mels,
        "low_hz": fmin,
        "high_hz": fmax or 0.0,
    }
    return np.ascontiguousarray(CepstraComputer(CepstraOptions(**preset)).compute(_samples(y)).T)


def delta(data: ArrayLike, *, width: int = 9, order: int = 1, axis: int = -1) -> NDArray[Any]:
    """Derivatives along time, as ``librosa.feature.delta`` gives them (Savitzky and Golay; edges by its "interp").

    Parameters
    ----------
    data : array_like
        Features; at least `width` values along `axis`.
    width : int
        Odd, at least 3: values that a polynomial is fitted to.
    order : int
        1 for deltas, 2 for accelerations; also the degree of the polynomial. Below `width`.
    axis : int

    Returns
    -------
    ndarray of the shape of `data`, float32 or float64
    """
    values = np.asarray(data)
    values = values if values.dtype.char in "fd" else values.astype(np.float64, casting="safe")
    if width < 3 or width % 2 == 0 or not 0 < order < width:
        raise InvalidArgument(f"width must be odd and at least 3, order 1..width - 1, got {width} and {order}")
    if values.ndim == 0 or not -values.ndim <= axis < values.ndim or values.shape[axis] < width:
        raise InvalidArgument(f"data of shape {values.shape} has fewer than {width} values along axis {axis}")
    half = width // 2
    powers = np.arange(-half, half + 1, dtype=np.float64)[:, None] ** np.arange(order + 1)
    weights = factorial(order) * np.linalg.pinv(powers)[order]
    windows = np.lib.stride_tricks.sliding_window_view(np.moveaxis(values, axis, -1), width, axis=-1)
    inner = (windows @ weights).astype(values.dtype)
    # That derivative of the polynomial is constant, so that the edges repeat it.
    edges = [(0, 0)] * (inner.ndim - 1) + [(half, half)]
    return np.moveaxis(np.pad(inner, edges, mode="edge"), -1, axis)


def _samples(y: ArrayLike) -> NDArray[np.float32]:
    samples = np.asarray(y, np.float32)
    if samples.ndim != 1 or not samples.size:
        raise InvalidArgument(f"y must be a vector of samples, got shape {samples.shape}")
    if not np.isfinite(samples).all():
        raise InvalidArgument(f"y[{np.flatnonzero(~np.isfinite(samples))[0]}] is not finite")
    return samples
