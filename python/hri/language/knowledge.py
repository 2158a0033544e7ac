# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""A knowledge base of sentences: the stored one that is nearest to the words that were recognised (thesis 5.1.6)."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from os import PathLike, fspath

from hri.core.errors import FormatError, InvalidArgument
from hri.core.files import read_csv
from hri.core.text import is_printable
from hri.language.word_errors import NIST_COSTS, align_words

SIGNS_COLUMN = "signs"
ANSWER_COLUMN = "answer"
MAX_DISTANCE = 0.5


@dataclass(frozen=True)
class StoredSentence:
    """A sentence that is known.

    Attributes
    ----------
    words : tuple of str
        As a recogniser names them.
    texts : mapping of str to str
        What it says, by language code, such as "en" and "hi".
    answer : tuple of str
        Gestures that a robot answers with, one after the other.
    """

    words: tuple[str, ...]
    texts: Mapping[str, str] = field(default_factory=dict)
    answer: tuple[str, ...] = ()

    def text(self, language: str = "en") -> str:
        """What it says in a language, else its words."""
        return self.texts.get(language) or " ".join(self.words)


@dataclass(frozen=True)
class StoredMatch:
    """The stored sentence nearest to some words, and how far it is from them, 0 (the same) to 1 (no word in common)."""

    sentence: StoredSentence
    distance: float


class KnowledgeBase:
    """Stored sentences, and which of them some words mean.

    Parameters
    ----------
    sentences : sequence of StoredSentence
    max_distance : float
        Words farther from every stored sentence are none of them, 0..1. `choose_max_distance` finds a value on
        recognised sentences.
    costs : tuple of int
        Of a substituted, a deleted and an inserted word.

    Raises
    ------
    InvalidArgument
        For no sentences, one without words or stored twice, and values out of range.
    """

    def __init__(
        self,
        sentences: Sequence[StoredSentence],
        max_distance: float = MAX_DISTANCE,
        costs: tuple[int, int, int] = NIST_COSTS,
    ) -> None:
        if not sentences:
            raise InvalidArgument("sentences: there is none")
        if not 0 <= max_distance <= 1:
            raise InvalidArgument(f"max_distance is {max_distance}, must lie in 0..1")
        if len(costs) != 3 or min(costs) < 1 or max(costs[1:]) > costs[0]:
            raise InvalidArgument(f"costs are {costs}, must be three numbers from 1 on, the first the largest")
        if any(not s.words for s in sentences):
            raise InvalidArgument("sentences: each needs words")
        distinct = {s.words for s in sentences}
        if len(distinct) < len(sentences):
            raise InvalidArgument("sentences: one is stored twice")
        self.sentences = tuple(sentences)
        self.max_distance = float(max_distance)
        self.costs = costs

    @classmethod
    def read(cls, path: str | PathLike[str], max_distance: float = MAX_DISTANCE) -> KnowledgeBase:
        """From a CSV file with the column ``signs``, words with blanks between, and a column for each language.

        A column ``answer`` may name gestures, with blanks between, that a robot answers with.

        Raises
        ------
        FormatError
            Names the file and the row: other columns or cells than these, no words, a sentence that stands twice.
        IoError
            When the file cannot be read.
        """
        rows = read_csv(path)
        name = fspath(path)
        header = rows[0] if rows else []
        if SIGNS_COLUMN not in header or len(set(header)) < len(header) or "" in header:
            raise FormatError(f"{name}: row 1: the columns must be '{SIGNS_COLUMN}' and codes of languages")
        sentences: list[StoredSentence] = []
        seen: set[tuple[str, ...]] = set()
        for number, row in enumerate(rows[1:], 2):
            cells = dict(zip(header, row, strict=False))
            words = tuple(cells.get(SIGNS_COLUMN, "").split())
            if not all(is_printable(cell) for cell in row):
                raise FormatError(f"{name}: row {number}: control characters in a cell")
            if len(row) != len(header) or not words:
                raise FormatError(f"{name}: row {number}: must have {len(header)} cells, and words in '{SIGNS_COLUMN}'")
            if words in seen:
                raise FormatError(f"{name}: row {number}: '{' '.join(words)}' stands in an earlier row too")
            seen.add(words)
            languages = (name for name in header if name not in (SIGNS_COLUMN, ANSWER_COLUMN))
            texts = {language: cells[language] for language in languages if cells[language]}
            sentences.append(StoredSentence(words, texts, tuple(cells.get(ANSWER_COLUMN, "").split())))
        if not sentences:
            raise FormatError(f"{name}: no rows")
        return cls(sentences, max_distance)

    def nearest(self, words: Sequence[str], alternatives: Sequence[Sequence[str]] = ()) -> StoredMatch:
        """The nearest stored sentence by weighted edit distance, however far; of several the first.

        Parameters
        ----------
        words : sequence of str
            As recognised.
        alternatives : sequence of sequences of str
            Other sentences that were recognised, the best first, as from `SentenceRecognizer.recognise_n_best`: a
            stored sentence is as far as it is from the nearest of all. Where several stored ones are as near, that of
            the better alternative counts.

        Raises
        ------
        InvalidArgument
            For a text in place of words.
        """
        tried = [words, *alternatives]
        if any(isinstance(one, str) for one in tried):
            raise InvalidArgument("a sentence is a sequence of words: split it")
        matches = [StoredMatch(stored, self._distance(stored.words, one)) for one in tried for stored in self.sentences]
        return min(matches, key=lambda match: match.distance)

    def unknown_words(self, labels: Iterable[str]) -> dict[str, str | None]:
        """Words of the stored sentences that are none of `labels`, each with the label that differs in case alone."""
        known = set(labels)
        by_case = {label.casefold(): label for label in sorted(known)}
        words = dict.fromkeys(word for stored in self.sentences for word in stored.words)
        return {word: by_case.get(word.casefold()) for word in words if word not in known}

    def match(self, words: Sequence[str], alternatives: Sequence[Sequence[str]] = ()) -> StoredMatch | None:
        """The nearest stored sentence within ``max_distance``; None: it is none of them."""
        found = self.nearest(words, alternatives)
        return found if found.distance <= self.max_distance else None

    def _distance(self, stored: Sequence[str], words: Sequence[str]) -> float:
        substitution, deletion, insertion = self.costs
        cost = 0
        for pair in align_words(stored, words, self.costs):
            if pair.hypothesis is None:
                cost += deletion
            elif pair.reference is None:
                cost += insertion
            elif pair.reference != pair.hypothesis:
                cost += substitution
        # Of sentences without a common word: a pair for each word of the shorter one, and the rest of the longer one.
        pairs, rest = min(len(stored), len(words)), abs(len(stored) - len(words))
        more = deletion if len(stored) > len(words) else insertion
        return cost / (min(substitution, deletion + insertion) * pairs + more * rest)


def choose_max_distance(right: Sequence[float], wrong: Sequence[float]) -> float:
    """The distance that divides matches best: most of `right` at or below it and most of `wrong` above it.

    Parameters
    ----------
    right, wrong : sequence of float
        Distances of recognised sentences whose nearest stored sentence was theirs, and of those where it was not,
        because another was nearer or theirs was not stored. Each kind weighs as much as the other.

    Raises
    ------
    InvalidArgument
        Without any distance.
    """
    if not right and not wrong:
        raise InvalidArgument("right and wrong: there is no distance to choose from")

    def share(of: Sequence[float], limit: float) -> float:
        return sum(value <= limit for value in of) / len(of) if of else 0.0

    tried = sorted({0.0, *right, *wrong})
    return max(tried, key=lambda limit: share(right, limit) - share(wrong, limit))
