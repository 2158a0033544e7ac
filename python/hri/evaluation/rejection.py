# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""How well a score separates in-vocabulary from out-of-vocabulary input."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hri.core.errors import InvalidArgument

Shares = NDArray[np.float64]


def error_rates(known: ArrayLike, unknown: ArrayLike) -> tuple[Shares, Shares]:
    """False accepts and false rejects at every threshold.

    Parameters
    ----------
    known, unknown : array-like of float
        Score of what belongs to the vocabulary, and of what does not; -inf for what is never accepted.

    Returns
    -------
    false_accepts, false_rejects : arrays of shape (num_thresholds,)
        Shares of `unknown` and of `known`, from the threshold that accepts everything to the one that accepts nothing.

    Raises
    ------
    InvalidArgument
        Where either is empty, or holds NaN.
    """
    ours, others = np.sort(np.asarray(known, float)), np.sort(np.asarray(unknown, float))
    if not ours.size or not others.size or np.isnan(ours).any() or np.isnan(others).any():
        raise InvalidArgument("known and unknown both need score, and none of it may be NaN")
    both = np.concatenate([ours, others])
    thresholds = np.append(np.unique(both[np.isfinite(both)]), np.inf)
    rejected = np.searchsorted(ours, thresholds, side="left") / ours.size
    accepted = 1.0 - np.searchsorted(others, thresholds, side="left") / others.size
    return accepted, rejected


def equal_error_rate(known: ArrayLike, unknown: ArrayLike) -> float:
    """The mean of false accepts and false rejects at the threshold where they are nearest; 0..1, 0.5 is chance.

    Parameters and errors as of `error_rates`.
    """
    accepted, rejected = error_rates(known, unknown)
    at = int(np.argmin(np.abs(accepted - rejected)))
    return float((accepted[at] + rejected[at]) / 2)


def false_rejects_at(known: ArrayLike, unknown: ArrayLike, shares: Sequence[float]) -> list[float]:
    """The least share of false rejects at which no more than each of `shares` of the unknown is accepted."""
    accepted, rejected = error_rates(known, unknown)
    return [float(rejected[accepted <= share].min()) for share in shares]
