# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The recogniser as it is under many conditions: what the studies of noise, tempo and distance share."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from hri.evaluation import EvaluationItem, EvaluationResult, evaluate_conditions
from hri.evaluation.conditions import Condition
from hri.recognition import WordRecognizer
from hri.recognition.decision import NO_INPUT, RECOGNISED
from hri.studies.front_ends import CHOICES
from hri.studies.registry import Progress, within
from hri.studies.tables import Row, by_fold, statistics
from hri.studies.word_features import load_words

SEED = 0
Trainings = Mapping[str, Sequence[Condition]]
"""By name, what is added to the clean recordings for training."""


def measured(result: EvaluationResult) -> Row:
    """What the studies of words say of one test.

    Accuracy by fold (the best label is right, rejected or not), and of all clips the shares that were recognised, that
    were recognised and rightly, and in which no speech was found, and the expected calibration error.
    """
    unheard = {fold.name: _share(fold.items, NO_INPUT) for fold in result.folds}
    row: Row = {
        **statistics({fold.name: fold.accuracy for fold in result.folds}),
        "recognised_mean": _share(result.items, RECOGNISED),
        **by_fold("recognised", {fold.name: _share(fold.items, RECOGNISED) for fold in result.folds}),
        "right_mean": result.recognised_right,
        **by_fold("right", {fold.name: fold.recognised_right for fold in result.folds}),
        "no_input_mean": float(np.mean(list(unheard.values()))),
        "no_input_std": float(np.std(list(unheard.values()))),
        **by_fold("no_input", unheard),
    }
    if (error := result.calibration_error) is not None:
        errors = {fold.name: fold.calibration_error for fold in result.folds}
        row |= {"calibration_error_mean": error, **by_fold("calibration_error", errors)}
    return row


def _share(items: Sequence[EvaluationItem], status: str) -> float:
    return float(np.mean([t.decision.status == status for t in items]))


def sweep(
    data_dir: Path,
    name: str,
    tests: Mapping[str, Condition | None],
    trainings: Trainings,
    progress: Progress,
    front_ends: Iterable[str] = ("plain",),
    takes: int | None = None,
    options: Mapping[str, Mapping[str, Any]] | None = None,
    adapt: bool = False,
    folds: int | None = None,
) -> dict[tuple[str, str], dict[str, Row]]:
    """What was measured, by (front end, training) and test, on a data set of `WORD_FOLDERS`.

    `options` are those of the recogniser by training, where they differ from the defaults; with `adapt`, every test is
    measured while adapting too, see `evaluate_conditions`.
    """
    dataset = load_words(data_dir, name, takes)
    found = {}
    for variant in front_ends:
        choice = CHOICES[variant]
        for trained, added in trainings.items():
            results = evaluate_conditions(
                dataset,
                partial(WordRecognizer, **choice.options, **(options or {}).get(trained, {})),
                tests,
                train=added,
                seed=SEED,
                front_end=choice.prepare,
                adapt=adapt,
                max_folds=folds,
                progress=within(progress, f"{name}, {variant}, {trained}"),
            )
            found[variant, trained] = {test: measured(result) for test, result in results.items()}
    return found


def result_of(rows: list[Row], passed: bool | None = None, **more: Any) -> dict[str, Any]:
    """A result with what all sweeps have in common."""
    return {"seed": SEED, "options": WordRecognizer().options.as_dict(), **more, "rows": rows, "passed": passed}
