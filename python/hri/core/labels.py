# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Labels and persons as text."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from hri.core.display import shown
from hri.core.errors import InvalidArgument


def as_text(value: object, name: str) -> str:
    """One label or person as text; as `as_texts`."""
    if isinstance(value, bool) or not isinstance(value, str | int | np.integer):
        raise InvalidArgument(f"{name} must be text, got {shown(value)}")
    text = str(value)
    if not text.isascii() and any("\ud800" <= character <= "\udfff" for character in text):
        raise InvalidArgument(f"{name} is {text!r}, which is not UTF-8")
    return text


def as_texts(values: Iterable[object], name: str) -> list[str]:
    """Labels or persons as text, integers written in digits.

    Raises
    ------
    InvalidArgument
        For a single text in place of several, for one that is neither text nor an integer (such as the NaN or None of a
        table's empty cell), and for one that UTF-8 cannot hold, as from the name of a file; names the item.
    """
    if isinstance(values, str | bytes):
        raise InvalidArgument(f"{name} must be a sequence of texts, got one: write [{shown(values)}]")
    if not isinstance(values, Iterable):
        raise InvalidArgument(f"{name} must be a sequence of texts, got {shown(values)}")
    return [as_text(value, f"{name}[{i}]") for i, value in enumerate(values)]
