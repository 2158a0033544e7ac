# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""A recogniser from its file, whichever it is."""

from __future__ import annotations

from os import PathLike, fspath
from typing import Literal, overload

from hri.core.errors import InvalidArgument
from hri.io import ModelFile
from hri.recognition.gesture import GestureRecognizer
from hri.recognition.loading import another_kind, refuse_recordings
from hri.recognition.subword import SubwordRecognizer
from hri.recognition.word import SpeechEmbedding, WordRecognizer

Mode = Literal["speech", "gesture"]
_MODES: dict[str, Mode] = {
    "word_recognizer": "speech",
    "subword_recognizer": "speech",
    "gesture_recognizer": "gesture",
}

_WANTED: dict[Mode | None, str] = {
    None: "recogniser of words or of gestures",
    "speech": "word recogniser",
    "gesture": "gesture recogniser",
}


@overload
def load(
    path: str | PathLike[str], *, embedding: SpeechEmbedding | None = None
) -> WordRecognizer | SubwordRecognizer | GestureRecognizer: ...
@overload
def load(
    path: str | PathLike[str], mode: Literal["speech"], *, embedding: SpeechEmbedding | None = None
) -> WordRecognizer | SubwordRecognizer: ...
@overload
def load(path: str | PathLike[str], mode: Literal["gesture"]) -> GestureRecognizer: ...
def load(
    path: str | PathLike[str], mode: Mode | None = None, *, embedding: SpeechEmbedding | None = None
) -> WordRecognizer | SubwordRecognizer | GestureRecognizer:
    """Read a recogniser of words or of gestures.

    Parameters
    ----------
    path : path_like
        What `save` wrote, in Python or C++.
    mode : {"speech", "gesture"}, optional
        What it has to be.
    embedding : SpeechEmbedding, optional
        For words of the front end "both" or "embedding", see `WordRecognizer.load`.

    Raises
    ------
    FormatError
        For a file that holds anything else, and for other weights of an embedding than those of training.
    InvalidArgument
        For an embedding where the model takes none, and another mode.
    ImportError
        For words of the front end "both" or "embedding" without weights; names the extra.
    IoError
        For one that cannot be read.
    """
    text = fspath(path)
    if mode not in _WANTED:
        raise InvalidArgument(f'mode must be "speech", "gesture" or None, got {mode!r}')
    wanted = _WANTED[mode]
    refuse_recordings(text, wanted)
    kind = ModelFile.read(text).kind
    found = _MODES.get(kind)
    if found is None or mode not in (None, found):
        raise another_kind(text, kind, wanted)
    if kind == "word_recognizer":
        return WordRecognizer.load(path, embedding=embedding)
    if embedding is not None:
        raise InvalidArgument(f"{text} takes no speech embedding: it is no model of words of the front end 'both'")
    return GestureRecognizer.load(path) if found == "gesture" else SubwordRecognizer.load(path)
