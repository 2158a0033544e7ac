# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Cepstra of still signs in frames (thesis section 3.1.3): of which signal, with and without DWT, averaged or not.

The thesis does not give the size of the picture before its DWT, and the cepstra depend on it. It is chosen in the
folds: of every training part, persons are dealt into `NUM_PARTS` parts, each left out in turn, and the size with which
a classifier gets most of their signs right is what it is tested with, on persons that had no say in it.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.datasets import Fold
from hri.datasets.folds import split_by_person
from hri.features.hand import FRAMED_CEPSTRUM, hand_features
from hri.studies.registry import Layout, Progress, Study
from hri.studies.sign_shapes import CLASSIFIERS, SignPictures, Vectors, read_signs, shares_right
from hri.studies.tables import Row, statistics

SIGNALS = {"columns": "picture", "rows": "picture", "outline": "contour"}
"""The pixels column by column, as the thesis has it, or row by row, or the distance of the outline from its middle."""
FRAMES = ("side by side", "averaged")
TRANSFORMS: dict[str, dict[str, Any]] = {
    "mfcc": {"num_levels": 0},
    "haar+mfcc": {"wavelet": "haar", "num_levels": 3},
    "db2+mfcc": {"wavelet": "db2", "num_levels": 3},
}
SIZES_PX: dict[str, tuple[int, ...]] = {
    "mfcc": (32, 64, 128, 256),
    "haar+mfcc": (128, 256, 512),
    "db2+mfcc": (128, 256, 512),
}
"""Sides of the square that masks are scaled to before the DWT; the pictures have 100 x 100 pixels. Three levels leave
an eighth of a side, and of less than 16 x 16 pixels no 11 frames of 32 samples can be made."""
CHOSEN = "chosen"
NUM_PARTS = 3
DEFAULT_CLASSIFIERS = ("euclidean", "lda", "3-nn", "svm")
MAX_ASPECT = 1.6
"""Height over width beyond which `hri::hand_box` cuts a forearm off."""


def transposed(mask: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """A mask whose columns are the rows of `mask`, without the forearm that is cut off below an upright hand."""
    rows, columns = (np.flatnonzero(mask.any(axis=axis)) for axis in (1, 0))
    width = columns[-1] - columns[0] + 1
    return np.ascontiguousarray(mask[: rows[0] + int(MAX_ASPECT * width)].T)


def framed_vectors(signs: SignPictures, signal: str, transform: str, mask_px: int) -> Vectors:
    """11 frames of 12 coefficients of every picture, float32, shape (num_pictures, 132)."""
    masks = [transposed(mask) for mask in signs.masks] if signal == "rows" else signs.masks
    fields = TRANSFORMS[transform] | {"signal": SIGNALS[signal], "mask_px": mask_px}
    return hand_features(masks, masks, "framed-mfcc", **fields)


def averaged(vectors: Vectors) -> Vectors:
    """The mean cepstrum of the frames of every row."""
    frames = vectors.reshape(len(vectors), int(FRAMED_CEPSTRUM["num_frames"]), -1)
    return np.asarray(frames.mean(axis=1), np.float32)


def _inner_folds(signs: SignPictures, fold: Fold) -> list[tuple[NDArray[np.int64], NDArray[np.int64]]]:
    """Parts of the training part by person, as indices of pictures."""
    train = np.asarray(fold.train, np.int64)
    inner = split_by_person([signs.dataset.samples[i].person for i in train], NUM_PARTS, 0)
    return [(train[part.train], train[part.test]) for part in inner]


def measure(signs: SignPictures, by_size: dict[str, Vectors], classifiers: Sequence[str]) -> list[Row]:
    """Accuracies with each size and with that chosen in the training persons, as rows of a result.

    Parameters
    ----------
    signs : SignPictures
    by_size : dict of str to ndarray of float32, shape (num_pictures, num_features)
        The features with every size of the mask; of sizes that do equally well the first is taken.
    classifiers : sequence of str
        Of `CLASSIFIERS`.

    Returns
    -------
    list of dict
        ``mask`` is a key of `by_size` or "chosen"; the latter's rows have by fold what was chosen as ``chosen_mask``.
    """
    found: dict[tuple[str, str], dict[str, float]] = {}
    picked: dict[str, dict[str, str]] = {name: {} for name in classifiers}
    for fold in signs.folds():
        inner = _inner_folds(signs, fold)
        right = {name: dict.fromkeys(by_size, 0.0) for name in classifiers}
        for size, vectors in by_size.items():
            shares = shares_right(vectors, signs.classes, fold.train, fold.test, classifiers)
            for name, share in shares.items():
                found.setdefault((size, name), {})[fold.name] = share
            for train, test in inner:
                for name, share in shares_right(vectors, signs.classes, train, test, classifiers).items():
                    right[name][size] += share * len(test)
        for name in classifiers:
            best = max(by_size, key=right[name].__getitem__)
            picked[name][fold.name] = best
            found.setdefault((CHOSEN, name), {})[fold.name] = found[best, name][fold.name]
    rows: list[Row] = []
    for (size, name), per_fold in found.items():
        chosen = {"chosen_mask": picked[name]} if size == CHOSEN else {}
        rows.append({"mask": size, "classifier": name, **statistics(per_fold), **chosen})
    return rows


def _run(
    data_dir: Path,
    progress: Progress,
    *,
    signal: Sequence[str] = tuple(SIGNALS),
    frames: Sequence[str] = FRAMES,
    features: Sequence[str] = tuple(TRANSFORMS),
    classifier: Sequence[str] = DEFAULT_CLASSIFIERS,
) -> dict[str, Any]:
    signs = read_signs(data_dir, progress)
    rows: list[Row] = []
    for of, name in product(signal, features):
        side_by_side = {}
        for done, px in enumerate(SIZES_PX[name]):
            side_by_side[f"{px} px"] = framed_vectors(signs, of, name, px)
            progress(f"{name} of the {of}", done + 1, len(SIZES_PX[name]))
        for how in frames:
            by_size = side_by_side
            if how == "averaged":
                by_size = {size: averaged(vectors) for size, vectors in side_by_side.items()}
            measured = measure(signs, by_size, classifier)
            rows += [{"signal": of, "frames": how, "features": name, **row} for row in measured]
    return {"rows": rows, "num_without_hand": signs.num_without_hand, "passed": None}


STUDIES = (
    Study(
        "sign-framing",
        "cepstra of signs in 11 frames (section 3.1.3) by signal and DWT; size of the mask chosen in nested folds",
        ("sign_digits",),
        "none: a comparison",
        _run,
        layout=Layout(columns="classifier", panel="signal"),
        axes={
            "signal": tuple(SIGNALS),
            "frames": FRAMES,
            "features": tuple(TRANSFORMS),
            "classifier": tuple(CLASSIFIERS),
        },
        sources=(
            "cpp/signal",
            "cpp/features/hand",
            "cpp/models/...",
            "cpp/vision",
        ),
        quick={
            "signal": ("columns",),
            "frames": ("side by side",),
            "features": ("haar+mfcc",),
            "classifier": ("euclidean", "lda"),
        },
    ),
)
