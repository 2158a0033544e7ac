# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""HTK's training from transcripts without times, beside that with times: strings of a speaker held out."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.htk import (
    Dictionary,
    EditScript,
    EmbeddedTrainer,
    EmbeddedTrainerOptions,
    FeatureExtractor,
    FlatStart,
    ModelSet,
    Recognizer,
    WordLattice,
    train_model,
)
from hri.language import WordErrors, count_word_errors
from hri.studies.clips import Clip, read_clips
from hri.studies.connected_words import EDGE_MS, strings_of
from hri.studies.registry import Layout, Progress, Study
from hri.studies.tables import statistics
from hri.studies.word_features import WORD_FOLDERS

KIND = "MFCC_0_D_A_Z"
FRAMES_A_S = 100
PAUSE_MS = 100
WORD_STATES, SILENCE_STATES = 8, 3
SKIP = 0.3
"""The probability that a pause between words is passed without a frame, before training."""
FLAT_PASSES, PASSES = 12, 4
"""Passes of embedded training from a flat start, and after that with every number of Gaussians."""
MIXTURES = (1, 2, 4)
FLOOR = 0.01
"""Least variance, as a share of that of all frames."""
TIMES, NO_TIMES, BOTH = "words by their times", "strings without times", "by times, then without"


@dataclass(frozen=True)
class _String:
    """Frames of a string, its digits, and the frames of each, which training without times does not see."""

    frames: NDArray[np.float32]
    labels: list[str]
    words: list[NDArray[np.float32]]

    @property
    def units(self) -> list[str]:
        """Its models: silence at the ends, a pause that may be missing between words."""
        between = [unit for label in self.labels for unit in (label, "sp")][:-1]
        return ["sil", *between, "sil"]


def _coded(clips: Sequence[Clip]) -> list[_String]:
    """Strings of each speaker, in an order and with noise that are always the same."""
    rate_hz = clips[0][2].sample_rate_hz
    persons = sorted({person for _, person, _ in clips})
    joined = [s for who in persons for s in strings_of([clip for clip in clips if clip[1] == who], PAUSE_MS)]
    extractor = FeatureExtractor(KIND, rate_hz)
    coded = []
    for string in joined:
        frames = extractor.compute(string.samples)
        # End points cut close; as labels do, words reach into the pauses on either side.
        half_s = PAUSE_MS / 2000
        times_s = [(first - half_s, last + half_s) for first, last in string.times_s["clip_times"]]
        words = [frames[round(FRAMES_A_S * first) : round(FRAMES_A_S * last)] for first, last in times_s]
        coded.append(_String(frames, string.labels, words))
    return coded


def _definition(name: str, means: NDArray[np.float64], variances: NDArray[np.float64], skip: float = 0.0) -> str:
    """A chain without jumps, of one Gaussian a state."""
    count, size = means.shape
    text = f'~h "{name}" <BEGINHMM> <NUMSTATES> {count + 2}\n'
    for number, (mean, variance) in enumerate(zip(means.tolist(), variances.tolist(), strict=True), 2):
        text += f"<STATE> {number} <MEAN> {size} {' '.join(map(repr, mean))}\n"
        text += f"<VARIANCE> {size} {' '.join(map(repr, variance))}\n"
    rows = np.diag([0.0] + [0.6] * count + [0.0]) + np.diag([1 - skip] + [0.4] * count, 1)
    rows[0, -1] = skip
    return (
        text + f"<TRANSP> {count + 2} " + "\n".join(" ".join(map(repr, row)) for row in rows.tolist()) + " <ENDHMM>\n"
    )


def _flat_models(strings: Sequence[_String], labels: Sequence[str]) -> tuple[ModelSet, ModelSet]:
    """All models at the mean and variance of all frames; and the floors of their training."""
    start = FlatStart()
    for string in strings:
        start.add(string.frames)
    floors = start.variance_floors(FLOOR)
    models = ModelSet(KIND)
    models.parse(floors.to_text(), "floors")
    shapes = [(label, WORD_STATES, 0.0) for label in labels] + [("sil", SILENCE_STATES, 0.0), ("sp", 1, SKIP)]
    for name, count, skip in shapes:
        zeros = np.zeros((count, strings[0].frames.shape[1]))
        models.parse(_definition(name, zeros, zeros + 1, skip), "a prototype")
    return start.apply(models, True), floors


def _embedded(models: ModelSet, strings: Sequence[_String], passes: int) -> ModelSet:
    for _ in range(passes):
        trainer = EmbeddedTrainer(models, EmbeddedTrainerOptions(weight_floor=100))
        for string in strings:
            trainer.add(string.frames, string.units)
        models = trainer.estimate()
    return models


def _by_times(strings: Sequence[_String], labels: Sequence[str], floors: ModelSet, mixtures: int) -> ModelSet:
    """Models of words from where they are said, of silence from the ends of strings, of pauses from silence."""
    models = ModelSet(KIND)
    models.parse(floors.to_text(), "floors")
    for label in labels:
        own = [word for s in strings for one, word in zip(s.labels, s.words, strict=True) if one == label]
        train_model(models, label, own, WORD_STATES, mixtures)
    edge = EDGE_MS * FRAMES_A_S // 1000
    ends = [part for s in strings for part in (s.frames[:edge], s.frames[-edge:])]
    train_model(models, "sil", ends, SILENCE_STATES, mixtures)
    silence = models.hmm("sil")
    middle = slice(mixtures, mixtures + 1)
    models.parse(_definition("sp", silence.means[middle], silence.variances[middle], SKIP), "the pause")
    return models


def _errors(models: ModelSet, strings: Sequence[_String], labels: Sequence[str]) -> WordErrors:
    """Of any number of digits, with no penalty and no beam."""
    words = Dictionary.parse("".join(f'"{label}" "{label}" sp\n' for label in labels) + "SIL [] sil\n", "words")
    lattice = WordLattice.of_grammar(f"$digit = {' | '.join(labels)}; ( SIL < $digit > SIL )", "grammar")
    recognizer = Recognizer(models, words, lattice)
    found = [[word.output for word in recognizer.recognise(s.frames).words if word.output] for s in strings]
    return count_word_errors([s.labels for s in strings], found)


def _trained(strings: Sequence[_String], labels: Sequence[str]) -> Iterator[tuple[str, int, ModelSet]]:
    """Models of every kind of training and number of Gaussians."""
    flat, floors = _flat_models(strings, labels)
    models = _embedded(flat, strings, FLAT_PASSES)
    for mixtures in MIXTURES:
        if mixtures > 1:
            models = EditScript.parse(f"MU {mixtures} {{*.state[2-99].mix}}", "split").apply(models)
        models = _embedded(models, strings, PASSES)
        yield NO_TIMES, mixtures, models
        given = _by_times(strings, labels, floors, mixtures)
        yield TIMES, mixtures, given
        yield BOTH, mixtures, _embedded(given, strings, PASSES)


def _run(data_dir: Path, progress: Progress, *, takes: int | None = None) -> dict[str, Any]:
    clips = read_clips(data_dir, "fsdd", progress, takes)
    persons = sorted({person for _, person, _ in clips})
    labels = sorted({label for label, _, _ in clips})
    errors: dict[tuple[str, int], dict[str, float]] = {}
    counts: dict[tuple[str, int], WordErrors] = {}
    for person in persons:
        train = _coded([clip for clip in clips if clip[1] != person])
        test = _coded([clip for clip in clips if clip[1] == person])
        for training, mixtures, models in _trained(train, labels):
            counted = _errors(models, test, labels)
            key = training, mixtures
            errors.setdefault(key, {})[person] = counted.rate
            counts[key] = counts.get(key, WordErrors()) + counted
            progress(person, sum(person in of for of in errors.values()), 3 * len(MIXTURES))
    rows = [
        {"training": training, "gaussians": mixtures, **statistics(rates, "word_error")}
        for (training, mixtures), rates in errors.items()
    ]
    error = {(row["training"], row["gaussians"]): row["word_error_mean"] for row in rows}
    most = max(MIXTURES)
    return {
        "pause_ms": PAUSE_MS,
        "counts": {f"{training}, {mixtures}": vars(counted) for (training, mixtures), counted in counts.items()},
        "rows": rows,
        "passed": bool(error[NO_TIMES, most] <= error[TIMES, most] + 0.02),
    }


STUDIES = (
    Study(
        "htk-embedded",
        "English digits (FSDD) in strings of 1 to 7, each of 4 speakers held out: word errors of models that HTK's "
        "flat start and embedded training make of strings without times, beside those from the times of the words",
        (WORD_FOLDERS["fsdd"],),
        "without times, a word error rate at most 2 points above that of models trained by the times of the words",
        _run,
        Layout(columns="gaussians", measure="word_error"),
        thins=True,
        sources=("cpp/htk", "cpp/models/hmm", "cpp/language"),
    ),
)
