# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""How good a signal was, measured on the signal alone: what fusion weighs the modes by."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import lru_cache
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

MIN_SNR_DB, MAX_SNR_DB = -20.0, 60.0
_FRAME_S, _SHIFT_S = 0.025, 0.010
_LOWEST_HZ, _HIGHEST_HZ = 100.0, 4000.0
_NUM_BANDS = 16
_FRAMES_AT_ONCE = 512
"""Of long recordings: spectra of all frames at once take several times the memory of what is kept of them."""
_FLOOR_SHARE, _TOP_SHARE = 0.1, 0.9


def speech_snr_db(samples: NDArray[np.float32], sample_rate_hz: int) -> float | None:
    """Estimate of the ratio of speech to noise of one utterance.

    In every one of 16 bands of equal width in mel (100..4000 Hz) the noise is the level that a tenth of the frames stay
    below, as in quantile-based noise estimation (Stahl, Fischer and Bippus, ICASSP 2000), and the speech that which a
    tenth of the frames exceed; the estimate is the mean over the bands in dB. It needs no pause before the word. It
    is biased: noise alone gives 6 to 8 dB, as its level is not the same in all frames, and speech at 10 dB about 13.

    Parameters
    ----------
    samples : float32 array, shape (num_samples,)
    sample_rate_hz : int

    Returns
    -------
    float or None
        dB, -20..60; None for a clip of less than four frames (25 ms each, 10 ms apart), one that is not finite, or
        silence.
    """
    length, shift = round(_FRAME_S * sample_rate_hz), round(_SHIFT_S * sample_rate_hz)
    if len(samples) < length + 3 * shift or not np.isfinite(samples).all():
        return None
    frames, window = np.lib.stride_tricks.sliding_window_view(samples, length)[::shift], np.hanning(length)
    power = np.empty((len(frames), length // 2 + 1))
    for first in range(0, len(frames), _FRAMES_AT_ONCE):
        block = slice(first, first + _FRAMES_AT_ONCE)
        power[block] = np.square(np.abs(np.fft.rfft(frames[block] * window, axis=1)))
    bands = power @ _bands(length, sample_rate_hz).T
    floor, top = np.quantile(bands, (_FLOOR_SHARE, _TOP_SHARE), axis=0)
    heard = top > 0
    if not heard.any():
        return None
    least = top[heard] * 10 ** (-MAX_SNR_DB / 10)
    ratios = 10 * np.log10(top[heard] / np.maximum(floor[heard], least))
    return float(np.clip(ratios.mean(), MIN_SNR_DB, MAX_SNR_DB))


def mask_quality(hands: Sequence[Any]) -> float | None:
    """Mean quality of the masks of the hand (`HandObservation`), 0..1, where there is one; None where there is none."""
    found = [float(hand.quality) for hand in hands if hand.quality > 0]
    return sum(found) / len(found) if found else None


@lru_cache(maxsize=16)
def _bands(length: int, sample_rate_hz: int) -> NDArray[np.float64]:
    """Which bins of the spectrum belong to each band, shape (num_bands, num_bins); bands without a bin are left out."""
    highest_hz = min(_HIGHEST_HZ, sample_rate_hz / 2)
    edges = np.linspace(_mel(_LOWEST_HZ), _mel(highest_hz), _NUM_BANDS + 1)
    bins = np.array([_mel(hz) for hz in np.fft.rfftfreq(length, 1 / sample_rate_hz)])
    bands = np.array([(bins >= low) & (bins < high) for low, high in pairwise(edges)], float)
    return bands[bands.any(axis=1)]


def _mel(hz: float) -> float:
    return 2595 * math.log10(1 + hz / 700)
