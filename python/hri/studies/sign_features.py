# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Shape features of still signs (thesis section 3.2): against classifiers, by size, and how they part the signs."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np

from hri.features.hand import FRAMED_CEPSTRUM
from hri.studies.registry import Layout, Progress, Study
from hri.studies.sign_shapes import CLASSIFIERS, SignPictures, Vectors, accuracies, read_signs, scaled
from hri.studies.tables import Row

NUM_FILTERS = 26
"""Room for 20 cepstra and more."""
SIGNALS: dict[str, dict[str, Any]] = {
    "picture": FRAMED_CEPSTRUM,
    "outline": FRAMED_CEPSTRUM | {"signal": "contour"},
    "averaged outline": {"signal": "contour", "num_frames": 3, "average_frames": True},
}
"""What cepstra are taken of: the picture, column by column, or the distance of the outline from its middle, in the
thesis's 11 frames side by side; or the latter, averaged over 3 frames."""
NUM_COEFFICIENTS = {"picture": 12, "outline": 12, "averaged outline": 14}
"""Of a frame, c0 included; 12 are the thesis's (text at figures 3.5 and 3.6)."""
NUM_BINS = (9, 18, 27, 36)
TRANSFORMS = {"mfcc": "", "haar+mfcc": "haar", "db2+mfcc": "db2"}
"""By name, the wavelet of three levels; "": no DWT."""

Feature = tuple[str, dict[str, Any]]
"""A kind of `hand_features` and its options."""


def _cepstra(signal: str, wavelet: str, num_levels: int = 3, num_coefficients: int = 0) -> Feature:
    """Without DWT if the wavelet is "" or there is no level; of the signal's own number of coefficients if 0."""
    transform = {"wavelet": wavelet, "num_levels": num_levels} if wavelet and num_levels else {"num_levels": 0}
    num_cepstra = (num_coefficients or NUM_COEFFICIENTS[signal]) - 1
    return "dwt-mfcc", SIGNALS[signal] | transform | {"num_cepstra": num_cepstra, "num_filters": NUM_FILTERS}


FEATURES: dict[str, Feature] = {
    **{f"orientation {bins}": ("orientation", {"num_bins": bins}) for bins in NUM_BINS},
    **{f"orientation {bins} (60x40)": ("frame-orientation", {"num_bins": bins}) for bins in NUM_BINS},
    "orientation 8x8x9": ("orientation", {"num_cells": 8, "num_bins": 9}),
    "mfcc": _cepstra("picture", ""),
    "mfcc (32 px)": ("dwt-mfcc", _cepstra("picture", "")[1] | {"mask_px": 32}),
    "haar+mfcc": _cepstra("picture", "haar"),
    "db2+mfcc": _cepstra("picture", "db2"),
    **{
        f"{name} ({of})": _cepstra(of, wavelet)
        for of in ("outline", "averaged outline")
        for name, wavelet in TRANSFORMS.items()
    },
    "wavelet moments": ("wavelet", {}),
    "wavelet moments (outline)": ("wavelet", {"source": "contour"}),
    "fourier": ("fourier", {}),
    "fourier (phase)": ("fourier", {"use_phase": True}),
    "chain code": ("chain-code", {}),
    "chain code (8 parts)": ("chain-code", {"num_parts": 8}),
    "hu moments": ("moments", {}),
    "joined": ("hand", {}),
}
"""By name, as the study compares them; "joined" is what `GestureRecognizer` uses. 32 pixels a side remain of 256 after
three levels of "haar"."""

COEFFICIENTS = (6, 8, 10, 12, 13, 14, 15, 17, 20, 24)
COEFFICIENT_CLASSIFIERS = ("3-nn", "svm")
WAVELETS = ("haar", "db2", "db4", "sym8")
LEVELS = (0, 1, 2, 3, 4)
DISTANCE_FEATURES = (
    "mfcc",
    "haar+mfcc",
    "db2+mfcc",
    "mfcc (outline)",
    "db2+mfcc (outline)",
    "mfcc (averaged outline)",
    "db2+mfcc (averaged outline)",
    "orientation 18",
    "wavelet moments",
    "fourier (phase)",
    "joined",
)
PLACES = ((0, 1), (1, 9))
"""Of figures 3.14-3.15 and 3.12-3.13: features 1 and 2, and 2 and 10."""


def _run_features(
    data_dir: Path,
    progress: Progress,
    *,
    features: Sequence[str] = tuple(FEATURES),
    classifier: Sequence[str] = tuple(CLASSIFIERS),
) -> dict[str, Any]:
    signs = read_signs(data_dir, progress)
    rows: list[Row] = []
    for name in features:
        vectors = signs.vectors(*FEATURES[name])
        found = accuracies(signs, vectors, classifier, progress, name)
        rows += [{"features": name, **row} for row in found]
    return {"rows": rows, "num_without_hand": signs.num_without_hand, "passed": None}


def _run_coefficients(
    data_dir: Path,
    progress: Progress,
    *,
    signal: Sequence[str] = tuple(SIGNALS),
    features: Sequence[str] = tuple(TRANSFORMS),
    classifier: Sequence[str] = COEFFICIENT_CLASSIFIERS,
) -> dict[str, Any]:
    signs = read_signs(data_dir, progress)
    rows: list[Row] = []
    for of, name, count in product(signal, features, COEFFICIENTS):
        vectors = signs.vectors(*_cepstra(of, TRANSFORMS[name], num_coefficients=count))
        found = accuracies(signs, vectors, classifier, progress, f"{name} of the {of}, {count} coefficients")
        rows += [{"signal": of, "features": name, "coefficients": count, **row} for row in found]
    return {"rows": rows, "num_without_hand": signs.num_without_hand, "passed": None}


def _run_wavelets(
    data_dir: Path,
    progress: Progress,
    *,
    signal: Sequence[str] = tuple(SIGNALS),
    wavelet: Sequence[str] = WAVELETS,
    classifier: Sequence[str] = COEFFICIENT_CLASSIFIERS,
) -> dict[str, Any]:
    signs = read_signs(data_dir, progress)
    rows: list[Row] = []
    for of, name, level in product(signal, wavelet, LEVELS):
        vectors = signs.vectors(*_cepstra(of, name, level))
        found = accuracies(signs, vectors, classifier, progress, f"{name} of the {of}, level {level}")
        rows += [{"signal": of, "wavelet": name, "level": level, **row} for row in found]
    return {"rows": rows, "num_without_hand": signs.num_without_hand, "passed": None}


def separation(vectors: Vectors, classes: Any, num_classes: int) -> list[Row]:
    """How every class lies among the others, after `scaled`, in units of the root of the number of features.

    Returns
    -------
    list of dict
        By class: ``within``, mean distance to the class's mean; ``between``, of its mean to those of the others;
        ``nearest``, to the nearest of them; ``ratio``, of between to within; spreads are over what is averaged.
    """
    rows = scaled(vectors, vectors) / np.sqrt(vectors.shape[1])
    means = np.array([rows[classes == c].mean(axis=0) for c in range(num_classes)])
    found = []
    for c in range(num_classes):
        within = np.linalg.norm(rows[classes == c] - means[c], axis=1)
        between = np.delete(np.linalg.norm(means - means[c], axis=1), c)
        found.append(
            {
                "within_mean": float(within.mean()),
                "within_std": float(within.std()),
                "between_mean": float(between.mean()),
                "between_std": float(between.std()),
                "nearest_mean": float(between.min()),
                "ratio_mean": float(between.mean() / within.mean()),
            }
        )
    return found


def _run_distances(
    data_dir: Path, progress: Progress, *, features: Sequence[str] = DISTANCE_FEATURES
) -> dict[str, Any]:
    signs = read_signs(data_dir, progress)
    rows: list[Row] = []
    points = {}
    for done, name in enumerate(features):
        vectors = signs.vectors(*FEATURES[name])
        found = separation(vectors, signs.classes, len(signs.labels))
        rows += [{"features": name, "sign": label, **row} for label, row in zip(signs.labels, found, strict=True)]
        points[name] = _points(signs, vectors)
        progress("distances", done + 1, len(features))
    return {"rows": rows, "points": points, "num_without_hand": signs.num_without_hand, "passed": None}


def _points(signs: SignPictures, vectors: Vectors) -> dict[str, Any]:
    """Two planes of the features of each sign, as pictures draw them."""
    rows = scaled(vectors, vectors)
    planes = {}
    for x, y in PLACES:
        if y >= rows.shape[1]:
            continue
        planes[f"features {x + 1} and {y + 1}"] = {
            label: np.round(rows[signs.classes == c][:, [x, y]], 3).tolist() for c, label in enumerate(signs.labels)
        }
    return planes


_DATA = ("sign_digits",)
_TARGET = "none: a comparison"
_SOURCES = (
    "cpp/signal",
    "cpp/features/hand",
    "cpp/models/...",
    "cpp/vision",
)

STUDIES = (
    Study(
        "sign-features",
        "shape features against classifiers (thesis tables 3.3-3.10) on hand signs for 0-9, 5 folds by person",
        _DATA,
        _TARGET,
        _run_features,
        layout=Layout(columns="classifier"),
        axes={"features": tuple(FEATURES), "classifier": tuple(CLASSIFIERS)},
        sources=_SOURCES,
        quick={"features": ("haar+mfcc",), "classifier": ("svm",)},
    ),
    Study(
        "sign-coefficients",
        "the number of coefficients of a silhouette with and without DWT (figures 3.21, 3.22), as sign-features",
        _DATA,
        _TARGET,
        _run_coefficients,
        layout=Layout(columns="coefficients", x="coefficients", panel="classifier"),
        axes={"signal": tuple(SIGNALS), "features": tuple(TRANSFORMS), "classifier": tuple(CLASSIFIERS)},
        sources=_SOURCES,
        quick={"signal": ("picture",), "features": ("haar+mfcc",), "classifier": ("svm",)},
    ),
    Study(
        "sign-wavelets",
        "wavelet and level before the cepstra of a silhouette (level 0: no wavelet), as sign-features",
        _DATA,
        _TARGET,
        _run_wavelets,
        layout=Layout(columns="level", x="level", panel="classifier"),
        axes={"signal": tuple(SIGNALS), "wavelet": WAVELETS, "classifier": tuple(CLASSIFIERS)},
        sources=_SOURCES,
        quick={"signal": ("picture",), "wavelet": ("haar",), "classifier": ("svm",)},
    ),
    Study(
        "sign-distances",
        "distances within and between signs, and planes of features (figures 3.12-3.19)",
        _DATA,
        _TARGET,
        _run_distances,
        layout=Layout(panel="features", measure="ratio", percent=False),
        axes={"features": tuple(FEATURES)},
        sources=_SOURCES,
        quick={"features": ("haar+mfcc",)},
    ),
)
