# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Rejection of out-of-vocabulary gestures, rest poses and pictures without a hand."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from hri.datasets import Dataset, Fold
from hri.evaluation.rejection import equal_error_rate
from hri.media import read_frames
from hri.recognition import Decision, GestureRecognizer
from hri.recognition.decision import NO_INPUT, RECOGNISED
from hri.studies import webcam
from hri.studies.registry import GESTURE_SOURCES, Layout, Progress, Study, within
from hri.studies.tables import Row, further_statistics, statistics
from hri.studies.unknown_words import halves

SEED = 0
NUM_FOLDS = 5
NUM_HALVES = 10
MAX_FALSE_REJECTS = 0.05
"""Share of right decisions that the model's own threshold may reject."""
MAX_FALSE_ACCEPTS = 0.20
"""Share of other gestures that it may accept."""
REST_CHANGE = 0.05
"""Share of all change in a clip up to which the hand still rests."""
SHORTEST_REST = 8
NUM_EMPTY = 20


@dataclass(frozen=True)
class Material:
    """Recordings, and what is looked at in them."""

    folder: str
    pattern: str | None
    source: Literal["silhouettes", "landmarks"]


DATA = {
    "webcam-gestures": Material(webcam.FOLDER, webcam.PATTERN, "silhouettes"),
    "webcam-landmarks": Material(webcam.FOLDER, webcam.PATTERN, "landmarks"),
    "sign-digits": Material("sign_digits", None, "silhouettes"),
}

Rows = NDArray[np.float32]


def rest_before(rows: Rows) -> Rows:
    """The first rows of a clip, in which the hand still rests; none where it moves from the start."""
    padded = np.vstack([rows[:1], rows, rows[-1:]]).astype(np.float64)
    smooth = (padded[:-2] + padded[1:-1] + padded[2:]) / 3
    steps = np.linalg.norm(np.diff(smooth, axis=0), axis=1)
    if steps.size == 0:
        return rows[:0]
    change = np.cumsum(np.maximum(steps - 1.5 * np.quantile(steps, 0.25), 0))
    length = int(np.searchsorted(change, REST_CHANGE * change[-1], side="right"))
    return rows[:length] if length >= SHORTEST_REST and change[-1] > 0 else rows[:0]


def empty_clips(number: int = NUM_EMPTY, seed: int = SEED) -> list[list[NDArray[np.uint8]]]:
    """Clips of plain walls of any colour, unevenly lit, in noise; no hand in any."""
    rng = np.random.default_rng(seed)
    clips = []
    for _ in range(number):
        colour, slope = rng.uniform(10, 220, 3), rng.uniform(-0.1, 0.1, 2)
        y, x = np.mgrid[0:1:120j, 0:1:160j]
        wall = colour * (1 + y * slope[0] + x * slope[1])[:, :, None]
        clips.append([np.clip(wall + rng.normal(0, 3, wall.shape), 0, 255).astype(np.uint8) for _ in range(12)])
    return clips


def _score(decisions: Sequence[Decision]) -> list[float]:
    return [decision.score if decision.nbest else -np.inf for decision in decisions]


def _share(decisions: Sequence[Decision], status: str) -> float:
    return float(np.mean([decision.status == status for decision in decisions]))


def _folds(dataset: Dataset) -> list[Fold]:
    by_person = bool(dataset.persons)
    return dataset.folds_by_person(NUM_FOLDS, SEED) if by_person else dataset.folds_stratified(NUM_FOLDS, SEED)


def _measure(
    dataset: Dataset,
    source: Any,
    rows: Sequence[Rows],
    empty: Sequence[Rows],
    num_halves: int | None,
    progress: Progress,
) -> tuple[Row, dict[str, Any]]:
    measured: dict[str, dict[str, float]] = {}
    chosen, folds = halves(dataset.labels, NUM_HALVES, SEED)[:num_halves], _folds(dataset)
    labels = [sample.label for sample in dataset.samples]
    for number, half in enumerate(chosen):
        known: list[Decision] = []
        right: list[bool] = []
        rejected: list[bool] = []  # of right ones
        unknown: list[Decision] = []
        resting: list[Decision] = []
        absent: list[Decision] = []
        for part, fold in enumerate(folds):
            train = [i for i in fold.train if labels[i] in half]
            signers = [dataset.samples[i].person for i in train] if dataset.persons else None
            signs = GestureRecognizer(source=source).fit_features(
                [rows[i] for i in train], [labels[i] for i in train], groups=signers
            )
            for i in fold.test:
                decision = signs.recognise_features(rows[i])
                (known if labels[i] in half else unknown).append(decision)
                if labels[i] in half:
                    right.append(bool(decision.nbest) and decision.nbest[0].label == labels[i])
                    if right[-1]:
                        rejected.append(decision.status != RECOGNISED)
                rest = rest_before(rows[i])
                if len(rest):
                    resting.append(signs.recognise_features(rest))
            absent += [signs.recognise_features(wall) for wall in empty]
            progress("training", number * len(folds) + part + 1, len(chosen) * len(folds))
        found = {
            "eer": equal_error_rate(_score(known), _score(unknown)),
            "false_rejects": float(np.mean(rejected)) if rejected else 1.0,
            "false_accepts": _share(unknown, RECOGNISED),
            "accuracy": float(np.mean(right)),
        }
        if resting:
            found["rest_eer"] = equal_error_rate(_score(known), _score(resting))
            found["rest_accepts"] = _share(resting, RECOGNISED)
        found["absent_no_input"] = _share(absent, NO_INPUT)
        found["absent_accepts"] = _share(absent, RECOGNISED)
        for measure, value in found.items():
            measured.setdefault(measure, {})[f"half {number + 1}"] = value
    row: Row = {}
    for measure, values in measured.items():
        row |= statistics(values, measure) if measure == "eer" else further_statistics(values, measure)
    return row, {"halves": chosen, "by_half": measured}


def _run(
    data_dir: Path, progress: Progress, *, data: Sequence[str] = tuple(DATA), folds: int | None = None
) -> dict[str, Any]:
    result_rows, details = [], {}
    for name in data:
        material = DATA[name]
        source = material.source
        if len(data) > 1 and source not in webcam.measurable((source, "silhouettes")):
            continue
        dataset = Dataset.load(data_dir / material.folder, "gesture", material.pattern)
        recognizer = GestureRecognizer(source=source)
        rows = []
        for done, sample in enumerate(dataset.samples):
            rows.append(recognizer.features(read_frames(sample.path).frames))
            progress(f"{name}: finding hands", done + 1, len(dataset))
        stills = max(map(len, rows)) == 1
        empty = [recognizer.features(clip[:1] if stills else clip) for clip in empty_clips()]
        row, details[name] = _measure(dataset, source, rows, empty, folds, within(progress, name))
        result_rows.append({"data": name, **row})
    return {
        "seed": SEED,
        "rows": result_rows,
        "details": details,
        "passed": all(
            row["false_rejects_mean"] <= MAX_FALSE_REJECTS and row["false_accepts_mean"] <= MAX_FALSE_ACCEPTS
            for row in result_rows
        ),
    }


STUDIES = (
    Study(
        "unknown-gestures",
        "gestures with half the vocabulary never trained, rest poses, and drawn walls without a hand: equal error rate "
        f"of rejection, shares at the default threshold; {NUM_HALVES} random halves, the score of {NUM_FOLDS} folds "
        "together",
        tuple(dict.fromkeys(material.folder for material in DATA.values())),
        f"at the model's own threshold at most {100 * MAX_FALSE_ACCEPTS:.0f} % of other gestures accepted, and at most "
        f"{100 * MAX_FALSE_REJECTS:.0f} % of right decisions rejected",
        _run,
        Layout(measure="eer"),
        {"data": tuple(DATA)},
        sources=GESTURE_SOURCES,
        folds=True,
    ),
)
