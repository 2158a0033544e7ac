# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Recognisers: thin wrappers of the C++ pipelines.

Streams of pictures need OpenCV, and are loaded on first use.
"""

from typing import TYPE_CHECKING

from hri._native import (
    LEARNED_STILL_CHANGE,
    ConnectedWordRecognizerOptions,
    ConnectedWordStreamOptions,
    GestureRecognizerOptions,
    GestureSegment,
    GestureSegmenter,
    GestureSegmenterOptions,
    SentenceRecognizerOptions,
    SentenceStreamOptions,
    SequenceModelOptions,
    SpeakerAdapterOptions,
    SpeechEmbeddingOptions,
    SubwordRecognizerOptions,
    WordRecognizerOptions,
)
from hri.core.lazy import loader
from hri.recognition.decision import Decision, NBest
from hri.recognition.files import load
from hri.recognition.gesture import GestureRecognizer
from hri.recognition.held_out_report import ConfusedPair, HeldOutReport
from hri.recognition.possibility import possibility_and_necessity
from hri.recognition.sentence import (
    Alternative,
    CommandRecognizer,
    ConnectedWordRecognizer,
    ConnectedWordStream,
    RecognisedSentence,
    RecognisedSign,
    SentenceEvent,
    SentenceRecognizer,
    SentenceStream,
    StreamedSign,
    TranscribedWord,
    Transcript,
    UtteranceResult,
)
from hri.recognition.subword import SubwordRecognizer
from hri.recognition.word import (
    FillerWord,
    SpeakerAdapter,
    SpeechEmbedding,
    Utterance,
    WordRecognizer,
    embedding_filler_words,
    embedding_weights,
    filler_words,
)

if TYPE_CHECKING:
    from hri._native_vision import GestureEvent, GestureSpotter, GestureStream, GestureStreamOptions
else:
    _LOADED = ("GestureEvent", "GestureSpotter", "GestureStream", "GestureStreamOptions")
    __getattr__ = loader(__name__, {"hri._native_vision": _LOADED})

__all__ = [
    "LEARNED_STILL_CHANGE",
    "Alternative",
    "CommandRecognizer",
    "ConfusedPair",
    "ConnectedWordRecognizer",
    "ConnectedWordRecognizerOptions",
    "ConnectedWordStream",
    "ConnectedWordStreamOptions",
    "Decision",
    "FillerWord",
    "GestureEvent",
    "GestureRecognizer",
    "GestureRecognizerOptions",
    "GestureSegment",
    "GestureSegmenter",
    "GestureSegmenterOptions",
    "GestureSpotter",
    "GestureStream",
    "GestureStreamOptions",
    "HeldOutReport",
    "NBest",
    "RecognisedSentence",
    "RecognisedSign",
    "SentenceEvent",
    "SentenceRecognizer",
    "SentenceRecognizerOptions",
    "SentenceStream",
    "SentenceStreamOptions",
    "SequenceModelOptions",
    "SpeakerAdapter",
    "SpeakerAdapterOptions",
    "SpeechEmbedding",
    "SpeechEmbeddingOptions",
    "StreamedSign",
    "SubwordRecognizer",
    "SubwordRecognizerOptions",
    "TranscribedWord",
    "Transcript",
    "Utterance",
    "UtteranceResult",
    "WordRecognizer",
    "WordRecognizerOptions",
    "embedding_filler_words",
    "embedding_weights",
    "filler_words",
    "load",
    "possibility_and_necessity",
]
