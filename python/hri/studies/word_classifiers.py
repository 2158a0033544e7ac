# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The classifiers that studies compare on spoken words (thesis table 6.5), trained on frames."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.features import normalise_time
from hri.models import (
    PCA,
    Classifier,
    Codebook,
    DistanceClassifier,
    GaussianBayes,
    GaussianMixtureHmm,
    GaussianMixtureHmmOptions,
    KnnClassifier,
    PossibilisticHmmOptions,
    PossibilisticHmmSet,
    PossibilityClassifier,
    Topology,
)
from hri.studies.word_features import Frames

NUM_ROWS = 16
"""Frames that a word is stretched or squeezed to for classifiers of fixed-length vectors."""
NUM_COMPONENTS = 40
"""Principal components kept of such a vector (thesis eq. 6.11-6.14)."""
NUM_STATES = 8
NUM_CODEWORDS = 128
MAX_ITERATIONS = 12
NUM_NEIGHBOURS = 2
"""As in the thesis, table 6.5."""

Predict = Callable[[Sequence[Frames]], NDArray[np.int64]]
Fit = Callable[[Sequence[Frames], Sequence[int], int], Predict]
"""Trains on frames and their classes in 0..num_classes - 1."""


def _vectors(frames: Sequence[Frames]) -> NDArray[np.float32]:
    width = frames[0].shape[1] // 3  # without deltas: the row's neighbours say the same
    return np.stack([normalise_time(f[:, :width], NUM_ROWS).ravel() for f in frames])


def _fit_vectors(
    make: Callable[[], Classifier], frames: Sequence[Frames], classes: Sequence[int], count: int
) -> Predict:
    vectors = _vectors(frames)
    pca = PCA(NUM_COMPONENTS).fit(vectors)
    trained = make().fit(pca.transform(vectors), classes)
    return lambda test: trained.predict(pca.transform(_vectors(test)))


def _by_class(items: Sequence[Any], classes: Sequence[int], count: int) -> list[list[Any]]:
    return [[item for item, own in zip(items, classes, strict=True) if own == c] for c in range(count)]


def _left_right() -> Any:
    return Topology(kind="left_right", num_states=NUM_STATES, max_jump=1)


def _fit_hmm(frames: Sequence[Frames], classes: Sequence[int], count: int) -> Predict:
    options = GaussianMixtureHmmOptions(topology=_left_right(), max_iterations=MAX_ITERATIONS)
    models = [GaussianMixtureHmm.train(own, options) for own in _by_class(frames, classes, count)]
    return lambda test: np.array([np.argmax([m.log_likelihood(f) for m in models]) for f in test])


def _fit_ptbhmm(frames: Sequence[Frames], classes: Sequence[int], count: int) -> Predict:
    rows = np.concatenate(frames)
    size = min(NUM_CODEWORDS, 1 << int(np.log2(len(rows))))
    book = Codebook(num_codewords=size).fit(rows)
    options = PossibilisticHmmOptions(
        topology=_left_right(), num_symbols=len(book), emission_floor=0.1 / len(book), max_iterations=MAX_ITERATIONS
    )
    symbols = _by_class([book.predict(f) for f in frames], classes, count)
    trained = PossibilisticHmmSet.train(symbols, options)
    return lambda test: np.array([np.argmax(trained.log_possibilities(book.predict(f))) for f in test])


def _nearest(metric: Any) -> Fit:
    return partial(_fit_vectors, partial(DistanceClassifier, metric=metric))


CLASSIFIERS: dict[str, Fit] = {
    "euclidean": _nearest("euclidean"),
    "manhattan": _nearest("manhattan"),
    "mahalanobis": _nearest("mahalanobis"),
    "bhattacharyya": _nearest("bhattacharyya"),
    "knn": partial(_fit_vectors, partial(KnnClassifier, num_neighbours=NUM_NEIGHBOURS)),
    "bayes": partial(_fit_vectors, partial(GaussianBayes, covariance="full")),
    "possibility": partial(_fit_vectors, partial(PossibilityClassifier, covariance="full")),
    "hmm": _fit_hmm,
    "ptbhmm": _fit_ptbhmm,
}
"""By name, as the thesis compares them."""
