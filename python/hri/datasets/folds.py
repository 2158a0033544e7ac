# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Splits for cross-validation: by person, or stratified where persons are not known."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from hri.core.checks import check_integer
from hri.core.display import short_repr
from hri.core.errors import InvalidArgument


@dataclass(frozen=True)
@short_repr
class Fold:
    """One split; indices point into `Dataset.samples`, rising.

    Attributes
    ----------
    name : str
        Who is held out.
    train, test : list of int
        Without a common index; together all samples.
    """

    name: str
    train: list[int]
    test: list[int]


def split_by_person(persons: Sequence[str], num_folds: int | None, seed: int) -> list[Fold]:
    """Folds in which no person is in both parts.

    Parameters
    ----------
    persons : sequence of str
        The person of every sample.
    num_folds : int or None
        2 up to the number of persons; None holds out one person at a time.
    seed : int
        0 or more; orders the persons before they are dealt into folds.

    Raises
    ------
    InvalidArgument
        For a sample without a person, fewer than two persons, `num_folds` out of range, or what is not an integer.
    """
    _check_integers(num_folds, seed)
    for index, person in enumerate(persons):
        if not person:
            raise InvalidArgument(f"sample {index} has no person, so it cannot be split by person")
    names = sorted(set(persons))
    if len(names) < 2:
        raise InvalidArgument(f"a split by person needs 2 persons or more, got {names}")
    if num_folds is None:
        return [_fold(name, persons, {name}) for name in names]
    if not 2 <= num_folds <= len(names):
        raise InvalidArgument(f"num_folds is {num_folds}, must be 2..{len(names)} (the number of persons)")
    order = np.random.default_rng(seed).permutation(len(names))
    groups = [sorted(names[i] for i in order[start::num_folds]) for start in range(num_folds)]
    return [_fold(_group_name(group, part, num_folds), persons, set(group)) for part, group in enumerate(groups)]


def split_by_value(name: str, values: Sequence[str]) -> list[Fold]:
    """Folds that each hold out one of the values that samples have.

    Raises
    ------
    InvalidArgument
        For fewer than two values.
    """
    different = sorted(set(values))
    if len(different) < 2:
        raise InvalidArgument(f"a split by {name} needs 2 values or more, got {different}")
    return [_fold(value, values, {value}) for value in different]


def split_stratified(labels: Sequence[str], num_folds: int, seed: int) -> list[Fold]:
    """Folds with nearly the same share of every label, for recordings of one or of unknown persons.

    Raises
    ------
    InvalidArgument
        When `num_folds` is below 2, or above the number of samples of some label (which is named), a negative seed, or
        what is not an integer.
    """
    _check_integers(num_folds, seed)
    fold_of = np.empty(len(labels), dtype=int)
    rng = np.random.default_rng(seed)
    next_fold = 0
    for label in sorted(set(labels)):
        members = np.flatnonzero([other == label for other in labels])
        if not 2 <= num_folds <= len(members):
            raise InvalidArgument(f"num_folds is {num_folds}, must be 2..{len(members)} (samples of label {label!r})")
        fold_of[rng.permutation(members)] = (next_fold + np.arange(len(members))) % num_folds
        next_fold = (next_fold + len(members)) % num_folds
    return [
        Fold(
            f"part {fold + 1} of {num_folds}",
            np.flatnonzero(fold_of != fold).tolist(),
            np.flatnonzero(fold_of == fold).tolist(),
        )
        for fold in range(num_folds)
    ]


def _check_integers(num_folds: int | None, seed: int) -> None:
    if num_folds is not None:
        check_integer(num_folds, "num_folds")
    check_integer(seed, "seed", 0)


def _group_name(group: Sequence[str], part: int, num_parts: int) -> str:
    if len(group) <= 3:
        return ", ".join(group)
    return f"part {part + 1} of {num_parts} ({len(group)} persons)"


def _fold(name: str, persons: Sequence[str], held_out: set[str]) -> Fold:
    return Fold(
        name,
        [i for i, person in enumerate(persons) if person not in held_out],
        [i for i, person in enumerate(persons) if person in held_out],
    )
