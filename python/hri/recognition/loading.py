# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Model files are read here, and what is none of the wanted kind is said to be what it is."""

from __future__ import annotations

import logging
from collections.abc import Callable
from os import PathLike, fspath
from pathlib import Path
from typing import Any

from hri.core.errors import FormatError
from hri.io import ModelFile
from hri.media import kind_of_file

_log = logging.getLogger(__name__)

_KINDS = {
    "word_recognizer": ("word recogniser", "WordRecognizer.load and --speech-model take it"),
    "connected_word_recognizer": ("recogniser of connected words", "ConnectedWordRecognizer.load takes it"),
    "subword_recognizer": ("recogniser of words made of units", "SubwordRecognizer.load and 'hri recognise' take it"),
    "sentence_recognizer": (
        "recogniser of signed sentences",
        "SentenceRecognizer.load, 'hri session' and 'hri serve' (--gesture-model) and 'hri watch' (--model) take it",
    ),
    "gesture_recognizer": ("gesture recogniser", "GestureRecognizer.load and --gesture-model take it"),
}


def load_native(make: Callable[[ModelFile], Any], path: str | PathLike[str], kind: str) -> Any:
    """The native recogniser that `make` makes of a file.

    Raises
    ------
    FormatError
        For what is no model, or a model of another kind than `kind`; says what it is.
    IoError
        For a file that cannot be read.
    """
    text = fspath(path)
    wanted = _KINDS[kind][0]
    refuse_recordings(text, wanted)
    try:
        recognizer = make(ModelFile.read(text))
        _log.info("%s: a %s of %d labels", text, wanted, len(recognizer.labels))
        return recognizer
    except FormatError as error:
        found = _found_kind(text)
        if found == kind or found not in _KINDS:
            raise
        raise another_kind(text, found, wanted) from error


def refuse_recordings(path: str, wanted: str) -> None:
    """Raise a FormatError for a file that by its name is a sound, a picture or a film, and no model."""
    kind_of_path = kind_of_file(Path(path))
    if kind_of_path not in ("", "a model"):
        raise FormatError(f"{path} is {kind_of_path}, and a {wanted} is needed here: train makes one, save writes it")


def another_kind(path: str, found: str, wanted: str) -> FormatError:
    """What to raise for a model of the kind `found` in place of what is wanted."""
    if found not in _KINDS:
        return FormatError(f"{path}: holds a {found!r}, and a {wanted} is needed here")
    name, taken_by = _KINDS[found]
    return FormatError(f"{path} is a {name}, and a {wanted} is needed here; {taken_by}")


def _found_kind(path: str) -> str:
    try:
        return str(ModelFile.read(path).kind)
    except FormatError:  # damaged, or no model at all
        return ""
