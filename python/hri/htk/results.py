# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Recognised words against what was said, as HResults counts and prints it."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
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

    def lines(self, word_name: str = "WORD", sentence_name: str = "SENT") -> list[str]:
        """The lines of sentences and words, and what these are called."""
        w = self.words
        wrong = self.num_sentences - self.num_correct
        return [
            f"{sentence_name}: %Correct={_percent(self.num_correct, self.num_sentences):.2f} "
            f"[H={self.num_correct}, S={wrong}, N={self.num_sentences}]",
            f"{word_name}: %Corr={self.correct:.2f}, Acc={self.accuracy:.2f} [H={self.num_hits}, D={w.deletions}, "
            f"S={w.substitutions}, I={w.insertions}, N={w.num_words}]",
        ]

    def file_line(self, name: str) -> str:
        """What is printed of one file."""
        w = self.words
        return (
            f"{name}: {self.correct:7.2f}({self.accuracy:7.2f})  [H={self.num_hits:4d}, D={w.deletions:3d}, "
            f"S={w.substitutions:3d}, I={w.insertions:3d}, N={w.num_words:3d}]"
        )

    def speaker_line(self, name: str) -> str:
        """What is printed of one speaker: words, then sentences."""
        right = _percent(self.num_correct, self.num_sentences)
        return f"{self.file_line(name)} {right:6.2f} [N={self.num_sentences:3d}]"


def compare(
    reference: Sequence[str], found: Sequence[str], costs: tuple[int, int, int] = HTK_COSTS
) -> tuple[WordErrors, list[AlignedWord]]:
    """The errors of one sentence, and how its words were aligned at these costs."""
    pairs = align_words(reference, found, costs)
    return WordErrors.of(pairs), pairs


def bar(title: str, mark: str = "-") -> str:
    """A line with a title in it, as wide as HResults has them."""
    return f"{mark * ((WIDTH - len(title) - 3) // 2)} {title} ".ljust(WIDTH, mark)


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


class Confusions:
    """Labels that were said, and what was found in their place.

    Attributes
    ----------
    counts : dict
        By pairs of what was said and what was recognised; None: nothing, of an insertion or a deletion.
    """

    def __init__(self) -> None:
        self.counts: dict[tuple[str | None, str | None], int] = {}

    def add(self, pairs: Sequence[AlignedWord]) -> None:
        """Count the words of an aligned sentence."""
        for pair in pairs:
            key = (pair.reference, pair.hypothesis)
            self.counts[key] = self.counts.get(key, 0) + 1

    def lines(self) -> list[str]:
        """A row for every label said, a column for every one recognised, deletions, share correct, insertions below."""
        said = sorted({r for r, _ in self.counts if r is not None} | {h for _, h in self.counts if h is not None})
        width = max([5, *map(len, said)]) + 1
        lines = [" " * width + "".join(f"{name:>{width}}" for name in [*said, "Del", "%c"])]
        for name in said:
            row = [self.counts.get((name, other), 0) for other in said]
            deleted = self.counts.get((name, None), 0)
            share = _percent(self.counts.get((name, name), 0), sum(row))
            cells = "".join(f"{count:>{width}}" for count in [*row, deleted])
            lines.append(f"{name:<{width}}{cells}{share:>{width}.1f}")
        inserted = "".join(f"{self.counts.get((None, name), 0):>{width}}" for name in said)
        return [*lines, f"{'Ins':<{width}}{inserted}"]


def speaker_of(mask: str, name: str) -> str | None:
    """What the % of a mask stand for in a name: *_%%%.rec has three characters before .rec; None of another name."""
    parts = {"*": ".*", "?": ".", "%": "(.)"}
    pattern = "".join(parts.get(character, re.escape(character)) for character in mask)
    match = re.fullmatch(pattern, name)
    return None if match is None else "".join(match.groups())


def nist_table(of_speakers: Mapping[str, Results], total: Results) -> list[str]:
    """Percent of words correct, substituted, deleted and inserted, of all errors, and of sentences with one."""
    border = "," + "-" * 61 + "."
    rule = "|" + "-" * 61 + "|"
    lines = [
        border,
        f"|{'HTK Results Analysis':^61}|",
        rule,
        "| SPKR    | # Snt |  Corr    Sub    Del    Ins    Err  S. Err   |".ljust(62) + "|",
        rule,
    ]
    rows = [*of_speakers.items(), ("Sum/Avg", total)]
    for number, (name, one) in enumerate(rows):
        if number and number == len(rows) - 1:
            lines.append(rule)
        w = one.words
        shares = [one.num_hits, w.substitutions, w.deletions, w.insertions, w.total]
        cells = "".join(f"{_percent(count, w.num_words):7.2f}" for count in shares)
        wrong = _percent(one.num_sentences - one.num_correct, one.num_sentences)
        lines.append(f"| {name:<8}| {one.num_sentences:5d} |{cells}{wrong:7.2f}".ljust(62) + "|")
    return [*lines, "`" + "-" * 61 + "'"]
