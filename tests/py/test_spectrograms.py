# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Spectrograms, cepstra and deltas against librosa."""

from __future__ import annotations

import librosa
import numpy as np
import pytest

from hri import InvalidArgument, features

RATE_HZ = 16000
SOUND = np.random.default_rng(0).normal(0, 0.1, 12345) + np.sin(2 * np.pi * 440 * np.arange(12345) / RATE_HZ)


@pytest.mark.parametrize(
    "options",
    [{}, {"n_fft": 512, "hop_length": 160, "n_mels": 40}, {"fmin": 100.0, "fmax": 6000.0}, {"power": 1.0}],
)
def test_mel_spectrogram_is_librosas(options: dict[str, float]) -> None:
    ours = features.melspectrogram(SOUND, RATE_HZ, **options)  # type: ignore[arg-type]
    theirs = librosa.feature.melspectrogram(y=SOUND, sr=RATE_HZ, **options)
    assert ours.dtype == np.float32 and ours.shape == theirs.shape
    np.testing.assert_allclose(ours, theirs, rtol=1e-3, atol=1e-5 * theirs.max())


@pytest.mark.parametrize("options", [{}, {"n_mfcc": 13, "n_fft": 512, "hop_length": 160, "n_mels": 40, "fmax": 7000.0}])
def test_mfcc_is_librosas(options: dict[str, float]) -> None:
    ours = features.mfcc(SOUND, RATE_HZ, **options)  # type: ignore[arg-type]
    theirs = librosa.feature.mfcc(y=SOUND, sr=RATE_HZ, **options)
    assert ours.shape == theirs.shape
    np.testing.assert_allclose(ours, theirs, rtol=1e-3, atol=1e-4 * np.abs(theirs).max())


@pytest.mark.parametrize(("width", "order"), [(9, 1), (9, 2), (5, 1), (3, 2)])
def test_delta_is_librosas(width: int, order: int) -> None:
    data = np.random.default_rng(1).normal(size=(13, 30))
    for axis in (-1, 0):
        ours = features.delta(data, width=width, order=order, axis=axis)
        np.testing.assert_allclose(ours, librosa.feature.delta(data, width=width, order=order, axis=axis), atol=1e-9)
    assert features.delta(data.astype("f4")).dtype == np.float32


def test_wrong_arguments_are_refused() -> None:
    with pytest.raises(InvalidArgument, match="width"):
        features.delta(np.zeros((2, 20)), width=4)
    with pytest.raises(InvalidArgument, match="fewer than 9"):
        features.delta(np.zeros((2, 8)))
    for wrong in ([], np.zeros((2, 3)), [np.nan] * 5000):
        with pytest.raises(InvalidArgument, match="y"):
            features.melspectrogram(wrong)
    with pytest.raises(InvalidArgument, match="n_fft"):
        features.melspectrogram(SOUND, n_fft=511)
