# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""How objects show themselves: one short line in a console, a small table in a notebook."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import fields
from html import escape
from os import PathLike, fspath
from typing import Any, TypeVar

import numpy as np

T = TypeVar("T")

_MAX_LINE = 160
_MAX_VALUE = 40
_MAX_PATH = 48
_MAX_ROWS = 12


def summary(name: str, *parts: object) -> str:
    """``name(part, part)``, without empty parts, cut to one line that fits a console."""
    text = f"{name}({', '.join(str(part) for part in parts if part not in (None, ''))})"
    return text if len(text) <= _MAX_LINE else f"{text[: _MAX_LINE - 4]}...)"


def short_repr(cls: type[T]) -> type[T]:
    """Class decorator, below ``@dataclass``: fields by name; of arrays type and shape, of collections the length."""

    def represent(self: Any) -> str:
        shown = (f"{field.name}={_short_value(getattr(self, field.name))}" for field in fields(self) if field.repr)
        return summary(cls.__name__, *shown)

    cls.__repr__ = represent  # type: ignore[method-assign]
    return cls


def shown(value: object) -> str:
    """A value as Python writes it, for the message of an error: cut to one line, whatever it is."""
    try:
        text = repr(value)
    except ValueError:  # an integer of more digits than Python writes
        text = f"<{type(value).__name__}>"
    return text if len(text) <= _MAX_LINE else f"{text[: _MAX_LINE - 3]}..."


def _short_value(value: object) -> str:
    if isinstance(value, np.ndarray):
        return f"{value.dtype}{list(value.shape)}"
    if isinstance(value, PathLike):
        return short_path(value)
    if isinstance(value, Mapping | list | tuple | set | frozenset) and len(value) > 0:
        if len(value) <= 4 and all(isinstance(entry, str | int | float) for entry in value):
            text = repr(value)
            if len(text) <= _MAX_VALUE:
                return text
        return f"<{count(len(value), 'entry', 'entries')}>"
    text = repr(value)
    return text if len(text) <= _MAX_VALUE else f"{text[: _MAX_VALUE - 3]}..."


def short_path(path: str | PathLike[str]) -> str:
    """A path in quotes; of a long one its end, which differs most."""
    text = fspath(path)
    return repr(text if len(text) <= _MAX_PATH else f"...{text[3 - _MAX_PATH :]}")


def short_list(values: Iterable[object], limit: int = 4) -> str:
    """The first few values, and how many more there are: "0 1 2 3 ... (11)"."""
    known = [str(value) for value in values]
    if len(known) <= limit:
        return " ".join(known)
    return f"{' '.join(known[:limit])} ... ({len(known)})"


def count(number: int, noun: str, plural: str = "") -> str:
    """ "1 label", "2 labels"."""
    return f"{number} {noun if number == 1 else plural or noun + 's'}"


def html_table(header: Sequence[object], rows: Sequence[Sequence[object]], caption: str = "") -> str:
    """An HTML table; of many rows the first ones, and a row that says how many were left out."""
    head = "".join(f"<th>{escape(str(cell))}</th>" for cell in header)
    shown = "".join(_html_row(row) for row in rows[:_MAX_ROWS])
    if len(rows) > _MAX_ROWS:
        shown += f'<tr><td colspan="{len(header)}">... {len(rows) - _MAX_ROWS} more</td></tr>'
    titled = f"<caption>{escape(caption)}</caption>" if caption else ""
    return f"<table>{titled}<thead><tr>{head}</tr></thead><tbody>{shown}</tbody></table>"


def _html_row(row: Sequence[object]) -> str:
    return f"<tr>{''.join(f'<td>{escape(str(cell))}</td>' for cell in row)}</tr>"
