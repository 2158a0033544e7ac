# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Rows of results: what was varied, and what was measured, with its value in every fold.

Rows hold ``{measure}_mean``, ``{measure}_std`` and the values of every fold: under ``"per_fold"`` those of the measure
that the row is about, under ``{measure}_per_fold`` those of each other one.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

Row = dict[str, Any]
PER_FOLD = "per_fold"


def statistics(per_fold: dict[str, float], measure: str = "accuracy") -> Row:
    """Mean and spread (population standard deviation) over folds, as rows hold them."""
    values = list(per_fold.values())
    mean = sum(values) / len(values)
    spread = (sum((value - mean) ** 2 for value in values) / len(values)) ** 0.5
    return {f"{measure}_mean": mean, f"{measure}_std": spread, PER_FOLD: per_fold}


def further_statistics(per_fold: dict[str, float], measure: str) -> Row:
    """The same of a measure beside that of `statistics`."""
    found = statistics(per_fold, measure)
    return found | by_fold(measure, found.pop(PER_FOLD))


def by_fold(measure: str, values: Mapping[str, float | None]) -> Row:
    """The folds of a measure whose mean is not that over folds, such as a share of all clips."""
    return {f"{measure}_{PER_FOLD}": dict(values)}


def folds_of(row: Row) -> dict[str, dict[str, Any]]:
    """The values of every fold by the key that holds them."""
    return {key: value for key, value in row.items() if key.endswith(PER_FOLD) and isinstance(value, dict)}


def axes_of(rows: Sequence[Row]) -> list[str]:
    """What is varied: the keys that no measurement takes, in the order of their first use."""
    keys = dict.fromkeys(key for row in rows for key in row)
    return [k for k in keys if not k.endswith(("_mean", "_std")) and not any(isinstance(r.get(k), dict) for r in rows)]


def measures_of(rows: Sequence[Row]) -> list[str]:
    """What was measured, in the order of first use."""
    return list(dict.fromkeys(key[: -len("_mean")] for row in rows for key in row if key.endswith("_mean")))
