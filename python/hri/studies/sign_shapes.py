# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Still signs as vectors, and the classifiers that studies compare on them (thesis section 3.2)."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.datasets import Dataset, Fold
from hri.features.hand import hand_features
from hri.media import read_image
from hri.models import LDA, PCA, Classifier, DistanceClassifier, GaussianBayes, KnnClassifier, LinearSvm
from hri.studies.registry import Progress
from hri.studies.tables import Row, statistics
from hri.vision.hands import find_silhouettes

NUM_FOLDS = 5
NUM_COMPONENTS = 40
"""Principal components kept of longer vectors, for classifiers that are not in `WIDE`."""
NUM_DISCRIMINANT_COMPONENTS = 200
"""The same for LDA, whose covariance needs more rows than columns: shorter vectors are only turned."""
NUM_NEIGHBOURS = (1, 3, 5, 7)
"""As in the thesis, table 3.7."""

Vectors = NDArray[np.float32]
Predict = Callable[[Vectors], NDArray[np.int64]]
Fit = Callable[[Vectors, NDArray[np.int64]], Predict]
"""Trains on vectors and their classes in 0..num_classes - 1."""


@dataclass(frozen=True)
class SignPictures:
    """Every picture of a folder of still signs with the mask of its hand; where none is found, the whole picture."""

    dataset: Dataset
    greys: list[NDArray[np.uint8]]
    masks: list[NDArray[np.uint8]]
    num_without_hand: int

    @property
    def labels(self) -> list[str]:
        return self.dataset.labels

    @property
    def classes(self) -> NDArray[np.int64]:
        return np.array([self.labels.index(sample.label) for sample in self.dataset.samples])

    def folds(self) -> list[Fold]:
        return self.dataset.folds_by_person(NUM_FOLDS, 0)

    def vectors(self, kind: str, options: dict[str, Any]) -> Vectors:
        return hand_features(self.greys, self.masks, kind, **options)  # type: ignore[arg-type]


def read_signs(data_dir: Path, progress: Progress) -> SignPictures:
    """The pictures of `sign_digits`."""
    dataset = Dataset.load(data_dir / "sign_digits", "gesture")
    greys, masks, missing = [], [], 0
    for done, sample in enumerate(dataset.samples):
        (found,) = find_silhouettes([read_image(sample.path)], faces="never")  # hands alone
        mask = np.asarray(found.mask)
        if not mask.any():
            mask, missing = np.full_like(mask, 255), missing + 1
        greys.append(np.asarray(found.grey))
        masks.append(mask)
        progress("finding hands", done + 1, len(dataset))
    return SignPictures(dataset, greys, masks, missing)


def _fit(make: Callable[[], Classifier], rows: Vectors, classes: NDArray[np.int64]) -> Predict:
    return make().fit(rows, classes).predict


def _fit_svm(rows: Vectors, classes: NDArray[np.int64]) -> Predict:
    # An average vector of length 1 suits a cost of 1.
    scale = 1 / np.sqrt(np.mean(np.sum(rows**2, axis=1)))
    trained = LinearSvm().fit(scale * rows, classes)
    return lambda test: trained.predict(scale * test)


def _fit_lda(rows: Vectors, classes: NDArray[np.int64]) -> Predict:
    # Where the covariance within classes is the identity, the nearest mean is the most probable of equal classes.
    plane = LDA().fit(rows, classes)
    trained = DistanceClassifier(metric="euclidean").fit(plane.transform(rows), classes)
    return lambda test: trained.predict(plane.transform(test))


def _nearest(metric: Any) -> Fit:
    return partial(_fit, partial(DistanceClassifier, metric=metric))


CLASSIFIERS: dict[str, Fit] = {
    **{metric: _nearest(metric) for metric in ("euclidean", "manhattan", "mahalanobis", "bhattacharyya")},
    **{f"{k}-nn": partial(_fit, partial(KnnClassifier, num_neighbours=k)) for k in NUM_NEIGHBOURS},
    "lda": _fit_lda,
    "bayes": partial(_fit, partial(GaussianBayes, covariance="full")),
    "svm": _fit_svm,
}
"""By name; distances are to class means."""
WIDE: dict[str, int | None] = {"lda": NUM_DISCRIMINANT_COMPONENTS, "svm": None}
"""The classifiers that get other than `NUM_COMPONENTS` principal components; None: the columns as they are."""


def scaled(rows: Vectors, by: Vectors) -> Vectors:
    """Columns with the mean and spread that those of `by` have taken off; what is constant there becomes 0."""
    spread = by.std(axis=0)
    constant = spread < 1e-6 * max(float(np.abs(by).max()), 1e-12)
    return np.where(constant, 0, (rows - by.mean(axis=0)) / np.where(constant, 1, spread)).astype(np.float32)


def shares_right(
    vectors: Vectors,
    classes: NDArray[np.int64],
    train: Sequence[int] | NDArray[np.int64],
    test: Sequence[int] | NDArray[np.int64],
    classifiers: Sequence[str],
) -> dict[str, float]:
    """The share of the rows `test` that every classifier gets right that was trained on the rows `train`.

    What columns are scaled by, and principal components, are of the rows `train` alone.
    """
    known, unknown = (scaled(vectors[rows], vectors[train]) for rows in (train, test))
    found, shown = {}, {}
    for name in classifiers:
        kept = WIDE.get(name, NUM_COMPONENTS)
        if kept not in shown:
            pca = PCA(min(kept, known.shape[1])).fit(known) if kept else None
            shown[kept] = (pca.transform(known), pca.transform(unknown)) if pca else (known, unknown)
        predict = CLASSIFIERS[name](shown[kept][0], classes[train])
        found[name] = float(np.mean(predict(shown[kept][1]) == classes[test]))
    return found


def accuracies(
    signs: SignPictures, vectors: Vectors, classifiers: Sequence[str], say: Progress, what: str
) -> list[Row]:
    """Of every classifier on the signs of persons it was not trained on, as rows of a result."""
    per_fold: dict[str, dict[str, float]] = {name: {} for name in classifiers}
    folds = signs.folds()
    for done, fold in enumerate(folds):
        found = shares_right(vectors, signs.classes, fold.train, fold.test, classifiers)
        for name, share in found.items():
            per_fold[name][fold.name] = share
        say(what, done + 1, len(folds))
    return [{"classifier": name, **statistics(shares)} for name, shares in per_fold.items()]
