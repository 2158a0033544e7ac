# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Connected digits: strings joined from isolated recordings of one speaker, who was not trained on.

English and Hindi digits; in noise, by a bigram, by a grammar, with words that are not in the vocabulary, and by
possibility-theory HMMs; by cepstra, and by the pretrained speech embedding as well.
"""

from __future__ import annotations

import copy
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from hri.language import Grammar, NGramModel, WordErrors, count_word_errors
from hri.recognition import ConnectedWordRecognizer, Transcript, WordRecognizer
from hri.recognition.base import best_labels
from hri.recognition.keywords import WordRecognizerKeywords
from hri.signal import ActivityOptions, find_speech
from hri.studies.clips import Clip, read_clips
from hri.studies.registry import WORD_SOURCES, Layout, Progress, Study, within
from hri.studies.tables import Row, further_statistics, statistics
from hri.studies.word_features import WORD_FOLDERS

FrontEndKind = Literal["cepstra", "both"]

PAUSES_MS = (0, 100, 300)
MAX_DIGITS = 7
EDGE_MS = 200
NOISE_DB = -50.0
"""Of white noise under every string, below its peak: that of a quiet room."""
TOLERANCE_S = 0.05
LEVEL_FRAME_MS, LEVEL_SHIFT_MS = 20, 5
LOOP, KNOWN, ISOLATED = "any number of words", "number known", "isolated words"
FREE, BIGRAM = "digits in a row of 3 choices, any order", "digits in a row of 3 choices, bigram"
GRAMMAR = "one of the strings and 200 others, by a grammar"
POSSIBILISTIC = "any number of words, PTBHMM"
MISSED, UNKNOWN = "3 of 10 words not trained on", "3 of 10 words not trained on, unknown words on"
REJECTING = "any number of words, unknown words on"
NOISES_DB = (20, 10)
"""Signal to noise, white noise."""
NUM_OTHERS = 200
NUM_SUCCESSORS = 3
NUM_UNKNOWN = 3
LANGUAGE_SCALE = 10.0
"""That of the documentation: it was not chosen here."""
SEED = 0
"""Of the strings and their noise; training has its own."""


@dataclass(frozen=True)
class DigitString:
    """A string of digits; `times_s` is where each begins and ends, by every rule of `END_POINTS`."""

    samples: NDArray[np.float32]
    labels: list[str]
    times_s: dict[str, list[tuple[float, float]]]


def _with_quiet(samples: NDArray[np.float32], edge_ms: float, rate_hz: int) -> NDArray[np.float32]:
    edge = np.zeros(round(edge_ms * rate_hz / 1000), np.float32)
    return np.concatenate([edge, samples, edge])


def clip_end_points(samples: NDArray[np.float32], rate_hz: int) -> tuple[int, int]:
    """Where the word of a recording begins and ends, found in the recording as it is."""
    return find_speech(samples, rate_hz, ActivityOptions(padding_ms=0)) or (0, len(samples))


def end_points(samples: NDArray[np.float32], rate_hz: int) -> tuple[int, int]:
    """Find them in the recording between stretches of a quiet room.

    Recordings may be cut close to their word. In these as they are the detector has no noise to measure but the
    quietest sounds of the word, and finds end points within it.
    """
    clip = _with_quiet(samples, EDGE_MS, rate_hz)
    room = np.abs(clip).max() * 10 ** (NOISE_DB / 20) * np.random.default_rng([SEED, 5]).standard_normal(len(clip))
    first, last = clip_end_points((clip + room).astype(np.float32), rate_hz)
    edge = round(EDGE_MS * rate_hz / 1000)
    return max(0, first - edge), min(len(samples), last - edge)


def level_end_points(samples: NDArray[np.float32], rate_hz: int) -> tuple[int, int]:
    """The middles of the first and the last frame less than `ActivityOptions.max_depth_db` below the loudest.

    They know neither voice nor noise, so that they do not share the faults of the detector.
    """
    length, shift = (round(ms * rate_hz / 1000) for ms in (LEVEL_FRAME_MS, LEVEL_SHIFT_MS))
    clip = _with_quiet(samples, LEVEL_FRAME_MS, rate_hz).astype(np.float64)
    total = np.concatenate([[0.0], np.cumsum(clip**2)])
    starts = np.arange(0, len(clip) - length, shift)
    power = total[starts + length] - total[starts]
    loud = starts[power > power.max() * 10 ** (-ActivityOptions().max_depth_db / 10)]
    return int(loud[0]) - length // 2, int(loud[-1]) - length // 2


END_POINTS: dict[str, Callable[[NDArray[np.float32], int], tuple[int, int]]] = {
    "times": end_points,
    "level_times": level_end_points,
    "clip_times": clip_end_points,
}
"""What the times of words are compared with, by the name of the measure."""


def join_clips(clips: Sequence[Clip], pause_ms: float, rng: np.random.Generator) -> DigitString:
    """The clips as they are, with pauses between them and quiet noise under all."""
    rate_hz = clips[0][2].sample_rate_hz
    edge, pause = (np.zeros(round(ms * rate_hz / 1000), np.float32) for ms in (EDGE_MS, pause_ms))
    parts, length = [edge], len(edge)
    times_s: dict[str, list[tuple[float, float]]] = {name: [] for name in END_POINTS}
    for _, _, sound in clips:
        for name, find in END_POINTS.items():
            first, last = find(sound.samples, rate_hz)
            times_s[name].append(((length + first) / rate_hz, (length + last) / rate_hz))
        parts += [sound.samples, pause]
        length += len(sound.samples) + len(pause)
    samples = np.concatenate([*parts, edge])
    noise = np.abs(samples).max() * 10 ** (NOISE_DB / 20) * rng.standard_normal(len(samples))
    return DigitString((samples + noise).astype(np.float32), [label for label, _, _ in clips], times_s)


def strings_of(clips: Sequence[Clip], pause_ms: float) -> list[DigitString]:
    """Every clip once, in strings of 1 to `MAX_DIGITS`, the same for every pause."""
    order = np.random.default_rng(SEED)
    noise = np.random.default_rng([SEED, round(pause_ms)])
    left = [clips[i] for i in order.permutation(len(clips))]
    strings = []
    while left:
        count = int(order.integers(1, MAX_DIGITS + 1))
        strings.append(join_clips(left[:count], pause_ms, noise))
        left = left[count:]
    return strings


def _successors(labels: Sequence[str], last: str) -> list[str]:
    """What may follow a digit: the next ones in a circle."""
    at = sorted(labels).index(last)
    return [sorted(labels)[(at + step) % len(labels)] for step in range(1, NUM_SUCCESSORS + 1)]


def _rows_of_choices(clips: Sequence[Clip], labels: Sequence[str], pause_ms: float) -> list[DigitString]:
    """Every clip once, each digit followed by one of its successors, as long as there are some left."""
    rng = np.random.default_rng([SEED, 1])
    left = [clips[i] for i in rng.permutation(len(clips))]
    strings = []
    while left:
        count, string = int(rng.integers(2, MAX_DIGITS + 1)), [left.pop()]
        while len(string) < count:
            may_follow = _successors(labels, string[-1][0])
            place = next((i for i, clip in enumerate(left) if clip[0] in may_follow), None)
            if place is None:
                break
            string.append(left.pop(place))
        strings.append(join_clips(string, pause_ms, rng))
    return strings


def _language(labels: Sequence[str]) -> NGramModel:
    """A bigram of rows drawn by the rule, not of the strings themselves."""
    rng = np.random.default_rng([SEED, 2])
    rows = []
    for _ in range(500):
        row = [str(rng.choice(labels))]
        while len(row) < rng.integers(2, MAX_DIGITS + 1):
            row.append(str(rng.choice(_successors(labels, row[-1]))))
        rows.append(row)
    return NGramModel.train(rows, vocabulary=list(labels))


def directory_of(strings: Sequence[DigitString], labels: Sequence[str]) -> Grammar:
    """The strings and others of as many words, as alternatives."""
    rng = np.random.default_rng([SEED, 3])
    sentences = {" ".join(f'"{label}"' for label in string.labels) for string in strings}
    for number in range(NUM_OTHERS):
        like = strings[number % len(strings)]
        sentences.add(" ".join(f'"{rng.choice(labels)}"' for _ in like.labels))
    return Grammar.parse(
        f"#JSGF V1.0;\ngrammar numbers;\npublic <number> = {' | '.join(sorted(sentences))};", "numbers"
    )


def with_noise(string: DigitString, snr_db: float, rng: np.random.Generator) -> DigitString:
    """The same in white noise, so many dB below it."""
    power = float(np.mean(np.square(string.samples, dtype=np.float64)))
    noise = np.sqrt(power * 10 ** (-snr_db / 10)) * rng.standard_normal(len(string.samples))
    return replace(string, samples=(string.samples + noise).astype(np.float32))


def _close(string: DigitString, found: Transcript, rule: str = "times") -> list[bool]:
    """Whether each beginning and each end lies within the tolerance, where the words are right; else nothing."""
    if list(found.labels) != string.labels:
        return []
    pairs = zip(string.times_s[rule], found.words, strict=True)
    return [
        abs(time_s - true_s) <= TOLERANCE_S
        for (first_s, last_s), word in pairs
        for time_s, true_s in ((word.first_s, first_s), (word.last_s, last_s))
    ]


def _isolated(train: Sequence[Clip], test: Sequence[Clip], front_end: FrontEndKind) -> float:
    """The error of `WordRecognizer` on single clips, rejected or not."""
    words = WordRecognizer(front_end=front_end).fit(
        [sound for _, _, sound in train],
        [label for label, _, _ in train],
        groups=[person for _, person, _ in train],
        fillers=[],
    )
    found = best_labels([words.recognise(sound) for _, _, sound in test])
    return float(np.mean(found != np.asarray([label for label, _, _ in test])))


def _row(
    pause_ms: float | str, words: str, errors: dict[str, float], times: dict[str, dict[str, float]] | None = None
) -> Row:
    measured: Row = {}
    for rule, by_person in (times or {}).items():
        measured |= further_statistics(by_person, rule)
    return {"pause_ms": pause_ms, "words": words, **statistics(errors, "word_error"), **measured}


@dataclass
class Measured:
    """Errors, and times by each rule of `END_POINTS`, by pause and condition, each by person."""

    errors: dict[tuple[int, str], dict[str, float]] = field(default_factory=dict)
    times: dict[tuple[int, str], dict[str, dict[str, float]]] = field(default_factory=dict)
    counts: dict[tuple[int, str], WordErrors] = field(default_factory=dict)

    def add(
        self,
        pause_ms: int,
        words: str,
        person: str,
        strings: Sequence[DigitString],
        recognise: Callable[[DigitString], Transcript],
    ) -> None:
        """Recognise all strings and count."""
        found = [recognise(string) for string in strings]
        counted = count_word_errors([s.labels for s in strings], [f.labels for f in found])
        key = pause_ms, words
        self.errors.setdefault(key, {})[person] = counted.rate
        by_rule = self.times.setdefault(key, {rule: {} for rule in END_POINTS})
        for rule, by_person in by_rule.items():
            close = [ok for s, f in zip(strings, found, strict=True) for ok in _close(s, f, rule)]
            by_person[person] = float(np.mean(close)) if close else 0.0
        self.counts[key] = self.counts.get(key, WordErrors()) + counted


def fit_connected(
    train: Sequence[Clip], progress: Progress, words: WordRecognizerKeywords, **options: Any
) -> ConnectedWordRecognizer:
    """By options of isolated words, and others."""
    return ConnectedWordRecognizer(words=words, **options).fit(
        [sound for _, _, sound in train],
        [label for label, _, _ in train],
        groups=[who for _, who, _ in train],
        progress=lambda done, total: progress("training", done, total),
    )


def _by(
    recognizer: ConnectedWordRecognizer, rate_hz: int, *, is_known: bool = False
) -> Callable[[DigitString], Transcript]:
    def recognise(string: DigitString) -> Transcript:
        return recognizer.recognise(string.samples, rate_hz, num_words=len(string.labels) if is_known else None)

    return recognise


def _measure(measured: Measured, person: str, test: Sequence[Clip], recognizer: ConnectedWordRecognizer) -> None:
    rate_hz = test[0][2].sample_rate_hz
    labels = sorted({label for label, _, _ in test})
    for pause_ms in PAUSES_MS:
        strings = strings_of(test, pause_ms)
        measured.add(pause_ms, LOOP, person, strings, _by(recognizer, rate_hz))
        measured.add(pause_ms, KNOWN, person, strings, _by(recognizer, rate_hz, is_known=True))
    longest = max(PAUSES_MS)
    strings = strings_of(test, longest)
    for snr_db in NOISES_DB:
        rng = np.random.default_rng([SEED, 4, snr_db])
        noisy = [with_noise(string, snr_db, rng) for string in strings]
        measured.add(longest, f"{LOOP}, white noise at {snr_db} dB", person, noisy, _by(recognizer, rate_hz))
    directed = copy.deepcopy(recognizer).set_grammar(directory_of(strings, labels))
    measured.add(longest, GRAMMAR, person, strings, _by(directed, rate_hz))
    rows = _rows_of_choices(test, labels, longest)
    measured.add(longest, FREE, person, rows, _by(recognizer, rate_hz))
    weighted = copy.deepcopy(recognizer).set_language(_language(labels)).set_decoder(language_scale=LANGUAGE_SCALE)
    measured.add(longest, BIGRAM, person, rows, _by(weighted, rate_hz))


def _measure_possibilities(
    measured: Measured,
    person: str,
    train: Sequence[Clip],
    test: Sequence[Clip],
    front_end: FrontEndKind,
    progress: Progress,
) -> None:
    """The same densities as possibilities over codewords."""
    model = fit_connected(train, progress, {"model": "ptbhmm", "front_end": front_end})
    for pause_ms in PAUSES_MS:
        measured.add(pause_ms, POSSIBILISTIC, person, strings_of(test, pause_ms), _by(model, test[0][2].sample_rate_hz))


def _measure_unknown(
    measured: Measured,
    person: str,
    train: Sequence[Clip],
    test: Sequence[Clip],
    front_end: FrontEndKind,
    progress: Progress,
) -> None:
    """The last words of the vocabulary are not trained on, and said; then all are known."""
    unknown = sorted({label for label, _, _ in test})[-NUM_UNKNOWN:]
    known = [clip for clip in train if clip[0] not in unknown]
    rate_hz = test[0][2].sample_rate_hz
    longest = max(PAUSES_MS)
    strings = [
        replace(s, labels=["<unk>" if label in unknown else label for label in s.labels])
        for s in strings_of(test, longest)
    ]
    for words, is_on in ((MISSED, False), (UNKNOWN, True)):
        model = fit_connected(known, progress, {"front_end": front_end}, unknown_words=is_on)
        measured.add(longest, words, person, strings, _by(model, rate_hz))
    rejecting = fit_connected(train, progress, {"front_end": front_end}, unknown_words=True)
    for pause_ms in (min(PAUSES_MS), longest):
        measured.add(pause_ms, REJECTING, person, strings_of(test, pause_ms), _by(rejecting, rate_hz))


def _run(
    data_dir: Path, progress: Progress, *, source: str, front_end: FrontEndKind, takes: int | None = None
) -> dict[str, Any]:
    clips = read_clips(data_dir, source, progress, takes)
    isolated: dict[str, float] = {}
    measured = Measured()
    penalties: dict[str, float] = {}
    weights: dict[str, float] = {}
    for person in sorted({person for _, person, _ in clips}):
        train = [clip for clip in clips if clip[1] != person]
        test = [clip for clip in clips if clip[1] == person]
        part = within(progress, person)
        isolated[person] = _isolated(train, test, front_end)
        recognizer = fit_connected(train, part, {"front_end": front_end})
        penalties[person] = recognizer.insertion_penalty
        weights[person] = recognizer.trained_options.words.embedding_weight
        _measure(measured, person, test, recognizer)
        _measure_unknown(measured, person, train, test, front_end, part)
        _measure_possibilities(measured, person, train, test, front_end, part)
    rows = [_row("", ISOLATED, isolated)]
    rows += [_row(*key, measured.errors[key], measured.times[key]) for key in measured.errors]
    most = max(PAUSES_MS)
    loop = statistics(measured.errors[most, LOOP], "word_error")["word_error_mean"]
    alone = statistics(isolated, "word_error")["word_error_mean"]
    placed = min(statistics(measured.times[most, LOOP][rule])["accuracy_mean"] for rule in ("times", "level_times"))
    return {
        "seed": SEED,
        "options": ConnectedWordRecognizer(words={"front_end": front_end}).options.as_dict(),
        "insertion_penalty": penalties,
        **({"embedding_weight": weights} if front_end == "both" else {}),
        "counts": {f"{pause_ms} ms, {words}": vars(counted) for (pause_ms, words), counted in measured.counts.items()},
        "rows": rows,
        "passed": bool(loop <= alone + 0.02 and placed >= 0.95),
    }


def _study(name: str, source: str, what: str, front_end: FrontEndKind = "cepstra") -> Study:
    by = {"cepstra": "", "both": ", by cepstra and a pretrained speech embedding (extra embedding)"}[front_end]
    return Study(
        name,
        f"{what} in strings of 1 to 7, joined with pauses of 0, 100 and 300 ms, each of 4 speakers held out, in noise, "
        "by a bigram, by a grammar, with words that were not trained on, and by PTBHMMs: word errors and word times, "
        f"beside the errors on isolated digits{by}",
        (WORD_FOLDERS[source],),
        "with pauses of 300 ms and any number of words, a word error rate at most 2 points above that of isolated "
        "digits, and 95 % of the beginnings and ends of words within 50 ms, by end points and by level",
        partial(_run, source=source, front_end=front_end),
        Layout(columns="words", measure="word_error"),
        thins=True,
        sources=(
            *WORD_SOURCES,
            "cpp/language",
            "cpp/recognition/sentence",
        ),
    )


STUDIES = (
    _study("connected-digits", "fsdd", "English digits (FSDD)"),
    _study("connected-digits-both", "fsdd", "English digits (FSDD)", "both"),
    _study("connected-hindi", "hindi-digits", "Hindi digits"),
    _study("connected-hindi-both", "hindi-digits", "Hindi digits", "both"),
)
