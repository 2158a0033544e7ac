# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""From a stream of pictures to its movements: the same path for a camera and for a video."""

from __future__ import annotations

import time
from collections.abc import Generator
from dataclasses import dataclass, field
from functools import partial
from typing import Any

import numpy as np

from hri.core.errors import FormatError
from hri.live import events
from hri.live.events import Event
from hri.live.frames import Frame, FrameSource, TimedFrame
from hri.live.movements import CUT, Mask, Movement, MovementDetector, MovementKind, MovementOptions
from hri.live.sources import Stalled, require_positive
from hri.live.stream_hands import HandFinder, PlainHands

GestureEvent = partial(Event, mode="gesture")
_RETRY_S = 0.5
_TRACK_S = 2.0

_KINDS = {
    MovementKind.start: events.MOVEMENT_START,
    MovementKind.end: events.MOVEMENT_END,
    MovementKind.dropped: events.MOVEMENT_DROPPED,
}


@dataclass
class Sight:
    """One picture, or something that happened between two.

    Attributes
    ----------
    time_s : float
    events : list of Event
        What happened with it.
    frame, mask : ndarray of uint8, or None
        The picture (BGR) and the hand in it; the mask is smaller.
    silhouette : hri._native_vision.Silhouette, or None
        The hand as recognisers take it.
    quality : float
        How well the hand stands out, 0..1.
    track : list of (float, float)
        Where the hand was in the last two seconds, in shares of the picture's width and height.
    running : list of (frame, time)
        The movement so far; empty when there is none.
    movement : list of (frame, time)
        With the end of a movement, all of it.
    """

    time_s: float
    events: list[Event] = field(default_factory=list)
    frame: Frame | None = None
    mask: Mask | None = None
    silhouette: Any = None
    quality: float = 0.0
    track: list[tuple[float, float]] = field(default_factory=list)
    running: list[TimedFrame] = field(default_factory=list)
    movement: list[TimedFrame] = field(default_factory=list)


class MovementFinder:
    """Finds every movement of a hand in a stream.

    Parameters
    ----------
    options : MovementOptions, optional
        When a movement begins and ends.
    hands : HandFinder, optional
        How hands are found; by default in every picture by itself.
    hand_interval_s : float
        How often the hand's place is told.
    reconnect_s : float
        For how long a source that stalled is opened again and again; 0 gives up at once.
    """

    def __init__(
        self,
        options: MovementOptions | None = None,
        hands: HandFinder | None = None,
        *,
        hand_interval_s: float = 0.1,
        reconnect_s: float = 0.0,
    ) -> None:
        require_positive("hand_interval_s", hand_interval_s)
        self._options = options or MovementOptions()
        self._hands = hands or PlainHands()
        self._hand_interval_s = hand_interval_s
        self._reconnect_s = reconnect_s

    def see(self, source: FrameSource, **told: Any) -> Generator[Sight, None, None]:
        """What is seen until the source ends; it is closed then, and also when the caller stops early.

        Raises
        ------
        Stalled
            When the source gives no more pictures and does not come back, after an event that says so.
        FormatError
            When its time runs backwards.
        """
        stream = _Stream(self._options)
        yield Sight(0.0, [GestureEvent(0.0, events.WATCHING, {"source": source.name, "fps": source.fps, **told})])
        next_hand_s, num_lost = 0.0, 0
        try:
            while True:
                try:
                    timed = source.read()
                except Stalled as error:
                    yield stream.interrupted(str(error))
                    if not self._comes_back(source):
                        raise
                    yield Sight(stream.time_s, [GestureEvent(stream.time_s, events.RECONNECTED, {})])
                    continue
                if timed is None:
                    break
                found = self._hands.find(timed[0], timed[1], stream.in_movement)
                sight = stream.push(timed, found, self._hands.renewed())
                if source.num_lost > num_lost:
                    fields = {"lost_frames": source.num_lost - num_lost}
                    sight.events.insert(0, GestureEvent(sight.time_s, events.OVERFLOW, fields))
                    num_lost = source.num_lost
                if sight.time_s >= next_hand_s:
                    next_hand_s = sight.time_s + self._hand_interval_s
                    sight.events.append(_hand(sight))
                yield sight
            sight = stream.finish()
            if sight.events:
                yield sight
            ended = GestureEvent(stream.time_s, events.ENDED, {"lost_frames": source.num_lost})
            yield Sight(stream.time_s, [ended])
        finally:
            source.close()

    def _comes_back(self, source: FrameSource) -> bool:
        until = time.monotonic() + self._reconnect_s
        while time.monotonic() < until:
            if source.reconnect():
                return True
            time.sleep(min(_RETRY_S, max(0.0, until - time.monotonic())))
        return False


class _Stream:
    """What is kept of a stream while it is watched."""

    def __init__(self, options: MovementOptions) -> None:
        self._options = options
        self._detector = MovementDetector(options)
        self._kept: list[TimedFrame] = []
        self._track: list[tuple[float, float, float]] = []
        self.time_s = 0.0

    @property
    def in_movement(self) -> bool:
        return self._detector.in_movement

    def push(self, timed: TimedFrame, found: Any, renewed: bool) -> Sight:
        frame, time_s = timed
        mask: Mask = np.asarray(found.mask)
        if time_s < self.time_s:
            raise FormatError(f"time runs backwards: a picture at {time_s:g} s after one at {self.time_s:g} s")
        self.time_s = time_s
        self._kept.append(timed)
        rows, columns = np.nonzero(mask)
        if len(rows):
            self._track.append((time_s, float(columns.mean() / mask.shape[1]), float(rows.mean() / mask.shape[0])))
        self._track = [place for place in self._track if place[0] > time_s - _TRACK_S]
        if renewed:
            self._detector.see_anew(mask)
        sight = self._told(self._detector.push(mask, time_s))
        sight.frame, sight.mask, sight.silhouette, sight.quality = frame, mask, found, float(found.quality)
        sight.track = [(x, y) for _, x, y in self._track]
        if self._detector.in_movement:
            sight.running = self._kept
        self._forget()
        return sight

    def finish(self) -> Sight:
        return self._told(self._detector.finish())

    def interrupted(self, message: str) -> Sight:
        """What was moving when the stream stalled is not known to its end, and must move no robot."""
        told = [GestureEvent(self.time_s, events.STALL, {"message": message})]
        if self._detector.in_movement:
            first_s = self._detector.may_have_begun_s or 0.0
            fields = {"first_s": round(first_s, 4), "last_s": round(self.time_s, 4), "reason": "stalled"}
            told.insert(0, GestureEvent(self.time_s, events.MOVEMENT_DROPPED, fields))
        self._detector = MovementDetector(self._options)
        self._kept.clear()
        self._track.clear()
        return Sight(self.time_s, told)

    def _told(self, movement: Movement | None) -> Sight:
        sight = Sight(self.time_s)
        if movement is None:
            return sight
        fields: dict[str, Any] = {"first_s": round(movement.first_s, 4)}
        if movement.kind is not MovementKind.start:
            fields |= {"last_s": round(movement.last_s, 4), "reason": movement.reason}
        if movement.kind is MovementKind.end:
            fields["cut"] = movement.reason == CUT
            first_s = movement.first_s - self._options.context_s
            sight.movement = [t for t in self._kept if first_s <= t[1] <= movement.last_s]
        sight.events.append(GestureEvent(self.time_s, _KINDS[movement.kind], fields))
        return sight

    def _forget(self) -> None:
        begun_s = self._detector.may_have_begun_s
        first_s = (self.time_s if begun_s is None else begun_s) - self._options.context_s
        skipped = next((i for i, timed in enumerate(self._kept) if timed[1] >= first_s), 0)
        if skipped:
            self._kept = self._kept[skipped:]


def _hand(sight: Sight) -> Event:
    assert sight.mask is not None
    area = float(np.count_nonzero(sight.mask) / sight.mask.size)
    x, y = sight.track[-1] if area and sight.track else (None, None)
    fields = {
        "area": round(area, 4),
        "x": None if x is None else round(x, 4),
        "y": None if y is None else round(y, 4),
        "quality": round(sight.quality, 3),
        "in_movement": bool(sight.running),
    }
    return GestureEvent(sight.time_s, events.HAND, fields)
