# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What connected words are recognised as: words with their times, and other sentences that might have been said."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass, field
from typing import Any

from hri import _native

UNKNOWN = "<unk>"
"""The label of a word that is not in the vocabulary."""


@dataclass(frozen=True)
class TranscribedWord:
    """One word of a transcript.

    Attributes
    ----------
    label : str
    first_s, last_s : float
        Its beginning and end from the beginning of the recording: beside a pause where its sound begins and ends, as
        `find_speech` finds them; between words without a pause where the models meet.
    log_score : float
        What it adds to the transcript's.
    confidence : float or None
        0..1: how probable it is that this word was said here, by the other sentences that might have been; None where
        that is not known.
    unknown : bool
        Whether it is no word of the vocabulary (``label`` is then ``<unk>``), or its confidence is below
        ``min_confidence``.
    """

    label: str
    first_s: float
    last_s: float
    log_score: float
    confidence: float | None = None
    unknown: bool = False


@dataclass(frozen=True)
class Alternative:
    """Another sentence that might have been said.

    Attributes
    ----------
    words : tuple of TranscribedWord
        In the order of time, without confidence.
    log_score : float
        Natural log, of its best path.
    """

    words: tuple[TranscribedWord, ...]
    log_score: float

    @property
    def text(self) -> str:
        """The words, with spaces between."""
        return " ".join(word.label for word in self.words)


@dataclass(frozen=True)
class Transcript:
    """The words of a recording.

    Attributes
    ----------
    words : tuple of TranscribedWord
        In the order of time; empty without speech.
    log_score : float
        Natural log, of the best path; 0 without speech.
    complete : bool
        False where the recording was too short for so many words as were asked for, or no sentence of the grammar fits:
        the words are then those of the best beginning of a sentence. Of `align` also without speech.
    notes : tuple of str
        What was converted or assumed on the way.
    alternatives : tuple of Alternative
        As many as were asked for, the best first, which has the words above.
    slots : dict
        What the grammar's tags say of the sentence.
    """

    words: tuple[TranscribedWord, ...]
    log_score: float = 0.0
    complete: bool = True
    notes: tuple[str, ...] = ()
    alternatives: tuple[Alternative, ...] = ()
    slots: dict[str, str] = field(default_factory=dict)

    @property
    def labels(self) -> tuple[str, ...]:
        """The words alone, ``<unk>`` for those that are unknown."""
        return tuple(UNKNOWN if word.unknown else word.label for word in self.words)

    @property
    def text(self) -> str:
        """The words, with spaces between."""
        return " ".join(self.labels)

    def to_dict(self) -> dict[str, Any]:
        """As plain values that can be written as JSON."""
        return {"text": self.text, **asdict(self)}


def transcript_of(found: _native.Transcript, notes: Sequence[str] = ()) -> Transcript:
    """As Python has it; `notes` stand before its own."""
    return Transcript(
        tuple(_word_of(word) for word in found.words),
        found.log_score,
        found.complete,
        (*notes, *found.notes),
        tuple(Alternative(tuple(_word_of(word) for word in a.words), a.log_score) for a in found.alternatives),
        dict(found.slots),
    )


def _word_of(word: _native.TranscribedWord) -> TranscribedWord:
    return TranscribedWord(word.label, word.first_s, word.last_s, word.log_score, word.confidence, word.unknown)
