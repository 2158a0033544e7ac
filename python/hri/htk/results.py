# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Recognised words against what was said, as HResults counts and prints it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from hri.language.word_errors import AlignedWord, WordErrors, align_words

HTK_COSTS = (10, 7, 7)
"""Of a substitution, a deletion and an insertion; NIST's are 4, 3 and 3."""
WIDTH = 67


@dataclass
class Results:
    """Counts over sentences.

    Attributes
    ----------
    words : WordErrors
    num_sentences, num_correct : int
        Sentences, and those without an error.
    """

    words: WordErrors = field(default_factory=WordErrors)
    num_sentences: int = 0
    num_correct: int = 0

    def add(self, errors: WordErrors) -> None:
        """Count one sentence more."""
        self.words += errors
        self.num_sentences += 1
        self.num_correct += errors.total == 0

    @property
    def num_hits(self) -> int:
        """Words that were recognised."""
        return self.words.num_words - self.words.substitutions - self.words.deletions

    @property
    def correct(self) -> float:
        """(N - D - S) / N in percent; 0 of no words."""
        return _percent(self.num_hits, self.words.num_words)

    @property
    def accuracy(self) -> float:
        """(N - D - S - I) / N in percent; 0 of no words."""
        return _percent(self.num_hits - self.words.insertions, self.words.num_words)

    def lines(self) -> list[str]:
        """The lines of sentences and words."""
        w = self.words
        wrong = self.num_sentences - self.num_correct
        return [
            f"SENT: %Correct={_percent(self.num_correct, self.num_sentences):.2f} "
            f"[H={self.num_correct}, S={wrong}, N={self.num_sentences}]",
            f"WORD: %Corr={self.correct:.2f}, Acc={self.accuracy:.2f} [H={self.num_hits}, D={w.deletions}, "
            f"S={w.substitutions}, I={w.insertions}, N={w.num_words}]",
        ]

    def file_line(self, name: str) -> str:
        """What is printed for one file."""
        w = self.words
        return (
            f"{name}: {self.correct:7.2f}({self.accuracy:7.2f})  [H={self.num_hits:4d}, D={w.deletions:3d}, "
            f"S={w.substitutions:3d}, I={w.insertions:3d}, N={w.num_words:3d}]"
        )


def compare(
    reference: Sequence[str], found: Sequence[str], costs: tuple[int, int, int] = HTK_COSTS
) -> tuple[WordErrors, list[AlignedWord]]:
    """The errors of one sentence, and how its words were aligned at these costs."""
    pairs = align_words(reference, found, costs)
    return WordErrors.of(pairs), pairs


def aligned_lines(pairs: Sequence[AlignedWord]) -> list[str]:
    """The two sentences one below the other."""
    cells = [(p.reference or "", p.hypothesis or "") for p in pairs]
    widths = [max(len(a), len(b)) for a, b in cells]
    return [
        f" {mark}: " + " ".join(cell[row].ljust(width) for cell, width in zip(cells, widths, strict=True)).rstrip()
        for row, mark in enumerate(("LAB", "REC"))
    ]


def _percent(part: int, whole: int) -> float:
    return 100 * part / whole if whole else 0.0
