# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What trimming clips to their words costs: every speaker's accuracy with trimming and on whole clips."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np

from hri.datasets import Dataset
from hri.evaluation import EvaluationResult, evaluate_conditions
from hri.evaluation.conditions import Condition, Samples
from hri.recognition import WordRecognizer
from hri.studies.commands import NUM_FOLDS, conditions
from hri.studies.front_ends import CHOICES, EMBEDDING
from hri.studies.registry import WORD_SOURCES, Layout, Progress, Study, within
from hri.studies.sweeps import SEED, measured
from hri.studies.tables import statistics
from hri.studies.word_features import WORD_FOLDERS, first_takes

FOLDERS = {**WORD_FOLDERS, "commands": "commands"}
FOLDS = {"commands": NUM_FOLDS}
"""Groups of speakers; of the other sets each speaker is held out alone."""
WHOLE, TRIMMED = "whole clips", "trimmed"
CLIPS = {WHOLE: False, TRIMMED: True}
FRONT_ENDS = {"cepstra": CHOICES["plain"].options, EMBEDDING: CHOICES[EMBEDDING].options}
QUIETER = "20 dB quieter"
MAX_LOSS = 0.01
"""Of any speaker."""


def quieter(samples: Samples, sample_rate_hz: int, rng: np.random.Generator) -> Samples:
    """The clip as it would have been recorded, in 16 bits, at a tenth of the gain."""
    return (np.round(samples * (32768 / 10)) / 32768).astype(np.float32)


def tests_of(data_dir: Path) -> dict[str, Condition | None]:
    """Quiet, white noise at 10 dB, and another level."""
    return {**conditions(data_dir), QUIETER: quieter}


def by_speaker(dataset: Dataset, result: EvaluationResult) -> dict[str, float]:
    """Accuracy of each speaker held out, rejected or not."""
    right: dict[str, list[bool]] = {}
    for fold in result.folds:
        for item in fold.items:
            right.setdefault(dataset.samples[item.index].person, []).append(item.best == item.truth)
    return {speaker: float(np.mean(found)) for speaker, found in sorted(right.items())}


def _run(
    data_dir: Path,
    progress: Progress,
    *,
    data: Sequence[str] = tuple(FOLDERS),
    front_end: Sequence[str] = tuple(FRONT_ENDS),
    takes: int | None = None,
    folds: int | None = None,
) -> dict[str, Any]:
    rows, losses = [], {}
    tests = tests_of(data_dir)
    for name, kind in product(data, front_end):
        dataset = first_takes(Dataset.load(data_dir / FOLDERS[name], "speech"), takes)
        found: dict[tuple[str, str], dict[str, float]] = {}
        for clips, trim in CLIPS.items():
            results = evaluate_conditions(
                dataset,
                partial(WordRecognizer, **{**FRONT_ENDS[kind], "trim": trim}),
                tests,
                num_folds=FOLDS.get(name),
                max_folds=folds,
                seed=SEED,
                progress=within(progress, f"{name}, {kind}, {clips}"),
            )
            for test, result in results.items():
                found[clips, test] = by_speaker(dataset, result)
                place = {"data": name, "front_end": kind, "clips": clips, "test": test}
                rows.append({**place, **measured(result), **statistics(found[clips, test])})
        for test in tests:
            whole, trimmed = found[WHOLE, test], found[TRIMMED, test]
            lost = {speaker: whole[speaker] - trimmed[speaker] for speaker in whole}
            losses[f"{name}, {kind}, {test}"] = lost
    return {
        "seed": SEED,
        "options": WordRecognizer().options.as_dict(),
        "rows": rows,
        "lost_by_speaker": losses,
        "passed": all(lost <= MAX_LOSS for of in losses.values() for lost in of.values()),
    }


STUDIES = (
    Study(
        "word-trimming",
        "accuracy of every speaker held out, on clips trimmed to their words and on whole clips, in quiet, in white "
        "noise at 10 dB and at another level; by cepstra and with a pretrained speech embedding (extra embedding)",
        (*FOLDERS.values(), "noise"),
        f"no speaker loses more than {100 * MAX_LOSS:g} point by trimming",
        _run,
        Layout(columns="clips", panel="test"),
        axes={"data": tuple(FOLDERS), "front_end": tuple(FRONT_ENDS)},
        thins=True,
        sources=WORD_SOURCES,
        folds=True,
        quick={"data": ("hindi-digits",), "front_end": ("cepstra",)},
    ),
)
