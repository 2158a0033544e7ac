# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Recognisers: thin wrappers of the C++ pipelines."""

from hri.recognition.decision import Decision, NBest
from hri.recognition.gesture import GestureRecognizer
from hri.recognition.word import FillerWord, SpeakerAdapter, Utterance, WordRecognizer, filler_words

__all__ = [
    "Decision",
    "FillerWord",
    "GestureRecognizer",
    "NBest",
    "SpeakerAdapter",
    "Utterance",
    "WordRecognizer",
    "filler_words",
]
