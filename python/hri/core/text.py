# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Text that a person wrote: which characters it may have."""

from __future__ import annotations

import unicodedata

_JOINERS = "\u200c\u200d"
_VIRAMA = 9
"""Canonical combining class of the signs that join consonants."""


def is_printable(text: str) -> bool:
    """Whether a text has no control characters: `str.isprintable`, and joiners where they belong in words.

    The zero width joiner (U+200D) and non-joiner (U+200C) say how Indic and Arabic letters are written together. They
    stand within a word, or after a virama (Unicode Standard Annex 31, section 2.3).

    Parameters
    ----------
    text : str

    Examples
    --------
    >>> is_printable("क्\u200dष"), is_printable("two\\nlines"), is_printable("\u200dstop")
    (True, False, False)
    """
    return all(
        character.isprintable() or (character in _JOINERS and _may_join(text, at)) for at, character in enumerate(text)
    )


def _may_join(text: str, at: int) -> bool:
    before, after = text[at - 1 : at], text[at + 1 : at + 2]
    joined = bool(before) and unicodedata.combining(before) == _VIRAMA
    return joined or all(one and unicodedata.category(one)[0] in "LM" for one in (before, after))
