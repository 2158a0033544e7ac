# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Distances of vectors and of Gaussians."""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from hri import _native

Metric = Literal["euclidean", "manhattan", "cosine", "bhattacharyya"]


def distance(metric: Metric, a: ArrayLike, b: ArrayLike) -> float:
    """Distance of two vectors of one length.

    Parameters
    ----------
    metric : {"euclidean", "manhattan", "cosine", "bhattacharyya"}
    a, b : array_like, shape (num_features,)
    """
    return float(_native.distance(metric, np.asarray(a, np.float32), np.asarray(b, np.float32)))


def bhattacharyya_gaussian(
    mean_a: ArrayLike, covariance_a: ArrayLike, mean_b: ArrayLike, covariance_b: ArrayLike
) -> float:
    """Bhattacharyya distance of two Gaussians.

    Parameters
    ----------
    mean_a, mean_b : array_like, shape (num_features,)
    covariance_a, covariance_b : array_like, shape (num_features, num_features)
        Positive definite.
    """
    parts = (np.asarray(part, np.float64) for part in (mean_a, covariance_a, mean_b, covariance_b))
    return float(_native.bhattacharyya_gaussian(*parts))
