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
TARGETS = {"silhouettes": 0.93, "landmarks": 0.99}
NUM_FOLDS = 5
SEEDS = (0, 1, 2)
MAX_DROP = 0.05
ANGLES = (0.0, 15.0, 30.0, 45.0)
"""Values of the option ``turn_degrees`` among which training folds choose."""
NUM_PARTS = 3
"""Parts of the conditions trained on, each left out in turn to choose."""
NUM_TRAINED = (3, 5, 7)
"""Conditions that are trained on, in the learning curve."""
NUM_SPLITS = 10
SPLIT_SEED = 0

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


def _train(dataset: Dataset, rows: Sequence[Rows], fold: Fold, source: Any, **options: Any) -> GestureRecognizer:
    return GestureRecognizer(source=source, **options).fit_features(
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


def _passed(rows: Sequence[dict[str, Any]]) -> bool:
    return all(row["accuracy_mean"] >= TARGETS[row["source"]] for row in rows)


def _conditions_of(dataset: Dataset, data_dir: Path) -> list[str]:
    own = data_dir / FOLDER / CONDITIONS
    clips = [f"{sample.label}/{sample.take}" for sample in dataset.samples]
    return read_conditions(clips, own if own.exists() else None)


def _fold(name: str, clips: Sequence[int], conditions: Sequence[str], left_out: Sequence[str]) -> Fold:
    """Those of `clips` whose condition is left out are tested."""
    return Fold(
        name, [i for i in clips if conditions[i] not in left_out], [i for i in clips if conditions[i] in left_out]
    )


def _choose(
    dataset: Dataset, rows: Sequence[Rows], clips: Sequence[int], conditions: Sequence[str], source: Any
) -> float:
    """The angle that does best when parts of the conditions of `clips` are left out; of equals, the surest."""
    names = list(dict.fromkeys(conditions[i] for i in clips))
    folds = [_fold("", clips, conditions, names[part::NUM_PARTS]) for part in range(min(NUM_PARTS, len(names)))]
    found: dict[float, tuple[int, float]] = {}
    for angle in ANGLES:
        right, sure = 0, 0.0
        for fold in folds:
            recognizer = _train(dataset, rows, fold, source, turn_degrees=angle)
            for i in fold.test:
                nbest = recognizer.recognise_features(rows[i]).nbest
                right += bool(nbest) and nbest[0].label == dataset.samples[i].label
                sure += sum(entry.probability for entry in nbest if entry.label == dataset.samples[i].label)
        found[angle] = (right, sure)
    return max(ANGLES, key=lambda angle: found[angle])


def _nested(
    data_dir: Path, progress: Progress, *, source: Sequence[str] = SOURCES, folds: int | None = None
) -> dict[str, Any]:
    dataset = _load(data_dir)
    conditions = _conditions_of(dataset, data_dir)
    rows, means, chosen = [], [], {}
    for name in measurable(source):
        features = _features(dataset, name, ["as recorded"], progress)["as recorded"]
        right: dict[str, list[bool]] = {}
        names = list(dict.fromkeys(conditions))[:folds]
        for done, left_out in enumerate(names):
            fold = _fold(left_out, range(len(dataset)), conditions, [left_out])
            angle = _choose(dataset, features, fold.train, conditions, name)
            recognizer = _train(dataset, features, fold, name, turn_degrees=angle)
            right[left_out] = _right(dataset, recognizer, features, fold)
            chosen[f"{name}, {left_out}"] = angle
            rows.append({"left out": left_out, "source": name, "accuracy_mean": float(np.mean(right[left_out]))})
            progress(f"training, {name}", done + 1, len(names))
        # Conditions have 3 to 12 clips each, so that every clip counts as much as any other.
        every = [value for values in right.values() for value in values]
        per_fold = {left_out: float(np.mean(values)) for left_out, values in right.items()}
        means.append(
            {"left out": "all clips", "source": name, "accuracy_mean": float(np.mean(every)), "per_fold": per_fold}
        )
    return {"chosen_degrees": chosen, "rows": [*rows, *means], "passed": _passed(means)}


def _splits(dataset: Dataset, conditions: Sequence[str], trained: int) -> list[Fold]:
    """Random conditions to train on, of which every gesture has a clip; the clips of the others are tested."""
    rng = np.random.default_rng(SPLIT_SEED)
    names = sorted(set(conditions))
    folds: list[Fold] = []
    while len(folds) < NUM_SPLITS:
        left_out = rng.permutation(names)[trained:].tolist()
        fold = _fold(f"split {len(folds) + 1}", range(len(dataset)), conditions, left_out)
        if {dataset.samples[i].label for i in fold.train} == set(dataset.labels):
            folds.append(fold)
    return folds


def _curve(
    data_dir: Path, progress: Progress, *, source: Sequence[str] = SOURCES, folds: int | None = None
) -> dict[str, Any]:
    dataset = _load(data_dir)
    conditions = _conditions_of(dataset, data_dir)
    most = len(set(conditions)) - 1
    rows = []
    for name in measurable(source):
        features = _features(dataset, name, ["as recorded"], progress)["as recorded"]
        for done, trained in enumerate(NUM_TRAINED):
            per_fold = {}
            for fold in _splits(dataset, conditions, min(trained, most))[:folds]:
                recognizer = _train(dataset, features, fold, name)
                per_fold[fold.name] = float(np.mean(_right(dataset, recognizer, features, fold)))
            rows.append({"trained on": trained, "source": name, **statistics(per_fold)})
            progress(f"training, {name}", done + 1, len(NUM_TRAINED))
    return {"seed": SPLIT_SEED, "rows": rows, "passed": None}


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
        "8 dynamic gestures before webcams, leaving out one condition of light and background at a time; options are "
        "chosen by leaving out others of those trained on",
        (FOLDER,),
        _TARGET,
        _nested,
        layout=Layout(columns="source"),
        axes={"source": SOURCES},
        sources=GESTURE_SOURCES,
        folds=True,
    ),
    Study(
        "webcam-conditions",
        f"the same by the number of conditions trained on, tested in all others, {NUM_SPLITS} random splits each",
        (FOLDER,),
        "none: how much new webcams cost",
        _curve,
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
