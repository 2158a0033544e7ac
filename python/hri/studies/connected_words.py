# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Connected digits: strings joined from isolated recordings of one speaker, who was not trained on."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.language import WordErrors, count_word_errors
from hri.recognition import ConnectedWordRecognizer, Transcript, WordRecognizer
from hri.recognition.base import best_labels
from hri.signal import ActivityOptions, find_speech
from hri.studies.clips import Clip, read_clips
from hri.studies.registry import WORD_SOURCES, Layout, Progress, Study, within
from hri.studies.tables import Row, statistics
from hri.studies.word_features import WORD_FOLDERS

PAUSES_MS = (0, 100, 300)
MAX_DIGITS = 7
EDGE_MS = 200
NOISE_DB = -50.0
"""Of white noise under every string, below its peak: that of a quiet room."""
TOLERANCE_S = 0.05
LOOP, KNOWN, ISOLATED = "any number of words", "number known", "isolated words"
SEED = 0
"""Of the strings and their noise; training has its own."""


@dataclass(frozen=True)
class DigitString:
    """A string of digits; `times_s` is where each begins and ends, by the end points of its recording."""

    samples: NDArray[np.float32]
    labels: list[str]
    times_s: list[tuple[float, float]]


def _joined(clips: Sequence[Clip], pause_ms: float, rng: np.random.Generator) -> DigitString:
    """The clips as they are, with pauses between them and quiet noise under all."""
    rate_hz = clips[0][2].sample_rate_hz
    edge, pause = (np.zeros(round(ms * rate_hz / 1000), np.float32) for ms in (EDGE_MS, pause_ms))
    parts, times_s, length = [edge], [], len(edge)
    for _, _, sound in clips:
        first, last = find_speech(sound.samples, rate_hz, ActivityOptions(padding_ms=0)) or (0, len(sound.samples))
        times_s.append(((length + first) / rate_hz, (length + last) / rate_hz))
        parts += [sound.samples, pause]
        length += len(sound.samples) + len(pause)
    samples = np.concatenate([*parts, edge])
    noise = np.abs(samples).max() * 10 ** (NOISE_DB / 20) * rng.standard_normal(len(samples))
    return DigitString((samples + noise).astype(np.float32), [label for label, _, _ in clips], times_s)


def _strings(clips: Sequence[Clip], pause_ms: float) -> list[DigitString]:
    """Every clip once, in strings of 1 to `MAX_DIGITS`, the same for every pause."""
    order = np.random.default_rng(SEED)
    noise = np.random.default_rng([SEED, round(pause_ms)])
    left = [clips[i] for i in order.permutation(len(clips))]
    strings = []
    while left:
        count = int(order.integers(1, MAX_DIGITS + 1))
        strings.append(_joined(left[:count], pause_ms, noise))
        left = left[count:]
    return strings


def _close(string: DigitString, found: Transcript) -> list[bool]:
    """Whether each beginning and each end lies within the tolerance, where the words are right; else nothing."""
    if list(found.labels) != string.labels:
        return []
    pairs = zip(string.times_s, found.words, strict=True)
    return [
        abs(time_s - true_s) <= TOLERANCE_S
        for (first_s, last_s), word in pairs
        for time_s, true_s in ((word.first_s, first_s), (word.last_s, last_s))
    ]


def _isolated(train: Sequence[Clip], test: Sequence[Clip]) -> float:
    """The error of `WordRecognizer` on single clips, rejected or not."""
    words = WordRecognizer(front_end="cepstra").fit(
        [sound for _, _, sound in train],
        [label for label, _, _ in train],
        groups=[person for _, person, _ in train],
        fillers=[],
    )
    found = best_labels([words.recognise(sound) for _, _, sound in test])
    return float(np.mean(found != np.asarray([label for label, _, _ in test])))


def _row(pause_ms: float | str, words: str, errors: dict[str, float], times: dict[str, float] | None = None) -> Row:
    measured = {} if times is None else statistics(times, "times")
    measured.pop("per_fold", None)
    return {"pause_ms": pause_ms, "words": words, **statistics(errors, "word_error"), **measured}


def _run(data_dir: Path, progress: Progress, *, takes: int | None = None) -> dict[str, Any]:
    clips = read_clips(data_dir, "fsdd", progress, takes)
    persons = sorted({person for _, person, _ in clips})
    isolated: dict[str, float] = {}
    errors: dict[tuple[int, str], dict[str, float]] = {}
    times: dict[tuple[int, str], dict[str, float]] = {}
    counts: dict[tuple[int, str], WordErrors] = {}
    penalties: dict[str, float] = {}
    for person in persons:
        train = [clip for clip in clips if clip[1] != person]
        test = [clip for clip in clips if clip[1] == person]
        isolated[person] = _isolated(train, test)
        recognizer = ConnectedWordRecognizer()
        part = within(progress, person)
        recognizer.fit(
            [sound for _, _, sound in train],
            [label for label, _, _ in train],
            groups=[who for _, who, _ in train],
            progress=lambda done, total, part=part: part("training", done, total),  # type: ignore[misc]
        )
        penalties[person] = recognizer.insertion_penalty
        for done, pause_ms in enumerate(PAUSES_MS):
            strings = _strings(test, pause_ms)
            rate_hz = test[0][2].sample_rate_hz
            for words in (LOOP, KNOWN):
                found = [
                    recognizer.recognise(s.samples, rate_hz, num_words=len(s.labels) if words == KNOWN else None)
                    for s in strings
                ]
                counted = count_word_errors([s.labels for s in strings], [f.labels for f in found])
                close = [ok for s, f in zip(strings, found, strict=True) for ok in _close(s, f)]
                key = pause_ms, words
                errors.setdefault(key, {})[person] = counted.rate
                times.setdefault(key, {})[person] = float(np.mean(close)) if close else 0.0
                counts[key] = counts.get(key, WordErrors()) + counted
            part("strings", done + 1, len(PAUSES_MS))
    rows = [_row("", ISOLATED, isolated)]
    rows += [_row(pause_ms, words, errors[pause_ms, words], times[pause_ms, words]) for pause_ms, words in errors]
    most = max(PAUSES_MS)
    loop = statistics(errors[most, LOOP], "word_error")["word_error_mean"]
    alone = statistics(isolated, "word_error")["word_error_mean"]
    placed = statistics(times[most, LOOP], "times")["times_mean"]
    return {
        "seed": SEED,
        "options": ConnectedWordRecognizer().options.as_dict(),
        "insertion_penalty": penalties,
        "counts": {f"{pause_ms} ms, {words}": vars(counted) for (pause_ms, words), counted in counts.items()},
        "rows": rows,
        "passed": bool(loop <= alone + 0.02 and placed >= 0.95),
    }


STUDIES = (
    Study(
        "connected-digits",
        "English digits (FSDD) in strings of 1 to 7, joined with pauses of 0, 100 and 300 ms, each of 4 speakers held "
        "out: word errors and word times, beside the errors on isolated digits",
        (WORD_FOLDERS["fsdd"],),
        "with pauses of 300 ms and any number of words, a word error rate at most 2 points above that of isolated "
        "digits, and 95 % of the beginnings and ends of words within 50 ms",
        _run,
        Layout(columns="words", measure="word_error"),
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
