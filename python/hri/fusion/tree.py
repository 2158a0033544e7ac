# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""A decision tree (CART with Gini impurity; Breiman, Friedman, Olshen and Stone, 1984)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import FormatError
from hri.io import ModelFile

Rows = NDArray[np.float64]

_MAX_DEPTH = 6
_MIN_LEAF = 20
_NUM_THRESHOLDS = 64
_MAX_NODES = 2 ** (_MAX_DEPTH + 1)
_LEAF = -1


class DecisionTree:
    """The share of "yes" in the leaf where a row ends.

    Parameters
    ----------
    nodes : float64 array, shape (num_nodes, 5)
        Of each: the input that it asks for, or -1 for a leaf; the threshold; the nodes for values up to the threshold
        and above it, both after this one; the share of yes.
    """

    kind = "tree"

    def __init__(self, nodes: Rows) -> None:
        self.nodes = nodes

    @classmethod
    def fit(cls, rows: Rows, yes: Rows, num_classes: int, seed: int) -> DecisionTree:
        """Grow to depth 6, of no leaf with fewer than 20 rows.

        Nothing is random, `seed` is not used; nor is `num_classes`, as every row counts by itself.
        """
        nodes: list[list[float]] = []
        _grow(nodes, rows, yes, 0)
        return cls(np.array(nodes))

    def scores(self, rows: Rows) -> Rows:
        """P(yes) of every row."""
        at = np.zeros(len(rows), dtype=np.intp)
        while True:
            inputs = self.nodes[at, 0].astype(np.intp)
            going = np.flatnonzero(inputs != _LEAF)
            if not len(going):
                return self.nodes[at, 4]
            above = rows[going, inputs[going]] > self.nodes[at[going], 1]
            at[going] = np.where(above, self.nodes[at[going], 3], self.nodes[at[going], 2]).astype(np.intp)

    def write(self, file: ModelFile, prefix: str) -> None:
        """Add it to a model file."""
        file.set_matrix_d(prefix + "nodes", self.nodes)

    @classmethod
    def read(cls, file: ModelFile, prefix: str, num_inputs: int) -> DecisionTree:
        """The inverse of `write`. Raises FormatError for what is no tree."""
        nodes = np.asarray(file.matrix_d(prefix + "nodes"))
        if nodes.ndim != 2 or nodes.shape[1] != 5 or not 1 <= len(nodes) <= _MAX_NODES:
            raise FormatError(f"{prefix}nodes has shape {nodes.shape}, must have 1..{_MAX_NODES} rows of 5")
        inputs, children = nodes[:, 0], nodes[:, 2:4]
        if not (np.isin(inputs, range(_LEAF, num_inputs)).all() and (children == np.floor(children)).all()):
            raise FormatError(f"{prefix}nodes: inputs must lie in -1..{num_inputs - 1}, children must be integers")
        inner = inputs != _LEAF
        # Children after their parent: every path ends.
        later = (children > np.arange(len(nodes))[:, None]) & (children < len(nodes))
        if not later[inner].all() or not ((nodes[:, 4] >= 0) & (nodes[:, 4] <= 1)).all():
            raise FormatError(f"{prefix}nodes: a child that is no later node, or a share outside 0..1")
        return cls(nodes)


def _grow(nodes: list[list[float]], rows: Rows, yes: Rows, depth: int) -> int:
    """Add the subtree for these rows; the number of its first node."""
    number = len(nodes)
    share = (float(yes.sum()) + 1) / (len(yes) + 2)  # Laplace's rule: no leaf is beyond doubt
    nodes.append([_LEAF, 0.0, 0.0, 0.0, share])
    split = _best_split(rows, yes) if depth < _MAX_DEPTH else None
    if split is not None:
        column, threshold = split
        above = rows[:, column] > threshold
        low = _grow(nodes, rows[~above], yes[~above], depth + 1)
        high = _grow(nodes, rows[above], yes[above], depth + 1)
        nodes[number][:4] = [column, threshold, low, high]
    return number


def _best_split(rows: Rows, yes: Rows) -> tuple[int, float] | None:
    """The input and the threshold that leave the least impurity; None where nothing is gained."""
    total, num_yes = len(yes), float(yes.sum())
    best, least = None, num_yes * (1 - num_yes / total) - 1e-9
    for column, values in enumerate(rows.T):
        thresholds = np.unique(np.quantile(values, np.linspace(0, 1, _NUM_THRESHOLDS + 2)[1:-1]))
        places = np.digitize(values, thresholds, right=True)
        below = np.cumsum(np.bincount(places, minlength=len(thresholds) + 1))[:-1].astype(float)
        yes_below = np.cumsum(np.bincount(places, weights=yes, minlength=len(thresholds) + 1))[:-1]
        fits = (below >= _MIN_LEAF) & (total - below >= _MIN_LEAF)
        if not fits.any():
            continue
        n, y = below[fits], yes_below[fits]
        impurity = y * (1 - y / n) + (num_yes - y) * (1 - (num_yes - y) / (total - n))
        at = int(np.argmin(impurity))
        if impurity[at] < least:
            best, least = (column, float(thresholds[fits][at])), float(impurity[at])
    return best
