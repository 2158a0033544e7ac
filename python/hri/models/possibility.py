# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Possibility theory: the possibility-theory HMM (PTBHMM, thesis chapter 4), possibilities and necessities."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hri import _native
from hri._native import PossibilisticHmmOptions, PossibilisticHmmSet, StatePossibilities
from hri.core.errors import InvalidArgument
from hri.core.estimator import keywords_of
from hri.core.sklearn_tags import make_tags
from hri.models.rows import as_labels, share_right
from hri.models.saving import SavedEstimator

if TYPE_CHECKING:
    from typing import Self


class PTBHMM(SavedEstimator):
    """Classifier of symbol sequences by possibility-theory HMMs, trained and scaled together.

    Keywords are those of `PossibilisticHmmOptions`; without ``num_symbols`` there are as many as the training data
    shows.

    Attributes
    ----------
    classes_ : ndarray, shape (num_classes,)
        The labels in sorted order.
    model_ : PossibilisticHmmSet
        The trained C++ model.

    Examples
    --------
    >>> words = [[0, 0, 1], [0, 1, 1], [1, 0], [1, 1, 0]]
    >>> model = PTBHMM(topology={"num_states": 2}).fit(words, ["up", "up", "down", "down"])
    >>> model.predict([[0, 1], [1, 0]]).tolist()
    ['up', 'down']
    """

    _estimator_type = "classifier"
    _native_class = PossibilisticHmmSet
    _options_class = PossibilisticHmmOptions
    classes_: NDArray[Any]

    @keywords_of(PossibilisticHmmOptions)
    def __init__(self, **params: Any) -> None:
        super().__init__(**params)

    def fit(self, X: Sequence[ArrayLike], y: ArrayLike) -> Self:
        """Train on symbol sequences.

        Parameters
        ----------
        X : sequence of integer arrays, shape (num_symbols_given,)
        y : array_like, shape (len(X),)
            The label of every sequence.
        """
        sequences = [_symbols(x, f"X[{i}]") for i, x in enumerate(X)]
        classes, indices = as_labels(y, len(sequences), "PTBHMM")
        options = self._options()
        if options.num_symbols == 0:
            options.num_symbols = 1 + max(int(s.max()) for s in sequences)
        per_class = [[s for s, k in zip(sequences, indices, strict=True) if k == c] for c in range(len(classes))]
        self._model = PossibilisticHmmSet.train(per_class, options)
        self.classes_ = classes
        return self

    def decision_function(self, X: Sequence[ArrayLike]) -> NDArray[np.float32]:
        """Log possibility of every sequence under every class, shape (len(X), num_classes)."""
        model = self._fitted
        rows = [model.log_possibilities(_symbols(x, f"X[{i}]")) for i, x in enumerate(X)]
        return np.asarray(rows, np.float32).reshape(len(rows), model.num_classes)

    def predict(self, X: Sequence[ArrayLike]) -> NDArray[Any]:
        """The label of every sequence."""
        return self.classes_[np.argmax(self.decision_function(X), axis=1)]

    def possibilities(self, X: Sequence[ArrayLike]) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
        """Possibility and necessity of every class for every sequence, each of shape (len(X), num_classes)."""
        model = self._fitted
        pairs = [model.classify(_symbols(x, f"X[{i}]")) for i, x in enumerate(X)]
        return np.asarray([p for p, _ in pairs]), np.asarray([n for _, n in pairs])

    def decode(self, symbols: ArrayLike, label: Any) -> tuple[float, NDArray[np.int32]]:
        """Log possibility of the best path of one sequence under the model of `label`, and the path."""
        score, path = self._fitted.viterbi(self._index_of(label), _symbols(symbols, "symbols"))
        return float(score), path

    def state_possibilities(self, symbols: ArrayLike, label: Any) -> StatePossibilities:
        """Possibility and necessity of every state at every symbol under the model of `label` (thesis eq. 4.23).

        Parameters
        ----------
        symbols : integer array_like, shape (num_frames,)
        label : object
            One of `classes_`.

        Returns
        -------
        StatePossibilities
            ``possibility``, ``necessity``, and what they come from: ``log_forward`` (eq. 4.10-4.11) and
            ``log_backward`` (eq. 4.15-4.16), each float64 of shape (num_frames, num_states), and
            ``log_possibility`` of the whole. Where that is -inf nothing is known of the states: all are fully
            possible, none is necessary.

        Raises
        ------
        InvalidArgument
            For another label, symbols the model does not have, or a rule of a conditioned minimum whose
            ``concentration`` is not 1.
        """
        return self._fitted.state_possibilities(self._index_of(label), _symbols(symbols, "symbols"))

    def _index_of(self, label: Any) -> int:
        found = np.flatnonzero(self._fitted is not None and self.classes_ == label)
        if len(found) != 1:
            raise InvalidArgument(f"no class {label!r}; there are: {', '.join(map(str, self.classes_))}")
        return int(found[0])

    def score(self, X: Sequence[ArrayLike], y: ArrayLike) -> float:
        """Share of sequences whose label is predicted, 0..1."""
        return share_right(self.predict(X), y, type(self).__name__)

    @property
    def model_(self) -> PossibilisticHmmSet:
        """The trained C++ model."""
        model: PossibilisticHmmSet = self._fitted
        return model

    def __sklearn_tags__(self) -> Any:
        return make_tags("classifier", rows=False, requires_y=True)


def possibility_of(distribution: ArrayLike, event: Sequence[int]) -> float:
    """Possibility of an event: the largest of its elements' (thesis eq. 4.1).

    Parameters
    ----------
    distribution : array_like, shape (num_elements,)
        Possibility of every element, 0..1.
    event : sequence of int
        Indices of the elements it is made of.
    """
    return float(_native.possibility_of(np.asarray(distribution, np.float64), list(event)))


def necessity_of(distribution: ArrayLike, event: Sequence[int]) -> float:
    """Necessity of an event: 1 minus the possibility of all else (thesis eq. 4.2). Parameters as `possibility_of`."""
    return float(_native.necessity_of(np.asarray(distribution, np.float64), list(event)))


def possibilities(log_densities: ArrayLike) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Possibility and necessity of every class from log densities (thesis eq. 5.14).

    Parameters
    ----------
    log_densities : array_like, shape (num_classes,)
        Natural logs.

    Returns
    -------
    possibility, necessity : ndarray of float32, shape (num_classes,)
    """
    return _native.possibilities(np.asarray(log_densities, np.float32))


def _symbols(values: ArrayLike, name: str) -> NDArray[Any]:
    symbols = np.asarray(values)
    if symbols.ndim != 1 or symbols.dtype.kind not in "iu" or not symbols.size:
        raise InvalidArgument(f"{name} must be a vector of whole numbers, got {symbols.dtype} of shape {symbols.shape}")
    return symbols
