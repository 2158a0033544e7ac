# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Sentences: several words in one recording, spoken or signed."""

from hri.recognition.sentence.commands import CommandRecognizer
from hri.recognition.sentence.recognizer import ConnectedWordRecognizer
from hri.recognition.sentence.sign_stream import SentenceEvent, SentenceStream, StreamedSign
from hri.recognition.sentence.signs import RecognisedSentence, RecognisedSign, SentenceRecognizer
from hri.recognition.sentence.stream import ConnectedWordStream, UtteranceResult
from hri.recognition.sentence.transcript import Alternative, TranscribedWord, Transcript

__all__ = [
    "Alternative",
    "CommandRecognizer",
    "ConnectedWordRecognizer",
    "ConnectedWordStream",
    "RecognisedSentence",
    "RecognisedSign",
    "SentenceEvent",
    "SentenceRecognizer",
    "SentenceStream",
    "StreamedSign",
    "TranscribedWord",
    "Transcript",
    "UtteranceResult",
]
