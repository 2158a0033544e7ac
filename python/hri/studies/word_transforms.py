# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Hidden Markov models of words on transformed frames, trained to make few errors, and on a speech embedding."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.datasets import Dataset
from hri.media import read_audio
from hri.models import GaussianMixtureHmm, GaussianMixtureHmmOptions, Topology
from hri.recognition import SpeechEmbedding
from hri.signal import find_speech, resample
from hri.studies.commands import FOLDER, NUM_FOLDS
from hri.studies.frame_transforms import (
    StateMoments,
    apply,
    fit_discriminants,
    fit_heteroscedastic,
    with_neighbours,
    with_third_differences,
)
from hri.studies.minimum_error import train_minimum_error
from hri.studies.registry import Layout, Progress, Study
from hri.studies.sweeps import SEED
from hri.studies.tables import statistics
from hri.studies.word_features import FEATURES, NUM_CEPSTRA, RATE_HZ, Frames, first_takes

MARGIN_S = 0.06
"""Kept on either side of a word, as the recogniser does."""
QUIET_S = 0.6
"""Of near silence on either side, for the embedding, which hears 0.775 s at a time."""
QUIET_LEVEL = 1e-4
NUM_STATES = 8
NUM_EMBEDDING_STATES = 6
NUM_GAUSSIANS = 2
MAX_ITERATIONS = 12
REACH = 4
"""Frames on either side that are put beside each before LDA."""
NUM_STATIC = 1 + NUM_CEPSTRA
NUM_KEPT = 3 * NUM_STATIC
"""As many as cepstra with deltas and accelerations have."""

Models = list[GaussianMixtureHmm]
States = list[NDArray[np.int64]]


@dataclass(frozen=True)
class Words:
    """Training and test words as frames."""

    train: list[Frames]
    classes: list[int]
    test: list[Frames]

    def moments(self, states: States) -> StateMoments:
        """Of the training words."""
        return StateMoments.of(self.train, states)

    def through(self, basis: NDArray[np.float64]) -> Words:
        """All frames in the space of the rows of `basis`."""
        return Words(apply(basis, self.train), self.classes, apply(basis, self.test))

    def each(self, change: Callable[[Frames], Frames]) -> Words:
        """All words changed."""
        return Words([change(own) for own in self.train], self.classes, [change(own) for own in self.test])


def train_models(words: Words, num_states: int = NUM_STATES) -> Models:
    """One left-right HMM a class."""
    topology = Topology(kind="left_right", num_states=num_states, max_jump=1)
    options = GaussianMixtureHmmOptions(topology=topology, num_mixtures=NUM_GAUSSIANS, max_iterations=MAX_ITERATIONS)
    by_class: list[list[Frames]] = [[] for _ in range(1 + max(words.classes))]
    for own, label in zip(words.train, words.classes, strict=True):
        by_class[label].append(own)
    return [GaussianMixtureHmm.train(own, options) for own in by_class]


def states_of(models: Models, words: Words) -> States:
    """The state of every training frame on its own word's best path, numbered over all words."""
    return [
        np.asarray(models[label].viterbi(own)[1], np.int64) + NUM_STATES * label
        for own, label in zip(words.train, words.classes, strict=True)
    ]


def even_states(words: Words) -> States:
    """States of equal length, numbered over all words."""
    return [
        np.arange(len(own)) * NUM_EMBEDDING_STATES // len(own) + NUM_EMBEDDING_STATES * label
        for own, label in zip(words.train, words.classes, strict=True)
    ]


def predict(models: Models, frames: Sequence[Frames]) -> NDArray[np.int64]:
    """The class of the likeliest model."""
    return np.array([np.argmax([model.log_likelihood(own) for model in models]) for own in frames])


def _with_cepstra(method: str, words: Words) -> tuple[Models, Words]:
    plain = train_models(words)
    if method == "mfcc":
        return plain, words
    if method == "mce":
        return train_minimum_error(plain, words.train, words.classes), words
    states = states_of(plain, words)
    if method == "hlda":
        longer = words.each(lambda own: with_third_differences(own, NUM_STATIC))
        moments = longer.moments(states)
        basis = fit_heteroscedastic(moments, NUM_KEPT, fit_discriminants(moments))[:NUM_KEPT]
        found = longer.through(basis)
    else:
        wider = words.each(lambda own: with_neighbours(own, NUM_STATIC, REACH))
        found = wider.through(fit_discriminants(wider.moments(states))[:NUM_KEPT])
        if method == "lda+mllt":
            found = found.through(fit_heteroscedastic(found.moments(states), NUM_KEPT, np.eye(NUM_KEPT)))
    return train_models(found), found


def _with_embedding(words: Words) -> tuple[Models, Words]:
    found = words.through(fit_discriminants(words.moments(even_states(words)))[:NUM_KEPT])
    return train_models(found, NUM_EMBEDDING_STATES), found


METHODS = ("mfcc", "lda", "lda+mllt", "hlda", "mce", "embedding")


def _read(path: Path) -> NDArray[np.float32]:
    """The word and a margin, at 16 kHz."""
    audio = read_audio(path)
    first, last = find_speech(audio.samples, audio.sample_rate_hz) or (0, len(audio.samples))
    margin = round(MARGIN_S * audio.sample_rate_hz)
    return np.asarray(
        resample(audio.samples[max(0, first - margin) : last + margin], audio.sample_rate_hz, RATE_HZ), np.float32
    )


def _embedded(embedding: SpeechEmbedding, samples: NDArray[np.float32], seed: int) -> Frames:
    quiet = round(QUIET_S * RATE_HZ)
    padded = np.random.default_rng([SEED, seed]).normal(0, QUIET_LEVEL, len(samples) + 2 * quiet).astype(np.float32)
    padded[quiet : quiet + len(samples)] += samples
    return embedding.sequence(padded, RATE_HZ)


def _run(
    data_dir: Path,
    progress: Progress,
    *,
    method: Sequence[str] = METHODS,
    takes: int | None = None,
    folds: int | None = None,
) -> dict[str, Any]:
    dataset = first_takes(Dataset.load(data_dir / FOLDER, "speech"), takes)
    embedding = SpeechEmbedding() if "embedding" in method else None
    cepstra: list[Frames] = []
    embedded: list[Frames] = []
    for done, sample in enumerate(dataset.samples):
        samples = _read(Path(sample.path))
        cepstra.append(FEATURES["mfcc"].frames(samples, RATE_HZ / 2))
        if embedding is not None:
            embedded.append(_embedded(embedding, samples, done))
        progress("reading", done + 1, len(dataset.samples))
    classes = [dataset.labels.index(sample.label) for sample in dataset.samples]
    right: dict[str, dict[str, float]] = {name: {} for name in method}
    for fold in dataset.folds_by_person(NUM_FOLDS, SEED)[:folds]:
        for done, name in enumerate(method):
            of_all = embedded if name == "embedding" else cepstra
            words = Words(
                [of_all[i] for i in fold.train], [classes[i] for i in fold.train], [of_all[i] for i in fold.test]
            )
            models, words = _with_embedding(words) if name == "embedding" else _with_cepstra(name, words)
            truth = np.array([classes[i] for i in fold.test])
            right[name][fold.name] = float(np.mean(predict(models, words.test) == truth))
            progress(f"without {fold.name}", done + 1, len(method))
    rows = [{"method": name, **statistics(shares)} for name, shares in right.items()]
    return {"seed": SEED, "rows": rows, "passed": None}


STUDIES = (
    Study(
        "word-transforms",
        "40 spoken commands, six groups of speakers left out in turn, by one HMM a word: on MFCC, after linear "
        "discriminants (LDA), MLLT and HLDA, after minimum classification error training (MCE), and on the sequence of "
        "the speech embedding (extra embedding); in quiet",
        (FOLDER,),
        "none: a comparison",
        _run,
        Layout(),
        axes={"method": METHODS},
        thins=True,
        sources=(
            "cpp/signal",
            "cpp/features/speech",
            "cpp/models/...",
            "cpp/recognition/word",
        ),
        folds=True,
    ),
)
