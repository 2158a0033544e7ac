# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""A small convolutional network that classifies sequences of frames, trained by the C++ library."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hri import _native
from hri._native import SequenceNetworkOptions
from hri.core.estimator import keywords_of
from hri.core.sklearn_tags import make_tags
from hri.models.rows import as_labels, as_rows, share_right
from hri.models.saving import SavedEstimator

if TYPE_CHECKING:
    from typing import Self


class SequenceNetwork(SavedEstimator):
    """Residual blocks of time-channel separable convolutions (MatchboxNet), mean and maximum over time, softmax.

    Keywords are those of `SequenceNetworkOptions`. Training takes the sequences as they are; that of
    `WordRecognizer(use_network=True)` also changes their speed, place and vocal tract, and adds noise.

    Attributes
    ----------
    classes_ : ndarray, shape (num_classes,)
        The labels in sorted order; set by `fit`.
    model_ : object
        The trained C++ model.

    Examples
    --------
    >>> import numpy as np
    >>> rng = np.random.default_rng(0)
    >>> ramps = [np.outer(np.linspace(0, 1, 20), np.ones(4)) + 0.1 * rng.standard_normal((20, 4)) for _ in range(16)]
    >>> sequences = ramps + [ramp[::-1] for ramp in ramps]
    >>> network = SequenceNetwork(num_channels=16, num_epochs=20).fit(sequences, ["rise"] * 16 + ["fall"] * 16)
    >>> network.predict(sequences[:1])
    array(['rise'], dtype='<U4')
    """

    _estimator_type = "classifier"
    _native_class = _native.SequenceNetwork
    _options_class = SequenceNetworkOptions
    classes_: NDArray[Any]

    @keywords_of(SequenceNetworkOptions)
    def __init__(self, **params: Any) -> None:
        super().__init__(**params)

    def fit(self, X: Sequence[ArrayLike], y: ArrayLike) -> Self:
        """Train.

        Parameters
        ----------
        X : sequence of array_like, each of shape (num_frames, dim)
            Finite numbers.
        y : array_like, shape (num_sequences,)
            The label of every sequence, two different ones or more.

        Returns
        -------
        self

        Raises
        ------
        InvalidArgument
            For shapes that do not fit, values that are not finite, parameters out of range.
        """
        options = self._options()
        owner = type(self).__name__
        sequences = [as_rows(frames, owner) for frames in X]
        classes, indices = as_labels(y, len(sequences), owner)
        self._model = self._native_class.train(sequences, indices, len(classes), options)
        self.classes_ = classes
        return self

    def predict_log_proba(self, X: Sequence[ArrayLike]) -> NDArray[np.float32]:
        """Log posterior of every class for every sequence, shape (num_sequences, num_classes)."""
        model = self._fitted
        rows = [model.log_posteriors(as_rows(frames, type(self).__name__, model.dim)) for frames in X]
        return np.asarray(rows, np.float32).reshape(len(rows), model.num_classes)

    def predict_proba(self, X: Sequence[ArrayLike]) -> NDArray[np.float32]:
        """Posterior of every class for every sequence, shape (num_sequences, num_classes)."""
        return np.exp(self.predict_log_proba(X))

    def predict(self, X: Sequence[ArrayLike]) -> NDArray[Any]:
        """The label of every sequence, shape (num_sequences,)."""
        return self.classes_[np.argmax(self.predict_log_proba(X), axis=1)]

    def score(self, X: Sequence[ArrayLike], y: ArrayLike) -> float:
        """Share of sequences whose label is predicted, 0..1."""
        return share_right(self.predict(X), y, type(self).__name__)

    def __sklearn_tags__(self) -> Any:
        return make_tags("classifier", requires_y=True)
