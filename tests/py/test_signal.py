# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Resampling against SciPy, end points."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.signal import resample_poly

from hri.core.errors import InvalidArgument
from hri.signal import find_speech, resample


def signal(count: int, dtype: str = "f8", seed: int = 0) -> np.ndarray:
    return np.random.default_rng(seed).normal(size=count).astype(dtype)


@pytest.mark.parametrize(("source", "target"), [(44100, 16000), (8000, 16000), (16000, 8000), (48000, 44100)])
def test_resampling_keeps_tones_and_equals_scipy_inside(source: int, target: int) -> None:
    time_s = np.arange(source) / source
    tone = (0.5 * np.sin(2 * np.pi * 1000 * time_s)).astype("f4")
    ours = resample(tone, source, target)
    assert len(ours) == target
    inner = slice(target // 20, -target // 20)
    exact = 0.5 * np.sin(2 * np.pi * 1000 * np.arange(target) / target)
    np.testing.assert_allclose(ours[inner], exact[inner], atol=2e-3)
    common = np.gcd(source, target)
    peer = resample_poly(tone.astype("f8"), target // common, source // common, window=("kaiser", 8.0))
    np.testing.assert_allclose(ours[inner], peer[inner], atol=5e-3)


def test_resampling_removes_what_the_lower_rate_cannot_hold() -> None:
    tone = np.sin(2 * np.pi * 6000 * np.arange(16000) / 16000).astype("f4")
    assert np.abs(resample(tone, 16000, 8000)[200:-200]).max() < 1e-3


def test_resampling_to_the_same_rate_changes_nothing() -> None:
    x = signal(100, "f4")
    np.testing.assert_array_equal(resample(x, 8000, 8000), x)
    assert len(resample(x[:0], 8000, 16000)) == 0
    with pytest.raises(InvalidArgument, match=r"1000\.\.384000"):
        resample(x, 10, 8000)


def burst(level: float, noise: float) -> np.ndarray:
    """0.3 s of a tone, from 0.5 s on, in 1.3 s of noise at 16 kHz."""
    x = noise * np.random.default_rng(0).normal(size=20800)
    x[8000:12800] += level * np.sin(2 * np.pi * 440 * np.arange(4800) / 16000)
    return x.astype("f4")


@pytest.mark.parametrize("level", [0.5, 0.05, 0.02])
@pytest.mark.parametrize("ratio", [300.0, 10.0, 6.0])
def test_word_is_found_whatever_its_level(level: float, ratio: float) -> None:
    first, last = find_speech(burst(level, level / ratio), 16000)
    assert first == pytest.approx(8000, abs=1200)
    assert last == pytest.approx(12800, abs=1200)


def test_silence_and_steady_noise_hold_no_word() -> None:
    assert find_speech(np.zeros(16000, "f4"), 16000) is None
    assert find_speech(np.full(16000, 0.3, "f4"), 16000) is None
    assert find_speech(signal(16000, "f4") * 0.1, 16000) is None
    with pytest.raises(InvalidArgument, match="sample 7"):
        find_speech(np.where(np.arange(16000) == 7, np.nan, 0).astype("f4"), 16000)
    with pytest.raises(InvalidArgument, match="too short"):
        find_speech(np.zeros(10, "f4"), 16000)
