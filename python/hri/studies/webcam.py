# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Dynamic gestures in front of webcams, in about ten conditions of light and background."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from importlib.resources import files
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import InvalidArgument
from hri.core.files import parse_toml, read_text
from hri.datasets import Dataset
from hri.datasets.folds import Fold
from hri.evaluation.conditions import expose, gamma, tint
from hri.media import read_frames
from hri.recognition import GestureRecognizer
from hri.studies.registry import GESTURE_SOURCES, Layout, Progress, Study
from hri.studies.tables import statistics

FOLDER = "webcam_gestures"
PATTERN = "{label}/{take}.m4v"
CONDITIONS = "conditions.toml"
"""In the folder of the clips, takes the place of the table that comes with the study."""
SOURCES = ("silhouettes", "landmarks")
TARGETS = {"silhouettes": 0.85, "landmarks": 0.95}
NUM_FOLDS = 5
SEEDS = (0, 1, 2)
MAX_DROP = 0.05

Frames = Sequence[NDArray[np.uint8]]
Rows = NDArray[np.float32]

LIGHTS: dict[str, Callable[[Frames], Frames]] = {
    "as recorded": lambda frames: frames,
    "half exposure": lambda frames: expose(frames, 0.5),
    "gamma 2": lambda frames: gamma(frames, 2.0),
    "red cast": lambda frames: tint(frames, (0.6, 0.6, 1.0)),
    "blue cast": lambda frames: tint(frames, (1.0, 0.6, 0.6)),
}


def read_conditions(clips: Sequence[str], table: Path | None = None) -> list[str]:
    """The condition of every clip, each named "label/take".

    Parameters
    ----------
    clips : sequence of str
    table : Path, optional
        A file like webcam_conditions.toml, for other clips than those it was written for.

    Raises
    ------
    InvalidArgument
        For a clip without a condition (names it and the file), or a file that is no such table.
    """
    source = Path("webcam_conditions.toml") if table is None else table
    try:
        text = files("hri.studies").joinpath(source.name).read_text("utf-8") if table is None else read_text(table)
        entries = parse_toml(text, source.name)["condition"]
        known = {clip: entry["name"] for entry in entries for clip in entry["clips"]}
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise InvalidArgument(f"{source}: no table of conditions: {error}") from error
    unknown = [clip for clip in clips if clip not in known]
    if unknown:
        raise InvalidArgument(
            f"{source.name} has no condition for {', '.join(unknown)}; look at the clips and name the condition of "
            f"each in {FOLDER}/{CONDITIONS}"
        )
    return [known[clip] for clip in clips]


def _load(data_dir: Path) -> Dataset:
    return Dataset.load(data_dir / FOLDER, "gesture", PATTERN)


def _features(dataset: Dataset, source: Any, lights: Sequence[str], progress: Progress) -> dict[str, list[Rows]]:
    """Rows of every clip in every light; every clip is read once."""
    recognizer = GestureRecognizer(source=source)
    found: dict[str, list[Rows]] = {light: [] for light in lights}
    for done, sample in enumerate(dataset.samples):
        frames = read_frames(sample.path).frames
        for light in lights:
            found[light].append(recognizer.features(LIGHTS[light](frames)))
        progress(f"finding hands, {source}", done + 1, len(dataset))
    return found


def _train(dataset: Dataset, rows: Sequence[Rows], fold: Fold, source: Any) -> GestureRecognizer:
    return GestureRecognizer(source=source).fit_features(
        [rows[i] for i in fold.train], [dataset.samples[i].label for i in fold.train]
    )


def _right(dataset: Dataset, recognizer: GestureRecognizer, rows: Sequence[Rows], fold: Fold) -> list[bool]:
    """Whether the best label of every test clip is right, rejected or not."""
    decisions = [recognizer.recognise_features(rows[i]) for i in fold.test]
    return [
        bool(decision.nbest) and decision.nbest[0].label == dataset.samples[i].label
        for i, decision in zip(fold.test, decisions, strict=True)
    ]


def measurable(source: Sequence[str]) -> list[str]:
    """Landmarks need MediaPipe; without it, they are measured only where they were asked for by name."""
    if len(source) == 1 or find_spec("mediapipe") is not None:
        return list(source)
    return [name for name in source if name != "landmarks"]


def _stratified(
    data_dir: Path, progress: Progress, *, source: Sequence[str] = SOURCES, folds: int | None = None
) -> dict[str, Any]:
    dataset = _load(data_dir)
    rows = []
    for name in measurable(source):
        features = _features(dataset, name, ["as recorded"], progress)["as recorded"]
        per_fold = {}
        for seed in SEEDS[:folds]:
            for part, fold in enumerate(dataset.folds_stratified(NUM_FOLDS, seed)[:folds]):
                recognizer = _train(dataset, features, fold, name)
                per_fold[f"seed {seed}, {fold.name}"] = float(np.mean(_right(dataset, recognizer, features, fold)))
                progress(f"training, {name}", seed * NUM_FOLDS + part + 1, len(SEEDS) * NUM_FOLDS)
        rows.append({"source": name, **statistics(per_fold)})
    return {"seeds": list(SEEDS), "num_folds": NUM_FOLDS, "rows": rows, "passed": _passed(rows)}


def _passed(rows: Sequence[dict[str, Any]]) -> bool:
    return all(row["accuracy_mean"] >= TARGETS[row["source"]] for row in rows)


def _conditions(
    data_dir: Path, progress: Progress, *, source: Sequence[str] = SOURCES, folds: int | None = None
) -> dict[str, Any]:
    dataset = _load(data_dir)
    own = data_dir / FOLDER / CONDITIONS
    conditions = read_conditions(
        [f"{sample.label}/{sample.take}" for sample in dataset.samples], own if own.exists() else None
    )
    rows, means = [], []
    for name in measurable(source):
        features = _features(dataset, name, ["as recorded"], progress)["as recorded"]
        right: dict[str, list[bool]] = {}
        names = list(dict.fromkeys(conditions))[:folds]
        for done, left_out in enumerate(names):
            fold = Fold(
                left_out,
                [i for i, condition in enumerate(conditions) if condition != left_out],
                [i for i, condition in enumerate(conditions) if condition == left_out],
            )
            right[left_out] = _right(dataset, _train(dataset, features, fold, name), features, fold)
            rows.append({"left out": left_out, "source": name, "accuracy_mean": float(np.mean(right[left_out]))})
            progress(f"training, {name}", done + 1, len(names))
        # Conditions have 3 to 12 clips each, so that every clip counts as much as any other.
        every = [value for values in right.values() for value in values]
        per_fold = {left_out: float(np.mean(values)) for left_out, values in right.items()}
        means.append(
            {"left out": "all clips", "source": name, "accuracy_mean": float(np.mean(every)), "per_fold": per_fold}
        )
    return {"rows": [*rows, *means], "passed": _passed(means)}


def _light(
    data_dir: Path, progress: Progress, *, light: Sequence[str] = tuple(LIGHTS), folds: int | None = None
) -> dict[str, Any]:
    dataset = _load(data_dir)
    lights = list(dict.fromkeys(("as recorded", *light)))
    features = _features(dataset, "silhouettes", lights, progress)
    per_fold: dict[str, dict[str, float]] = {name: {} for name in lights}
    for seed in SEEDS[:folds]:
        for part, fold in enumerate(dataset.folds_stratified(NUM_FOLDS, seed)[:folds]):
            recognizer = _train(dataset, features["as recorded"], fold, "silhouettes")
            for name in lights:
                right = _right(dataset, recognizer, features[name], fold)
                per_fold[name][f"seed {seed}, {fold.name}"] = float(np.mean(right))
            progress("training", seed * NUM_FOLDS + part + 1, len(SEEDS) * NUM_FOLDS)
    rows = [{"light": name, **statistics(found)} for name, found in per_fold.items()]
    drops = {row["light"]: rows[0]["accuracy_mean"] - row["accuracy_mean"] for row in rows}
    return {"seeds": list(SEEDS), "rows": rows, "drops": drops, "passed": max(drops.values()) < MAX_DROP}


_TARGET = " and ".join(f"{source} >= {100 * target:.0f} %" for source, target in TARGETS.items())

STUDIES = (
    Study(
        "webcam-gestures",
        f"8 dynamic gestures before webcams, {NUM_FOLDS} stratified folds",
        (FOLDER,),
        _TARGET,
        _stratified,
        axes={"source": SOURCES},
        sources=GESTURE_SOURCES,
        folds=True,
    ),
    Study(
        "webcam-conditions",
        "the same, leaving out one condition of light and background at a time",
        (FOLDER,),
        _TARGET,
        _conditions,
        layout=Layout(columns="source"),
        axes={"source": SOURCES},
        sources=GESTURE_SOURCES,
        folds=True,
    ),
    Study(
        "webcam-light",
        "the same, trained as recorded, tested in made-up light",
        (FOLDER,),
        f"no light costs {100 * MAX_DROP:.0f} points or more",
        _light,
        axes={"light": tuple(LIGHTS)},
        sources=GESTURE_SOURCES,
        folds=True,
        quick={"light": ("half exposure",)},
    ),
)
