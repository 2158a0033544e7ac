# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Word errors of studies that leave one condition after the other out, and over all of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from hri.language import WordErrors, count_word_errors
from hri.studies.tables import Row, by_fold, statistics


@dataclass
class CountedWords:
    """Word error rates by condition, the errors of all together, and which boundaries are near the true ones."""

    errors: dict[str, float] = field(default_factory=dict)
    total: WordErrors = field(default_factory=WordErrors)
    near: list[bool] = field(default_factory=list)
    right: dict[str, float] = field(default_factory=dict)
    near_by_condition: dict[str, float] = field(default_factory=dict)

    def add(self, condition: str, truth: list[list[str]], found: list[list[str]], near: Sequence[bool] = ()) -> None:
        """Count the sentences of a condition."""
        errors = count_word_errors(truth, found)
        self.errors[condition] = errors.rate
        self.total += errors
        self.near += near
        self.right[condition] = _words_right(errors)
        if near:
            self.near_by_condition[condition] = float(np.mean(near))

    @property
    def words_right(self) -> float:
        """Share of the words of all conditions."""
        return _words_right(self.total)

    def row(self, **names: object) -> Row:
        """A row of a table, which begins with these columns."""
        over_all = {"word_error": self.total.rate, "words_right": self.words_right, **vars(self.total)}
        if self.near:
            over_all["boundaries_near"] = float(np.mean(self.near))
        row = {
            **names,
            **statistics(self.errors, "word_error"),
            "over_all": over_all,
            **by_fold("words_right", self.right),
        }
        return row | (by_fold("boundaries_near", self.near_by_condition) if self.near else {})


def _words_right(errors: WordErrors) -> float:
    return 1 - (errors.substitutions + errors.deletions) / errors.num_words
