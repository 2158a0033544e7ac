# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Worse conditions made from good recordings: noise at a stated SNR, other exposure."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from hri import _native
from hri.errors import InvalidArgument
from hri.media import read_audio

Samples = NDArray[np.float32]
SYNTHESISED = ("white", "pink")


def make_noise(name: str, num_samples: int, sample_rate_hz: int, rng: np.random.Generator) -> Samples:
    """Noise of any level, as long as asked for.

    Parameters
    ----------
    name : str
        "white" or "pink" (synthesised), or the path of a recording, of which a part is taken at random.

    Raises
    ------
    InvalidArgument
        For a name that is neither.
    """
    if name == "white":
        return rng.standard_normal(num_samples).astype(np.float32)
    if name == "pink":
        spectrum = np.fft.rfft(rng.standard_normal(num_samples))
        spectrum /= np.sqrt(np.maximum(np.arange(len(spectrum)), 1.0))
        return np.fft.irfft(spectrum, num_samples).astype(np.float32)
    if not Path(name).is_file():
        raise InvalidArgument(f"noise {name!r} is neither {' nor '.join(SYNTHESISED)} nor a file")
    audio = read_audio(name)
    samples = audio.samples
    if audio.sample_rate_hz != sample_rate_hz:
        samples = np.asarray(_native.resample(samples, audio.sample_rate_hz, sample_rate_hz))
    start = int(rng.integers(len(samples)))
    return np.resize(np.roll(samples, -start), num_samples).astype(np.float32)


def mix_noise(samples: Samples, noise: Samples, snr_db: float) -> Samples:
    """`samples` plus `noise`, scaled so that the ratio of their mean powers is `snr_db`.

    Parameters
    ----------
    samples, noise : float32 arrays, shape (num_samples,)
    snr_db : float
        -30..60.

    Raises
    ------
    InvalidArgument
        For lengths that differ, an SNR out of range, or noise without power.
    """
    if samples.shape != noise.shape:
        raise InvalidArgument(f"samples and noise differ in shape: {samples.shape}, {noise.shape}")
    if not -30 <= snr_db <= 60:
        raise InvalidArgument(f"snr_db must lie in -30..60, got {snr_db}")
    power = float(np.mean(np.square(noise, dtype=np.float64)))
    if not power > 0:
        raise InvalidArgument("noise has no power")
    wanted = float(np.mean(np.square(samples, dtype=np.float64))) / 10 ** (snr_db / 10)
    return (samples + noise * np.sqrt(wanted / power)).astype(np.float32)


def expose(frames: Sequence[NDArray[np.uint8]], factor: float) -> list[NDArray[np.uint8]]:
    """Frames with every pixel times `factor` (0.05..20), clipped at white.

    Raises
    ------
    InvalidArgument
        For a factor out of range.
    """
    if not 0.05 <= factor <= 20:
        raise InvalidArgument(f"exposure must lie in 0.05..20, got {factor}")
    return [np.clip(frame * np.float32(factor), 0, 255).astype(np.uint8) for frame in frames]
