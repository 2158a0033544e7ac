# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Commands of several words with slots: the sentences of a grammar, decided on like words."""

from __future__ import annotations

import copy
from collections.abc import Collection, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri import _native
from hri.core.errors import FormatError, InvalidArgument
from hri.core.suggest import did_you_mean
from hri.language import Grammar
from hri.recognition.decision import NO_INPUT, RECOGNISED, UNKNOWN, Decision, NBest
from hri.recognition.inputs import AudioInput
from hri.recognition.sentence.recognizer import ConnectedWordRecognizer
from hri.recognition.sentence.transcript import Alternative

MOST_SENTENCES = 10_000
NUM_ALTERNATIVES = 20
MIN_CONFIDENCE = 0.9
_MOST_NAMED = 5
_SURE = 0.5


class CommandRecognizer:
    """Decide which command of a grammar was said; the decision carries its slots.

    Sentences with the same slots are one command: its label is the sentence of them that stands first in the grammar.
    A sentence without slots, such as "stop", is a command by itself.

    Parameters
    ----------
    words : ConnectedWordRecognizer
        Trained or loaded; it is not changed. With ``unknown_words`` what is no command may be rejected; without, the
        nearest command is taken.
    grammar : Grammar
        Its words are labels of `words`; it repeats nothing, so that its sentences can be listed.
    min_confidence : float
        From 0 to 1. What is less sure is unknown: words outside the vocabulary fit several commands alike, those of a
        command fit it alone.

    Attributes
    ----------
    classes_ : ndarray of str
        The labels of all commands, sorted.
    commands_ : dict of str to dict of str to str
        The slots of each.

    Raises
    ------
    InvalidArgument
        For words that are no labels, for repetitions, for more than 10 000 sentences, and a `min_confidence` outside
        0..1.
    NotFittedError
        For words that are not trained.
    """

    mode = "speech"

    def __init__(
        self, words: ConnectedWordRecognizer, grammar: Grammar, *, min_confidence: float = MIN_CONFIDENCE
    ) -> None:
        if not 0.0 <= min_confidence <= 1.0:
            raise InvalidArgument(f"min_confidence must lie in 0..1, got {min_confidence}")
        self.min_confidence = min_confidence
        _require_known(grammar.words, [str(label) for label in words.classes_])
        self._grammar = grammar
        self._words = copy.copy(words).set_grammar(grammar)
        self._any_words = copy.copy(words).set_grammar(_any_of([str(label) for label in words.classes_]))
        self.commands_: dict[str, dict[str, str]] = {}
        self._label_of: dict[tuple[str, ...], str] = {}
        by_slots: dict[tuple[tuple[str, str], ...], str] = {}
        for sentence in grammar.sentences(MOST_SENTENCES):
            text = " ".join(sentence)
            slots = grammar.slots_of(sentence) or {}
            label = by_slots.setdefault(tuple(sorted(slots.items())), text) if slots else text
            self.commands_.setdefault(label, dict(slots))
            self._label_of[tuple(sentence)] = label
        self.classes_: NDArray[np.str_] = np.array(sorted(self.commands_))

    def __getstate__(self) -> dict[str, Any]:
        return {"words": self._words, "grammar": self._grammar.text, "min_confidence": self.min_confidence}

    def __setstate__(self, state: dict[str, Any]) -> None:
        name = type(self).__name__
        if not isinstance(state, dict) or state.keys() != {"words", "grammar", "min_confidence"}:
            raise FormatError(f"the state of {name} must have words, grammar and min_confidence")
        words, grammar, least = state["words"], state["grammar"], state["min_confidence"]
        if not (
            isinstance(words, ConnectedWordRecognizer) and isinstance(grammar, str) and isinstance(least, int | float)
        ):
            raise FormatError(f"the state of {name} must have a ConnectedWordRecognizer, a text and a number")
        parsed = Grammar.parse(grammar, f"the grammar of {name}")
        self.__init__(words, parsed, min_confidence=least)  # type: ignore[misc]

    @property
    def words(self) -> ConnectedWordRecognizer:
        """What recognises the words, by the grammar."""
        return self._words

    @property
    def grammar(self) -> Grammar:
        """Whose sentences are the commands."""
        return self._grammar

    @property
    def endpointer(self) -> _native.EndpointerOptions:
        """When a command has ended: pauses between its words do not end it."""
        fields = _native.ConnectedWordStreamOptions().endpointer.as_dict()
        return _native.EndpointerOptions(**{**fields, "activity": self._words.options.words.activity})

    def recognise(self, audio: AudioInput, sample_rate_hz: int | None = None) -> Decision:
        """Decide on one utterance.

        Parameters
        ----------
        audio : path, Audio, or array of shape (num_samples,)
        sample_rate_hz : int, optional
            Of an array.

        Returns
        -------
        Decision
            ``nbest`` are the commands among the `NUM_ALTERNATIVES` best sentences; their probabilities are shares of
            exp(``confidence_scale`` x log score) among these, added up over sentences of the same command, and
            ``confidence`` is that of the best. "unknown" where that is below `min_confidence`, where a word was none of
            the vocabulary, or what was said is too short for any sentence.

        Raises
        ------
        InvalidArgument, FormatError, IoError
            As of `ConnectedWordRecognizer.recognise`.
        """
        found = self._words.recognise(audio, sample_rate_hz, num_alternatives=NUM_ALTERNATIVES)
        if not found.words:
            return Decision(self.mode, NO_INPUT, NO_INPUT, 0.0, notes=found.notes)
        nbest = self._nbest(found.alternatives or (Alternative(found.words, found.log_score),))
        # Words below `min_confidence` count as unknown, too.
        label = UNKNOWN if not found.complete else self._label_of.get(found.labels, UNKNOWN)
        confidence = next((entry.probability for entry in nbest if entry.label == label), 0.0)
        if label == UNKNOWN or confidence < self.min_confidence:
            return Decision(self.mode, UNKNOWN, UNKNOWN, 0.0, found.log_score, nbest, found.notes)
        slots = self.commands_[label]
        return Decision(
            self.mode, label, RECOGNISED, confidence, found.log_score, nbest, found.notes, slots=dict(slots)
        )

    def recognise_early(
        self, audio: AudioInput, labels: Collection[str], sample_rate_hz: int | None = None
    ) -> Decision | None:
        """Decide before a command has ended, where what has been said of it is one of some labels.

        The words are found in any order, not by the grammar, so that the beginning of another command is not
        misrecognised as one of these.

        Parameters
        ----------
        audio : path, Audio, or array of shape (num_samples,)
            What has been said so far.
        labels : collection of str
        sample_rate_hz : int, optional
            Of an array.

        Returns
        -------
        Decision or None
            Its ``confidence`` is that of its least sure word, at least one half; None for anything else.

        Raises
        ------
        InvalidArgument, FormatError, IoError
            As of `recognise`.
        """
        found = self._any_words.recognise(audio, sample_rate_hz)
        label = self._label_of.get(found.labels, UNKNOWN)
        confidence = min((word.confidence or 0.0 for word in found.words), default=0.0)
        if label not in labels or not found.complete or confidence < _SURE:
            return None
        nbest = (NBest(label, confidence, found.log_score),)
        slots = dict(self.commands_[label])
        return Decision(self.mode, label, RECOGNISED, confidence, found.log_score, nbest, found.notes, slots=slots)

    def _nbest(self, alternatives: tuple[Alternative, ...]) -> tuple[NBest, ...]:
        """Commands in falling order; sentences that are none have a share and no place."""
        log_scores = np.array([alternative.log_score for alternative in alternatives])
        scale = self._words._trained.options.confidence_scale  # chosen in training, unlike that of the options given
        weights = np.exp(scale * (log_scores - log_scores.max()))
        shares: dict[str, float] = {}
        best: dict[str, float] = {}
        for alternative, weight, log_score in zip(alternatives, weights / weights.sum(), log_scores, strict=True):
            label = self._label_of.get(tuple(word.label for word in alternative.words))
            if label is not None:
                shares[label] = shares.get(label, 0.0) + float(weight)
                best[label] = max(best.get(label, -np.inf), float(log_score))
        order = sorted(shares, key=lambda label: (-shares[label], label))
        return tuple(NBest(label, shares[label], best[label]) for label in order)


def _any_of(labels: Sequence[str]) -> Grammar:
    """Any number of these words in any order."""
    quoted = (label.replace("\\", "\\\\").replace('"', '\\"') for label in labels if not any(map(str.isspace, label)))
    words = " | ".join(f'"{label}"' for label in quoted)
    return Grammar.parse(f"#JSGF V1.0;\ngrammar any;\npublic <any> = ( {words} )+;\n", "any")


def _require_known(words: Sequence[str], labels: Sequence[str]) -> None:
    unknown = [word for word in words if word not in labels]
    if unknown:
        few = ", ".join(unknown[:_MOST_NAMED]) + (", ..." if len(unknown) > _MOST_NAMED else "")
        known = did_you_mean(unknown[0], labels, "it knows")
        raise InvalidArgument(f"the grammar has words that the model was not trained on: {few}; {known}")
