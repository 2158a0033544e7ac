# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Labelled sequences of frames for studies of sequence models, and their splits by person."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from hri.datasets import Dataset
from hri.datasets.asl_sentences import SignedSentence, read_asl_sentences
from hri.features import CepstraComputer, CepstraOptions
from hri.media import read_audio
from hri.signal import find_speech, resample
from hri.studies.registry import Progress

RATE_HZ = 8000
"""Of all speech: what telephone and narrow-band recordings have in common."""
DELTA_WINDOW = 3
DELTA_WEIGHT = 8.0
"""Velocities are small beside positions; this brings both to the same spread."""


@dataclass(frozen=True)
class Example:
    """One word, said or signed: `frames` has shape (num_frames, num_features)."""

    label: str
    person: str
    frames: NDArray[np.float32]


@dataclass(frozen=True)
class Split:
    """One person held out; the classes are those labels that are trained often enough.

    Attributes
    ----------
    person : str
        Who is held out.
    labels : list of str
        The classes, sorted.
    train : list of list of int
        Indices of the examples of each class, by other persons.
    pool : list of int
        All examples by other persons, also those of rare labels: what codebooks are trained on.
    test : list of int
        The held-out person's examples whose label is a class.
    """

    person: str
    labels: list[str]
    train: list[list[int]]
    pool: list[int]
    test: list[int]


def spoken_words(folder: Path, what: str, progress: Progress) -> list[Example]:
    """Cepstra of every recording: MFCC 0-12 and deltas at 8 kHz, mean and variance normalised, pauses cut."""
    samples = Dataset.load(folder, "speech").samples
    computer = CepstraComputer(CepstraOptions(sample_rate_hz=RATE_HZ, normalisation="mean_variance", delta_orders=1))
    examples = []
    for done, sample in enumerate(samples):
        audio = read_audio(sample.path)
        clip = audio.samples
        if audio.sample_rate_hz != RATE_HZ:
            clip = resample(clip, audio.sample_rate_hz, RATE_HZ)
        bounds = find_speech(clip, RATE_HZ)
        if bounds is not None:
            clip = clip[bounds[0] : bounds[1]]
        examples.append(Example(sample.label, sample.person, computer.compute(clip)))
        progress(f"{what}: reading", done + 1, len(samples))
    return examples


def signed_words(folder: Path) -> list[Example]:
    """Words cut from signed sentences: positions of both hands from the nose, and their velocities."""
    examples = []
    for sentence in read_asl_sentences(folder):
        frames = hand_features(sentence)
        examples += [
            Example(word.label, sentence.signer, frames[word.first : word.last + 1]) for word in sentence.words
        ]
    return examples


def hand_features(sentence: SignedSentence) -> NDArray[np.float32]:
    """Shape (num_frames, 8): x and y of the right and the left hand, then their regression deltas.

    Each sentence is centred on its own mean and divided by the root mean square of its own spread, so that
    neither a signer's size nor the distance of the camera is learned.
    """
    positions = sentence.positions.astype(np.float64)
    hands = np.concatenate([positions[:, 1] - positions[:, 2], positions[:, 0] - positions[:, 2]], axis=1)
    hands -= hands.mean(axis=0)
    spread = float(np.sqrt(np.mean(hands**2)))
    if spread > 0:
        hands /= spread
    return np.concatenate([hands, DELTA_WEIGHT * _deltas(hands, DELTA_WINDOW)], axis=1).astype(np.float32)


def _deltas(rows: NDArray[np.float64], window: int) -> NDArray[np.float64]:
    """Slope of the regression line over `window` rows on each side, edges repeated."""
    padded = np.pad(rows, ((window, window), (0, 0)), mode="edge")
    end = window + len(rows)
    steps = range(1, window + 1)
    slopes = [step * (padded[window + step : end + step] - padded[window - step : end - step]) for step in steps]
    return np.sum(slopes, axis=0) / (2 * sum(step**2 for step in steps))


def splits_by_person(examples: Sequence[Example], least: int) -> Iterator[Split]:
    """Each person held out once. Classes are the labels with at least `least` examples by the others.

    The held-out person's words have no say in what the classes are; words that are no class are not tested,
    because no model could name them.
    """
    for person in sorted({example.person for example in examples}):
        pool = [i for i, example in enumerate(examples) if example.person != person]
        counts = Counter(examples[i].label for i in pool)
        labels = sorted(label for label, count in counts.items() if count >= least)
        yield Split(
            person,
            labels,
            [[i for i in pool if examples[i].label == label] for label in labels],
            pool,
            [i for i, example in enumerate(examples) if example.person == person and example.label in labels],
        )
