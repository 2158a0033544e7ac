# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Front ends that studies compare: options of the recogniser, and what is done to the sound before it."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from hri.evaluation.conditions import FrontEnd, Samples
from hri.signal import denoise


@dataclass(frozen=True)
class FrontEndChoice:
    """A variant of the recogniser as it is.

    Attributes
    ----------
    options : dict
        Of `WordRecognizer`, where they differ from the defaults.
    prepare : FrontEnd, optional
        Done to every clip of training and test.
    """

    options: dict[str, Any] = field(default_factory=dict)
    prepare: FrontEnd | None = None


def shrinkage(samples: Samples, sample_rate_hz: int) -> tuple[Samples, int]:
    """Less noise by shrinking wavelet details, with the library's defaults."""
    return np.asarray(denoise(samples)), sample_rate_hz


HFCC_E = {"cepstra": {"filter_bank": "hfcc", "erb_factor": 2.0}}

PLAIN = "plain"
FRONT_ENDS: dict[str, FrontEndChoice] = {
    PLAIN: FrontEndChoice(),
    "hfcc-e": FrontEndChoice(HFCC_E),
    "shrinkage": FrontEndChoice(prepare=shrinkage),
    "hfcc-e and shrinkage": FrontEndChoice(HFCC_E, shrinkage),
}
"""By name; "plain" is the recogniser with its defaults."""

EMBEDDING = "both"
CHOICES = {**FRONT_ENDS, EMBEDDING: FrontEndChoice({"front_end": "both"})}
"""With cepstra and a pretrained speech embedding, which is an extra."""
