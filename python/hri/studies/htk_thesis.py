# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Words by HTK's way of training and recognition as in section 6.1 of the thesis: figures 6.3 to 6.7."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import InvalidArgument
from hri.datasets import Dataset
from hri.htk import Dictionary, FeatureExtractor, FlatStart, ModelSet, Recognizer, WordLattice, train_model
from hri.media import read_audio
from hri.signal import find_speech
from hri.studies.registry import Layout, Progress, Study
from hri.studies.sweeps import SEED
from hri.studies.tables import Row, statistics
from hri.studies.word_features import WORD_FOLDERS

KINDS = {"MFCC": "MFCC_E_D_A", "LPCC": "LPCEPSTRA_E_D_A", "LPC": "LPC_E_D_A"}
DEPENDENT, INDEPENDENT = "speaker dependent", "speaker independent"
MAX_SPEAKERS = 5
NUM_STATES = 8
FLOOR = 0.01
"""Least variance, as a share of that of all frames."""
MARGIN_S = 0.03
"""Kept before and after the end points, as labels set by hand keep it."""
FOLDERS = {"commands": "commands", **{name: WORD_FOLDERS[name] for name in ("hindi-digits", "hindi-words")}}
"""The Hindi sets stay apart: who is called speaker2 in one of them is not the speaker2 of the other."""


@dataclass(frozen=True)
class _Word:
    label: str
    person: str
    take: int
    frames: dict[str, NDArray[np.float32]]
    """By kind of feature."""


@dataclass(frozen=True)
class _Group:
    """Speakers that are trained on, and one who is not; None where all are."""

    name: str
    train: tuple[str, ...]
    stranger: str | None


def _read(data_dir: Path, data: str, kinds: Sequence[str], progress: Progress) -> list[_Word]:
    """The words between their end points."""
    samples = Dataset.load(data_dir / FOLDERS[data], "speech").samples
    met: dict[tuple[str, str], int] = {}
    words = []
    for done, sample in enumerate(samples):
        audio = read_audio(sample.path)
        rate_hz, clip = audio.sample_rate_hz, audio.samples
        bounds = find_speech(clip, rate_hz)
        if bounds is not None:
            margin = round(MARGIN_S * rate_hz)
            clip = clip[max(0, bounds[0] - margin) : bounds[1] + margin]
        frames = {kind: FeatureExtractor(KINDS[kind], rate_hz).compute(clip) for kind in kinds}
        take = met[sample.person, sample.label] = met.get((sample.person, sample.label), -1) + 1
        words.append(_Word(sample.label, sample.person, take, frames))
        progress(f"{data}: reading", done + 1, len(samples))
    return words


def _groups(persons: Sequence[str], size: int) -> list[_Group]:
    """Groups of so many speakers: of many speakers those apart from each other, of few each with those that follow."""
    block = MAX_SPEAKERS + 1
    order = [persons[i] for i in np.random.default_rng(SEED).permutation(len(persons))]
    if len(order) >= 2 * block:
        blocks = [order[first : first + block] for first in range(0, len(order) - block + 1, block)]
    else:
        blocks = [order[first:] + order[:first] for first in range(len(order))]
    return [
        _Group(f"with {names[0]}", tuple(names[:size]), names[-1] if size < len(names) else None)
        for names in blocks
        if size <= len(names)
    ]


def _accuracy(train: Sequence[_Word], test: Sequence[_Word], kind: str) -> float:
    """Share of words that HTK's decoder, in a grammar of single words, names rightly."""
    labels = sorted({word.label for word in train})
    start = FlatStart()
    for word in train:
        start.add(word.frames[kind])
    models = ModelSet(KINDS[kind])
    models.parse(start.variance_floors(FLOOR).to_text(), "floors")
    for label in labels:
        own = [word.frames[kind] for word in train if word.label == label and len(word.frames[kind]) >= NUM_STATES]
        if not own:
            raise InvalidArgument(f"no recording of {label!r} has {NUM_STATES} frames")
        train_model(models, label, own, NUM_STATES)
    dictionary = Dictionary.parse("".join(f'"{label}" "{label}"\n' for label in labels), "words")
    recognizer = Recognizer(models, dictionary, WordLattice.of_grammar(f"( {' | '.join(labels)} )", "grammar"))
    right = 0
    for word in test:
        if len(word.frames[kind]) >= NUM_STATES:  # a shorter one goes through no model, and counts as wrong
            right += [one.output for one in recognizer.recognise(word.frames[kind]).words] == [word.label]
    return right / len(test)


def _dependent(words: Sequence[_Word], group: _Group, kind: str) -> float:
    """Each take left out in turn."""
    own = [word for word in words if word.person in group.train]
    takes = sorted({word.take for word in own})
    parts = [([w for w in own if w.take != take], [w for w in own if w.take == take]) for take in takes]
    return float(np.mean([_accuracy(train, test, kind) for train, test in parts]))


def _run(
    data_dir: Path, progress: Progress, *, data: Sequence[str] = tuple(FOLDERS), features: Sequence[str] = tuple(KINDS)
) -> dict[str, Any]:
    rows: list[Row] = []
    for name in data:
        words = _read(data_dir, name, features, progress)
        persons = sorted({word.person for word in words})
        for size in range(1, min(MAX_SPEAKERS, len(persons)) + 1):
            groups = _groups(persons, size)
            for kind in features:
                found: dict[str, dict[str, float]] = {DEPENDENT: {}, INDEPENDENT: {}}
                for done, group in enumerate(groups):
                    found[DEPENDENT][group.name] = _dependent(words, group, kind)
                    if group.stranger is not None:
                        train = [word for word in words if word.person in group.train]
                        test = [word for word in words if word.person == group.stranger]
                        found[INDEPENDENT][group.name] = _accuracy(train, test, kind)
                    progress(f"{name}: {kind}, {size} speakers", done + 1, len(groups))
                rows += [
                    {"data": name, "test": test, "features": kind, "speakers": size, **statistics(shares)}
                    for test, shares in found.items()
                    if shares
                ]
    return {"seed": SEED, "kinds": KINDS, "num_states": NUM_STATES, "rows": rows, "passed": None}


STUDIES = (
    Study(
        "htk-thesis",
        "figures 6.3 to 6.7 of the thesis: words by HTK's training and decoder (init, rest, vite), MFCC, LPCC and LPC, "
        "1 to 5 speakers trained on, the same speakers and others tested",
        tuple(FOLDERS.values()),
        "a table and plot beside the thesis's",
        _run,
        Layout(columns="speakers", x="speakers", panel="data"),
        axes={"data": tuple(FOLDERS), "features": tuple(KINDS)},
        sources=("cpp/htk", "cpp/models/hmm", "cpp/language"),
        quick={"data": ("hindi-words",), "features": ("MFCC",)},
    ),
)
