# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Resampling against SciPy."""

from __future__ import annotations

import numpy as np

from hri import signal
from timing import Bench, Timed, medians


def resample() -> Timed:
    """10 s from 44.1 kHz to 16 kHz."""
    from scipy.signal import resample_poly

    tone = np.sin(2 * np.pi * 1000 / 44100 * np.arange(44100)).astype(np.float32)
    ours, theirs = signal.resample(tone, 44100, 16000), resample_poly(tone, 160, 441, window=("kaiser", 8.0))
    assert len(ours) == len(theirs) and np.allclose(ours[200:-200], theirs[200:-200], atol=1e-3)
    audio = np.random.default_rng(0).standard_normal(441000).astype(np.float32)
    return medians(
        lambda: signal.resample(audio, 44100, 16000), lambda: resample_poly(audio, 160, 441, window=("kaiser", 8.0))
    )


BENCHES = [Bench("resample", resample, "SciPy")]
