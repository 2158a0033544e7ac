# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Worse conditions made from good recordings, what they have in common; other exposure of pictures."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from hri.core.checks import check_number
from hri.core.errors import InvalidArgument
from hri.core.optional import import_opencv

Samples = NDArray[np.float32]

Condition = Callable[[Samples, int, np.random.Generator], Samples]
"""Gives a clip as it sounds under a condition, from (samples, sample_rate_hz, rng); what is random comes from `rng`."""

FrontEnd = Callable[[Samples, int], tuple[Samples, int]]
"""What is done to every clip, of training and test, before the recogniser gets it: gives samples and their rate."""


def check_exposure(factor: float) -> None:
    """Refuse a factor on pixels that is no number of 0.05..20. Raises InvalidArgument."""
    check_number(factor, "exposure", 0.05, 20)


def expose(frames: Sequence[NDArray[np.uint8]], factor: float) -> list[NDArray[np.uint8]]:
    """Frames with every pixel times `factor` (0.05..20), clipped at white.

    Raises
    ------
    InvalidArgument
        For a factor out of range.
    """
    check_exposure(factor)
    return _mapped(frames, np.clip(np.arange(256, dtype=np.float32) * np.float32(factor), 0, 255).astype(np.uint8))


def gamma(frames: Sequence[NDArray[np.uint8]], exponent: float) -> list[NDArray[np.uint8]]:
    """Frames with every pixel, on 0..1, to the power of `exponent` (0.2..5): above 1 darkens what is not bright.

    Raises
    ------
    InvalidArgument
        For an exponent out of range.
    """
    if not 0.2 <= exponent <= 5:
        raise InvalidArgument(f"gamma must lie in 0.2..5, got {exponent}")
    return _mapped(frames, np.round(255 * (np.arange(256) / 255) ** exponent).astype(np.uint8))


def tint(frames: Sequence[NDArray[np.uint8]], gains: tuple[float, float, float]) -> list[NDArray[np.uint8]]:
    """Frames in coloured light: blue, green and red times their gain (0.05..20), clipped at white.

    Raises
    ------
    InvalidArgument
        For a gain out of range.
    """
    if len(gains) != 3 or not all(0.05 <= gain <= 20 for gain in gains):
        raise InvalidArgument(f"gains must be three numbers in 0.05..20, got {gains}")
    return _mapped(frames, np.clip(np.arange(256)[:, None] * np.asarray(gains), 0, 255).astype(np.uint8))


def _mapped(frames: Sequence[NDArray[np.uint8]], levels: NDArray[np.uint8]) -> list[NDArray[np.uint8]]:
    """Every value replaced by its entry in `levels`: 256 for all channels, or for each of three beside each other."""
    lut = import_opencv("to change the light of pictures").LUT
    return [np.asarray(lut(frame, levels.reshape(1, 256, -1))) for frame in frames]
