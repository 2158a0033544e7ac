# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Texts that people read in more than one language: phrases.toml has them all, by their codes."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Mapping
from functools import lru_cache
from importlib.resources import files
from typing import Any

LANGUAGES = ("en", "hi")
_PLACE = re.compile(r"\{(\w+)(?:\|(\w+))?\}")


class Phrase(str):
    """English text that is known by a code, so that it can be said in another language, too.

    It is the text wherever a text is wanted.

    Parameters
    ----------
    text : str
        In English.
    code : str
        Of phrases.toml.
    values : mapping of str to object, optional
        What stands in its places: text, a number, another phrase, a list of these, or a dict of texts by language.
    """

    code: str
    values: dict[str, Any]

    def __new__(cls, text: str, code: str = "", values: Mapping[str, Any] | None = None) -> Phrase:
        made = super().__new__(cls, text)
        made.code, made.values = code, dict(values or {})
        return made

    def to_dict(self) -> dict[str, Any]:
        """Code and values, as plain values that can be written as JSON."""
        return {"code": self.code, "values": {name: _plain(value) for name, value in self.values.items()}}


def phrase(code: str, **values: Any) -> Phrase:
    """A phrase in English. Raises KeyError for a code that is not in phrases.toml."""
    return Phrase(in_language(code, "en", values), code, values)


def in_language(code: str, language: str, values: Mapping[str, Any] | None = None) -> str:
    """A phrase in one of `LANGUAGES`."""
    return _PLACE.sub(lambda place: _said((values or {})[place[1]], place[2], language), phrases()[code][language])


def phrase_of(error: BaseException) -> str:
    """What an error says, as the phrase where it was made of one."""
    said = error.args[0] if error.args else ""
    return said if isinstance(said, Phrase) else str(error)


@lru_cache(maxsize=1)
def phrases() -> dict[str, dict[str, str]]:
    """Every phrase with its places, by code and language."""
    return tomllib.loads(files("hri.core").joinpath("phrases.toml").read_text(encoding="utf-8"))


def _said(value: Any, joint: str | None, language: str) -> str:
    if isinstance(value, Phrase) and value.code:
        return in_language(value.code, language, value.values)
    if isinstance(value, Mapping):
        return str(value.get(language) or value.get("en") or next(iter(value.values()), ""))
    if isinstance(value, list | tuple):
        between = phrases()[joint][language] if joint else ", "
        return between.join(_said(one, None, language) for one in value)
    return str(value)


def _plain(value: Any) -> Any:
    if isinstance(value, Phrase):
        return value.to_dict() if value.code else str(value)
    if isinstance(value, list | tuple):
        return [_plain(one) for one in value]
    return dict(value) if isinstance(value, Mapping) else value
