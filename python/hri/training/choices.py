# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What a recogniser is trained with where its user leaves it open: by the extras installed, and the recordings."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from hri.datasets import Dataset
from hri.recognition import WordRecognizer, embedding_weights
from hri.training.hand_source import choose_source

NETWORK_MIN_PERSONS = {"cepstra": 3, "both": 10, "embedding": 10}
"""By front end, from how many on a network is trained unless asked otherwise: beside cepstra it gains much in noise
even with three, beside the embedding little (`hri study fsdd-noise-network`); there it was measured again with
twenty only."""


@dataclass(frozen=True)
class Choice:
    """What `choose_options` adds.

    Attributes
    ----------
    options : dict
        Keywords of the recogniser, beside those that were given.
    why : str
        Why gestures are of this source, in a line for the reader; "" where that was given, and for words.
    """

    options: dict[str, Any]
    why: str = ""


def choose_options(
    dataset: Dataset, given: Mapping[str, Any] | None = None, *, num_persons: int | None = None
) -> Choice:
    """What `hri train` takes beside the options that are given.

    Words are of both front ends where the extra `embedding` is installed, and a network votes too from as many
    speakers on as `NETWORK_MIN_PERSONS` says. Gestures are of landmarks where the extra `mediapipe` is installed and
    finds a hand in nearly all of a few recordings looked at, of silhouettes otherwise.

    Parameters
    ----------
    dataset : Dataset
    given : mapping of str to object, optional
        Keywords of the recogniser that stand.
    num_persons : int, optional
        How many are trained on; all of the data set unless said.

    Raises
    ------
    InvalidArgument, TypeError
        For an option that the recogniser does not have, or a value that it refuses.
    FormatError, IoError
        For a recording looked at that cannot be read; the message names the file.
    """
    given = {} if given is None else given
    if dataset.kind == "gesture":
        if "source" in given:
            return Choice({})
        source, why = choose_source(dataset)
        return Choice({"source": source}, why)
    chosen: dict[str, Any] = {}
    if "front_end" not in given and has_embedding():
        chosen["front_end"] = "both"
    front_end = WordRecognizer(**{**given, **chosen}).options.front_end
    persons = len(dataset.persons) if num_persons is None else num_persons
    if "use_network" not in given and persons >= NETWORK_MIN_PERSONS[front_end]:
        chosen["use_network"] = True
    return Choice(chosen)


def has_embedding() -> bool:
    """Whether the extra `embedding` is installed."""
    try:
        embedding_weights()
    except ImportError:
        return False
    return True
