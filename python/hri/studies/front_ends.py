# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Front ends that studies compare: options of the recogniser, and what is done to the sound before it."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from hri.evaluation.conditions import FrontEnd


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


HFCC_E = {"cepstra": {"filter_bank": "hfcc", "erb_factor": 2.0}}

FRONT_ENDS: dict[str, FrontEndChoice] = {
    "plain": FrontEndChoice(),
    "hfcc-e": FrontEndChoice(HFCC_E),
}
"""By name; "plain" is the recogniser with its defaults."""
