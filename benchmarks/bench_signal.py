# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Wavelets and resampling against PyWavelets and SciPy."""

from __future__ import annotations

import numpy as np

from hri import _native
from timing import Bench, Timed, medians

RATE_HZ = 16000


def _audio(seconds: float, seed: int = 0) -> np.ndarray:
    """Noise whose level changes, float32."""
    rng = np.random.default_rng(seed)
    count = int(seconds * RATE_HZ)
    swell = 0.05 + 0.2 * np.abs(np.sin(2 * np.pi * 3 * np.arange(count) / RATE_HZ))
    return (swell * rng.standard_normal(count)).astype(np.float32)


def dwt_word() -> Timed:
    """One level of db4 over a word of 1 s at 16 kHz, float64, symmetric border."""
    import pywt

    x = _audio(1.0).astype(np.float64)
    for ours, theirs in zip(
        _native.dwt(x, "db4", _native.Border.symmetric), pywt.dwt(x, "db4", "symmetric"), strict=True
    ):
        assert np.allclose(ours, theirs, atol=1e-12)
    return medians(
        lambda: _native.dwt(x, "db4", _native.Border.symmetric), lambda: pywt.dwt(x, "db4", "symmetric"), 101
    )


def wavedec_word() -> Timed:
    """Five levels of db8 over a word of 1 s at 16 kHz, float32, periodised."""
    import pywt

    x = _audio(1.0)
    ours = _native.wavedec(x, "db8", _native.Border.periodization, 5)
    for a, b in zip(ours, pywt.wavedec(x, "db8", "periodization", 5), strict=True):
        assert np.allclose(a, b, atol=1e-5)
    return medians(
        lambda: _native.wavedec(x, "db8", _native.Border.periodization, 5),
        lambda: pywt.wavedec(x, "db8", "periodization", 5),
        101,
    )


def dwt2_picture() -> Timed:
    """One level of db2 over a picture of 640 x 480, float32, periodised."""
    import pywt

    image = np.random.default_rng(0).uniform(0, 255, (480, 640)).astype(np.float32)
    for ours, theirs in zip(
        _native.dwt2(image, "db2", _native.Border.periodization), pywt.dwt2(image, "db2", "periodization"), strict=True
    ):
        assert np.allclose(ours, theirs, atol=1e-2)
    return medians(
        lambda: _native.dwt2(image, "db2", _native.Border.periodization),
        lambda: pywt.dwt2(image, "db2", "periodization"),
    )


def resample() -> Timed:
    """10 s from 44.1 kHz to 16 kHz."""
    from scipy.signal import resample_poly

    tone = np.sin(2 * np.pi * 1000 / 44100 * np.arange(44100)).astype(np.float32)
    ours, theirs = _native.resample(tone, 44100, 16000), resample_poly(tone, 160, 441, window=("kaiser", 8.0))
    assert len(ours) == len(theirs) and np.allclose(ours[200:-200], theirs[200:-200], atol=1e-3)
    audio = np.random.default_rng(0).standard_normal(441000).astype(np.float32)
    return medians(
        lambda: _native.resample(audio, 44100, 16000), lambda: resample_poly(audio, 160, 441, window=("kaiser", 8.0))
    )


BENCHES = [
    Bench("dwt_word", dwt_word, "PyWavelets"),
    Bench("wavedec_word", wavedec_word, "PyWavelets"),
    Bench("dwt2_picture", dwt2_picture, "PyWavelets"),
    Bench("resample", resample, "SciPy"),
]
