# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""From a folder of labelled recordings to a trained recogniser."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from os import PathLike
from typing import overload

import numpy as np

from hri.core.errors import InvalidArgument
from hri.datasets import Dataset
from hri.evaluation.noise import check_noises
from hri.media import read_audio, read_frames
from hri.recognition import FillerWord, GestureRecognizer, SpeechEmbedding, WordRecognizer
from hri.training.choices import choose_options
from hri.training.copies import across_a_room, in_noise

Progress = Callable[[str, int, int], None]


@overload
def train(
    dataset: Dataset | str | PathLike[str],
    recognizer: WordRecognizer,
    *,
    fillers: Sequence[FillerWord] | None = None,
    embedding: SpeechEmbedding | None = None,
    noises: Sequence[str] = (),
    rooms: bool = False,
    progress: Progress | None = None,
) -> WordRecognizer: ...
@overload
def train(
    dataset: Dataset | str | PathLike[str], recognizer: GestureRecognizer, *, progress: Progress | None = None
) -> GestureRecognizer: ...
@overload
def train(
    dataset: Dataset | str | PathLike[str],
    recognizer: WordRecognizer | GestureRecognizer | None = None,
    *,
    fillers: Sequence[FillerWord] | None = None,
    embedding: SpeechEmbedding | None = None,
    noises: Sequence[str] = (),
    rooms: bool = False,
    progress: Progress | None = None,
) -> WordRecognizer | GestureRecognizer: ...
def train(
    dataset: Dataset | str | PathLike[str],
    recognizer: WordRecognizer | GestureRecognizer | None = None,
    *,
    fillers: Sequence[FillerWord] | None = None,
    embedding: SpeechEmbedding | None = None,
    noises: Sequence[str] = (),
    rooms: bool = False,
    progress: Progress | None = None,
) -> WordRecognizer | GestureRecognizer:
    """Train on every recording of `dataset`.

    Parameters
    ----------
    dataset : Dataset or path-like
        Or the folder of one, as `Dataset.load` reads it. Its kind decides what is trained; its persons are held out in
        turn to calibrate confidences.
    recognizer : WordRecognizer or GestureRecognizer, optional
        One with options of its own, trained in place. Otherwise what ``hri train`` makes of these recordings: see
        `choose_options`.
    fillers : sequence of FillerWord, optional
        For words: those outside the vocabulary, as of `WordRecognizer.fit`.
    embedding : SpeechEmbedding, optional
        For words by the front ends "both" and "embedding", as of `WordRecognizer.fit`; without `recognizer` it asks
        for the first of them.
    noises : sequence of str, optional
        For words: train on a copy of every recording in noise too, 0 to 20 dB below the word. Each is "white", "pink"
        or, best, the path of a recording of the place where the recogniser is used; a copy takes one of them.
    rooms : bool
        For words: train on a copy of every recording as heard across a room too, 0.5 to 4 m away, in rooms of many
        kinds (`hri.evaluation.room.AcrossRooms`).
    progress : callable, optional
        Called with (what is being done, steps done, steps in all).

    Returns
    -------
    WordRecognizer or GestureRecognizer

    Raises
    ------
    InvalidArgument
        When `recognizer` is for the other mode, or another kind of recogniser, fillers, an embedding, noises or rooms
        are given for gestures, a noise is none or silent, or training refuses the recordings or the embedding.
    FormatError, IoError
        For a recording that cannot be read; the message names the file.
    """
    given: object = recognizer  # whatever the annotation says
    if not isinstance(given, WordRecognizer | GestureRecognizer | None):
        name = given.__name__ if isinstance(given, type) else type(given).__name__
        raise InvalidArgument(f"recognizer must be a WordRecognizer or a GestureRecognizer, got {name}")
    if isinstance(dataset, str | PathLike):
        dataset = Dataset.load(dataset, None if recognizer is None else recognizer.mode)
    if dataset.kind != "speech":
        copies = (("noises are", noises or None), ("rooms are", rooms or None))
        of_words = (("fillers are", fillers), ("embedding is", embedding), *copies)
        for what, value in of_words:
            if value is not None:
                raise InvalidArgument(f"{what} for speech, the data set is {dataset.kind}")
    check_noises(noises)
    if recognizer is None:
        recognizer = _chosen(dataset, embedding)
    if recognizer.mode != dataset.kind:
        raise InvalidArgument(
            f"the data set {dataset.root} is for {dataset.kind}, the recogniser is for {recognizer.mode}"
        )
    report = progress or (lambda what, done, total: None)
    if isinstance(recognizer, WordRecognizer):
        return _train_words(dataset, recognizer, fillers, embedding, noises, rooms, report)
    return _train_gestures(dataset, recognizer, report)


def _chosen(dataset: Dataset, embedding: SpeechEmbedding | None) -> WordRecognizer | GestureRecognizer:
    given = {} if embedding is None else {"front_end": "both"}
    options = {**given, **choose_options(dataset, given).options}
    return WordRecognizer(**options) if dataset.kind == "speech" else GestureRecognizer(**options)


def fillers_of(dataset: Dataset) -> list[FillerWord]:
    """The recordings of a data set of speech as filler words."""
    words = []
    for sample in dataset.samples:
        audio = read_audio(sample.path)
        words.append(FillerWord(audio.samples, audio.sample_rate_hz, sample.label))
    return words


def _train_words(
    dataset: Dataset,
    recognizer: WordRecognizer,
    fillers: Sequence[FillerWord] | None,
    embedding: SpeechEmbedding | None,
    noises: Sequence[str],
    rooms: bool,
    progress: Progress,
) -> WordRecognizer:
    clips = []
    for done, sample in enumerate(dataset.samples):
        clips.append(read_audio(sample.path))
        progress("reading", done + 1, len(dataset))
    samples = list(dataset.samples)
    seed = recognizer.options.seed
    if noises:
        samples += dataset.samples
        for number, clip in enumerate(clips[: len(dataset)]):
            clips.append(in_noise(clip, noises, np.random.default_rng([seed, number])))
            progress("adding noise", number + 1, len(dataset))
    if rooms:
        samples += dataset.samples
        for number, clip in enumerate(clips[: len(dataset)]):
            clips.append(across_a_room(clip, np.random.default_rng([seed, number, 1])))
            progress("adding rooms", number + 1, len(dataset))
    return recognizer.fit(
        clips,
        [s.label for s in samples],
        groups=[s.person for s in samples],
        recordings=[str(number % len(dataset)) for number in range(len(samples))],
        fillers=fillers,
        embedding=embedding,
        progress=lambda done, total: progress("training", done, total),
    )


def _train_gestures(dataset: Dataset, recognizer: GestureRecognizer, progress: Progress) -> GestureRecognizer:
    # Only the features of a clip are kept, so that a folder of videos need not fit in memory.
    rows = []
    untrained = recognizer.untrained()  # one that is trained sees by the options of its training
    for done, sample in enumerate(dataset.samples):
        rows.append(untrained.features(read_frames(sample.path).frames))
        progress("finding hands", done + 1, len(dataset))
    return recognizer.fit_features(
        rows,
        [s.label for s in dataset.samples],
        groups=[s.person for s in dataset.samples],
        progress=lambda done, total: progress("training", done, total),
    )
