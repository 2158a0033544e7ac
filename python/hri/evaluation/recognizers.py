# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Which recognisers can be evaluated: those that decide for one label; others are refused before anything is read."""

from __future__ import annotations

from collections.abc import Callable

from hri.core.errors import InvalidArgument
from hri.recognition import GestureRecognizer, SpeechEmbedding, SubwordRecognizer, WordRecognizer

Recognizer = WordRecognizer | GestureRecognizer
_DECIDING = (WordRecognizer, SubwordRecognizer, GestureRecognizer)
"""Their `fit` takes one label for each recording, their `recognise` gives a `Decision`."""


def factory_of(
    recognizer: Callable[[], Recognizer] | Recognizer, kind: str, embedding: SpeechEmbedding | None = None
) -> Callable[[], Recognizer]:
    """What makes untrained recognisers: with the options of `recognizer`, if it is one.

    Parameters
    ----------
    recognizer : callable or recogniser
        A callable is called once here, to see what it makes.
    kind : str
        Of the data set.
    embedding : SpeechEmbedding, optional
        That `fit` is going to get.

    Raises
    ------
    InvalidArgument
        For a recogniser of another kind, one whose `recognise` gives no `Decision`, or an embedding that `fit` does not
        take.
    """
    make: Callable[[], Recognizer]
    if isinstance(recognizer, WordRecognizer | GestureRecognizer):
        make = recognizer.untrained().untrained  # of a copy, whose options stay as they are now
    elif isinstance(recognizer, type):
        _check_class(recognizer, kind)  # one that is refused may need arguments
        make = recognizer
    elif callable(recognizer):
        make = recognizer
    else:
        raise _other_recognizer(type(recognizer))
    made = type(make())
    _check_class(made, kind)
    if embedding is not None and kind == "speech" and not issubclass(made, WordRecognizer):
        raise InvalidArgument(f"embedding is for a WordRecognizer, got {made.__name__}")
    return make


def _check_class(recognizer: type, kind: str) -> None:
    if not issubclass(recognizer, _DECIDING):
        raise _other_recognizer(recognizer)
    if recognizer.mode != kind:
        raise InvalidArgument(f"the data set is for {kind}, the recogniser is for {recognizer.mode}")


def _other_recognizer(found: type) -> InvalidArgument:
    return InvalidArgument(
        "make_recognizer must be a WordRecognizer, a GestureRecognizer, or a class or function that makes one (or a "
        f"SubwordRecognizer), got {found.__name__}"
    )
