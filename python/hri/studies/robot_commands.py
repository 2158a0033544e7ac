# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Commands of several words with slots, joined from single words of people who were not trained on."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from hri.datasets import Dataset
from hri.language import Grammar
from hri.media import read_audio
from hri.recognition import CommandRecognizer, ConnectedWordRecognizer
from hri.studies.clips import Clip
from hri.studies.connected_words import DigitString, join_clips, with_noise
from hri.studies.registry import WORD_SOURCES, Layout, Progress, Study, within
from hri.studies.tables import statistics
from hri.studies.word_features import first_takes

FOLDER = "commands"
NUM_FOLDS = 3
PAUSE_MS = 200
NOISE_DB = 20
SEED = 0
QUIET, NOISY = "quiet", f"white noise at {NOISE_DB} dB"
TARGET = 0.9
_NUMBERS = ("one", "two", "three", "four", "five")
_STEPS = " | ".join(f"{word} {{steps={number}}}" for number, word in enumerate(_NUMBERS, start=1))
GRAMMAR = f"""#JSGF V1.0;
grammar commands;
public <command> = ( forward {{walk=forward}} | backward {{walk=backward}} ) [ {_STEPS} ]
                 | ( left {{side=left}} | right {{side=right}} ) up {{gesture=up}} [ <times> ]
                 | stop;
<times> = two {{times=2}} | three {{times=3}};
"""


def _sentences(clips: Sequence[Clip], commands: Sequence[str], rng: np.random.Generator) -> list[DigitString]:
    """Every command once, of recordings of one speaker."""
    by_word: dict[str, list[Clip]] = {}
    for clip in clips:
        by_word.setdefault(clip[0], []).append(clip)
    chosen = [[by_word[w][rng.integers(len(by_word[w]))] for w in command.split()] for command in commands]
    return [join_clips(words, PAUSE_MS, rng) for words in chosen]


def _run(data_dir: Path, progress: Progress, *, takes: int | None = None) -> dict[str, Any]:
    grammar = Grammar.parse(GRAMMAR, "commands.jsgf")
    dataset = first_takes(Dataset.load(data_dir / FOLDER, "speech"), takes)
    clips: list[Clip] = [(s.label, s.person, read_audio(s.path)) for s in dataset.samples if s.label in grammar.words]
    people = sorted({person for _, person, _ in clips})
    right: dict[str, dict[str, float]] = {QUIET: {}, NOISY: {}}
    wrong_slots: list[str] = []
    for fold in range(NUM_FOLDS):
        held_out = people[fold::NUM_FOLDS]
        train = [clip for clip in clips if clip[1] not in held_out]
        words = ConnectedWordRecognizer(max_words=4).fit(
            [sound for _, _, sound in train],
            [label for label, _, _ in train],
            groups=[person for _, person, _ in train],
            progress=partial(within(progress, f"part {fold + 1}"), "training"),
        )
        commands = CommandRecognizer(words, grammar)
        for person in held_out:
            rng = np.random.default_rng([SEED, people.index(person)])
            labels = sorted(commands.commands_)
            said = _sentences([clip for clip in clips if clip[1] == person], labels, rng)
            rate_hz = next(sound.sample_rate_hz for _, who, sound in clips if who == person)
            noisy = [with_noise(sentence, NOISE_DB, rng) for sentence in said]
            for condition, strings in ((QUIET, said), (NOISY, noisy)):
                found = [commands.recognise(string.samples, rate_hz).label for string in strings]
                right[condition][person] = float(np.mean([f == label for f, label in zip(found, labels, strict=True)]))
                wrong_slots += [f"{a} -> {b}" for a, b in zip(labels, found, strict=True) if a != b]
    rows = [{"condition": condition, **statistics(of_people)} for condition, of_people in right.items()]
    return {
        "seed": SEED,
        "num_commands": len(grammar.sentences()),
        "confusions": sorted(wrong_slots),
        "rows": rows,
        "passed": float(np.mean(list(right[QUIET].values()))) >= TARGET,
    }


STUDIES = (
    Study(
        "robot-commands",
        "19 commands with slots, such as forward three or right up two, joined from Arabic words of 24 people with "
        "pauses of 200 ms, a third of the people held out in turn: whether all slots are right",
        (FOLDER,),
        "all slots right in 90 % of the commands in quiet",
        _run,
        Layout(columns="condition", measure="accuracy"),
        thins=True,
        sources=(
            *WORD_SOURCES,
            "cpp/language",
            "cpp/recognition/sentence",
            "python/language",
            "python/recognition/sentence",
        ),
    ),
)
