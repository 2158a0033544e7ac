# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Linear projections of rows: principal components, and directions that separate classes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hri import _native
from hri._native import LdaOptions
from hri.core.errors import InvalidArgument
from hri.core.estimator import keywords_of
from hri.core.sklearn_tags import make_tags
from hri.models.rows import as_labels, as_rows
from hri.models.saving import RowEstimator

if TYPE_CHECKING:
    from typing import Self


class _Projection(RowEstimator):
    """Base of both.

    Attributes
    ----------
    components_ : ndarray of float32, shape (num_components, num_features)
    mean_ : ndarray of float32, shape (num_features,)
    n_features_in_ : int
    """

    @property
    def components_(self) -> NDArray[np.float32]:
        """Directions, a row each."""
        return np.asarray(self._fitted.components)

    @property
    def mean_(self) -> NDArray[np.float32]:
        """Mean of the rows trained on."""
        return np.asarray(self._fitted.mean)

    def transform(self, X: ArrayLike) -> NDArray[np.float32]:
        """Rows in the space of the components, float32, shape (num_rows, num_components)."""
        model = self._fitted
        return np.asarray(model.transform(as_rows(X, type(self).__name__, model.dim)))


class PCA(_Projection):
    """Principal component analysis (thesis eq. 6.11-6.14).

    Parameters
    ----------
    num_components : int, optional
        At least 1; fewer are kept where the rows vary in fewer directions. By default all.

    Attributes
    ----------
    components_ : ndarray of float32, shape (num_components, num_features)
        Orthonormal, by falling variance; the largest entry of each is positive.
    explained_variance_ : ndarray of float32, shape (num_components,)
    mean_ : ndarray of float32, shape (num_features,)

    Examples
    --------
    >>> PCA(num_components=1).fit([[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]]).components_.round(3).tolist()
    [[0.7070000171661377, 0.7070000171661377]]
    """

    _native_class = _native.Pca

    def __init__(self, num_components: int | None = None) -> None:
        super().__init__(num_components=num_components)

    def _check_params(self) -> None:
        asked = self._params["num_components"]
        if asked is None:
            return
        if isinstance(asked, bool) or not isinstance(asked, int | np.integer):
            raise TypeError(f"num_components must be a whole number or None, got {asked!r}")
        if asked < 1:
            raise InvalidArgument(f"num_components must be at least 1, got {asked}")

    def fit(self, X: ArrayLike, y: object = None) -> Self:
        """Find the components of the rows of `X`; `y` is not used."""
        self._check_params()
        rows = as_rows(X, "PCA", min_rows=2)
        asked = self._params["num_components"]
        self._model = _native.Pca.train(rows, rows.shape[1] if asked is None else asked)
        return self

    def fit_transform(self, X: ArrayLike, y: object = None) -> NDArray[np.float32]:
        """`fit`, then `transform` of the same rows."""
        return self.fit(X).transform(X)

    def inverse_transform(self, X: ArrayLike) -> NDArray[np.float32]:
        """Rows of the original space, from what `transform` gave."""
        components = self.components_
        return as_rows(X, "PCA.inverse_transform", len(components)) @ components + self.mean_

    @property
    def explained_variance_(self) -> NDArray[np.float32]:
        """Variance along every component."""
        return np.asarray(self._fitted.variances)

    def __sklearn_tags__(self) -> Any:
        return make_tags(None, transforms=True)


class LDA(_Projection):
    """Linear discriminant analysis: the directions along which classes lie furthest apart.

    Keywords are those of `LdaOptions`.

    Attributes
    ----------
    components_ : ndarray of float32, shape (num_components, num_features)
    ratios_ : ndarray of float32, shape (num_components,)
        Variance between classes over variance within them, falling.
    classes_ : ndarray, shape (num_classes,)
    """

    _native_class = _native.Lda
    _options_class = LdaOptions

    @keywords_of(LdaOptions)
    def __init__(self, **params: Any) -> None:
        super().__init__(**params)

    def fit(self, X: ArrayLike, y: ArrayLike) -> Self:
        """Find the directions that separate the labels `y`, one a row of `X`."""
        options = self._options()
        rows = as_rows(X, "LDA")
        classes, indices = as_labels(y, len(rows), "LDA")
        self._model = _native.Lda.train(rows, indices, len(classes), options)
        return self

    def fit_transform(self, X: ArrayLike, y: ArrayLike) -> NDArray[np.float32]:
        """`fit`, then `transform` of the same rows."""
        return self.fit(X, y).transform(X)

    @property
    def ratios_(self) -> NDArray[np.float32]:
        """Variance between classes over variance within."""
        return np.asarray(self._fitted.ratios)

    def __sklearn_tags__(self) -> Any:
        return make_tags(None, transforms=True, requires_y=True)
