# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""A network of one hidden layer."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import FormatError
from hri.io import ModelFile

Rows = NDArray[np.float64]

_NUM_HIDDEN = 8
_MAX_HIDDEN = 1024
_NUM_STEPS = 300
_RATE = 0.05
_DECAY = 1e-4


class Network:
    """P(c) in proportion to exp(v tanh(W x(c) + b)), the same for all classes.

    Parameters
    ----------
    hidden : float64 array, shape (num_hidden, num_inputs + 1)
        W and b.
    output : float64 array, shape (1, num_hidden)
        v.
    """

    kind = "network"

    def __init__(self, hidden: Rows, output: Rows) -> None:
        self.hidden, self.output = hidden, output

    @classmethod
    def fit(cls, rows: Rows, yes: Rows, num_classes: int, seed: int) -> Network:
        """Cross-entropy over the classes of each sample, and weight decay, by Adam (Kingma and Ba, 2015).

        All rows are used at once; `seed` gives the first weights.
        """
        rng = np.random.default_rng(seed)
        hidden = rng.normal(0, 1 / np.sqrt(rows.shape[1]), (_NUM_HIDDEN, rows.shape[1] + 1))
        output = rng.normal(0, 1 / np.sqrt(_NUM_HIDDEN), (1, _NUM_HIDDEN))
        model = cls(hidden, output)
        inputs = _with_constant(rows)
        moments = [(np.zeros_like(w), np.zeros_like(w)) for w in (hidden, output)]
        for step in range(1, _NUM_STEPS + 1):
            for weights, slope, (mean, square) in zip(
                (model.hidden, model.output), model._gradient(inputs, yes, num_classes), moments, strict=True
            ):
                mean += 0.1 * (slope - mean)
                square += 0.001 * (slope * slope - square)
                scaled = mean / (1 - 0.9**step) / (np.sqrt(square / (1 - 0.999**step)) + 1e-8)
                weights -= _RATE * (1 - step / (_NUM_STEPS + 1)) * scaled
        return model

    def scores(self, rows: Rows) -> Rows:
        """exp(v tanh(W x + b)) of every row."""
        return self._forward(_with_constant(rows))[1]

    def _forward(self, inputs: Rows) -> tuple[Rows, Rows]:
        active = np.tanh(inputs @ self.hidden.T)
        return active, np.exp(np.clip(active @ self.output[0], -300, 300))

    def _gradient(self, inputs: Rows, yes: Rows, num_classes: int) -> tuple[Rows, Rows]:
        active, found = self._forward(inputs)
        shares = found.reshape(-1, num_classes)
        shares = shares / shares.sum(axis=1, keepdims=True)
        error = (shares.ravel() - yes) * num_classes / len(yes)
        back = error[:, None] * self.output[0] * (1 - np.square(active))
        return back.T @ inputs + _DECAY * self.hidden, (error @ active)[None, :] + _DECAY * self.output

    def write(self, file: ModelFile, prefix: str) -> None:
        """Add it to a model file."""
        file.set_matrix_d(prefix + "hidden", self.hidden)
        file.set_matrix_d(prefix + "output", self.output)

    @classmethod
    def read(cls, file: ModelFile, prefix: str, num_inputs: int) -> Network:
        """The inverse of `write`. Raises FormatError where the sizes do not fit."""
        hidden, output = (np.asarray(file.matrix_d(prefix + name)) for name in ("hidden", "output"))
        if hidden.ndim != 2 or hidden.shape[1] != num_inputs + 1 or not 1 <= len(hidden) <= _MAX_HIDDEN:
            raise FormatError(f"{prefix}hidden has shape {hidden.shape}, must have 1..{_MAX_HIDDEN} x {num_inputs + 1}")
        if output.shape != (1, len(hidden)):
            raise FormatError(f"{prefix}output has shape {output.shape}, must have (1, {len(hidden)})")
        return cls(hidden, output)


def _with_constant(rows: Rows) -> Rows:
    return np.column_stack([rows, np.ones(len(rows))])
