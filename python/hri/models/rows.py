# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Rows and labels as models of rows take them, with messages that name what is wrong."""

from __future__ import annotations

import sys
import warnings
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hri.core.errors import InvalidArgument

Rows = NDArray[np.float32]


def as_rows(X: ArrayLike, owner: str, num_features: int | None = None, min_rows: int = 1) -> Rows:
    """A matrix as contiguous float32.

    Raises
    ------
    InvalidArgument
        For another shape than (num_rows, num_features), complex numbers, NaN or infinity.
    TypeError
        For sparse matrices.
    """
    if hasattr(X, "toarray"):
        raise TypeError(f"{owner} takes no sparse matrix: sparse data was passed, dense is required; use X.toarray()")
    values = np.asarray(X)
    if values.dtype.kind == "c":
        raise InvalidArgument(f"Complex data not supported by {owner}")
    if values.ndim != 2:
        raise InvalidArgument(
            f"{owner} expected a 2D array, got {values.ndim}D of shape {values.shape}. Reshape your data: "
            "X.reshape(1, -1) for a single row"
        )
    if values.shape[0] < min_rows:
        raise InvalidArgument(
            f"Found array with {values.shape[0]} sample(s) (shape={values.shape}) while a minimum of {min_rows} is "
            f"required by {owner}."
        )
    if values.shape[1] == 0:
        raise InvalidArgument(
            f"Found array with 0 feature(s) (shape={values.shape}) while a minimum of 1 is required by {owner}."
        )
    if num_features is not None and values.shape[1] != num_features:
        raise InvalidArgument(
            f"X has {values.shape[1]} features, but {owner} is expecting {num_features} features as input"
        )
    with np.errstate(over="ignore"):
        rows = np.ascontiguousarray(values, dtype=np.float32)
    if not np.isfinite(rows).all():
        row, column = np.argwhere(~np.isfinite(rows))[0]
        raise InvalidArgument(
            f"{owner}: X[{row}, {column}] is {values[row, column]}: NaN, infinity or too large for float32"
        )
    return rows


def as_labels(y: ArrayLike | None, num_rows: int, owner: str) -> tuple[NDArray[Any], NDArray[np.int32]]:
    """The classes in sorted order, and the class of every row.

    Raises
    ------
    InvalidArgument
        For another length than the rows', fewer than two classes, or numbers that are no classes.
    """
    if y is None:
        raise InvalidArgument(f"{owner} requires y to be passed, but the target y is None")
    labels = np.asarray(y)
    if labels.ndim == 2 and labels.shape[1] == 1:
        _warn_of_column(owner)
        labels = labels[:, 0]
    if labels.ndim != 1:
        raise InvalidArgument(f"Unknown label type: y must be one-dimensional, got shape {labels.shape}")
    if len(labels) != num_rows:
        raise InvalidArgument(f"X and y differ in length: {num_rows}, {len(labels)}")
    if labels.dtype.kind == "f":
        if not np.isfinite(labels).all():
            raise InvalidArgument("Input y contains NaN or infinity")
        if (labels != np.floor(labels)).any():
            raise InvalidArgument("Unknown label type: continuous numbers are no classes")
    classes, indices = np.unique(labels, return_inverse=True)
    if len(classes) < 2:
        raise InvalidArgument(f"{owner} needs two classes or more; y has {len(classes)} class")
    return classes, indices.astype(np.int32)


def share_right(predicted: NDArray[Any], y: ArrayLike, owner: str) -> float:
    """Share of labels that are predicted, 0..1; `y` may be a column, as `as_labels` takes it.

    Raises
    ------
    InvalidArgument
        For another length than that of what was predicted, another shape, or nothing at all.
    """
    labels = np.asarray(y)
    if labels.ndim == 2 and labels.shape[1] == 1:
        labels = labels[:, 0]
    if labels.ndim != 1:
        raise InvalidArgument(f"y must be one-dimensional, got shape {labels.shape}")
    if len(labels) != len(predicted):
        raise InvalidArgument(f"X and y differ in length: {len(predicted)}, {len(labels)}")
    if not len(labels):
        raise InvalidArgument(f"{owner}.score needs one item or more")
    return float(np.mean(predicted == labels))


def _warn_of_column(owner: str) -> None:
    theirs = sys.modules.get("sklearn.exceptions")
    category = UserWarning if theirs is None else theirs.DataConversionWarning
    warnings.warn(
        "A column-vector y was passed when a 1d array was expected. Please change the shape of y to (n_samples,), "
        f"for example using ravel(); {owner} takes the column.",
        category,
        stacklevel=4,
    )
