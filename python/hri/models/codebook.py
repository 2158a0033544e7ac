# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Vector quantisation: frames become the number of their nearest codeword."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hri import _native
from hri._native import CodebookOptions, CodebookReport
from hri.core.errors import InvalidArgument
from hri.core.estimator import keywords_of
from hri.core.sklearn_tags import make_tags
from hri.models.rows import as_rows
from hri.models.saving import RowEstimator

if TYPE_CHECKING:
    from typing import Self


class Codebook(RowEstimator):
    """A codebook grown by splitting (Linde, Buzo, Gray), or by k-means from given codewords.

    Keywords are those of `CodebookOptions`.

    Attributes
    ----------
    cluster_centers_ : ndarray of float32, shape (num_codewords, num_features)
    report_ : CodebookReport
        Sizes and distortions of the iterations; not saved.
    model_ : object
        The trained C++ model.

    Examples
    --------
    >>> frames = [[0.0], [0.1], [9.0], [9.1]]
    >>> codebook = Codebook(num_codewords=2).fit(frames)
    >>> sorted(codebook.cluster_centers_.ravel().round(2).tolist())
    [0.05000000074505806, 9.050000190734863]
    """

    _native_class = _native.Codebook
    _options_class = CodebookOptions
    report_: CodebookReport

    @keywords_of(CodebookOptions)
    def __init__(self, **params: Any) -> None:
        super().__init__(**params)

    @classmethod
    def from_centers(cls, centers: ArrayLike) -> Self:
        """A codebook of these codewords, shape (num_codewords, num_features)."""
        rows = as_rows(centers, cls.__name__)
        codebook = cls(num_codewords=len(rows))
        codebook._model = _native.Codebook(rows)
        return codebook

    def fit(self, X: ArrayLike, y: object = None, *, init: ArrayLike | None = None) -> Self:
        """Train on frames.

        Parameters
        ----------
        X : array_like, shape (num_frames, num_features)
            At least as many as there are to be codewords.
        y : object
            Not used.
        init : array_like, shape (num_codewords, num_features), optional
            Codewords that k-means starts from; without them the codebook grows from one by splitting.
        """
        options = self._options()
        rows = as_rows(X, "Codebook")
        report = CodebookReport()
        if init is None:
            self._model = _native.Codebook.train_lbg(rows, options, report)
        else:
            start = as_rows(init, "Codebook.init", rows.shape[1])
            self._model = _native.Codebook.train_kmeans(rows, start, options, report)
        self.report_ = report
        return self

    def predict(self, X: ArrayLike) -> NDArray[np.int32]:
        """The nearest codeword of every frame, shape (num_frames,)."""
        model = self._fitted
        return np.asarray(model.quantise(as_rows(X, "Codebook", model.dim)))

    def fit_predict(self, X: ArrayLike, y: object = None) -> NDArray[np.int32]:
        """`fit`, then `predict` of the same frames."""
        return self.fit(X).predict(X)

    def transform(self, X: ArrayLike) -> NDArray[np.float32]:
        """Euclidean distance of every frame to every codeword, shape (num_frames, num_codewords)."""
        model = self._fitted
        rows = as_rows(X, "Codebook", model.dim).astype(np.float64)
        centers = self.cluster_centers_.astype(np.float64)
        squares = (rows**2).sum(axis=1)[:, None] - 2 * rows @ centers.T + (centers**2).sum(axis=1)
        return np.sqrt(np.maximum(squares, 0)).astype(np.float32)

    def fit_transform(self, X: ArrayLike, y: object = None) -> NDArray[np.float32]:
        """`fit`, then `transform` of the same frames."""
        return self.fit(X).transform(X)

    def inverse_transform(self, symbols: ArrayLike) -> NDArray[np.float32]:
        """The codewords of the numbers that `predict` gave, shape (num_frames, num_features)."""
        numbers = np.asarray(symbols)
        centers = self.cluster_centers_
        if numbers.ndim != 1 or numbers.dtype.kind not in "iu" or (numbers.size and not numbers.min() >= 0):
            raise InvalidArgument("symbols must be a vector of whole numbers from 0")
        if numbers.size and numbers.max() >= len(centers):
            raise InvalidArgument(f"symbol {numbers.max()} is beyond the last codeword, {len(centers) - 1}")
        return centers[numbers]

    def distortion(self, X: ArrayLike) -> float:
        """Mean squared distance of the frames to their codewords."""
        model = self._fitted
        return float(model.distortion(as_rows(X, "Codebook", model.dim)))

    def score(self, X: ArrayLike, y: object = None) -> float:
        """Minus the sum of squared distances of the frames to their codewords."""
        return -len(np.asarray(X)) * self.distortion(X)

    @property
    def cluster_centers_(self) -> NDArray[np.float32]:
        """The codewords."""
        return np.asarray(self._fitted.centroids)

    def __len__(self) -> int:
        return int(self._fitted.size)

    def __sklearn_tags__(self) -> Any:
        return make_tags(None, transforms=True)
