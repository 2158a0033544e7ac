# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Fields of a TOML table written by hand: present, of their kind, and within their range."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from collections.abc import Set as AbstractSet
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import InvalidArgument

Kind = TypeVar("Kind")
_KINDS: dict[type, str] = {str: "text", list: "a list", dict: "a table"}


def field_of(table: Mapping[str, Any], name: str, kind: type[Kind], where: str) -> Kind:
    """A field that must be there; InvalidArgument, which says where, when it is not or is of another kind."""
    if name not in table:
        raise InvalidArgument(f"{where}: {name} is missing")
    value = table[name]
    if not isinstance(value, kind):
        raise InvalidArgument(f"{where}: {name} must be {_KINDS[kind]}")
    return value


def only_fields(table: Mapping[str, Any], known: AbstractSet[str], where: str) -> None:
    """InvalidArgument for a field that is not known."""
    unknown = sorted(set(table) - known)
    if unknown:
        raise InvalidArgument(f"{where}: no field {', '.join(unknown)}")


def number_in(
    table: Mapping[str, Any], name: str, where: str, least: float, most: float, default: float | None = None
) -> float:
    """A number within a range; InvalidArgument when it is not, or missing without a default."""
    if name not in table and default is not None:
        return default
    if name not in table:
        raise InvalidArgument(f"{where}: {name} is missing")
    value = _number(table[name])
    if not least <= value <= most:
        raise InvalidArgument(f"{where}: {name} must be a number from {least:g} to {most:g}")
    return value


def numbers_of(value: Any, counts: Sequence[int], where: str) -> NDArray[np.float64]:
    """A list of finite numbers, so many of them."""
    found = [_number(entry) for entry in value] if isinstance(value, list) else []
    if len(found) not in counts or not np.isfinite(found).all():
        raise InvalidArgument(f"{where}: must be a list of {' or '.join(map(str, counts))} numbers")
    return np.array(found)


def _number(value: Any) -> float:
    """NaN for what is none."""
    if isinstance(value, bool) or not isinstance(value, int | float):
        return float("nan")
    try:
        return float(value)
    except OverflowError:
        return float("inf")
