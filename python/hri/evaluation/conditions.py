# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Worse conditions made from good recordings, what they have in common; other exposure of pictures."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from hri.errors import InvalidArgument

Samples = NDArray[np.float32]

Condition = Callable[[Samples, int, np.random.Generator], Samples]
"""Gives a clip as it sounds under a condition, from (samples, sample_rate_hz, rng); what is random comes from `rng`."""

FrontEnd = Callable[[Samples, int], tuple[Samples, int]]
"""What is done to every clip, of training and test, before the recogniser gets it: gives samples and their rate."""


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
