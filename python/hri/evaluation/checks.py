# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Data sets that can be evaluated; others are refused before anything is read or trained."""

from __future__ import annotations

from hri.core.display import shown
from hri.core.errors import InvalidArgument
from hri.datasets import Dataset


def check_dataset(dataset: object, name: str) -> None:
    """Refuse what is no `Dataset`, such as the path of one. Raises InvalidArgument."""
    if not isinstance(dataset, Dataset):
        raise InvalidArgument(f"{name} must be a Dataset, as Dataset.load reads it, got {shown(dataset)}")


def check_not_empty(dataset: Dataset, name: str) -> None:
    """Refuse a data set without recordings. Raises InvalidArgument."""
    if not len(dataset):
        raise InvalidArgument(f"{name} has no recordings")
