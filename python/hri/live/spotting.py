# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The pictures of every gesture in a stream, for training on them, and whether they are good enough for that."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass
from typing import TYPE_CHECKING

from hri.core.phrases import phrase
from hri.live.events import Event
from hri.live.frame_results import segment_event
from hri.live.frames import Frame, TimedFrame
from hri.recognition import GestureRecognizer, GestureSegment, GestureSegmenterOptions

if TYPE_CHECKING:
    from hri.vision import HandFinder

MIN_SEEN = 0.8
"""Share of a gesture's pictures that must show the hand."""
MIN_QUALITY = 0.4
"""How well the hand must stand out, on average."""
REST_S = 0.4
"""Of the rest before a dynamic gesture that is recorded with it, so that training sees that it begins at rest."""
FEWEST_FRAMES = 8
"""Below that, hands in clips are not looked for as in longer ones."""


@dataclass(frozen=True)
class SpottedGesture:
    """Pictures of a gesture with their times.

    Attributes
    ----------
    frames : list of (ndarray, float)
    quality : float
        How well the hand stands out, 0..1.
    seen : float
        Share of the pictures that show it.
    """

    frames: list[TimedFrame]
    quality: float
    seen: float

    @property
    def duration_s(self) -> float:
        """From the first to the last picture."""
        return self.frames[-1][1] - self.frames[0][1]

    @property
    def fps(self) -> float:
        """That at which the pictures came: a webcam's changes with the light."""
        return (len(self.frames) - 1) / self.duration_s if self.duration_s > 0 else 1.0


class SpottingStream:
    """Finds gestures, and keeps the pictures of the one that is shown and how well the hand was seen in them.

    Parameters
    ----------
    options : GestureSegmenterOptions
    num_hands : int
    hands : HandFinder, optional
    dynamic : bool
        Hands are found as those of dynamic gestures.
    """

    def __init__(
        self, options: GestureSegmenterOptions, num_hands: int, hands: HandFinder | None = None, dynamic: bool = True
    ) -> None:
        from hri.recognition import GestureSpotter
        from hri.vision import HandFinder

        finder = HandFinder() if hands is None else hands
        self.spotter = GestureSpotter(finder, dynamic=dynamic, options=options, max_hands=num_hands)
        self.gesture = SpottedGesture([], 0.0, 0.0)
        self._max_s, self._context_s = float(options.max_gesture_s), float(options.context_s)
        self._kept: deque[tuple[Frame, float, float]] = deque()
        self._time_s = 0.0

    @classmethod
    def for_recognizer(cls, signs: GestureRecognizer) -> SpottingStream:
        """One that finds gestures as the streams of this recogniser do."""
        from hri.vision import HandFinder

        options = GestureSegmenterOptions(**signs.stream_options().segmenter.as_dict())
        if signs.is_dynamic and not options.arrivals:
            options.context_s = max(options.context_s, REST_S)
        finder = HandFinder(signs.options.hands)
        return cls(options, signs.options.num_hands, finder, signs.is_dynamic)

    def push(self, frame: Frame, time_s: float) -> list[Event]:
        """What happened with the next picture."""
        self._time_s = time_s
        segment = self.spotter.push(frame, time_s)
        hand = self.spotter.hand
        self._kept.append((frame, time_s, float(hand.quality) if hand.mask.any() else 0.0))
        happened = self._events(segment)
        # What began before that has been cut by now.
        since_s = max(self.spotter.kept_since_s, time_s - self._max_s - self._context_s)
        while self._kept and self._kept[0][1] < since_s:
            self._kept.popleft()
        return happened

    def finish(self) -> list[Event]:
        """The stream has ended."""
        happened = self._events(self.spotter.finish())
        self._kept.clear()  # the next stream may begin at any time
        return happened

    def interrupt(self) -> list[Event]:
        """Pictures are missing: what had begun is dropped."""
        happened = self._events(self.spotter.interrupt())
        self._kept.clear()
        return happened

    def _events(self, segment: GestureSegment) -> list[Event]:
        if segment.kind == "none":
            return []
        if segment.kind == "end":
            first_s = segment.first_s - self._context_s
            inside = [kept for kept in self._kept if first_s <= kept[1] <= segment.last_s]
            shown = [quality for _, _, quality in inside if quality > 0]
            frames = [(frame, time_s) for frame, time_s, _ in inside]
            self.gesture = SpottedGesture(frames, sum(shown) / max(1, len(shown)), len(shown) / max(1, len(inside)))
        return [segment_event(segment, self._time_s)]


def fault_of(gesture: SpottedGesture, cut: bool, num_lost: int) -> str:
    """What is wrong with a recording; "" if nothing."""
    if cut:
        return phrase("fault_long")
    if num_lost:
        return phrase("fault_lost", count=num_lost)
    if len(gesture.frames) < FEWEST_FRAMES:
        return phrase("fault_few", count=len(gesture.frames))
    if gesture.seen < MIN_SEEN:
        return phrase("fault_unseen", percent=f"{100 * gesture.seen:.0f}")
    if gesture.quality < MIN_QUALITY:
        return phrase("fault_faint")
    return ""
