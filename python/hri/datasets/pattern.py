# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""File name patterns such as ``{label}/{label}_{person}_{take}.wav``."""

from __future__ import annotations

import re
from dataclasses import dataclass

from hri.core.errors import InvalidArgument

PLACEHOLDERS = ("label", "person", "take", "_")
_PLACEHOLDER = re.compile(r"\{([^{}]*)\}")


@dataclass(frozen=True)
class PathFields:
    """What a path says by its name; "" for a placeholder that the pattern does not have."""

    label: str
    person: str
    take: str


class Pattern:
    """How the paths of a data set name label, person and take.

    Placeholders are ``{label}`` (needed), ``{person}``, ``{take}`` and ``{_}`` (anything, ignored).
    None of them matches a "/". A placeholder that stands twice must match the same text twice. A
    ``{person}``, ``{take}`` or ``{_}`` ends at the first character that follows it in the pattern;
    a ``{label}`` may hold that character, so ``{label}_{person}_{take}`` reads ``turn_left_ann_1``
    as turn_left, ann, 1. Upper and lower case differ, except in the suffix.

    Parameters
    ----------
    text : str
        Relative path with "/" between folders; without a suffix it fits any suffix.

    Raises
    ------
    InvalidArgument
        For an unknown placeholder, a pattern without ``{label}``, or two placeholders with nothing
        between.
    """

    def __init__(self, text: str) -> None:
        self.text = text
        self.has_person = "{person}" in text
        self.has_take = "{take}" in text
        self._regex = _compile(text)

    def match(self, relative_path: str) -> PathFields | None:
        """Split a path (relative, with "/"), or return None when it does not fit."""
        found = self._regex.fullmatch(relative_path)
        if found is None:
            return None
        groups = found.groupdict(default="")
        return PathFields(groups["label"], groups.get("person", ""), groups.get("take", ""))

    def __repr__(self) -> str:
        return f"Pattern({self.text!r})"


def _compile(text: str) -> re.Pattern[str]:
    pieces = _PLACEHOLDER.split(text)  # literal, name, literal, name, ..., literal
    literals, names = pieces[0::2], pieces[1::2]
    for name in names:
        if name not in PLACEHOLDERS:
            known = ", ".join("{" + known + "}" for known in PLACEHOLDERS)
            raise InvalidArgument(f"pattern {text!r}: unknown placeholder {{{name}}}; known are {known}")
    if "label" not in names:
        raise InvalidArgument(f"pattern {text!r}: needs a {{label}} placeholder")
    if any(brace in literal for literal in literals for brace in "{}"):
        raise InvalidArgument(f"pattern {text!r}: a brace is not closed")
    if text.startswith("/") or ".." in text.split("/"):
        raise InvalidArgument(f"pattern {text!r}: must stay inside the data set's folder")

    *body, tail = literals
    stem_end, dot, suffix = tail.rpartition(".")
    expression = ""
    seen: set[str] = set()
    for index, name in enumerate(names):
        following = literals[index + 1]
        if following == "" and index + 1 < len(names):
            raise InvalidArgument(f"pattern {text!r}: nothing between {{{name}}} and {{{names[index + 1]}}}")
        expression += re.escape(body[index])
        if name in seen:
            expression += f"(?P={name})"
            continue
        stop = "" if name == "label" else re.escape(following[:1] or ".")
        expression += f"[^/{stop}]+" if name == "_" else f"(?P<{name}>[^/{stop}]+)"
        if name != "_":
            seen.add(name)
    if dot:
        expression += re.escape(stem_end) + rf"(?i:\.{re.escape(suffix)})"
    else:
        expression += re.escape(tail) + r"\.[^/.]+"
    return re.compile(expression)
