# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""ANFIS: a first-order Sugeno fuzzy system trained by least squares and gradient (Jang, IEEE SMC 23(3), 1993)."""

from __future__ import annotations

from itertools import product

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import FormatError
from hri.io import ModelFile

Rows = NDArray[np.float64]

_NUM_EPOCHS = 8
_RIDGE = 1e-3
_STEP = 0.02
"""Length of a step of all centres and widths together."""
_LEAST_WIDTH, _MOST_WIDTH = 0.05, 5.0


class Anfis:
    """Every input has two Gaussian sets, "low" and "high"; every combination of sets is a rule.

    A rule fires by the product of its memberships, and gives a linear function of the inputs; the output is the mean of
    the rules by how strongly they fire, cut to 0..1.

    Parameters
    ----------
    centres, widths : float64 arrays, shape (num_inputs, 2)
    consequents : float64 array, shape (2 ** num_inputs, num_inputs + 1)
        Of every rule, the last for the constant.
    """

    kind = "anfis"

    def __init__(self, centres: Rows, widths: Rows, consequents: Rows) -> None:
        self.centres, self.widths, self.consequents = centres, widths, consequents

    @classmethod
    def fit(cls, rows: Rows, yes: Rows, num_classes: int, seed: int) -> Anfis:
        """Jang's hybrid rule: in every epoch least squares for the consequents, a gradient step for the sets.

        Of all epochs the one with the least squared error is kept. Nothing is random, `seed` is not used; nor is
        `num_classes`, as every row counts by itself.
        """
        low, high = np.quantile(rows, (0.05, 0.95), axis=0)
        centres = np.stack([low, np.maximum(high, low + 0.1)], axis=1)
        widths = np.repeat(np.clip((centres[:, 1:] - centres[:, :1]) / 2, _LEAST_WIDTH, _MOST_WIDTH), 2, axis=1)
        model = cls(centres, widths, np.zeros((2 ** rows.shape[1], rows.shape[1] + 1)))
        best, least = model, np.inf
        for _ in range(_NUM_EPOCHS):
            model.consequents = model._least_squares(rows, yes)
            error = float(np.mean(np.square(model._output(rows) - yes)))
            if error < least:
                best, least = cls(model.centres, model.widths, model.consequents), error
            model.centres, model.widths = model._moved(rows, yes)
        return best

    def scores(self, rows: Rows) -> Rows:
        """P(yes) of every row."""
        return np.clip(self._output(rows), 0.0, 1.0)

    def _strengths(self, rows: Rows) -> Rows:
        """How strongly every rule fires, scaled to sum 1, shape (num_rows, num_rules)."""
        z = (rows[:, :, None] - self.centres) / self.widths
        logs = -0.5 * z * z
        total = sum(logs[:, i, :][:, _SETS[rows.shape[1]][:, i]] for i in range(rows.shape[1]))
        strengths = np.exp(total - np.max(total, axis=1, keepdims=True))
        return np.asarray(strengths / strengths.sum(axis=1, keepdims=True))

    def _output(self, rows: Rows) -> Rows:
        return np.asarray((self._strengths(rows) * (_with_constant(rows) @ self.consequents.T)).sum(axis=1))

    def _least_squares(self, rows: Rows, yes: Rows) -> Rows:
        strengths, inputs = self._strengths(rows), _with_constant(rows)
        columns = (strengths[:, :, None] * inputs[:, None, :]).reshape(len(rows), -1)
        normal = columns.T @ columns + _RIDGE * np.eye(columns.shape[1])
        return np.asarray(np.linalg.solve(normal, columns.T @ yes)).reshape(self.consequents.shape)

    def _moved(self, rows: Rows, yes: Rows) -> tuple[Rows, Rows]:
        """Centres and widths a step down the squared error."""
        strengths, outputs = self._strengths(rows), _with_constant(rows) @ self.consequents.T
        output = (strengths * outputs).sum(axis=1)
        # d output / d log strength of a rule, times the error.
        pull = strengths * (outputs - output[:, None]) * (output - yes)[:, None]
        by_centre, by_width = np.zeros_like(self.centres), np.zeros_like(self.widths)
        for i, sets in enumerate(_SETS[rows.shape[1]].T):
            for s in (0, 1):
                of_set = pull[:, sets == s].sum(axis=1)
                z = (rows[:, i] - self.centres[i, s]) / self.widths[i, s]
                by_centre[i, s] = np.mean(of_set * z / self.widths[i, s])
                by_width[i, s] = np.mean(of_set * z * z / self.widths[i, s])
        size = np.sqrt(np.sum(np.square(by_centre)) + np.sum(np.square(by_width)))
        step = _STEP / max(float(size), 1e-12)
        widths = np.clip(self.widths - step * by_width, _LEAST_WIDTH, _MOST_WIDTH)
        return self.centres - step * by_centre, widths

    def write(self, file: ModelFile, prefix: str) -> None:
        """Add it to a model file."""
        for name in ("centres", "widths", "consequents"):
            file.set_matrix_d(prefix + name, getattr(self, name))

    @classmethod
    def read(cls, file: ModelFile, prefix: str, num_inputs: int) -> Anfis:
        """The inverse of `write`. Raises FormatError that names the field."""
        shapes = {"centres": (num_inputs, 2), "widths": (num_inputs, 2), "consequents": (2**num_inputs, num_inputs + 1)}
        found = {}
        for name, shape in shapes.items():
            found[name] = np.asarray(file.matrix_d(prefix + name))
            if found[name].shape != shape:
                raise FormatError(f"{prefix}{name} has shape {found[name].shape}, must have {shape}")
        if not (found["widths"] >= _LEAST_WIDTH).all():
            raise FormatError(f"{prefix}widths must be {_LEAST_WIDTH} or more")
        return cls(**found)


_SETS = {n: np.array(list(product((0, 1), repeat=n))) for n in range(1, 7)}
"""Which set of every input each rule has."""


def _with_constant(rows: Rows) -> Rows:
    return np.column_stack([rows, np.ones(len(rows))])
