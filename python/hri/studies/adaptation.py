# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Adaptation of a trained recogniser to an unseen speaker from a few words, supervised and unsupervised."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from hri.core.errors import InvalidArgument
from hri.recognition import SpeakerAdapter, WordRecognizer
from hri.studies.clips import Clip, fit_clips, read_clips
from hri.studies.registry import WORD_SOURCES, Layout, Progress, Study, within
from hri.studies.tables import Row, by_fold, statistics
from hri.studies.word_features import WORD_FOLDERS

DATA = tuple(WORD_FOLDERS)
WORDS = (5, 10, 20)
LEARNING = ("supervised", "unsupervised")
DRAWS = 5
"""Times that the words to learn from are drawn for every speaker."""
SEED = 0

Shares = dict[str, float]
"""By measure."""


def _draw(clips: Sequence[Clip], rng: np.random.Generator) -> list[int]:
    """Places of the most clips learned from, in random order: one of every label before the second of any."""
    waiting: dict[str, list[int]] = {}
    for place in rng.permutation(len(clips)).tolist():
        waiting.setdefault(clips[place][0], []).append(place)
    rounds = range(max(map(len, waiting.values())))
    return [places[n] for n in rounds for places in waiting.values() if n < len(places)][: max(WORDS)]


def _adapted(words: WordRecognizer, clips: Sequence[Clip], supervised: bool) -> WordRecognizer:
    adapter = SpeakerAdapter(words)
    for label, _, sound in clips:
        if supervised:
            adapter.learn(sound, label)
        else:
            adapter.recognise(sound.samples, sound.sample_rate_hz, update=False)
    adapter.update()
    return adapter.recognizer


def _shares(words: WordRecognizer, clips: Sequence[Clip]) -> Shares:
    """Those of the clips whose best label is what was said, and that were recognised as it."""
    best = right = 0
    for label, _, sound in clips:
        decision = words.recognise(sound.samples, sound.sample_rate_hz)
        best += bool(decision.nbest) and decision.nbest[0].label == label
        right += decision.label == label
    return {"accuracy": best / len(clips), "right": right / len(clips)}


def _of_speaker(
    words: WordRecognizer, clips: Sequence[Clip], learning: Sequence[str], number: int
) -> dict[tuple[str, int], Shares]:
    """Shares by (learning, words learned from), over the draws; every draw is tested on the clips it leaves."""
    shares: dict[tuple[str, int], list[Shares]] = {}
    for draw in range(DRAWS):
        order = _draw(clips, np.random.default_rng([SEED, number, draw]))
        rest = [clip for place, clip in enumerate(clips) if place not in order]
        before = _shares(words, rest)
        for how in learning:
            shares.setdefault((how, 0), []).append(before)
            for count in WORDS:
                adapted = _adapted(words, [clips[place] for place in order[:count]], how == "supervised")
                shares.setdefault((how, count), []).append(_shares(adapted, rest))
    return {
        key: {measure: float(np.mean([one[measure] for one in found])) for measure in found[0]}
        for key, found in shares.items()
    }


def _run(
    data_dir: Path,
    progress: Progress,
    *,
    data: Sequence[str] = DATA,
    learning: Sequence[str] = LEARNING,
    takes: int | None = None,
    folds: int | None = None,
) -> dict[str, Any]:
    rows: list[Row] = []
    for name in data:
        say = within(progress, name)
        clips = read_clips(data_dir, name, say, takes)
        persons = sorted({person for _, person, _ in clips})
        found: dict[tuple[str, int], dict[str, Shares]] = {}
        for number, person in enumerate(persons[:folds]):
            own = [clip for clip in clips if clip[1] == person]
            if len(own) <= max(WORDS):
                raise InvalidArgument(f"{name}: {person} has {len(own)} recordings, more than {max(WORDS)} are needed")
            words = fit_clips([clip for clip in clips if clip[1] != person], "hmm")
            for key, shares in _of_speaker(words, own, learning, number).items():
                found.setdefault(key, {})[person] = shares
            say("speakers", number + 1, len(persons))
        for (how, count), by_person in found.items():
            right = {person: shares["right"] for person, shares in by_person.items()}
            row = {"data": name, "learning": how, "words": count}
            row |= statistics({person: shares["accuracy"] for person, shares in by_person.items()})
            rows.append({**row, "right_mean": float(np.mean(list(right.values()))), **by_fold("right", right)})
    return {"seed": SEED, "draws": DRAWS, "rows": rows, "passed": None}


STUDIES = (
    Study(
        "adapt-words",
        "a trained recogniser after 5, 10 and 20 words of an unseen speaker, supervised and not, on the rest of them; "
        "leave one of 4 speakers out",
        tuple(WORD_FOLDERS.values()),
        "none: a comparison",
        _run,
        layout=Layout(columns="words", x="words", panel="data"),
        axes={"data": DATA, "learning": LEARNING},
        thins=True,
        sources=WORD_SOURCES,
        folds=True,
        quick={"data": ("hindi-words",)},
    ),
)
