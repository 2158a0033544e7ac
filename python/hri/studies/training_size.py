# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""How many recordings of a word, and of how many speakers, training needs."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations
from pathlib import Path
from typing import Any

import numpy as np

from hri.studies.classifiers import accuracies, persons_held_out
from hri.studies.registry import Layout, Progress, Study
from hri.studies.tables import statistics
from hri.studies.word_classifiers import CLASSIFIERS
from hri.studies.word_features import FEATURES, SpokenWord, all_frames, read_words

DATA = ("fsdd", "hindi-words")
SAMPLES = {"fsdd": (1, 2, 5, 10, 20, 50), "hindi-words": (1, 2, 3, 5)}
"""Recordings of a word by each speaker."""
SPEAKERS = (1, 2, 3)
CHOICES = ("euclidean", "knn", "bayes", "hmm", "ptbhmm")
SEEDS = (0, 1, 2)
FEATURE = "hfcc"


def drawn(
    words: Sequence[SpokenWord], train: Sequence[int], persons: Sequence[str], count: int, seed: int
) -> list[int]:
    """`count` recordings of every word by each of `persons`, at random."""
    rng = np.random.default_rng(seed)
    by_word: dict[tuple[str, str], list[int]] = {}
    for i in train:
        if words[i].person in persons:
            by_word.setdefault((words[i].person, words[i].label), []).append(i)
    return sorted(int(i) for own in by_word.values() for i in rng.choice(own, min(count, len(own)), replace=False))


def _run(
    data_dir: Path,
    progress: Progress,
    *,
    data: Sequence[str] = DATA,
    classifier: Sequence[str] = CHOICES,
    takes: int | None = None,
    folds: int | None = None,
) -> dict[str, Any]:
    rows = []
    for name in data:
        words = read_words(data_dir, name, progress, takes)
        frames = all_frames(words, FEATURES[FEATURE], name, progress)
        splits = list(persons_held_out(words))[:folds]
        counts = [count for count in SAMPLES[name] if takes is None or count <= takes]
        total, done = len(classifier) * len(SPEAKERS) * len(counts) * len(splits), 0
        for choice in classifier:
            for num_speakers in SPEAKERS:
                for count in counts:
                    per_fold = {}
                    for person, train, test in splits:
                        # Every choice of speakers once, or one of them for every seed.
                        others = sorted({words[i].person for i in train})
                        groups = list(combinations(others, num_speakers))
                        found = [
                            accuracies(
                                CLASSIFIERS[choice],
                                words,
                                drawn(words, train, groups[seed % len(groups)], count, seed),
                                test,
                                frames,
                                {"": frames},
                            )[""]
                            for seed in SEEDS
                        ]
                        per_fold[person] = float(np.mean(found))
                        done += 1
                        progress(name, done, total)
                    place = {"data": name, "classifier": choice, "speakers": num_speakers, "samples": count}
                    rows.append({**place, **statistics(per_fold)})
    return {"seeds": list(SEEDS), "features": FEATURE, "rows": rows, "passed": None}


STUDIES = (
    Study(
        "training-samples",
        "accuracy for a new speaker against the recordings of each word by each speaker, and the number of speakers, "
        "trained on",
        ("fsdd/recordings", "hindi_words/words"),
        "none: a comparison",
        _run,
        layout=Layout(columns="samples", x="samples", panel="data"),
        axes={"data": DATA, "classifier": CHOICES},
        thins=True,
        sources=(
            "cpp/signal",
            "cpp/features/speech",
            "cpp/models/...",
        ),
        folds=True,
        quick={"data": ("hindi-words",), "classifier": ("euclidean",)},
    ),
)
