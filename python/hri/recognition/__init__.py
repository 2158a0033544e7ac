# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Recognisers: thin wrappers of the C++ pipelines."""

from hri.recognition.background import BackgroundWord, background_words
from hri.recognition.decision import Decision, NBest
from hri.recognition.gesture import GestureRecognizer
from hri.recognition.speaker import SpeakerAdapter
from hri.recognition.word import WordRecognizer

__all__ = [
    "BackgroundWord",
    "Decision",
    "GestureRecognizer",
    "NBest",
    "SpeakerAdapter",
    "WordRecognizer",
    "background_words",
]
