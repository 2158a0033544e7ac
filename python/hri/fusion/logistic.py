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
    """P(c) in proportion to exp(w x(c)), the same w for all classes.

    x(c) holds log P(c) in each mode, by itself and times the mode's reliability, against its best class: a product
    whose exponents are linear in the reliabilities.

    Parameters
    ----------
    weights : float64 array, shape (1, num_columns)
    """

    kind = "logistic"

    def __init__(self, weights: Rows) -> None:
        self.weights = weights

    @classmethod
    def fit(cls, rows: Rows, yes: Rows, num_classes: int, seed: int) -> LogisticStacking:
        """A regression of which of two classes is right, the right one against each other, on what parts their x.

        Nothing is random, `seed` is not used.
        """
        model = LogisticRegression().fit(*comparisons(rows, yes, num_classes))
        return cls(model.coef_)

    def scores(self, rows: Rows) -> Rows:
        """exp(w x) of every row."""
        return np.asarray(np.exp(np.clip(stacked(rows) @ self.weights[0], -300, 300)))

    def write(self, file: ModelFile, prefix: str) -> None:
        """Add it to a model file."""
        file.set_matrix_d(prefix + "weights", self.weights)

    @classmethod
    def read(cls, file: ModelFile, prefix: str, num_inputs: int) -> LogisticStacking:
        """The inverse of `write`. Raises FormatError where the sizes do not fit."""
        weights = np.asarray(file.matrix_d(prefix + "weights"))
        shape = (1, stacked(np.zeros((1, num_inputs))).shape[1])
        if weights.shape != shape:
            raise FormatError(f"{prefix}weights has shape {weights.shape}, must have {shape}")
        return cls(weights)


def stacked(rows: Rows) -> Rows:
    """x of every row, scaled as the margins are: log P of both modes, and the same times their reliabilities."""
    logs = np.minimum(rows[:, :2], 0.0)  # but for the best class, the margin is the distance to the best
    return np.column_stack([logs, logs * rows[:, 2:4]])


def comparisons(rows: Rows, yes: Rows, num_classes: int) -> tuple[Rows, NDArray[np.bool_]]:
    """x of the right class less x of each other class of its sample, "yes", and the negative of it, "no"."""
    columns = stacked(rows).reshape(-1, num_classes, 2 * 2)
    right = yes.reshape(-1, num_classes) > 0
    parts = (columns[right][:, None, :] - columns)[~right]
    return np.concatenate([parts, -parts]), np.repeat([True, False], len(parts))
