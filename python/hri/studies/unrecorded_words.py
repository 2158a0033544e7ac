# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Connected words of which some were never recorded: synthetic voices say them in training, people in the test."""

from __future__ import annotations

import copy
from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from hri.language import count_word_errors
from hri.recognition import ConnectedWordRecognizer
from hri.studies.clips import Clip, read_clips
from hri.studies.connected_words import FrontEndKind, directory_of, fit_connected, strings_of
from hri.studies.registry import WORD_SOURCES, Layout, Progress, Study, within
from hri.studies.synthetic_speakers import WORDS
from hri.studies.tables import Row, further_statistics, statistics
from hri.studies.word_features import WORD_FOLDERS
from hri.synthetic.speech import speak_words

DATA = ("fsdd", "hindi-digits")
ADDED = 3
"""Words of the ten that no person said in training; others for every speaker, so that each is among them."""
VOICES = 24
PAUSE_MS = 300
SEED = 0
RECORDED, SPOKEN = "recorded", "said by synthetic voices"
METHODS = (RECORDED, SPOKEN)
MEASURES = ("added", "others", "errors", "errors_by_grammar")
MOST_LOST = 0.1


def _spoken(name: str, progress: Progress) -> list[Clip]:
    clips, labels, voices = speak_words(WORDS[name], VOICES, 1, SEED, partial(progress, "speaking"))
    return list(zip(labels, voices, clips, strict=True))


def _train(method: str, recorded: Sequence[Clip], spoken: Sequence[Clip], added: Sequence[str]) -> list[Clip]:
    if method == RECORDED:
        return list(recorded)
    return [clip for clip in recorded if clip[0] not in added] + [clip for clip in spoken if clip[0] in added]


def _measured(words: ConnectedWordRecognizer, test: Sequence[Clip], added: Sequence[str]) -> dict[str, float]:
    """Shares of the words that are right where their number is known, and word errors where it is not."""
    rate_hz = test[0][2].sample_rate_hz
    strings = strings_of(test, PAUSE_MS)
    right: dict[bool, list[bool]] = {True: [], False: []}
    for string in strings:
        found = words.recognise(string.samples, rate_hz, num_words=len(string.labels)).labels
        found = (*found, *[""] * (len(string.labels) - len(found)))
        for true, heard in zip(string.labels, found, strict=True):
            right[true in added].append(true == heard)
    by_grammar = copy.deepcopy(words).set_grammar(directory_of(strings, [str(label) for label in words.classes_]))
    said = [string.labels for string in strings]
    errors, grammar_errors = (
        count_word_errors(said, [model.recognise(string.samples, rate_hz).labels for string in strings]).rate
        for model in (words, by_grammar)
    )
    return {
        "added": float(np.mean(right[True])),
        "others": float(np.mean(right[False])),
        "errors": errors,
        "errors_by_grammar": grammar_errors,
    }


def _run(
    data_dir: Path,
    progress: Progress,
    *,
    front_end: FrontEndKind,
    data: Sequence[str] = DATA,
    takes: int | None = None,
) -> dict[str, Any]:
    rows: list[Row] = []
    for name in data:
        say = within(progress, name)
        clips = read_clips(data_dir, name, say, takes)
        spoken = _spoken(name, say)
        labels = sorted({label for label, _, _ in clips})
        found: dict[str, dict[str, dict[str, float]]] = {method: {} for method in METHODS}
        for number, person in enumerate(sorted({person for _, person, _ in clips})):
            added = [labels[(ADDED * number + i) % len(labels)] for i in range(ADDED)]
            recorded = [clip for clip in clips if clip[1] != person]
            test = [clip for clip in clips if clip[1] == person]
            for method in METHODS:
                train = _train(method, recorded, spoken, added)
                model = fit_connected(train, within(say, f"{person}, {method}"), {"front_end": front_end})
                found[method][person] = _measured(model, test, added)
        rows += [_row(name, method, found[method]) for method in METHODS]
    errors = {(row["data"], row["method"]): row["errors_by_grammar_mean"] for row in rows}
    return {
        "seed": SEED,
        "voices": VOICES,
        "rows": rows,
        "passed": all(errors[name, SPOKEN] <= errors[name, RECORDED] + MOST_LOST for name in data),
    }


def _row(name: str, method: str, by_person: dict[str, dict[str, float]]) -> Row:
    row: Row = {"data": name, "method": method}
    for measure in MEASURES:
        shares = {person: of[measure] for person, of in by_person.items()}
        row |= statistics(shares, measure) if measure == "added" else further_statistics(shares, measure)
    return row


def _study(name: str, front_end: FrontEndKind, by: str = "") -> Study:
    return Study(
        name,
        "strings of digits of which 3 of 10 were never recorded but said by synthetic voices in training, English and "
        "Hindi, each of 4 speakers held out: the share of these and of other words that is right where the number of "
        f"words is known, and word errors where it is not, without and with a grammar{by}",
        tuple(WORD_FOLDERS[name] for name in DATA),
        "by a grammar of 200 sentences and more, a word error rate at most 10 points above that with recordings of all "
        "words",
        partial(_run, front_end=front_end),
        Layout(columns="method", measure="added"),
        axes={"data": DATA},
        thins=True,
        sources=(
            *WORD_SOURCES,
            "cpp/language",
            "cpp/recognition/sentence",
        ),
    )


STUDIES = (
    _study("unrecorded-words", "cepstra"),
    _study("unrecorded-words-both", "both", "; by cepstra and a pretrained speech embedding (extra embedding)"),
)
