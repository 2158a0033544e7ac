# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Does a wavelet help? Levels of the approximation (thesis section 6.2.2) and wavelets, clean and in noise."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import product
from pathlib import Path
from typing import Any

from hri.evaluation import AddNoise
from hri.evaluation.conditions import Condition
from hri.studies.classifiers import accuracies, persons_held_out
from hri.studies.noise import noise_paths
from hri.studies.registry import Layout, Progress, Study, within
from hri.studies.tables import Row, statistics
from hri.studies.word_classifiers import CLASSIFIERS
from hri.studies.word_features import (
    HFCC,
    FeatureKind,
    SpokenWord,
    all_frames,
    approximation_kind,
    read_words,
    shrinkage_kind,
)

DATA = ("fsdd", "hindi-words")
WAVELETS = ("haar", "db2", "db6", "sym8")
LEVELS = (1, 2, 3, 4)
CHOICES = ("bayes", "hmm")
SNR_DB = 10.0
NOISES = ("white", "pink")
METHODS: dict[str, Callable[[str, int, dict[str, Any]], FeatureKind]] = {
    "approximation": approximation_kind,
    "shrinkage": shrinkage_kind,
}
"""Both readings of noise reduction; each gives a kind of features from (wavelet, level, options of the cepstra)."""


def _measure(
    kind: FeatureKind, heard: dict[str, list[SpokenWord]], classifier: Sequence[str], progress: Progress
) -> dict[tuple[str, str], Row]:
    """By classifier and condition; trained on clean words."""
    frames = {
        condition_name: all_frames(clips, kind, condition_name, progress) for condition_name, clips in heard.items()
    }
    words = heard["clean"]
    folds = list(persons_held_out(words))
    measured: dict[tuple[str, str], Row] = {}
    for choice in classifier:
        per_fold: dict[str, dict[str, float]] = {condition_name: {} for condition_name in heard}
        for done, (person, train, test) in enumerate(folds):
            found = accuracies(CLASSIFIERS[choice], words, train, test, frames["clean"], frames)
            for condition_name, share in found.items():
                per_fold[condition_name][person] = share
            progress(choice, done + 1, len(folds))
        measured |= {(choice, condition_name): statistics(shares) for condition_name, shares in per_fold.items()}
    return measured


def _run(
    data_dir: Path,
    progress: Progress,
    *,
    data: Sequence[str] = DATA,
    method: Sequence[str] = tuple(METHODS),
    wavelet: Sequence[str] = WAVELETS,
    classifier: Sequence[str] = CHOICES,
    takes: int | None = None,
) -> dict[str, Any]:
    paths = noise_paths(data_dir)
    conditions: dict[str, Condition | None] = {"clean": None}
    conditions |= {f"{name} {SNR_DB:g} dB": AddNoise([paths[name]], [SNR_DB]) for name in NOISES}
    rows = []
    for name in data:
        heard = {
            condition_name: read_words(data_dir, name, progress, takes, condition)
            for condition_name, condition in conditions.items()
        }
        plain = _measure(FeatureKind(HFCC), heard, classifier, within(progress, name))
        for how, family in product(method, wavelet):
            by_level = {0: plain}
            for level in LEVELS:
                kind = METHODS[how](family, level, HFCC)
                by_level[level] = _measure(kind, heard, classifier, within(progress, f"{name}, {family} {level}"))
            for choice, condition_name in plain:
                place = {"data": name, "classifier": choice, "noise": condition_name, "method": how, "wavelet": family}
                rows += [
                    {**place, "level": level, **found[choice, condition_name]} for level, found in by_level.items()
                ]
    return {"seed": 0, "snr_db": SNR_DB, "rows": rows, "passed": None}


STUDIES = (
    Study(
        "wavelet-levels",
        "HFCC of words by wavelet and level (thesis section 6.2.2), 0 (none) to 4 of 16 kHz: of the approximation, "
        "and after shrinkage of the details; trained clean, tested clean and in noise at 10 dB; one speaker held out",
        ("fsdd/recordings", "hindi_words/words", "noise"),
        "none: a comparison",
        _run,
        layout=Layout(columns="level", x="level", panel="noise"),
        axes={"data": DATA, "method": tuple(METHODS), "wavelet": WAVELETS, "classifier": CHOICES},
        thins=True,
        sources=(
            "cpp/signal",
            "cpp/features/speech",
            "cpp/models/...",
        ),
        quick={"data": ("hindi-words",), "method": ("shrinkage",), "wavelet": ("db6",), "classifier": ("hmm",)},
    ),
)
