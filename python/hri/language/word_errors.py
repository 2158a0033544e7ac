# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Word errors: substitutions, deletions and insertions by alignment, as NIST's sclite counts them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from hri.core.errors import InvalidArgument

NIST_COSTS = (4, 3, 3)
"""Of a substitution, a deletion and an insertion, by which sclite aligns."""


@dataclass(frozen=True)
class AlignedWord:
    """A word of the reference beside one of the hypothesis; None where there is none."""

    reference: str | None
    hypothesis: str | None


@dataclass(frozen=True)
class WordErrors:
    """Counts over one sentence or many.

    Attributes
    ----------
    num_words : int
        Of the references.
    substitutions, deletions, insertions : int
    """

    num_words: int = 0
    substitutions: int = 0
    deletions: int = 0
    insertions: int = 0

    @property
    def total(self) -> int:
        """All errors."""
        return self.substitutions + self.deletions + self.insertions

    @property
    def rate(self) -> float:
        """Word error rate, (S + D + I) / N: above 1 where more was inserted than said.

        Raises
        ------
        InvalidArgument
            Where the references have no word.
        """
        if self.num_words == 0:
            raise InvalidArgument("a word error rate needs a reference with a word")
        return self.total / self.num_words

    @classmethod
    def of(cls, pairs: Sequence[AlignedWord]) -> WordErrors:
        """The errors of one aligned sentence."""
        return cls(
            sum(p.reference is not None for p in pairs),
            sum(None not in (p.reference, p.hypothesis) and p.reference != p.hypothesis for p in pairs),
            sum(p.hypothesis is None for p in pairs),
            sum(p.reference is None for p in pairs),
        )

    def __add__(self, other: WordErrors) -> WordErrors:
        return WordErrors(
            self.num_words + other.num_words,
            self.substitutions + other.substitutions,
            self.deletions + other.deletions,
            self.insertions + other.insertions,
        )


def align_words(
    reference: Sequence[str], hypothesis: Sequence[str], costs: tuple[int, int, int] = NIST_COSTS
) -> list[AlignedWord]:
    """Align two sentences at the least cost of substitutions, deletions and insertions, by default as sclite does.

    Of alignments that cost the same, as sclite: one with a word on both sides as late as possible, then with an
    insertion.
    """
    substitution, deletion, insertion = costs
    rows = [[j * insertion for j in range(len(hypothesis) + 1)]]
    for i, said in enumerate(reference, 1):
        row = [i * deletion]
        for j, found in enumerate(hypothesis, 1):
            both = rows[i - 1][j - 1] + (0 if said == found else substitution)
            row.append(min(both, rows[i - 1][j] + deletion, row[j - 1] + insertion))
        rows.append(row)
    aligned = []
    i, j = len(reference), len(hypothesis)
    while i or j:
        cost = rows[i][j]
        if i and j and cost == rows[i - 1][j - 1] + (0 if reference[i - 1] == hypothesis[j - 1] else substitution):
            i, j = i - 1, j - 1
            aligned.append(AlignedWord(reference[i], hypothesis[j]))
        elif j and cost == rows[i][j - 1] + insertion:
            j -= 1
            aligned.append(AlignedWord(None, hypothesis[j]))
        else:
            i -= 1
            aligned.append(AlignedWord(reference[i], None))
    return aligned[::-1]


def count_word_errors(references: Sequence[Sequence[str]], hypotheses: Sequence[Sequence[str]]) -> WordErrors:
    """The errors of all sentences together.

    Raises
    ------
    InvalidArgument
        For another number of hypotheses than of references, and for a sentence that is one string, not words.
    """
    if len(references) != len(hypotheses):
        raise InvalidArgument(f"there are {len(references)} references and {len(hypotheses)} hypotheses")
    errors = WordErrors()
    for reference, hypothesis in zip(references, hypotheses, strict=True):
        if isinstance(reference, str) or isinstance(hypothesis, str):
            raise InvalidArgument("a sentence is a sequence of words: split it")
        errors += WordErrors.of(align_words(reference, hypothesis))
    return errors
