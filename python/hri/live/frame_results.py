# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""From a source of pictures to what was found in each: the same loop for a camera and for a video, and for streams that
are watched or recorded."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Generator
from dataclasses import dataclass, field
from functools import partial
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import FormatError
from hri.live import events
from hri.live.events import Event
from hri.live.frames import Frame, FrameSource
from hri.live.sources import Stalled
from hri.live.visibility import Visibility
from hri.recognition import GestureSegment
from hri.vision import HandObservation

gesture_event = partial(Event, mode="gesture")
Mask = NDArray[np.uint8]
_RETRY_S = 0.5
_TRACK_S = 2.0
_SEGMENTS = {"start": events.GESTURE_START, "end": events.GESTURE_END, "dropped": events.GESTURE_DROPPED}


class Stream(Protocol):
    """What looks at the pictures: `hri.live` has one that recognises gestures, and one that only finds them."""

    def push(self, frame: Frame, time_s: float) -> list[Event]:
        """What happened with the next picture."""
        ...

    def finish(self) -> list[Event]:
        """What happens as the stream has ended."""
        ...

    def interrupt(self) -> list[Event]:
        """What happens as the source gives no more pictures, for now at least."""
        ...

    @property
    def spotter(self) -> Any:
        """With the attributes `hand`, `place` and `in_gesture` of `hri.recognition.GestureSpotter`; and `face_seen`,
        where it knows whether a face was."""
        ...


@dataclass
class FrameResult:
    """What was found in one picture, or happened between two.

    Attributes
    ----------
    time_s : float
    events : list of Event
        What happened with it.
    frame, mask : ndarray of uint8, or None
        The picture (BGR) and the hand in it; the mask is smaller.
    hand : HandObservation, or None
        The hand as recognisers take it.
    track : list of (float, float)
        Where the hand was in the last two seconds, in shares of the picture's width and height.
    in_gesture : bool
        A gesture has begun and not ended.
    missing : str
        What the pictures lack for a hand to be seen, as `Visibility` says.
    """

    time_s: float
    events: list[Event] = field(default_factory=list)
    frame: Frame | None = None
    mask: Mask | None = None
    hand: HandObservation | None = None
    track: list[tuple[float, float]] = field(default_factory=list)
    in_gesture: bool = False
    missing: str = ""

    @property
    def quality(self) -> float:
        """How well the hand stands out, 0..1."""
        return float(self.hand.quality) if self.hand is not None else 0.0


def frame_results(
    source: FrameSource,
    stream: Stream,
    *,
    hand_interval_s: float = 0.1,
    reconnect_s: float = 0.0,
    visibility: Visibility | None = None,
    **metadata: Any,
) -> Generator[FrameResult, None, None]:
    """What is found until the source ends; it is closed then, and also when the caller stops early.

    Parameters
    ----------
    source : FrameSource
    stream : Stream
    hand_interval_s : float
        How often the hand's place is reported.
    reconnect_s : float
        For how long a source that stalled is opened again and again; 0 gives up at once.
    visibility : Visibility, optional
        Says what is missing; by default one that misses no face.
    **metadata
        Fields of the first event.

    Raises
    ------
    Stalled
        When the source gives no more pictures and does not come back, after an event that says so.
    FormatError
        When its time runs backwards.
    """
    track: deque[tuple[float, float, float]] = deque()
    next_hand_s, num_lost, time_s = 0.0, 0, 0.0
    visibility = visibility or Visibility()
    visibility.reset()
    try:
        begun = {"source": source.name, "fps": source.fps, **metadata}
        yield FrameResult(0.0, [gesture_event(0.0, events.WATCHING, begun)])
        while True:
            try:
                timed = source.read()
            except Stalled as stalled:
                happened = stream.interrupt()
                yield FrameResult(time_s, [*happened, gesture_event(time_s, events.STALL, {"message": str(stalled)})])
                track.clear()
                visibility.reset()
                if not _comes_back(source, reconnect_s):
                    raise
                yield FrameResult(time_s, [gesture_event(time_s, events.RECONNECTED)])
                continue
            if timed is None:
                break
            frame, now_s = timed
            if now_s < time_s:
                raise FormatError(f"time runs backwards: a picture at {now_s:g} s after one at {time_s:g} s")
            time_s = now_s
            result = FrameResult(time_s, stream.push(np.ascontiguousarray(frame), time_s), frame)
            spotter = stream.spotter
            result.hand, result.in_gesture = spotter.hand, spotter.in_gesture
            result.mask = result.hand.mask
            place = spotter.place
            face_seen = getattr(spotter, "face_seen", None)
            result.missing = visibility.push(frame, time_s, place is not None, face_seen)
            if place is not None:
                track.append((time_s, place[0], place[1]))
            while track and track[0][0] <= time_s - _TRACK_S:
                track.popleft()
            result.track = [(x, y) for _, x, y in track]
            if source.num_lost > num_lost:
                fields = {"lost_frames": source.num_lost - num_lost}
                result.events.insert(0, gesture_event(time_s, events.OVERFLOW, fields))
                num_lost = source.num_lost
            if time_s >= next_hand_s:
                next_hand_s = time_s + hand_interval_s
                result.events.append(_hand(result, place))
            yield result
        happened = stream.finish()
        if happened:
            yield FrameResult(time_s, happened)
        yield FrameResult(time_s, [gesture_event(time_s, events.ENDED, {"lost_frames": source.num_lost})])
    finally:
        source.close()


def segment_event(segment: GestureSegment, time_s: float) -> Event:
    """The event of a gesture segment."""
    fields: dict[str, Any] = {"first_s": round(segment.first_s, 4)}
    if segment.kind != "start":
        fields |= {"last_s": round(segment.last_s, 4), "reason": segment.reason}
    if segment.kind == "end":
        fields["cut"] = segment.reason == "cut"
    return gesture_event(time_s, _SEGMENTS[segment.kind], fields)


def _comes_back(source: FrameSource, reconnect_s: float) -> bool:
    until = time.monotonic() + reconnect_s
    while time.monotonic() < until:
        if source.reconnect():
            return True
        time.sleep(min(_RETRY_S, max(0.0, until - time.monotonic())))
    return False


def _hand(result: FrameResult, place: tuple[float, float, float] | None) -> Event:
    x, y, area = (None, None, 0.0) if place is None else (round(place[0], 4), round(place[1], 4), place[2])
    fields = {"area": round(area, 4), "x": x, "y": y, "quality": round(result.quality, 3)}
    seen = {"in_gesture": result.in_gesture, "missing": result.missing}
    return gesture_event(result.time_s, events.HAND, {**fields, **seen})
