# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Recognisers: thin wrappers of the C++ pipelines."""

from hri.recognition.decision import Decision, NBest
from hri.recognition.gesture import GestureRecognizer
from hri.recognition.word import BackgroundWord, SpeakerAdapter, WordRecognizer, background_words

__all__ = [
    "BackgroundWord",
    "Decision",
    "GestureRecognizer",
    "NBest",
    "SpeakerAdapter",
    "WordRecognizer",
    "background_words",
]
