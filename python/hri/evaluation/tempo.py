# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Slower and faster speech of the same pitch."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hri.core.errors import InvalidArgument
from hri.core.optional import import_optional
from hri.evaluation.conditions import Samples

_FRAME_S = 0.03
_MARGIN_S = 0.1


@dataclass(frozen=True)
class ChangeTempo:
    """A condition: the clip `factor` times as fast, by overlapping its waveform (WSOLA).

    Attributes
    ----------
    factor : float
        0.25..4; 2 halves the length.
    """

    factor: float

    def __post_init__(self) -> None:
        if not 0.25 <= self.factor <= 4:
            raise InvalidArgument(f"factor of tempo must lie in 0.25..4, got {self.factor}")

    def __call__(self, samples: Samples, sample_rate_hz: int, rng: np.random.Generator) -> Samples:
        """The clip at the new tempo, round(len(samples) / factor) samples.

        Raises
        ------
        ImportError
            Without audiotsm; says how to install it.
        """
        import_optional("audiotsm", "studies", "to change the tempo")
        from audiotsm import wsola
        from audiotsm.io.array import ArrayReader, ArrayWriter

        # The last frames are not given out: silence takes their place, and is cut.
        margin = np.zeros(round(_MARGIN_S * sample_rate_hz * max(1.0, self.factor)), np.float32)
        writer = ArrayWriter(1)
        frame = 2 * round(_FRAME_S * sample_rate_hz / 2)
        wsola(1, speed=self.factor, frame_length=frame).run(ArrayReader(np.append(samples, margin)[None]), writer)
        length = round(len(samples) / self.factor)
        changed = writer.data[0]
        return np.ascontiguousarray(np.pad(changed, (0, max(0, length - len(changed))))[:length], dtype=np.float32)
