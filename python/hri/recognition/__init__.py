# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Recognisers: thin wrappers of the C++ pipelines."""

from hri._native import (
    GestureRecognizerOptions,
    GestureSegmenterOptions,
    SequenceModelOptions,
    SpeakerAdapterOptions,
    WordRecognizerOptions,
)
from hri.recognition.decision import Decision, NBest
from hri.recognition.files import load
from hri.recognition.gesture import GestureRecognizer
from hri.recognition.word import FillerWord, SpeakerAdapter, Utterance, WordRecognizer, filler_words

__all__ = [
    "Decision",
    "FillerWord",
    "GestureRecognizer",
    "GestureRecognizerOptions",
    "GestureSegmenterOptions",
    "NBest",
    "SequenceModelOptions",
    "SpeakerAdapter",
    "SpeakerAdapterOptions",
    "Utterance",
    "WordRecognizer",
    "WordRecognizerOptions",
    "filler_words",
    "load",
]
