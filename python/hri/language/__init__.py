# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Language: pronunciations, n-gram models and networks of words, the decoder of connected words, word errors.

The decoder knows models by their chains and by the log scores of their states; `hri.ConnectedWordRecognizer` puts it
behind a front end.
"""

from hri._native import (
    ConfusionSlot,
    ConnectedDecoder,
    ConnectedDecoderOptions,
    DecodedSentence,
    DecodedWord,
    GaussianEmissions,
    Grammar,
    Lattice,
    LatticeOptions,
    NGramFit,
    NGramModel,
    NGramOptions,
    PossibilisticEmissions,
    WordChain,
    WordNetwork,
)
from hri.language.knowledge import KnowledgeBase, StoredMatch, StoredSentence, choose_max_distance
from hri.language.pronunciation import closest_phone, pronounce, split_phones
from hri.language.word_errors import AlignedWord, WordErrors, align_words, count_word_errors

__all__ = [
    "AlignedWord",
    "ConfusionSlot",
    "ConnectedDecoder",
    "ConnectedDecoderOptions",
    "DecodedSentence",
    "DecodedWord",
    "GaussianEmissions",
    "Grammar",
    "KnowledgeBase",
    "Lattice",
    "LatticeOptions",
    "NGramFit",
    "NGramModel",
    "NGramOptions",
    "PossibilisticEmissions",
    "StoredMatch",
    "StoredSentence",
    "WordChain",
    "WordErrors",
    "WordNetwork",
    "align_words",
    "choose_max_distance",
    "closest_phone",
    "count_word_errors",
    "pronounce",
    "split_phones",
]
