# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Words that were never recorded: by their spelling and units of other words, beside synthetic voices that say them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from copy import copy
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from hri.datasets import Dataset
from hri.media import read_audio
from hri.recognition import SubwordRecognizer, WordRecognizer
from hri.studies.clips import Clip, read_clips
from hri.studies.registry import WORD_SOURCES, Layout, Progress, Study, within
from hri.studies.synthetic_speakers import WORDS
from hri.studies.tables import Row, further_statistics, statistics
from hri.studies.word_features import WORD_FOLDERS
from hri.synthetic.speech import make_speech_corpus

OTHER_WORDS = {"fsdd": "other_words"}
"""Where more words of the language are by other people, which units are trained on, too. The Hindi sets are not each
other's: who is left out of one may be in the other under another name."""
RECORDINGS = (0, 1, 3)
ADDED = 3
"""Words of the ten that are left out and added, together; so many for each of GROUPS."""
GROUPS = 2
MOST_TAKES = 5
"""Recordings of a word by a speaker that units are trained on; of as many others a speaker is tested."""
VOICES = 24
SEED = 0
UNITS, NO_BONUS, WORD_MODELS, ALONE = "units", "units, no bonus", "word models", "synthetic voices alone"


@dataclass(frozen=True)
class _Fold:
    """Clips of one speaker held out, and the words added for it."""

    added: list[str]
    train: list[Clip]
    test: list[Clip]
    own: dict[str, list[Clip]]


def _other_clips(data_dir: Path, name: str) -> tuple[list[Clip], dict[str, str]]:
    """Recordings of other words in the same language, and how these are written."""
    if name not in OTHER_WORDS:
        return [], {}
    samples = Dataset.load(data_dir / OTHER_WORDS[name], "speech").samples
    clips = [(sample.label, sample.person, read_audio(sample.path)) for sample in samples]
    return clips, {label: label for label, _, _ in clips}


def _folds(clips: Sequence[Clip]) -> Iterator[tuple[str, _Fold]]:
    """By speaker and by group of words left out; in all, every word is left out for some speaker."""
    labels = sorted({label for label, _, _ in clips})
    takes: dict[tuple[str, str], list[Clip]] = {}
    for clip in clips:
        takes.setdefault((clip[1], clip[0]), []).append(clip)
    keep = max(RECORDINGS)
    for number, person in enumerate(sorted({who for who, _ in takes})):
        own = {label: of_word for (who, label), of_word in takes.items() if who == person}
        test = [clip for of_word in own.values() for clip in of_word[keep : keep + MOST_TAKES]]
        for group in range(GROUPS):
            first = ADDED * number + len(labels) // GROUPS * group
            added = [labels[(first + i) % len(labels)] for i in range(ADDED)]
            train = [
                clip
                for (who, label), of_word in takes.items()
                if who != person and label not in added
                for clip in of_word[:MOST_TAKES]
            ]
            yield person, _Fold(added, train, test, {label: own[label][:keep] for label in added})


def _shares(words: WordRecognizer | SubwordRecognizer, fold: _Fold) -> Row:
    """Of added words, of the others, and of all, the share recognised; rejected ones count by their best label."""
    truth = np.asarray([label for label, _, _ in fold.test])
    right = words.predict([sound for _, _, sound in fold.test]) == truth
    is_added = np.isin(truth, fold.added)
    return {
        "added": float(np.mean(right[is_added])),
        "others": float(np.mean(right[~is_added])),
        "all": float(np.mean(right)),
    }


def _fit(words: Any, clips: Sequence[Clip], **options: Any) -> Any:
    return words.fit(
        [sound for _, _, sound in clips],
        [label for label, _, _ in clips],
        groups=[person for _, person, _ in clips],
        **options,
    )


def _of_units(
    fold: _Fold, more: Sequence[Clip], language: str, spellings: dict[str, str]
) -> Iterator[tuple[tuple[str, int], Row]]:
    clips = [*fold.train, *more]
    # Nothing is rejected here, so no speaker needs to be held out for a threshold.
    base = _fit(SubwordRecognizer(num_folds=0), clips, language=language, spellings=spellings)
    for label in sorted({label for label, _, _ in more} - {label for label, _, _ in fold.train}):
        base.remove_word(label)
    for count in RECORDINGS:
        words = copy(base)
        for label in fold.added:
            own = [sound for _, _, sound in fold.own[label][:count]]
            words.add_word(label, spellings[label], language=language, clips=own)
        yield (UNITS, count), _shares(words, fold)
        if count == 0:
            yield (NO_BONUS, count), _shares(_without_bonus(words), fold)


def _without_bonus(words: SubwordRecognizer) -> SubwordRecognizer:
    file = words.to_model_file()
    plain = copy(words)
    file.set_number("unrecorded_bonus", 0.0)
    plain._native = words._native_class.from_model_file(file)
    return plain


def _of_word_models(fold: _Fold) -> Iterator[tuple[tuple[str, int], Row]]:
    base = _fit(WordRecognizer(), fold.train, fillers=[])
    for count in RECORDINGS[1:]:
        words = copy(base)
        for label in fold.added:
            words.add_word(label, [sound for _, _, sound in fold.own[label][:count]])
        yield (WORD_MODELS, count), _shares(words, fold)


def _by_voices(words: dict[str, dict[str, str]], progress: Progress) -> WordRecognizer:
    """Trained on synthetic voices alone, of all words."""
    with TemporaryDirectory() as folder:
        made = make_speech_corpus(folder, words, VOICES, 1, SEED, partial(progress, "speaking"))
        clips = [(sample.label, sample.person, read_audio(sample.path)) for sample in made.samples]
    trained: WordRecognizer = _fit(WordRecognizer(), clips, fillers=[])
    return trained


def _rows(found: dict[tuple[str, int], dict[str, list[Row]]], name: str) -> Iterator[Row]:
    """Means over the groups of words of a speaker, then over speakers."""
    for (method, count), by_person in found.items():
        row: Row = {"data": name, "method": method, "recordings": count}
        for measure in ("added", "others", "all"):
            shares = {person: float(np.mean([one[measure] for one in ones])) for person, ones in by_person.items()}
            row |= statistics(shares, measure) if measure == "added" else further_statistics(shares, measure)
        yield row


def _run(data_dir: Path, progress: Progress, *, data: Sequence[str] = tuple(WORDS), folds: int | None = None) -> Any:
    rows: list[Row] = []
    for name in data:
        say = within(progress, name)
        ((language, spellings),) = WORDS[name].items()
        clips = read_clips(data_dir, name, say)
        others, other_spellings = _other_clips(data_dir, name)
        voices = _by_voices(WORDS[name], say)
        found: dict[tuple[str, int], dict[str, list[Row]]] = {}
        splits = list(_folds(clips))[: None if folds is None else GROUPS * folds]
        for done, (person, fold) in enumerate(splits):
            cells = [
                *_of_units(fold, others, language, {**other_spellings, **spellings}),
                *_of_word_models(fold),
                ((ALONE, 0), _shares(voices, fold)),
            ]
            for key, shares in cells:
                found.setdefault(key, {}).setdefault(person, []).append(shares)
            say(person, done + 1, len(splits))
        rows += _rows(found, name)
    best = {row["data"]: row["added_mean"] for row in rows if row["method"] == UNITS and row["recordings"] == 0}
    beside = {row["data"]: row["added_mean"] for row in rows if row["method"] == ALONE}
    return {
        "seed": SEED,
        "added_words": ADDED,
        "voices": VOICES,
        "rows": rows,
        "passed": all(best[name] > beside[name] for name in best),
    }


STUDIES = (
    Study(
        "new-words",
        "words never recorded, added by their spelling to units of other words by other speakers, with 0, 1 and "
        "3 recordings by the user; beside synthetic voices and models of whole words; leave one of 4 speakers out",
        (*(WORD_FOLDERS[name] for name in WORDS), *OTHER_WORDS.values()),
        "without recordings, a larger share of the new words than a recogniser trained on synthetic voices alone",
        _run,
        layout=Layout(columns="recordings", x="recordings", panel="data", measure="added"),
        axes={"data": tuple(WORDS)},
        sources=(*WORD_SOURCES, "cpp/recognition/subword", "cpp/htk"),
        folds=True,
        quick={"data": ("hindi-words",)},
    ),
)
