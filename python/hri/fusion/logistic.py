# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Logistic stacking (Wolpert, Neural Networks 5(2), 1992), by the C++ library's logistic regression."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import FormatError
from hri.io import ModelFile
from hri.models import LogisticRegression

Rows = NDArray[np.float64]


class LogisticStacking:
    """P(yes) = sigmoid(w x + b) with the margins of both modes, by themselves and times the reliabilities, in x.

    Parameters
    ----------
    weights : float64 array, shape (1, num_columns + 1)
        w and b, in the units of the columns.
    """

    kind = "logistic"

    def __init__(self, weights: Rows) -> None:
        self.weights = weights

    @classmethod
    def fit(cls, rows: Rows, yes: Rows, seed: int) -> LogisticStacking:
        """Newton's method on the penalised log-likelihood; nothing is random, `seed` is not used."""
        model = LogisticRegression().fit(stacked(rows), yes > 0)
        return cls(np.concatenate([model.coef_[0], model.intercept_])[None, :])

    def scores(self, rows: Rows) -> Rows:
        """P(yes) of every row."""
        log_odds = stacked(rows) @ self.weights[0, :-1] + self.weights[0, -1]
        return np.asarray(1 / (1 + np.exp(-np.clip(log_odds, -30, 30))))

    def write(self, file: ModelFile, prefix: str) -> None:
        """Add it to a model file."""
        file.set_matrix_d(prefix + "weights", self.weights)

    @classmethod
    def read(cls, file: ModelFile, prefix: str, num_inputs: int) -> LogisticStacking:
        """The inverse of `write`. Raises FormatError where the sizes do not fit."""
        weights = np.asarray(file.matrix_d(prefix + "weights"))
        shape = (1, stacked(np.zeros((1, num_inputs))).shape[1] + 1)
        if weights.shape != shape:
            raise FormatError(f"{prefix}weights has shape {weights.shape}, must have {shape}")
        return cls(weights)


def stacked(rows: Rows) -> Rows:
    """Margins of both modes (columns 0 and 1), the same times their reliabilities (columns 2 and 3)."""
    return np.column_stack([rows[:, :2], rows[:, :2] * rows[:, 2:4]])
