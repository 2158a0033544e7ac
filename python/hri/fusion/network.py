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
    """sigmoid(v tanh(W x + b) + c).

    Parameters
    ----------
    hidden : float64 array, shape (num_hidden, num_inputs + 1)
        W and b.
    output : float64 array, shape (1, num_hidden + 1)
        v and c.
    """

    kind = "network"

    def __init__(self, hidden: Rows, output: Rows) -> None:
        self.hidden, self.output = hidden, output

    @classmethod
    def fit(cls, rows: Rows, yes: Rows, seed: int) -> Network:
        """Cross-entropy and weight decay by Adam (Kingma and Ba, 2015) on all rows at once; `seed` starts it."""
        rng = np.random.default_rng(seed)
        hidden = rng.normal(0, 1 / np.sqrt(rows.shape[1]), (_NUM_HIDDEN, rows.shape[1] + 1))
        output = np.zeros((1, _NUM_HIDDEN + 1))
        output[0, -1] = np.log(max(float(yes.mean()), 1e-6) / max(1 - float(yes.mean()), 1e-6))
        output[0, :-1] = rng.normal(0, 1 / np.sqrt(_NUM_HIDDEN), _NUM_HIDDEN)
        model = cls(hidden, output)
        inputs = _with_constant(rows)
        moments = [(np.zeros_like(w), np.zeros_like(w)) for w in (hidden, output)]
        for step in range(1, _NUM_STEPS + 1):
            for weights, slope, (mean, square) in zip(
                (model.hidden, model.output), model._gradient(inputs, yes), moments, strict=True
            ):
                mean += 0.1 * (slope - mean)
                square += 0.001 * (slope * slope - square)
                scaled = mean / (1 - 0.9**step) / (np.sqrt(square / (1 - 0.999**step)) + 1e-8)
                weights -= _RATE * (1 - step / (_NUM_STEPS + 1)) * scaled
        return model

    def scores(self, rows: Rows) -> Rows:
        """P(yes) of every row."""
        return self._forward(_with_constant(rows))[1]

    def _forward(self, inputs: Rows) -> tuple[Rows, Rows]:
        active = _with_constant(np.tanh(inputs @ self.hidden.T))
        return active, 1 / (1 + np.exp(-np.clip(active @ self.output[0], -30, 30)))

    def _gradient(self, inputs: Rows, yes: Rows) -> tuple[Rows, Rows]:
        active, found = self._forward(inputs)
        error = (found - yes) / len(yes)
        back = error[:, None] * self.output[0, :-1] * (1 - np.square(active[:, :-1]))
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
        if output.shape != (1, len(hidden) + 1):
            raise FormatError(f"{prefix}output has shape {output.shape}, must have (1, {len(hidden) + 1})")
        return cls(hidden, output)


def _with_constant(rows: Rows) -> Rows:
    return np.column_stack([rows, np.ones(len(rows))])
