# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What trimming clips to their words costs: every speaker's accuracy with trimming and on whole clips."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from hri.datasets import Dataset
from hri.evaluation import EvaluationResult, evaluate_conditions
from hri.recognition import WordRecognizer
from hri.studies.commands import NUM_FOLDS, conditions
from hri.studies.registry import WORD_SOURCES, Layout, Progress, Study, within
from hri.studies.sweeps import SEED, measured
from hri.studies.tables import statistics
from hri.studies.word_features import WORD_FOLDERS, first_takes

FOLDERS = {**WORD_FOLDERS, "commands": "commands"}
FOLDS = {"commands": NUM_FOLDS}
"""Groups of speakers; of the other sets each speaker is held out alone."""
WHOLE, TRIMMED = "whole clips", "trimmed"
CLIPS = {WHOLE: False, TRIMMED: True}
MAX_LOSS = 0.01
"""Of any speaker."""


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
    takes: int | None = None,
    folds: int | None = None,
) -> dict[str, Any]:
    rows, losses = [], {}
    for name in data:
        dataset = first_takes(Dataset.load(data_dir / FOLDERS[name], "speech"), takes)
        found: dict[tuple[str, str], dict[str, float]] = {}
        for clips, trim in CLIPS.items():
            results = evaluate_conditions(
                dataset,
                partial(WordRecognizer, trim=trim),
                conditions(data_dir),
                num_folds=FOLDS.get(name),
                max_folds=folds,
                seed=SEED,
                progress=within(progress, f"{name}, {clips}"),
            )
            for test, result in results.items():
                found[clips, test] = by_speaker(dataset, result)
                place = {"data": name, "clips": clips, "test": test}
                rows.append({**place, **measured(result), **statistics(found[clips, test])})
        for test in conditions(data_dir):
            whole, trimmed = found[WHOLE, test], found[TRIMMED, test]
            losses[f"{name}, {test}"] = {speaker: whole[speaker] - trimmed[speaker] for speaker in whole}
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
        "accuracy of every speaker held out, by cepstra, on clips trimmed to their words and on whole clips, in quiet "
        "and in white noise at 10 dB",
        (*FOLDERS.values(), "noise"),
        f"no speaker loses more than {100 * MAX_LOSS:g} point by trimming",
        _run,
        Layout(columns="clips", panel="test"),
        axes={"data": tuple(FOLDERS)},
        thins=True,
        sources=WORD_SOURCES,
        folds=True,
        quick={"data": ("hindi-digits",)},
    ),
)
