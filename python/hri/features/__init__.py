# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Features of speech and of hands."""

from hri.features.hand import HAND_KINDS, hand_column_names, hand_features
from hri.features.speech import KINDS, PRESETS, cepstra, cepstra_options, column_names

__all__ = [
    "HAND_KINDS",
    "KINDS",
    "PRESETS",
    "cepstra",
    "cepstra_options",
    "column_names",
    "hand_column_names",
    "hand_features",
]
