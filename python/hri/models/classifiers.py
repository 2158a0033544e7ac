# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Classifiers of rows, with scikit-learn's methods over the C++ library's.

Rows are used in float32. Labels may be anything that can be sorted: text, numbers, booleans.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hri import _native
from hri._native import (
    DistanceClassifierOptions,
    GaussianBayesOptions,
    KnnOptions,
    LinearSvmOptions,
    LogisticRegressionOptions,
    RbfClassifierOptions,
    SoftmaxRegressionOptions,
)
from hri.core.errors import InvalidArgument
from hri.core.estimator import keywords_of
from hri.core.sklearn_tags import make_tags
from hri.models.rows import as_labels, as_rows, share_right
from hri.models.saving import RowEstimator

if TYPE_CHECKING:
    from typing import Self


class Classifier(RowEstimator):
    """Base of the classifiers of rows.

    Attributes
    ----------
    classes_ : ndarray, shape (num_classes,)
        The labels in sorted order; set by `fit`.
    n_features_in_ : int
        Columns of the rows it was trained on.
    model_ : object
        The trained C++ model, whose `decision_values` takes single rows too.
    """

    _estimator_type = "classifier"
    classes_: NDArray[Any]

    def fit(self, X: ArrayLike, y: ArrayLike) -> Self:
        """Train.

        Parameters
        ----------
        X : array_like, shape (num_rows, num_features)
            Finite numbers.
        y : array_like, shape (num_rows,)
            The label of every row, two different ones or more.

        Returns
        -------
        self

        Raises
        ------
        InvalidArgument
            For shapes that do not fit, values that are not finite (names the first), parameters out of range.
        """
        options = self._options()
        owner = type(self).__name__
        rows = as_rows(X, owner)
        classes, indices = self._labels(y, len(rows))
        self._model = self._native_class.train(rows, indices, len(classes), options)
        self.classes_ = classes
        return self

    def _labels(self, y: ArrayLike, num_rows: int) -> tuple[NDArray[Any], NDArray[np.int32]]:
        return as_labels(y, num_rows, type(self).__name__)

    def decision_function(self, X: ArrayLike) -> NDArray[np.float32]:
        """Score of each class; larger is likelier.

        Parameters
        ----------
        X : array_like, shape (num_rows, num_features)

        Returns
        -------
        ndarray of float32, shape (num_rows, num_classes)
            In the order of `classes_`; of two classes shape (num_rows,), above 0 for ``classes_[1]``.
        """
        values = self._decision_values(X)
        if values.shape[1] != 2:
            return values
        # Beyond all densities both are -inf: neither is likelier.
        return np.subtract(
            values[:, 1], values[:, 0], out=np.zeros_like(values[:, 0]), where=values[:, 1] != values[:, 0]
        )

    def _decision_values(self, X: ArrayLike) -> NDArray[np.float32]:
        model = self._fitted
        return np.asarray(model.decision_values(as_rows(X, type(self).__name__, model.dim)))

    def predict(self, X: ArrayLike) -> NDArray[Any]:
        """The label of every row, shape (num_rows,)."""
        best = np.argmax(self._decision_values(X), axis=1)
        return self.classes_[best]

    def score(self, X: ArrayLike, y: ArrayLike) -> float:
        """Share of rows whose label is predicted, 0..1."""
        return share_right(self.predict(X), y, type(self).__name__)

    def __sklearn_tags__(self) -> Any:
        return make_tags("classifier", requires_y=True)


class _Probabilistic(Classifier):
    def predict_log_proba(self, X: ArrayLike) -> NDArray[np.float64]:
        """Natural logs of `predict_proba`, without underflow."""
        values = self._decision_values(X).astype(np.float64)
        top = values.max(axis=1, keepdims=True)
        known = np.isfinite(top)  # else so far from all that every density is 0: all are alike
        values, top = np.where(known, values, 0.0), np.where(known, top, 0.0)
        return values - top - np.log(np.exp(values - top).sum(axis=1, keepdims=True))

    def predict_proba(self, X: ArrayLike) -> NDArray[np.float64]:
        """Posterior of every class, shape (num_rows, num_classes), in the order of `classes_`."""
        return np.exp(self.predict_log_proba(X))


class LinearSvm(Classifier):
    """Linear support vector machines, one class against the rest, by dual coordinate descent.

    Keywords are the fields of `LinearSvmOptions`.

    Attributes
    ----------
    coef_ : ndarray of float32, shape (num_classes, num_features)
    intercept_ : ndarray of float32, shape (num_classes,)

    Examples
    --------
    >>> import numpy as np
    >>> rows = np.array([[0.0, 0.0], [0.0, 1.0], [3.0, 3.0], [3.0, 4.0]])
    >>> model = LinearSvm(cost=1.0).fit(rows, ["left", "left", "right", "right"])
    >>> model.predict([[0.1, 0.4], [2.9, 3.0]]).tolist()
    ['left', 'right']
    """

    _native_class = _native.LinearSvm
    _options_class = LinearSvmOptions

    @keywords_of(LinearSvmOptions)
    def __init__(self, **params: Any) -> None:
        super().__init__(**params)

    @property
    def coef_(self) -> NDArray[np.float32]:
        """Weights of every class's machine."""
        return np.asarray(self._fitted.weights)

    @property
    def intercept_(self) -> NDArray[np.float32]:
        """Bias of every class's machine."""
        return np.asarray(self._fitted.biases)


class RbfClassifier(Classifier):
    """Least-squares support vector machines with a radial kernel. Keywords are those of `RbfClassifierOptions`."""

    _native_class = _native.RbfClassifier
    _options_class = RbfClassifierOptions

    @keywords_of(RbfClassifierOptions)
    def __init__(self, **params: Any) -> None:
        super().__init__(**params)


class GaussianBayes(_Probabilistic):
    """Bayes' rule with one Gaussian a class. Keywords are those of `GaussianBayesOptions`."""

    _native_class = _native.GaussianBayes
    _options_class = GaussianBayesOptions

    @keywords_of(GaussianBayesOptions)
    def __init__(self, **params: Any) -> None:
        super().__init__(**params)


class LogisticRegression(_Probabilistic):
    """Logistic regression of two classes. Keywords are those of `LogisticRegressionOptions`.

    Attributes
    ----------
    coef_ : ndarray of float64, shape (1, num_features)
    intercept_ : ndarray of float64, shape (1,)
    """

    _native_class = _native.LogisticRegression
    _options_class = LogisticRegressionOptions

    @keywords_of(LogisticRegressionOptions)
    def __init__(self, **params: Any) -> None:
        super().__init__(**params)

    def _labels(self, y: ArrayLike, num_rows: int) -> tuple[NDArray[Any], NDArray[np.int32]]:
        classes, indices = super()._labels(y, num_rows)
        if len(classes) > 2:
            raise InvalidArgument(
                "Only binary classification is supported. The type of the target is multiclass: y has "
                f"{len(classes)} labels"
            )
        return classes, indices

    @property
    def coef_(self) -> NDArray[np.float64]:
        """Weights for ``classes_[1]``, in the units of the rows."""
        return np.asarray(self._fitted.weights)[None, :]

    @property
    def intercept_(self) -> NDArray[np.float64]:
        """Bias for ``classes_[1]``."""
        return np.asarray([self._fitted.bias])

    def __sklearn_tags__(self) -> Any:
        return make_tags("classifier", requires_y=True, binary_only=True)


class SoftmaxRegression(_Probabilistic):
    """Logistic regression of any number of classes. Keywords are those of `SoftmaxRegressionOptions`."""

    _native_class = _native.SoftmaxRegression
    _options_class = SoftmaxRegressionOptions

    @keywords_of(SoftmaxRegressionOptions)
    def __init__(self, **params: Any) -> None:
        super().__init__(**params)


class KnnClassifier(Classifier):
    """The k nearest rows by Euclidean distance vote. Keywords are those of `KnnOptions`."""

    _native_class = _native.Knn
    _options_class = KnnOptions

    @keywords_of(KnnOptions)
    def __init__(self, **params: Any) -> None:
        super().__init__(**params)


class DistanceClassifier(Classifier):
    """The class whose mean is nearest (thesis table 6.5). Keywords are those of `DistanceClassifierOptions`."""

    _native_class = _native.DistanceClassifier
    _options_class = DistanceClassifierOptions

    @keywords_of(DistanceClassifierOptions)
    def __init__(self, **params: Any) -> None:
        super().__init__(**params)


class PossibilityClassifier(Classifier):
    """Gaussian densities of the classes as possibilities (thesis eq. 5.14-5.15); keywords of `GaussianBayesOptions`.

    Decision values are log possibilities.
    """

    _native_class = _native.PossibilityClassifier
    _options_class = GaussianBayesOptions

    @keywords_of(GaussianBayesOptions)
    def __init__(self, **params: Any) -> None:
        super().__init__(**params)

    def possibilities(self, X: ArrayLike) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
        """Possibility and necessity of every class for every row, each of shape (num_rows, num_classes)."""
        model = self._fitted
        pairs = [model.classify(row) for row in as_rows(X, type(self).__name__, model.dim)]
        return np.asarray([p for p, _ in pairs]), np.asarray([n for _, n in pairs])
