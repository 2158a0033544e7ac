# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Classifiers of hand features against scikit-learn."""

from __future__ import annotations

import numpy as np

from hri.models import GaussianBayes, KnnClassifier, LinearSvm
from timing import Bench, Timed, medians

NUM_CLASSES = 10
DIM = 200


def _rows(count: int, seed: int) -> tuple[np.ndarray, np.ndarray]:
    """Rows around ten centres, as the features of ten signs lie, float32, and their classes."""
    rng = np.random.default_rng(seed)
    centres = np.random.default_rng(0).normal(0, 0.5, (NUM_CLASSES, DIM))
    classes = rng.integers(0, NUM_CLASSES, count)
    return (centres[classes] + rng.normal(size=(count, DIM))).astype(np.float32), classes


def svm_train() -> Timed:
    """Ten linear machines from 500 rows of 200 features, cost 1, default tolerances."""
    from sklearn.svm import LinearSVC

    rows, classes = _rows(500, 1)
    ours = LinearSvm(cost=1.0).fit(rows, classes)

    def peer() -> LinearSVC:
        return LinearSVC(C=1.0, dual=True, random_state=0).fit(rows, classes)

    def cost(weights: np.ndarray, biases: np.ndarray) -> float:
        signs = np.where(classes[:, None] == np.arange(NUM_CLASSES), 1, -1)
        slack = np.maximum(0, 1 - signs * (rows @ weights.T + biases))
        return 0.5 * (np.sum(weights**2) + np.sum(biases**2)) + np.sum(slack**2)

    theirs = peer()
    # Each has its own tolerance: what they reach has to be the same.
    assert np.isclose(cost(ours.coef_, ours.intercept_), cost(theirs.coef_, theirs.intercept_), rtol=1e-4)
    return medians(lambda: LinearSvm(cost=1.0).fit(rows, classes), peer, 7)


def _svms() -> tuple[object, object]:
    """Ours as the C++ model, which takes single rows, and the peer with its weights."""
    from sklearn.svm import LinearSVC

    rows, classes = _rows(500, 1)
    ours = LinearSvm().fit(rows, classes).model_
    peer = LinearSVC(random_state=0).fit(rows, classes)
    peer.coef_, peer.intercept_ = np.array(ours.weights), np.array(ours.biases)
    return ours, peer


def svm_picture() -> Timed:
    """The scores of one row of 200 features by ten linear machines with equal weights, as for each picture; the peer
    is NumPy's product, which checks nothing."""
    ours, peer = _svms()
    row, _ = _rows(1, 2)
    weights, biases = peer.coef_.T.astype(np.float32), peer.intercept_.astype(np.float32)
    assert np.allclose(ours.decision_values(row), row @ weights + biases, atol=1e-3)
    return medians(lambda: ours.decision_values(row), lambda: row @ weights + biases, 501)


def svm_batch() -> Timed:
    """The same for 1000 rows at once."""
    ours, peer = _svms()
    rows, _ = _rows(1000, 2)
    assert np.allclose(ours.decision_values(rows), peer.decision_function(rows), atol=1e-3)
    return medians(lambda: ours.decision_values(rows), lambda: peer.decision_function(rows), 51)


def _knn(num_tested: int) -> Timed:
    from sklearn.neighbors import KNeighborsClassifier

    (rows, classes), (test, _) = _rows(1000, 1), _rows(num_tested, 2)
    ours = KnnClassifier(num_neighbours=5).fit(rows, classes).model_
    peer = KNeighborsClassifier(5, algorithm="brute").fit(rows, classes)
    # Ours adds up to 2e-3 to rank classes with as many neighbours.
    assert np.allclose(ours.decision_values(test), peer.predict_proba(test), atol=2e-3)
    return medians(lambda: ours.decision_values(test), lambda: peer.predict_proba(test), 31)


def knn_picture() -> Timed:
    """The five nearest of 1000 rows for one row of 200 features, brute force, as for each picture; the peer is what
    NumPy does for this, by norms kept from training."""
    (rows, classes), (test, _) = _rows(1000, 1), _rows(1, 2)
    ours = KnnClassifier(num_neighbours=5).fit(rows, classes).model_
    norms, numbers = np.einsum("ij,ij->i", rows, rows), np.unique(classes, return_inverse=True)[1]

    def peer() -> np.ndarray:
        nearest = np.argpartition(norms - 2 * (rows @ test[0]), 5)[:5]
        return np.bincount(numbers[nearest], minlength=10) / 5

    # Ours adds up to 2e-3 to rank classes with as many neighbours.
    assert np.allclose(ours.decision_values(test), peer(), atol=2e-3)
    return medians(lambda: ours.decision_values(test), peer, 101)


def knn_batch() -> Timed:
    """The same for 200 rows at once."""
    return _knn(200)


def bayes_batch() -> Timed:
    """The densities of 500 rows of 40 features under ten Gaussians with full covariances."""
    from sklearn.discriminant_analysis import QuadraticDiscriminantAnalysis

    (rows, classes), (test, _) = _rows(2000, 1), _rows(500, 2)
    rows, test = np.ascontiguousarray(rows[:, :40]), np.ascontiguousarray(test[:, :40])
    ours = GaussianBayes(covariance="full", shrinkage=0.0).fit(rows, classes).model_
    peer = QuadraticDiscriminantAnalysis().fit(rows, classes)
    # The covariances are divided by n in ours and by n - 1 in the peer.
    assert np.mean(ours.decision_values(test).argmax(1) == peer.predict(test)) > 0.99
    return medians(lambda: ours.decision_values(test), lambda: peer.decision_function(test))


BENCHES = [
    Bench("svm_train", svm_train, "scikit-learn"),
    Bench("svm_picture", svm_picture, "NumPy"),
    Bench("svm_batch", svm_batch, "scikit-learn"),
    Bench("knn_picture", knn_picture, "NumPy"),
    Bench("knn_batch", knn_batch, "scikit-learn"),
    Bench("bayes_batch", bayes_batch, "scikit-learn"),
]
