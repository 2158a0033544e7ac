# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Features of single frames of moving gestures (thesis tables 3.6, 3.10 and 4.3), by frames and as sequences."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import InvalidArgument
from hri.datasets import Dataset
from hri.features.hand import hand_features
from hri.language import WordErrors, count_word_errors
from hri.media import read_frames
from hri.models import PCA
from hri.recognition import SentenceRecognizer
from hri.studies.gesture_sentences import ONE_MODEL, SEED, GestureClip, sentences_of, train_words
from hri.studies.hybrid_features import FAMILIES, NUM_FRAMES, NUM_PARTS, SEEDS, moving_frames
from hri.studies.registry import Layout, Progress, Study
from hri.studies.sign_features import FEATURES as SIGN_FEATURES
from hri.studies.sign_shapes import CLASSIFIERS, NUM_COMPONENTS, NUM_NEIGHBOURS, Fit, scaled
from hri.studies.tables import Row, further_statistics, statistics
from hri.studies.webcam import CONDITIONS, FOLDER, PATTERN, read_conditions
from hri.vision.hands import find_silhouettes

FEATURES = (
    "orientation 18",
    "orientation 36",
    "orientation 18 (60x40)",
    "orientation 36 (60x40)",
    "mfcc",
    "haar+mfcc",
    "db2+mfcc",
)
"""Of `sign-features`: tables 3.10 and 4.3 compare these; (60x40) of the whole picture, the others of the hand."""
BY_FRAMES = ("knn", "svm")
BY_SEQUENCES = ("HMM", "PTBHMM", "HMM, Gaussian", "PTBHMM, Gaussian")
BINS = ("18", "36")
MODELS = ("hmm", "ptbhmm")
GAP = 15
"""Frames between two gestures of a sentence."""

Rows = NDArray[np.float32]
Labels = NDArray[np.int64]


@dataclass(frozen=True)
class MovingClip:
    """A gesture: the rows of each of `FEATURES` at `NUM_FRAMES` frames spread over what moves."""

    label: str
    condition: str
    rows: dict[str, Rows]


def _samples(data_dir: Path) -> tuple[Dataset, list[str]]:
    dataset = Dataset.load(data_dir / FOLDER, "gesture", PATTERN)
    own = data_dir / FOLDER / CONDITIONS
    takes = [f"{sample.label}/{sample.take}" for sample in dataset.samples]
    conditions = read_conditions(takes, own if own.exists() else None)
    if len(set(conditions)) < 3:
        raise InvalidArgument(f"{FOLDER}: clips of {len(set(conditions))} conditions, needed are 3")
    return dataset, conditions


def _read(data_dir: Path, features: Sequence[str], progress: Progress) -> tuple[list[str], list[MovingClip]]:
    dataset, conditions = _samples(data_dir)
    clips = []
    for sample, condition in zip(dataset.samples, conditions, strict=True):
        shapes = find_silhouettes(read_frames(sample.path).frames, faces="never")
        frames = moving_frames([np.asarray(shape.mask) for shape in shapes])
        chosen = [shapes[i] for i in frames[np.linspace(0, len(frames) - 1, NUM_FRAMES).round().astype(int)]]
        greys, masks = [np.asarray(s.grey) for s in chosen], [np.asarray(s.mask) for s in chosen]
        rows = {}
        for name in features:
            kind, options = SIGN_FEATURES[name]
            rows[name] = hand_features(greys, masks, kind, **options)  # type: ignore[arg-type]
        clips.append(MovingClip(sample.label, condition, rows))
        progress("finding hands", len(clips), len(dataset))
    return dataset.labels, clips


def _prepared(rows: Sequence[Rows], train: Labels, components: bool) -> list[Rows]:
    """Columns scaled, and principal components of them, as the clips trained on have them."""
    known = np.concatenate([rows[i] for i in train])
    same = [scaled(one, known) for one in rows]
    if not components:
        return same
    pca = PCA(min(NUM_COMPONENTS, known.shape[1])).fit(scaled(known, known))
    return [np.asarray(pca.transform(one), np.float32) for one in same]


def vote(fit: Fit, rows: Sequence[Rows], labels: Labels, train: Labels, test: Labels) -> tuple[list[float], list[bool]]:
    """Every frame is named by itself: the share of right ones of each test clip, and whether most have its name.

    Of names that are equally frequent the first in the order of the labels counts.
    """
    known = np.concatenate([rows[i] for i in train])
    predict = fit(known, np.repeat(labels[train], [len(rows[i]) for i in train]))
    named = [np.asarray(predict(rows[i]), np.int64) for i in test]
    shares = [float(np.mean(names == labels[i])) for names, i in zip(named, test, strict=True)]
    return shares, [int(np.bincount(names).argmax()) == labels[i] for names, i in zip(named, test, strict=True)]


def _inner_parts(conditions: NDArray[np.str_], outer: Labels) -> list[tuple[Labels, Labels]]:
    names = list(dict.fromkeys(conditions[outer].tolist()))
    parts = []
    for part in range(min(NUM_PARTS, len(names))):
        left_out = np.isin(conditions[outer], names[part::NUM_PARTS])
        parts.append((outer[~left_out], outer[left_out]))
    return parts


def _choose_neighbours(rows: Sequence[Rows], labels: Labels, conditions: NDArray[np.str_], outer: Labels) -> int:
    """The number of neighbours that names most frames right in conditions left out of those trained on."""
    right = dict.fromkeys(NUM_NEIGHBOURS, 0.0)
    for train, test in _inner_parts(conditions, outer):
        inner = _prepared(rows, train, components=True)
        for k in right:
            right[k] += sum(vote(CLASSIFIERS[f"{k}-nn"], inner, labels, train, test)[0])
    return max(right, key=lambda k: right[k])


def _run_features(
    data_dir: Path,
    progress: Progress,
    *,
    features: Sequence[str] = FEATURES,
    folds: int | None = None,
) -> dict[str, Any]:
    names, clips = _read(data_dir, features, progress)
    labels = np.array([names.index(clip.label) for clip in clips])
    conditions = np.array([clip.condition for clip in clips])
    per_fold: dict[tuple[str, str], dict[str, float]] = {}
    frames: dict[tuple[str, str], dict[str, float]] = {}
    neighbours: dict[str, dict[str, int]] = {}
    left_out = list(dict.fromkeys(conditions.tolist()))[:folds]
    for name in features:
        rows = [clip.rows[name] for clip in clips]
        for done, condition in enumerate(left_out):
            test, train = np.flatnonzero(conditions == condition), np.flatnonzero(conditions != condition)
            k = _choose_neighbours(rows, labels, conditions, train)
            neighbours.setdefault(name, {})[condition] = k
            whole, components = _prepared(rows, train, False), _prepared(rows, train, True)
            for classifier, fit, given in (
                ("knn", CLASSIFIERS[f"{k}-nn"], components),
                ("svm", CLASSIFIERS["svm"], whole),
            ):
                shares, right = vote(fit, given, labels, train, test)
                frames.setdefault((name, classifier), {})[condition] = float(np.mean(shares))
                per_fold.setdefault((name, classifier), {})[condition] = float(np.mean(right))
            for family in FAMILIES[1:]:
                for classifier, found in family(components, labels, train, test, SEEDS).items():
                    per_fold.setdefault((name, classifier), {})[condition] = float(found.mean())
            progress(name, done + 1, len(left_out))
    rows_of_result: list[Row] = []
    for (name, classifier), values in per_fold.items():
        row = {"features": name, "classifier": classifier, **statistics(values)}
        if (name, classifier) in frames:
            row |= further_statistics(frames[name, classifier], "frames")
        rows_of_result.append(row)
    return {"seeds": list(SEEDS), "num_neighbours": neighbours, "rows": rows_of_result, "passed": None}


class _Histograms:
    """Rows as they are, all columns on the scale of one."""

    def __init__(self, clips: Sequence[GestureClip]) -> None:
        seen = np.concatenate([clip.rows[~np.isnan(clip.rows[:, 0])] for clip in clips])
        self._scale = float(seen.std(axis=0).mean())

    def __call__(self, rows: Rows) -> Rows:
        return (rows / self._scale).astype(np.float32)


def _read_histograms(data_dir: Path, bins: Sequence[str], progress: Progress) -> dict[str, list[GestureClip]]:
    """Of every frame; NaN where no hand is seen."""
    dataset, conditions = _samples(data_dir)
    clips: dict[str, list[GestureClip]] = {name: [] for name in bins}
    for done, (sample, condition) in enumerate(zip(dataset.samples, conditions, strict=True)):
        shapes = find_silhouettes(read_frames(sample.path).frames, faces="never")
        for name in bins:
            rows = np.full((len(shapes), int(name)), np.nan, np.float32)
            for t, shape in enumerate(shapes):
                row = hand_features(
                    [np.asarray(shape.grey)], [np.asarray(shape.mask)], "orientation", num_bins=int(name)
                )
                if len(row):
                    rows[t] = row[0]
            clips[name].append(GestureClip(sample.label, condition, rows, sample.path))
        progress("finding hands", done + 1, len(dataset))
    return clips


def _run_sentences(
    data_dir: Path,
    progress: Progress,
    *,
    bins: Sequence[str] = BINS,
    model: Sequence[str] = MODELS,
    folds: int | None = None,
) -> dict[str, Any]:
    read = _read_histograms(data_dir, bins, progress)
    rows: list[Row] = []
    for num_bins, clips in read.items():
        conditions = list(dict.fromkeys(clip.condition for clip in clips))[:folds]
        for name in model:
            whole: dict[str, float] = {}
            errors: dict[str, float] = {}
            total = WordErrors()
            for done, condition in enumerate(conditions):
                train = [clip for clip in clips if clip.condition != condition]
                histograms: Callable[[Rows], Rows] = _Histograms(train)
                words = train_words(train, histograms, name, **ONE_MODEL)  # type: ignore[arg-type]
                sentences = sentences_of([clip for clip in clips if clip.condition == condition], GAP, SEED)
                truth = [s.labels for s in sentences]
                found = [list(words.recognise(histograms(s.rows)).labels) for s in sentences]
                counted = count_word_errors(truth, found)
                total += counted
                errors[condition] = counted.rate
                whole[condition] = float(np.mean([a == b for a, b in zip(truth, found, strict=True)]))
                progress(f"{num_bins} bins, {name}", done + 1, len(conditions))
            rows.append(
                {
                    "bins": num_bins,
                    "model": name,
                    **statistics(whole),
                    **further_statistics(errors, "word_error"),
                    "over_all": {"word_error": total.rate, **vars(total)},
                }
            )
    options = SentenceRecognizer(input="rows", language_order=0, **ONE_MODEL).options.as_dict()
    return {"seed": SEED, "options": options, "rows": rows, "passed": None}


_SOURCES = (
    "cpp/signal",
    "cpp/features/hand",
    "cpp/models/...",
    "cpp/vision",
)

STUDIES = (
    Study(
        "moving-features",
        "features of single frames of 8 gestures before webcams: orientation histograms, MFCC, DWT and MFCC (tables "
        "3.6, 3.10), by KNN and SVM, the clip by the most frequent name, and as sequences by HMM and PTBHMM (table "
        "4.3); one condition of light and background left out at a time",
        (FOLDER,),
        "none: a comparison",
        _run_features,
        layout=Layout(columns="classifier"),
        axes={"features": FEATURES},
        sources=_SOURCES,
        folds=True,
        quick={"features": ("orientation 18",)},
    ),
    Study(
        "orientation-sentences",
        "sentences of 2 to 5 gestures before webcams by orientation histograms of 18 and 36 bins, HMM and PTBHMM "
        "(table 4.3): sentences right and word errors, one condition of light and background left out at a time",
        (FOLDER,),
        "none: a comparison",
        _run_sentences,
        layout=Layout(columns="model"),
        axes={"bins": BINS, "model": MODELS},
        sources=(*_SOURCES, "cpp/language", "cpp/recognition/sentence"),
        folds=True,
        quick={"bins": ("18",), "model": ("ptbhmm",)},
    ),
)
