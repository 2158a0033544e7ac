# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Commands of several words with slots, joined from single words of people who were not trained on."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import combinations
from pathlib import Path
from typing import Any

import numpy as np

from hri.datasets import Dataset
from hri.language import Grammar
from hri.media import read_audio
from hri.recognition import CommandRecognizer, ConnectedWordRecognizer
from hri.recognition.decision import NO_INPUT, UNKNOWN
from hri.recognition.sentence.commands import MIN_CONFIDENCE
from hri.studies.clips import Clip
from hri.studies.connected_words import DigitString, FrontEndKind, join_clips, with_noise
from hri.studies.registry import WORD_SOURCES, Layout, Progress, Study, within
from hri.studies.tables import Row, statistics
from hri.studies.word_features import first_takes

PAUSE_MS = 200
NOISE_DB = 20
SEED = 0
QUIET, NOISY, OTHER_WORDS = CONDITIONS = "quiet", f"white noise at {NOISE_DB} dB", "other words"
TARGET = 0.9
BOUNDS = (0.999, 0.998, 0.995, 0.99, 0.98, 0.95, 0.9, 0.8, 0.5, 0.0)
KEPT = 0.95


@dataclass(frozen=True)
class Corpus:
    """Recordings of words, of which the grammar's are in commands."""

    folders: tuple[str, ...]
    grammar: str
    num_parts: int
    """Of the people, of which each is held out in turn."""


_NUMBERS = ("one", "two", "three", "four", "five")
_STEPS = " | ".join(f"{word} {{steps={number}}}" for number, word in enumerate(_NUMBERS, start=1))
_ARABIC = f"""#JSGF V1.0;
grammar commands;
public <command> = ( forward {{walk=forward}} | backward {{walk=backward}} ) [ {_STEPS} ]
                 | ( left {{side=left}} | right {{side=right}} ) up {{gesture=up}} [ <times> ]
                 | stop;
<times> = two {{times=2}} | three {{times=3}};
"""
_TITLES = {"kahani": "story", "khel": "game", "kitaab": "book"}
_HINDI = f"""#JSGF V1.0;
grammar titles;
public <command> = ( {" | ".join(f"{word} {{kind={kind}}}" for word, kind in _TITLES.items())} )
                   ( {" | ".join(f"{number} {{number={number}}}" for number in range(1, 11))} );
"""
ARABIC = Corpus(("commands",), _ARABIC, num_parts=3)
HINDI = Corpus(("hindi_words/words", "hindi_words/digits"), _HINDI, num_parts=4)
"""Who is called speaker2 among the words need not be the speaker2 of the digits, and may be another of them."""


def _sentences(clips: Sequence[Clip], commands: Sequence[str], rng: np.random.Generator) -> list[DigitString]:
    """Every command once, of recordings of one speaker."""
    by_word: dict[str, list[Clip]] = {}
    for clip in clips:
        by_word.setdefault(clip[0], []).append(clip)
    chosen = [[by_word[w][rng.integers(len(by_word[w]))] for w in command.split()] for command in commands]
    return [join_clips(words, PAUSE_MS, rng) for words in chosen]


@dataclass(frozen=True)
class Heard:
    """What a person said, what was recognised, and how sure that was."""

    person: str
    condition: str
    said: str
    found: str
    confidence: float

    def right(self, min_confidence: float) -> bool:
        """Whether it was recognised as what it is."""
        return self.found == self.said and self.confidence >= min_confidence

    def accepted(self, min_confidence: float) -> bool:
        """Whether it was accepted as any command."""
        return self.found not in (UNKNOWN, NO_INPUT) and self.confidence >= min_confidence


def _chosen(heard: Sequence[Heard]) -> float:
    """The strictest bound that keeps `KEPT` of the commands that were right in quiet."""
    right = [one for one in heard if one.condition == QUIET and one.right(0.0)]
    return next(bound for bound in BOUNDS if sum(one.right(bound) for one in right) >= KEPT * len(right))


def _rows(heard: Sequence[Heard], chosen: Mapping[str, float]) -> list[Row]:
    """By bound: none, the default one, and that which is `chosen` for each person; shares are of a person each."""
    persons = sorted(chosen)
    bounds = {"0": dict.fromkeys(persons, 0.0), "default": dict.fromkeys(persons, MIN_CONFIDENCE)}
    bounds["chosen"] = {person: chosen[person] for person in persons}  # sums are the same in the same order
    rows: list[Row] = []
    for name, of_person in bounds.items():
        for condition in (QUIET, NOISY, OTHER_WORDS):
            shares = {}
            for person, bound in of_person.items():
                mine = [one for one in heard if (one.person, one.condition) == (person, condition)]
                taken = Heard.accepted if condition == OTHER_WORDS else Heard.right
                shares[person] = float(np.mean([taken(one, bound) for one in mine]))
            rows.append({"min_confidence": name, "condition": condition, **statistics(shares)})
    return rows


class _Study:
    """Recordings, and recognisers of commands trained on some of the people."""

    def __init__(self, clips: Sequence[Clip], grammar: str, front_end: FrontEndKind) -> None:
        self.front_end = front_end
        self.grammar = Grammar.parse(grammar, "commands.jsgf")
        self.clips = clips
        self.people = sorted({person for _, person, _ in clips})

    def trained(self, people: set[str], progress: Progress) -> CommandRecognizer:
        """A recogniser of commands that has met these people only."""
        train = [clip for clip in self.clips if clip[1] in people and clip[0] in self.grammar.words]
        words = ConnectedWordRecognizer(words={"front_end": self.front_end}, max_words=4, unknown_words=True).fit(
            [sound for _, _, sound in train],
            [label for label, _, _ in train],
            groups=[person for _, person, _ in train],
            progress=partial(progress, "training"),
        )
        return CommandRecognizer(words, self.grammar, min_confidence=0.0)

    def heard(self, commands: CommandRecognizer, person: str, conditions: Sequence[str] = CONDITIONS) -> list[Heard]:
        """What is recognised of a person, who says the same whatever the recogniser and the conditions."""
        rng = np.random.default_rng([SEED, self.people.index(person)])
        labels = sorted(commands.commands_)
        of_person = [clip for clip in self.clips if clip[1] == person]
        rate_hz = of_person[0][2].sample_rate_hz
        said = _sentences(of_person, labels, rng)
        strings = [(QUIET, label, string.samples) for label, string in zip(labels, said, strict=True)]
        strings += [
            (NOISY, label, with_noise(one, NOISE_DB, rng).samples) for one, label in zip(said, labels, strict=True)
        ]
        strings += [
            (OTHER_WORDS, "", sound.samples) for label, _, sound in of_person if label not in self.grammar.words
        ]
        found = []
        for condition, label, samples in strings:
            if condition in conditions:
                one = commands.recognise(samples, rate_hz)
                found.append(Heard(person, condition, label, one.label, one.confidence))
        return found


def _run(
    data_dir: Path, progress: Progress, *, corpus: Corpus, front_end: FrontEndKind, takes: int | None = None
) -> dict[str, Any]:
    samples = [
        sample
        for folder in corpus.folders
        for sample in first_takes(Dataset.load(data_dir / folder, "speech"), takes).samples
    ]
    study = _Study([(s.label, s.person, read_audio(s.path)) for s in samples], corpus.grammar, front_end)
    people = set(study.people)
    parts = [set(study.people[part :: corpus.num_parts]) for part in range(corpus.num_parts)]
    heard: list[Heard] = []
    for number, part in enumerate(parts, start=1):
        say = within(progress, f"part {number}")
        commands = study.trained(people - part, say)
        for done, person in enumerate(sorted(part)):
            heard += study.heard(commands, person)
            say("testing", done + 1, len(part))
    # The bound of a part is chosen on the others, each scored by a recogniser that has met neither.
    inner: list[list[Heard]] = [[] for _ in parts]
    for pair in combinations(range(len(parts)), 2):
        say = within(progress, "parts " + " and ".join(str(part + 1) for part in pair))
        others = study.trained(people - parts[pair[0]] - parts[pair[1]], say)
        for held_out, scored in (pair, pair[::-1]):
            for person in sorted(parts[scored]):
                inner[held_out] += study.heard(others, person, [QUIET])
            say("choosing", held_out + 1, len(parts))
    bounds = [_chosen(ones) for ones in inner]
    chosen = {person: bound for part, bound in zip(parts, bounds, strict=True) for person in part}
    rows = _rows(heard, chosen)
    quiet = next(row for row in rows if (row["min_confidence"], row["condition"]) == ("default", QUIET))
    return {
        "seed": SEED,
        "num_commands": len(study.grammar.sentences()),
        "min_confidence": MIN_CONFIDENCE,
        "chosen_min_confidence": bounds,
        "confusions": sorted(f"{one.said} -> {one.found}" for one in heard if one.said and one.found != one.said),
        "rows": rows,
        "passed": quiet["accuracy_mean"] >= TARGET,
    }


_ARABIC_TEXT = (
    "19 commands with slots, such as forward three or right up two, joined from Arabic words of 24 people with "
    "pauses of 200 ms, a third of the people"
)
_HINDI_TEXT = (
    "30 commands with slots, such as kahani 3 (story three), joined from Hindi words and digits of four speakers with "
    "pauses of 200 ms, one speaker"
)


def _study(name: str, corpus: Corpus, text: str, front_end: FrontEndKind) -> Study:
    by = "" if front_end == "cepstra" else "; by cepstra and a pretrained speech embedding (extra embedding)"
    return Study(
        name,
        f"{text} held out in turn: whether all slots are right; and how many of their other words, said by themselves, "
        f"are accepted as a command{by}",
        corpus.folders,
        "all slots right in 90 % of the commands in quiet, by the default min_confidence",
        partial(_run, corpus=corpus, front_end=front_end),
        Layout(columns="condition", measure="accuracy"),
        thins=True,
        sources=(
            *WORD_SOURCES,
            "cpp/language",
            "cpp/recognition/sentence",
        ),
    )


STUDIES = (
    _study("robot-commands", ARABIC, _ARABIC_TEXT, "cepstra"),
    _study("robot-commands-both", ARABIC, _ARABIC_TEXT, "both"),
    _study("hindi-commands", HINDI, _HINDI_TEXT, "cepstra"),
    _study("hindi-commands-both", HINDI, _HINDI_TEXT, "both"),
)
