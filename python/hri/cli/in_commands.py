# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What errors of the library say to those who write Python, as those need it who type commands."""

from __future__ import annotations

import re

_TAKEN_BY = {
    "WordRecognizer.load and --speech-model take it": (
        "'hri listen' and 'hri adapt' (--model), 'hri recognise', 'hri session' and 'hri serve' (--speech-model) "
        "take it"
    ),
    "ConnectedWordRecognizer.load takes it": (
        "'hri transcribe' and 'hri align' (--model), and 'hri session' and 'hri serve' with --grammar (--speech-model) "
        "take it"
    ),
    "SubwordRecognizer.load and 'hri recognise' take it": (
        "'hri recognise' (--speech-model), 'hri add-word' and 'hri remove-word' (--model) take it"
    ),
    "SentenceRecognizer.load, 'hri session' and 'hri serve' (--gesture-model) and 'hri watch' (--model) take it": (
        "'hri read-sentences' and 'hri watch' (--model), 'hri session' and 'hri serve' (--gesture-model) take it"
    ),
    "GestureRecognizer.load and --gesture-model take it": (
        "'hri watch' and 'hri add-gesture' (--model), 'hri recognise', 'hri session' and 'hri serve' (--gesture-model) "
        "take it"
    ),
}
"""Of models that are of another kind than what is needed."""
_MADE_BY = {
    "recogniser of words or of gestures": "hri train",
    "word recogniser": "hri train speech",
    "gesture recogniser": "hri train gesture",
    "recogniser of connected words": "hri train-connected",
    "recogniser of words made of units": "hri train-units",
    "recogniser of signed sentences": "hri train-sentences",
}
_TRAIN = re.compile(rf"a ({'|'.join(_MADE_BY)}) is needed here: train makes one, save writes it")
_EITHER_PATTERN = re.compile(r"may be (\S+) or (\S+); say which by pattern='\.\.\.'")
_PATTERN = re.compile(r"\bpattern=('[^']*')")


def of_models(text: str) -> str:
    """An error about a model file: which commands take it, or make what is needed."""
    for taken_by, commands in _TAKEN_BY.items():
        text = text.replace(taken_by, commands)
    return _TRAIN.sub(lambda found: f"a {found[1]} is needed here: '{_MADE_BY[found[1]]}' makes one", text)


def of_patterns(text: str, option: str | None) -> str:
    """An error about a folder of recordings: what to type.

    Parameters
    ----------
    text : str
    option : str or None
        What the command calls the pattern; None where it has no option for it.
    """
    text = _EITHER_PATTERN.sub(r"may be \1 or \2; say which, by pattern='\1' or pattern='\2'", text)
    return _PATTERN.sub(rf"{option} \1" if option is not None else r"pattern = \1 in its dataset.toml", text)
