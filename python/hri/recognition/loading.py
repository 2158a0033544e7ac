# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Model files are read here, and what is none of the wanted kind is said to be what it is."""

from __future__ import annotations

import logging
from os import PathLike, fspath
from pathlib import Path
from typing import Any

from hri import _native
from hri.core.errors import FormatError
from hri.media import AUDIO_SUFFIXES, IMAGE_SUFFIXES, VIDEO_SUFFIXES

_log = logging.getLogger(__name__)

_KINDS = {
    "word_recognizer": ("word recogniser", "WordRecognizer.load and --speech-model take it"),
    "gesture_recognizer": ("gesture recogniser", "GestureRecognizer.load and --gesture-model take it"),
}
_MEDIA = {"sound file": AUDIO_SUFFIXES, "picture": IMAGE_SUFFIXES, "video": VIDEO_SUFFIXES}


def load_native(native_class: Any, path: str | PathLike[str], kind: str) -> Any:
    """The native recogniser in a file.

    Raises
    ------
    FormatError
        For what is no model, or a model of another kind than `kind`; says what it is.
    IoError
        For a file that cannot be read.
    """
    text = fspath(path)
    wanted = _KINDS[kind][0]
    for name, suffixes in _MEDIA.items():
        if Path(text).suffix.lower() in suffixes:
            raise FormatError(f"{text} is a {name}, not a model: a {wanted} from training is needed here")
    try:
        recognizer = native_class.load(text)
        _log.info("%s: a %s of %d labels", text, wanted, len(recognizer.labels))
        return recognizer
    except FormatError as error:
        found = _found_kind(text)
        if found == kind or found not in _KINDS:
            raise
        name, taken_by = _KINDS[found]
        raise FormatError(f"{text} is a {name}, and a {wanted} is needed here; {taken_by}") from error


def _found_kind(path: str) -> str:
    try:
        return str(_native.ModelFile.read(path).kind)
    except FormatError:  # damaged, or no model at all
        return ""
