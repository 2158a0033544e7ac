# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Decisions on the gestures of a stream."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import ExitStack, closing
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from hri.live import events
from hri.live.events import Event, decision_fields
from hri.live.frame_results import FrameResult, frame_results, gesture_event, segment_event
from hri.live.frames import Frame, FrameSource
from hri.live.sources import require_positive
from hri.live.visibility import Visibility
from hri.recognition import Decision, GestureRecognizer, GestureSegmenterOptions
from hri.recognition.quality import mask_quality
from hri.vision.landmarks import LandmarkTracker

if TYPE_CHECKING:
    from hri.recognition import GestureEvent, GestureStream


_MAX_HANDS = 1024
"""Pictures over which the quality of a gesture's masks is averaged, at most."""


class Watcher:
    """Recognises every gesture in a stream of pictures.

    Hands are found as the recogniser says, by its options and `GestureRecognizer.faces`: in every picture by itself for
    still signs, by colours learned from the stream for dynamic gestures. Features are computed as the pictures come, so
    that a decision stands at once when a gesture ends. A decision that may still change is reported as "preliminary": a
    robot obeys "decision" only.

    Parameters
    ----------
    recognizer : GestureRecognizer
        Trained or loaded.
    segmenter : GestureSegmenterOptions, optional
        When a gesture begins and ends; by default as suits how hands are found and whether the recogniser's gestures
        begin at rest.
    max_pause_s : float
        Where the gestures trained on pause, what was shown before a longer pause is another gesture.
    hand_interval_s : float
        How often the hand's place is reported.
    partial_interval_s : float
        How often it is reported what a gesture looks like so far.
    reconnect_s : float
        For how long a camera that stalled is opened again and again; 0 gives up at once.
    locale : str
        Passed on with decisions.
    model_id : str
        Which model decided; passed on with decisions.
    on_result : callable, optional
        Called with every `FrameResult` and the newest `Decision` (None before the first), for pictures of what is going
        on.
    """

    def __init__(
        self,
        recognizer: GestureRecognizer,
        segmenter: GestureSegmenterOptions | None = None,
        *,
        max_pause_s: float = 2.5,
        hand_interval_s: float = 0.1,
        partial_interval_s: float = 0.5,
        reconnect_s: float = 0.0,
        locale: str = "",
        model_id: str = "",
        on_result: Callable[[FrameResult, Decision | None], None] | None = None,
    ) -> None:
        require_positive("hand_interval_s", hand_interval_s)
        require_positive("partial_interval_s", partial_interval_s)
        self._recognizer = recognizer
        chosen = recognizer.stream_options()
        if segmenter is not None:
            chosen.segmenter = segmenter
        chosen.max_pause_s, chosen.partial_interval_s = max_pause_s, partial_interval_s
        self._options = chosen
        recognizer.stream(chosen)  # refuses options out of range now
        self._intervals = {"hand_interval_s": hand_interval_s, "reconnect_s": reconnect_s}
        self._locale = locale
        self._model_id = model_id
        self._on_result = on_result

    def watch(self, source: FrameSource) -> Iterator[Event]:
        """Events until the source ends; it is closed then, and also when the caller stops early.

        Raises
        ------
        Stalled
            When the source gives no more pictures and does not come back, after an event that says so.
        """
        newest: Decision | None = None
        with ExitStack() as stack:
            landmarks: LandmarkTracker | None = None
            if self._recognizer.options.source == "landmarks":
                landmarks = stack.enter_context(LandmarkTracker(max_hands=self._recognizer.options.num_hands))
            native = self._recognizer.stream(self._options)
            stream = _DecidingStream(native, landmarks, self._locale, self._model_id)
            seen = Visibility(self._recognizer.face_finder(), needs_face=True)
            results = frame_results(source, stream, **self._intervals, visibility=seen, model=self._model_id)
            for result in stack.enter_context(closing(results)):
                decided = [event.decision for event in result.events if event.decision is not None]
                newest = decided[-1] if decided else newest
                if self._on_result is not None:
                    self._on_result(result, newest)
                yield from result.events


@dataclass(frozen=True)
class _SeenHand:
    time_s: float
    quality: float


class _DecidingStream:
    """A native stream of decisions, as events."""

    def __init__(
        self,
        spotter: GestureStream,
        landmarks: LandmarkTracker | None,
        locale: str,
        model_id: str,
    ) -> None:
        self.spotter = spotter
        self._landmarks = landmarks
        self._locale = locale
        self._model_id = model_id
        self._time_s = 0.0
        self._hands: deque[_SeenHand] = deque(maxlen=_MAX_HANDS)

    def push(self, frame: Frame, time_s: float) -> list[Event]:
        self._time_s = time_s
        points = [] if self._landmarks is None else self._landmarks.find_all(frame)
        return self._events(lambda: self._pushed(frame, time_s, points))

    def _pushed(self, frame: Frame, time_s: float, points: Any) -> list[GestureEvent]:
        happened = self.spotter.push(frame, time_s, points)
        if self._landmarks is None:
            self._hands.append(_SeenHand(time_s, float(self.spotter.hand.quality)))
        return happened

    def finish(self) -> list[Event]:
        return self._events(self.spotter.finish)

    def interrupt(self) -> list[Event]:
        return self._events(self.spotter.interrupt)

    def _events(self, happen: Callable[[], list[GestureEvent]]) -> list[Event]:
        begun = time.perf_counter()
        happened = happen()
        compute_ms = round(1000 * (time.perf_counter() - begun), 3)
        return [self._event(native, compute_ms) for native in happened]

    def _event(self, native: GestureEvent, compute_ms: float) -> Event:
        if native.kind == "segment":
            return segment_event(native.segment, self._time_s)
        segment = native.segment
        hands = [hand for hand in self._hands if segment.first_s <= hand.time_s <= segment.last_s]
        decision = replace(Decision.from_native("gesture", native.decision), quality=mask_quality(hands))
        fields = decision_fields(decision, self._locale, self._model_id)
        if native.kind != events.DECISION:  # for the eye, and not to act on
            fields |= {"incremental": fields["final"], "final": ""}
        if native.kind != events.PARTIAL:
            span = {"first_s": round(segment.first_s, 4), "last_s": round(segment.last_s, 4)}
            fields = {**span, **fields, "compute_ms": compute_ms}
        return gesture_event(self._time_s, native.kind, fields, decision)
