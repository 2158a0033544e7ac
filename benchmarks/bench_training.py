# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Processor time of training on many recordings of words, beside a budget; HRI_DATA names the folder of recordings."""

from __future__ import annotations

import time
from dataclasses import replace

import timing
from hri.datasets import Dataset
from hri.media import read_audio
from hri.recognition import WordRecognizer
from hri.studies.word_features import first_takes
from timing import Bench, Timed

DIGITS, COMMANDS = "fsdd/recordings", "commands"
DIGITS_BUDGET_S = 60.0
COMMANDS_BUDGET_S = 120.0
QUICK_SPEAKERS = 4
QUICK_LABELS = 6
ASKED = 50
"""Recordings that the model is asked for, to see that it was trained at all."""


def _recordings(folder: str) -> Dataset:
    """All of them; where only answers are checked, one of each of few words by few speakers."""
    dataset = Dataset.load(timing.need_recordings(folder), "speech")
    if timing.most_repeats is None:
        return dataset
    persons, labels = dataset.persons[:QUICK_SPEAKERS], dataset.labels[:QUICK_LABELS]
    few = [sample for sample in dataset.samples if sample.person in persons and sample.label in labels]
    return first_takes(replace(dataset, samples=few), 1)


def _trained(words: WordRecognizer, folder: str, budget_s: float) -> Timed:
    """Processor seconds of one training, on all processors; reading the recordings does not count."""
    samples = _recordings(folder).samples
    if words.options.front_end == "both":
        timing.need_embedding()
    clips, labels = [read_audio(sample.path) for sample in samples], [sample.label for sample in samples]
    groups = [sample.person for sample in samples]
    began_s, spent_s = time.perf_counter(), time.process_time()
    words.fit(clips, labels, groups=groups, fillers=None if timing.most_repeats is None else ())
    spent_s, took_s = time.process_time() - spent_s, time.perf_counter() - began_s
    asked = range(0, len(clips), max(1, len(clips) // ASKED))
    right = sum(words.recognise(clips[i]).nbest[0].label == labels[i] for i in asked)
    assert right > 0.8 * len(asked), "the models do not know what they were trained on"
    return spent_s, budget_s, {"recordings": float(len(clips)), "wall_clock_s": took_s}


def train_digits() -> Timed:
    """Training on 2000 recordings of ten digits (fsdd) by cepstra: processor time, beside the budget of 60 s."""
    return _trained(WordRecognizer(), DIGITS, DIGITS_BUDGET_S)


def train_digits_both() -> Timed:
    """The same by cepstra and the pretrained speech embedding (extra embedding)."""
    return _trained(WordRecognizer(front_end="both"), DIGITS, DIGITS_BUDGET_S)


def train_commands() -> Timed:
    """Training on 2880 recordings of 40 commands by cepstra: processor time, beside the budget of 120 s."""
    return _trained(WordRecognizer(), COMMANDS, COMMANDS_BUDGET_S)


def train_commands_both() -> Timed:
    """The same by cepstra and the pretrained speech embedding (extra embedding)."""
    return _trained(WordRecognizer(front_end="both"), COMMANDS, COMMANDS_BUDGET_S)


def train_commands_network() -> Timed:
    """The same by both front ends with a network of the same words beside them."""
    return _trained(WordRecognizer(front_end="both", use_network=True), COMMANDS, COMMANDS_BUDGET_S)


BENCHES = [
    Bench("train_digits", train_digits, "60 s budget"),
    Bench("train_digits_both", train_digits_both, "60 s budget"),
    Bench("train_commands", train_commands, "120 s budget"),
    Bench("train_commands_both", train_commands_both, "120 s budget"),
    Bench("train_commands_network", train_commands_network, "120 s budget"),
]
