# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""A word added to a trained recogniser from few recordings, by the user or by others."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from copy import copy
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from hri.recognition import WordRecognizer
from hri.recognition.decision import RECOGNISED
from hri.studies.clips import Clip, fit_clips, read_clips
from hri.studies.registry import WORD_SOURCES, Layout, Progress, Study, within
from hri.studies.tables import Row, further_statistics, statistics
from hri.studies.word_features import WORD_FOLDERS

DATA = ("fsdd", "hindi-words")
MODELS = ("hmm", "ptbhmm")
SAMPLES = (1, 2, 3, 5, 10)
MOST_TAKES = 12
"""Recordings of a word by a speaker that are trained on; of as many others a speaker is tested."""
WORDS = 3
"""Words added for each speaker, one at a time."""
SEED = 0


@dataclass(frozen=True)
class Split:
    """Clips of one speaker held out.

    Attributes
    ----------
    train : list of Clip
        By the other speakers.
    test : list of Clip
        By this one.
    own : list of Clip
        By this one too: what a user can add words from, and not tested.
    """

    person: str
    train: list[Clip]
    test: list[Clip]
    own: list[Clip]


def _splits(clips: Sequence[Clip]) -> Iterator[Split]:
    """Each speaker held out; what a user adds words from comes out of at most half of the recordings of a word."""
    rng = np.random.default_rng(SEED)
    takes: dict[tuple[str, str], list[Clip]] = {}
    for clip in clips:
        takes.setdefault((clip[1], clip[0]), []).append(clip)
    for own in takes.values():
        rng.shuffle(own)
    for person in sorted({who for who, _ in takes}):
        split = Split(person, [], [], [])
        for (who, _), of_word in takes.items():
            if who != person:
                split.train.extend(of_word[:MOST_TAKES])
                continue
            kept = min(max(SAMPLES), (len(of_word) + 1) // 2)
            split.own.extend(of_word[:kept])
            split.test.extend(of_word[kept : kept + MOST_TAKES])
        yield split


def _by_turns(clips: Sequence[Clip]) -> list[Clip]:
    """The first clip of every speaker, then the second, and so on."""
    seen: dict[str, int] = {}
    turns = []
    for clip in clips:
        seen[clip[1]] = seen.get(clip[1], 0) + 1
        turns.append(seen[clip[1]])
    return [clips[i] for i in sorted(range(len(clips)), key=lambda i: turns[i])]


def _measure(words: WordRecognizer, clips: Sequence[Clip], label: str) -> Row:
    """Shares of the clips of `label`, and of the others.

    "added" and "others" count the best label, rejected or not; with "_right" what is recognised, and rightly;
    "rejected" counts clips of `label`.
    """
    best: dict[bool, list[bool]] = {True: [], False: []}
    right: dict[bool, list[bool]] = {True: [], False: []}
    rejected = []
    for said, _, sound in clips:
        decision = words.recognise(sound.samples, sound.sample_rate_hz)
        best[said == label].append(bool(decision.nbest) and decision.nbest[0].label == said)
        right[said == label].append(decision.label == said)
        if said == label:
            rejected.append(decision.status != RECOGNISED)
    return {
        "added": float(np.mean(best[True])),
        "others": float(np.mean(best[False])),
        "added_right": float(np.mean(right[True])),
        "others_right": float(np.mean(right[False])),
        "rejected": float(np.mean(rejected)),
    }


def _of_word(split: Split, label: str, model: str) -> Iterator[tuple[tuple[str, int], Row]]:
    """What was measured by (source, recordings) when `label` was left out of training and added."""
    known = fit_clips([clip for clip in split.train if clip[0] != label], model)
    before = _measure(known, split.test, label)
    yield ("not added", 0), {measure: before[measure] for measure in ("others", "others_right")}
    pools = {"user": split.own, "others": _by_turns(split.train)}
    for source, clips in pools.items():
        sounds = [sound for said, _, sound in clips if said == label]
        for count in SAMPLES:
            if count > len(sounds):
                continue
            extended = copy(known).add_word(
                label,
                [sound.samples for sound in sounds[:count]],
                [sound.sample_rate_hz for sound in sounds[:count]],
            )
            yield (source, count), _measure(extended, split.test, label)


def _rows(found: Mapping[tuple[str, int], Mapping[str, Sequence[Row]]], place: Row) -> Iterator[Row]:
    """Means over the words of a speaker, then over speakers."""
    for (source, count), by_person in found.items():
        row = {**place, "source": source, "samples": count}
        for measure in ("added", "others", "added_right", "others_right", "rejected"):
            shares = {
                person: float(np.mean([one[measure] for one in ones]))
                for person, ones in by_person.items()
                if measure in ones[0]
            }
            if shares:
                row |= statistics(shares, measure) if measure == "added" else further_statistics(shares, measure)
        yield row


def _run(
    data_dir: Path,
    progress: Progress,
    *,
    data: Sequence[str] = DATA,
    model: Sequence[str] = MODELS,
    takes: int | None = None,
    folds: int | None = None,
) -> dict[str, Any]:
    rows: list[Row] = []
    for name in data:
        say = within(progress, name)
        splits = list(_splits(read_clips(data_dir, name, say, takes)))[:folds]
        labels = sorted({label for label, _, _ in splits[0].train})
        for kind in model:
            found: dict[tuple[str, int], dict[str, list[Row]]] = {}
            for number, split in enumerate(splits):
                # Other words for every speaker, so that together they are (almost) all.
                chosen = [labels[(WORDS * number + i) % len(labels)] for i in range(WORDS)]
                full = fit_clips(split.train, kind)
                for done, label in enumerate(chosen):
                    count = sum(said == label for said, _, _ in split.train)
                    cells = [*_of_word(split, label, kind), (("training", count), _measure(full, split.test, label))]
                    for key, measured in cells:
                        found.setdefault(key, {}).setdefault(split.person, []).append(measured)
                    say(f"{kind}, {split.person}", done + 1, len(chosen))
            rows += _rows(found, {"data": name, "model": kind})
    return {"seed": SEED, "words_per_speaker": WORDS, "most_takes": MOST_TAKES, "rows": rows, "passed": None}


STUDIES = (
    Study(
        "few-samples",
        "a word added to a trained recogniser from 1 to 10 recordings, by the user himself or by others, against "
        "training with it; leave one of 4 speakers out",
        tuple(WORD_FOLDERS[name] for name in DATA),
        "none: a comparison",
        _run,
        layout=Layout(x="samples", panel="data", measure="added"),
        axes={"data": DATA, "model": MODELS},
        thins=True,
        sources=WORD_SOURCES,
        folds=True,
        quick={"data": ("hindi-words",)},
    ),
)
