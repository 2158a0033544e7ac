# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Sentences: several words in one recording."""

from hri.recognition.sentence.recognizer import ConnectedWordRecognizer, TranscribedWord, Transcript

__all__ = ["ConnectedWordRecognizer", "TranscribedWord", "Transcript"]
