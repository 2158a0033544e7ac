# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Isolated words: training, recognition, adaptation to a speaker."""

from hri.recognition.word.background import BackgroundWord, background_words
from hri.recognition.word.recognizer import WordRecognizer
from hri.recognition.word.speaker import SpeakerAdapter

__all__ = ["BackgroundWord", "SpeakerAdapter", "WordRecognizer", "background_words"]
