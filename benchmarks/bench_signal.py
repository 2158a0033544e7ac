# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Wavelets, cepstra and resampling against PyWavelets, librosa and SciPy."""

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


def cepstra() -> Timed:
    """13 mel cepstra (26 filters, 25 ms every 10 ms, FFT of 512) of 10 s at 16 kHz, with two orders of deltas."""
    import librosa

    audio = _audio(10.0)
    computer = _native.CepstraComputer(
        _native.CepstraOptions(sample_rate_hz=RATE_HZ, pre_emphasis=0.0, low_hz=0.0, normalisation="none", lifter=0.0)
    )

    settings = {"sr": RATE_HZ, "n_fft": 512, "win_length": 400, "hop_length": 160, "window": np.hamming(400)}
    mel = {"n_mels": 26, "htk": True, "norm": None, "center": False}

    def peer() -> np.ndarray:
        # librosa puts the window in the middle of the FFT's 512 samples, we at their start.
        power = librosa.feature.melspectrogram(y=np.pad(audio, 56), **settings, **mel)
        static = librosa.feature.mfcc(S=np.log(np.maximum(power, 1e-10)), n_mfcc=13)
        velocity = librosa.feature.delta(static, width=5, mode="nearest")
        return np.vstack([static, velocity, librosa.feature.delta(velocity, width=5, mode="nearest")])

    ours, theirs = computer.compute(audio), peer().T
    count = min(len(ours), len(theirs))
    assert np.allclose(ours[:count, :13], theirs[:count, :13], atol=2e-3)
    inside = slice(4, count - 4)
    assert np.allclose(ours[inside], theirs[inside], atol=2e-3)
    return medians(lambda: computer.compute(audio), peer)


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
    Bench("cepstra", cepstra, "librosa"),
    Bench("resample", resample, "SciPy"),
]
