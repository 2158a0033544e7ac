# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Words of unseen speakers by the pretrained speech embedding and linear discriminants alone."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.datasets import Dataset
from hri.models import LDA
from hri.recognition import SpeechEmbedding
from hri.studies.registry import WORD_SOURCES, Layout, Progress, Study
from hri.studies.tables import statistics

SETS = {
    "English digits": "fsdd/recordings",
    "Hindi digits": "hindi_words/digits",
    "Hindi words": "hindi_words/words",
    "commands": "commands",
}
MAX_FOLDS = 6
SHRINKAGES = (0.05, 0.2, 0.5)
"""Chosen among within the training speakers of every fold."""

Vectors = NDArray[np.float32]
Names = NDArray[np.str_]


def predict(train: Vectors, labels: Names, test: Vectors, shrinkage: float) -> Names:
    """The word whose mean is nearest among linear discriminants."""
    plane = LDA(shrinkage=shrinkage).fit(train, labels)
    rows, names = plane.transform(train), np.unique(labels)
    means = np.stack([rows[labels == name].mean(axis=0) for name in names])
    squares = (plane.transform(test)[:, None, :] - means[None]) ** 2
    return names[squares.sum(axis=2).argmin(axis=1)]


def folds_of(persons: Names) -> list[Names]:
    """Speakers to leave out together: one by one, of more than six in six groups."""
    everybody = np.unique(persons)
    count = min(MAX_FOLDS, len(everybody))
    return [everybody[i::count] for i in range(count)]


def choose(train: Vectors, labels: Names, persons: Names) -> float:
    """The shrinkage that is right most often on speakers left out of these."""

    def right(shrinkage: float) -> float:
        shares = []
        for left_out in folds_of(persons):
            test = np.isin(persons, left_out)
            found = predict(train[~test], labels[~test], train[test], shrinkage)
            shares.append(float(np.mean(found == labels[test])))
        return float(np.mean(shares))

    return max(SHRINKAGES, key=right)


def _run(data_dir: Path, progress: Progress, *, data: Sequence[str] = tuple(SETS)) -> dict[str, Any]:
    embedding = SpeechEmbedding()
    rows = []
    for name in data:
        samples = Dataset.load(data_dir / SETS[name], "speech").samples
        vectors = np.empty((len(samples), embedding.options.num_pieces * embedding.num_outputs), np.float32)
        for i, sample in enumerate(samples):
            vectors[i] = embedding.transform([sample.path])[0]
            progress(f"embedding {name}", i + 1, len(samples))
        labels = np.array([sample.label for sample in samples])
        persons = np.array([sample.person for sample in samples])
        shares, folds = {}, folds_of(persons)
        for i, left_out in enumerate(folds):
            test = np.isin(persons, left_out)
            shrinkage = choose(vectors[~test], labels[~test], persons[~test])
            found = predict(vectors[~test], labels[~test], vectors[test], shrinkage)
            shares[", ".join(left_out)] = float(np.mean(found == labels[test]))
            progress(f"speakers left out of {name}", i + 1, len(folds))
        rows.append({"data": name} | statistics(shares))
    return {
        "rows": rows,
        "weights": embedding.checksum,
        "options": embedding.options.as_dict(),
        "passed": all(float(row["accuracy_mean"]) >= 0.9 for row in rows),
    }


STUDIES = (
    Study(
        "speech-embedding",
        "words of speakers left out by the pretrained speech embedding and linear discriminants (extra embedding)",
        tuple(SETS.values()),
        "mean accuracy >= 90 % in every set, shrinkage chosen within the training speakers",
        _run,
        Layout(),
        axes={"data": tuple(SETS)},
        sources=WORD_SOURCES,
        quick={"data": ("Hindi digits", "Hindi words")},
    ),
)
