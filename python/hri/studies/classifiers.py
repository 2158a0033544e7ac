# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Features against classifiers (thesis tables 6.2-6.5), on words of unseen speakers."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from hri.studies.registry import Layout, Progress, Study, within
from hri.studies.tables import statistics
from hri.studies.word_classifiers import CLASSIFIERS, Fit
from hri.studies.word_features import FEATURES, WORD_FOLDERS, Frames, SpokenWord, all_frames, read_words

DATA = ("fsdd", "hindi-digits", "hindi-words")


def persons_held_out(words: Sequence[SpokenWord]) -> Iterator[tuple[str, list[int], list[int]]]:
    """Each person, what the others said, what the person said (indices)."""
    for person in sorted({word.person for word in words}):
        train = [i for i, word in enumerate(words) if word.person != person]
        yield person, train, [i for i, word in enumerate(words) if word.person == person]


def accuracies(
    fit: Fit,
    words: Sequence[SpokenWord],
    train: Sequence[int],
    test: Sequence[int],
    trained_on: Sequence[Frames],
    tested_on: Mapping[str, Sequence[Frames]],
) -> dict[str, float]:
    """Share of the test words that get their own label, under each condition; frames are those of all words."""
    labels = sorted({word.label for word in words})
    classes = np.array([labels.index(word.label) for word in words])
    predict = fit([trained_on[i] for i in train], classes[train].tolist(), len(labels))
    return {
        name: float(np.mean(predict([frames[i] for i in test]) == classes[test])) for name, frames in tested_on.items()
    }


def _run(
    data_dir: Path,
    progress: Progress,
    *,
    data: Sequence[str] = DATA,
    features: Sequence[str] = tuple(FEATURES),
    classifier: Sequence[str] = tuple(CLASSIFIERS),
    takes: int | None = None,
    folds: int | None = None,
) -> dict[str, Any]:
    rows = []
    for name in data:
        words = read_words(data_dir, name, progress, takes)
        for kind in features:
            say = within(progress, name)
            frames = all_frames(words, FEATURES[kind], kind, say)
            per_fold: dict[str, dict[str, float]] = {choice: {} for choice in classifier}
            for person, train, test in list(persons_held_out(words))[:folds]:
                for done, choice in enumerate(classifier):
                    found = accuracies(CLASSIFIERS[choice], words, train, test, frames, {"": frames})
                    per_fold[choice][person] = found[""]
                    say(f"{kind} without {person}", done + 1, len(classifier))
            rows += [
                {"data": name, "features": kind, "classifier": choice, **statistics(shares)}
                for choice, shares in per_fold.items()
            ]
    return {"rows": rows, "passed": None}


STUDIES = (
    Study(
        "speech-classifiers",
        "features against classifiers (thesis tables 6.2-6.5) on English digits, Hindi digits and Hindi words, leave "
        "one of 4 speakers out",
        tuple(WORD_FOLDERS.values()),
        "none: a comparison",
        _run,
        layout=Layout(columns="features", panel="data"),
        axes={"data": DATA, "features": tuple(FEATURES), "classifier": tuple(CLASSIFIERS)},
        thins=True,
        sources=(
            "cpp/signal",
            "cpp/features/speech",
            "cpp/models/...",
        ),
        folds=True,
        quick={"data": ("hindi-words",), "features": ("hfcc",), "classifier": ("bayes", "hmm", "ptbhmm")},
    ),
)
