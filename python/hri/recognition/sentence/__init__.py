# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Sentences: several words in one recording, spoken or signed."""

from hri.recognition.sentence.recognizer import ConnectedWordRecognizer, TranscribedWord, Transcript
from hri.recognition.sentence.signs import RecognisedSentence, RecognisedSign, SentenceRecognizer

__all__ = [
    "ConnectedWordRecognizer",
    "RecognisedSentence",
    "RecognisedSign",
    "SentenceRecognizer",
    "TranscribedWord",
    "Transcript",
]
