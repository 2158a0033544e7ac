# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Wavelet transforms against PyWavelets."""

from __future__ import annotations

import numpy as np

from hri import signal as wavelets
from timing import Bench, Timed, medians

NUM_SAMPLES = 16000
SHAPE = (480, 640)


def _agree(ours: list[np.ndarray], theirs: list[np.ndarray], tolerance: float) -> None:
    for a, b in zip(ours, theirs, strict=True):
        assert a.dtype == b.dtype and np.allclose(a, b, rtol=0, atol=tolerance)


def dwt1d() -> Timed:
    """Three levels of db4 over 16000 samples, float32, symmetric border."""
    import pywt

    x = np.random.default_rng(0).standard_normal(NUM_SAMPLES).astype(np.float32)
    _agree(wavelets.wavedec(x, "db4", level=3), pywt.wavedec(x, "db4", level=3), 1e-5)
    return medians(lambda: wavelets.wavedec(x, "db4", level=3), lambda: pywt.wavedec(x, "db4", level=3), 401)


def idwt1d() -> Timed:
    """The inverse of three levels of db4 over 16000 samples, float32, symmetric border."""
    import pywt

    x = np.random.default_rng(0).standard_normal(NUM_SAMPLES).astype(np.float32)
    bands = pywt.wavedec(x, "db4", level=3)
    _agree([wavelets.waverec(bands, "db4")], [pywt.waverec(bands, "db4")], 1e-5)
    return medians(lambda: wavelets.waverec(bands, "db4"), lambda: pywt.waverec(bands, "db4"), 401)


def dwt1d_long() -> Timed:
    """Five levels of db20 over 16000 samples, float64, periodised."""
    import pywt

    x = np.random.default_rng(0).standard_normal(NUM_SAMPLES)
    where = ("db20", "periodization", 5)
    _agree(wavelets.wavedec(x, *where), pywt.wavedec(x, *where), 1e-9)
    return medians(lambda: wavelets.wavedec(x, *where), lambda: pywt.wavedec(x, *where), 101)


def dwt2d() -> Timed:
    """One level of db2 over a picture of 640 x 480, float32, symmetric border."""
    import pywt

    image = np.random.default_rng(0).uniform(0, 255, SHAPE).astype(np.float32)
    (approx, details), (expected, theirs) = wavelets.dwt2(image, "db2"), pywt.dwt2(image, "db2")
    _agree([approx, *details], [expected, *theirs], 1e-2)
    return medians(lambda: wavelets.dwt2(image, "db2"), lambda: pywt.dwt2(image, "db2"), 51)


def idwt2d() -> Timed:
    """The inverse of one level of db2 over a picture of 640 x 480, float32, symmetric border."""
    import pywt

    image = np.random.default_rng(0).uniform(0, 255, SHAPE).astype(np.float32)
    level = pywt.dwt2(image, "db2")
    _agree([wavelets.idwt2(level, "db2", shape=SHAPE)], [pywt.idwt2(level, "db2")], 1e-2)
    return medians(lambda: wavelets.idwt2(level, "db2", shape=SHAPE), lambda: pywt.idwt2(level, "db2"), 51)


BENCHES = [
    Bench("dwt1d", dwt1d, "PyWavelets"),
    Bench("idwt1d", idwt1d, "PyWavelets"),
    Bench("dwt1d_long", dwt1d_long, "PyWavelets"),
    Bench("dwt2d", dwt2d, "PyWavelets"),
    Bench("idwt2d", idwt2d, "PyWavelets"),
]
