# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What a page that comes needs to know of words, signs and sentences."""

from __future__ import annotations

from typing import Any

from hri.language import KnowledgeBase
from hri.recognition import CommandRecognizer, GestureRecognizer, SentenceRecognizer, WordRecognizer
from hri.session import SessionOptions

_MOST_STORED = 50
_LEARN_NOTHING = ("svm", "bayes")
"""Models of gestures that keep too little of what they were trained on."""


def known_by(
    words: WordRecognizer | CommandRecognizer | None, signs: GestureRecognizer | SentenceRecognizer | None
) -> dict[str, Any]:
    """Which modes there are, their labels, and of what commands are made."""
    commands = words if isinstance(words, CommandRecognizer) else None
    return {
        "speech": words is not None,
        "gesture": signs is not None,
        "words": [] if words is None else [str(label) for label in words.classes_],
        "signs": [] if signs is None else [str(label) for label in signs.classes_],
        "grammar": None if commands is None else commands.grammar.text,
        "made_of": [] if commands is None else [str(label) for label in commands.words.classes_],
    }


def learns_gestures(signs: GestureRecognizer | None) -> bool:
    """Whether gestures can be added to a recogniser."""
    return signs is not None and signs.options.model not in _LEARN_NOTHING


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
