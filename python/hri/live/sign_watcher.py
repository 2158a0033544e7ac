# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Signed sentences in a stream of pictures."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import closing
from typing import TYPE_CHECKING, Any

import numpy as np

from hri.core.errors import InvalidArgument
from hri.live import events
from hri.live.events import Event
from hri.live.frame_results import FrameResult, frame_results, gesture_event
from hri.live.frames import Frame, FrameSource
from hri.live.hand_frames import HandFrames, PersonTracks
from hri.live.sources import require_positive
from hri.live.visibility import Visibility
from hri.recognition import Decision, SentenceEvent, SentenceRecognizer, SentenceStream, SentenceStreamOptions

if TYPE_CHECKING:
    from hri.vision import HandObservation

NO_HEAD_S = 5.0
"""After so long with pictures and without a head it is reported that there is none."""


class SignWatcher:
    """Recognises every signed sentence in a stream of pictures.

    A sentence goes from where the hands begin to move to where they rest or leave. The words found so far are reported
    on the way, those of the whole sentence when it has ended.

    Parameters
    ----------
    recognizer : SentenceRecognizer
        Trained or loaded.
    options : SentenceStreamOptions, optional
        When a sentence begins and ends.
    hands : HandFrames, optional
        What makes a row of every picture, for one stream at a time. By default `PersonTracks`; a recogniser of rows
        needs what computes the rows that it was trained on, such as `GestureRows`.
    hand_interval_s : float
        How often the hand's place is reported.
    reconnect_s : float
        For how long a camera that stalled is opened again and again; 0 gives up at once.
    locale : str
        Passed on with sentences.
    model_id : str
        Which model recognised; passed on with sentences.
    on_result : callable, optional
        Called with every `FrameResult` and None, for pictures of what is going on.

    Raises
    ------
    InvalidArgument
        For options out of range; for a recogniser of rows without `hands`, and of rows where these are tracks; where
        tracks need faces and no cascade is installed.
    NotFittedError
        For a recogniser that is not trained.
    """

    def __init__(
        self,
        recognizer: SentenceRecognizer,
        options: SentenceStreamOptions | None = None,
        *,
        hands: HandFrames | None = None,
        hand_interval_s: float = 0.1,
        reconnect_s: float = 0.0,
        locale: str = "",
        model_id: str = "",
        on_result: Callable[[FrameResult, Decision | None], None] | None = None,
    ) -> None:
        require_positive("hand_interval_s", hand_interval_s)
        self._recognizer = recognizer
        self._options = {} if options is None else options.as_dict()
        num_columns = SentenceStream(recognizer, **self._options).num_columns  # refuses options out of range now
        if hands is None and recognizer.options.input == "rows":
            raise InvalidArgument(
                "the model was trained on rows of features, and does not say which: pass hands=, such as GestureRows"
            )
        self._hands = hands if hands is not None else PersonTracks()
        if self._hands.num_columns not in (None, num_columns):
            raise InvalidArgument(
                f"hands gives {self._hands.num_columns} values a frame, the model takes {num_columns}"
            )
        self._intervals = {"hand_interval_s": hand_interval_s, "reconnect_s": reconnect_s}
        self._locale, self._model_id = locale, model_id
        self._on_result = on_result

    def watch(self, source: FrameSource) -> Iterator[Event]:
        """Events until the source ends; it is closed then, and also when the caller stops early.

        Raises
        ------
        Stalled
            When the source gives no more pictures and does not come back, after an event that says so.
        """
        stream = _SigningStream(SentenceStream(self._recognizer, **self._options), self._hands)
        stream.metadata = {"locale": self._locale, "model": self._model_id}
        seen = Visibility(getattr(self._hands, "faces", None), needs_face=stream.face_seen is not None)
        results = frame_results(source, stream, **self._intervals, visibility=seen, model=self._model_id)
        with closing(results):
            for result in results:
                if self._on_result is not None:
                    self._on_result(result, None)
                yield from result.events


class _SigningStream:
    """A stream of sentences, as events."""

    def __init__(self, sentences: SentenceStream, hands: HandFrames) -> None:
        self.metadata: dict[str, Any] = {}
        self._sentences, self._hands = sentences, hands
        self._time_s = 0.0
        self._shape: tuple[int, ...] = ()
        self._head_s: float | None = None
        self.face_seen = None if hands.num_columns is None else True
        """Whether the head was, in the last picture; None where hands need none."""
        self._reset()

    def _reset(self) -> None:
        self._hands.reset()

    @property
    def spotter(self) -> _SigningStream:
        """What `frame_results` asks for the hand."""
        return self

    @property
    def hand(self) -> HandObservation:
        """In the last picture."""
        return self._hands.hand

    @property
    def place(self) -> tuple[float, float, float] | None:
        """In the last picture."""
        return self._hands.place

    @property
    def in_gesture(self) -> bool:
        """Whether a sentence has begun."""
        return self._sentences.in_sentence

    def push(self, frame: Frame, time_s: float) -> list[Event]:
        happened: list[Event] = []
        if frame.shape != self._shape:
            if self._shape:  # places and outlines of before are of no use
                happened = self.interrupt()
            self._shape = frame.shape
        self._time_s = time_s
        row = self._hands.push(frame, time_s, self._sentences.in_sentence)
        if self.face_seen is not None:
            self.face_seen = not np.isnan(row[-1])
        if not len(row):  # no hand was seen yet, and how many features it has is not known
            row = np.full(self._sentences.num_columns, np.nan, np.float32)
        happened += self._events(lambda: self._sentences.push(row, time_s)) + self._head(row)
        self._hands.keep(self._sentences.num_kept)
        return happened

    def finish(self) -> list[Event]:
        happened = self._events(self._sentences.finish)
        self._reset()
        return happened

    def interrupt(self) -> list[Event]:
        happened = self._events(self._sentences.interrupt)
        self._reset()
        return happened

    def _head(self, row: Any) -> list[Event]:
        """That there is no head for tracks, once until there is one."""
        if self._hands.num_columns is None or not np.isnan(row[-1]) or self._head_s is None:
            self._head_s = self._time_s
        elif self._time_s - self._head_s > NO_HEAD_S:
            fields = {"first_s": round(self._head_s, 4), "last_s": round(self._time_s, 4), "reason": "no_head"}
            self._head_s = float("inf")
            return [gesture_event(self._time_s, events.GESTURE_DROPPED, fields)]
        return []

    def _events(self, happen: Callable[[], SentenceEvent | None]) -> list[Event]:
        begun = time.perf_counter()
        found = happen()
        if found is None:
            return []
        span = {"first_s": round(found.first_s, 4), "last_s": round(found.last_s, 4)}
        if found.kind == "start":
            return [self._event(events.GESTURE_START, {"first_s": span["first_s"]})]
        if found.kind == "dropped":
            return [self._event(events.GESTURE_DROPPED, span | {"reason": found.reason})]
        if found.kind == "partial":
            return [self._event(events.SIGNING, span | self._words(found) | {"num_stable": found.num_stable})]
        fields = span | self._words(found) | {"log_score": found.log_score, **self.metadata}
        fields["compute_ms"] = round(1000 * (time.perf_counter() - begun), 3)
        over = span | {"reason": found.reason, "cut": found.reason == "cut"}
        return [self._event(events.GESTURE_END, over), self._event(events.SIGNED, fields)]

    def _words(self, found: SentenceEvent) -> dict[str, Any]:
        """The words, and when each was signed."""
        words = [self._hands.name(word) for word in found.words]
        times = [[round(word.first_s, 4), round(word.last_s, 4)] for word in found.words]
        return {"words": words, "times_s": times}

    def _event(self, kind: str, fields: dict[str, Any]) -> Event:
        return gesture_event(self._time_s, kind, fields)
