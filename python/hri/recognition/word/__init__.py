# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Isolated words: training, recognition, adaptation to a speaker."""

from hri.recognition.word.embedding import SpeechEmbedding, embedding_weights
from hri.recognition.word.fillers import FillerWord, embedding_filler_words, filler_words
from hri.recognition.word.recognizer import Utterance, WordRecognizer
from hri.recognition.word.speaker import SpeakerAdapter

__all__ = [
    "FillerWord",
    "SpeakerAdapter",
    "SpeechEmbedding",
    "Utterance",
    "WordRecognizer",
    "embedding_filler_words",
    "embedding_weights",
    "filler_words",
]
