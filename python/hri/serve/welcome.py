# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What a page that comes needs to know of sentences."""

from __future__ import annotations

from typing import Any

from hri.language import KnowledgeBase
from hri.recognition import SentenceRecognizer
from hri.session import SessionOptions

_MOST_STORED = 50


def sentences_of(options: SessionOptions, signs: Any, knowledge: KnowledgeBase | None) -> dict[str, Any] | None:
    """What begins and ends a sentence, and which are stored; None where there are no sentences."""
    if not options.sentence_labels and not isinstance(signs, SentenceRecognizer):
        return None
    stored = () if knowledge is None else knowledge.sentences
    return {
        "begin": list(options.sentence_begin_labels),
        "end": list(options.sentence_end_labels),
        "stored": [" ".join(sentence.words) for sentence in stored[:_MOST_STORED]],
        "more": max(0, len(stored) - _MOST_STORED),
    }
