# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What the words of a model were trained on, which has to be at hand where a page adds words to commands."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from pathlib import Path
from typing import Protocol

from hri.core.display import short_list
from hri.core.errors import InvalidArgument
from hri.media import Audio
from hri.recognition import CommandRecognizer, WordRecognizer

Spoken = tuple[list[Audio], list[str], list[str]]
"""Clips, labels and names of voices."""


class Recording(Protocol):
    """A word by a person, in a file."""

    @property
    def path(self) -> Path: ...
    @property
    def label(self) -> str: ...
    @property
    def person(self) -> str: ...


def require_recordings_of(
    words: WordRecognizer | CommandRecognizer | None, recordings: Sequence[Recording], spoken: Collection[str]
) -> None:
    """See that there are recordings of the words of the model, and of no others.

    Raises
    ------
    InvalidArgument
        Otherwise, for words one by one, and for a model without `unknown_words`.
    """
    if not isinstance(words, CommandRecognizer):
        raise InvalidArgument("recordings are needed only to add words to commands of several words")
    labels = {str(label) for label in words.words.classes_}
    recorded = {recording.label for recording in recordings} | set(spoken)
    if left := short_list(sorted(labels - recorded)):
        raise InvalidArgument(f"no recordings are there of words that the model knows: {left}")
    if left := short_list(sorted(recorded - labels)):
        raise InvalidArgument(f"recordings are there of words that the model does not know: {left}")
    if not words.words.options.unknown_words:
        raise InvalidArgument(
            "a new word would count as a command while it is recorded: train the model with unknown_words=true"
        )
