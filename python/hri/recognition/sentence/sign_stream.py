# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Signed sentences from a stream of frames, with what is found so far on the way."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Unpack

import numpy as np
from numpy.typing import ArrayLike

from hri import _native
from hri.recognition.sentence.signs import RecognisedSign

if TYPE_CHECKING:
    from hri.recognition.keywords import SentenceStreamKeywords
    from hri.recognition.sentence.signs import SentenceRecognizer


@dataclass(frozen=True)
class StreamedSign(RecognisedSign):
    """One word of a sentence in a stream; its frames are numbered from the beginning of the stream.

    Attributes
    ----------
    first_s, last_s : float
        Times of its first frame and of its last.
    """

    first_s: float
    last_s: float


@dataclass(frozen=True)
class SentenceEvent:
    """What happened with a frame.

    Attributes
    ----------
    kind : {"start", "partial", "end", "dropped"}
        A sentence has begun; what was found in it so far; in the end; what seemed to be a sentence was none.
    reason : {"", "rested", "left", "cut", "ended", "stalled"}
        Why it ended: the hands are still; out of view; it is too long; the stream ended, or was interrupted.
    words : tuple of StreamedSign
        In the order of time.
    log_score : float
        Natural log, of the best path.
    num_stable : int
        So many of the first words have ended, and several searches in a row agree on them (``num_agreeing``): they are
        kept until the end, where the whole sentence may still correct them.
    first_s, last_s : float
        The sentence, so far.
    """

    kind: str
    reason: str
    words: tuple[StreamedSign, ...]
    log_score: float
    num_stable: int
    first_s: float
    last_s: float

    @property
    def labels(self) -> tuple[str, ...]:
        """The words alone."""
        return tuple(word.label for word in self.words)

    @property
    def text(self) -> str:
        """The words, with spaces between."""
        return " ".join(self.labels)


class SentenceStream:
    """Recognise a stream of frames sentence by sentence; memory is bounded by the longest sentence.

    A sentence begins as the hands move, and ends as they rest or leave. Its words are those of
    `SentenceRecognizer.recognise` over its frames.

    Parameters
    ----------
    recognizer : SentenceRecognizer
        Fitted.
    **options
        Fields of ``hri.recognition.SentenceStreamOptions``.

    Raises
    ------
    InvalidArgument
        For options out of range.
    """

    def __init__(self, recognizer: SentenceRecognizer, **options: Unpack[SentenceStreamKeywords]) -> None:
        self.options = _native.SentenceStreamOptions(**options)
        self._native = _native.SentenceStream(recognizer._trained, self.options)

    def push(self, frame: ArrayLike, time_s: float) -> SentenceEvent | None:
        """The next frame and its time; what happened with it, if anything.

        Parameters
        ----------
        frame : array_like, shape (3, 2), (6,) or (num_features,)
            A row of what `SentenceRecognizer.recognise` takes. Tracks without a head begin no sentence.
        time_s : float

        Raises
        ------
        InvalidArgument
            For another shape, values that are infinite or NaN in part, and a time that runs backwards.
        """
        return _event_of(self._native.push(np.asarray(frame, np.float32).reshape(-1), time_s))

    def finish(self) -> SentenceEvent | None:
        """The stream has ended, and with it any sentence. The next one may begin."""
        return _event_of(self._native.finish())

    def interrupt(self) -> SentenceEvent | None:
        """The stream was interrupted: what had begun is dropped."""
        return _event_of(self._native.interrupt())

    @property
    def in_sentence(self) -> bool:
        """Whether one has begun and not ended."""
        return bool(self._native.in_sentence)

    @property
    def num_columns(self) -> int:
        """Values of a frame."""
        return int(self._native.num_columns)

    @property
    def num_kept(self) -> int:
        """Frames in memory: the last so many."""
        return int(self._native.num_kept)


def _event_of(found: Any) -> SentenceEvent | None:
    if found.kind == "none":
        return None
    words = tuple(
        StreamedSign(w.label, w.first_frame, w.last_frame, w.log_score, w.first_s, w.last_s) for w in found.words
    )
    reason = "" if found.reason == "none" else found.reason
    return SentenceEvent(found.kind, reason, words, found.log_score, found.num_stable, found.first_s, found.last_s)
