# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What a caller may have meant by a name that there is not."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches

_MAX_LISTED = 12


def nearest(name: str, known: Iterable[str]) -> list[str]:
    """Up to three of `known` that are spelt like `name`, the nearest first; upper and lower case count alike."""
    by_lower = {entry.lower(): entry for entry in known}
    return [by_lower[match] for match in get_close_matches(name.lower(), by_lower, n=3, cutoff=0.6)]


def did_you_mean(name: str, known: Iterable[str], what: str = "there are") -> str:
    """The end of an error message: the names like `name`, or those there are where none is like it.

    Examples
    --------
    >>> did_you_mean("trian", ["train", "watch"])
    "did you mean 'train'?"
    >>> did_you_mean("x", ["train", "watch"])
    'there are: train, watch'
    """
    names = [str(entry) for entry in known]
    alike = nearest(name, names)
    if alike:
        return f"did you mean {' or '.join(repr(entry) for entry in alike)}?"
    more = f" and {len(names) - _MAX_LISTED} more" if len(names) > _MAX_LISTED else ""
    return f"{what}: {', '.join(names[:_MAX_LISTED])}{more}"
