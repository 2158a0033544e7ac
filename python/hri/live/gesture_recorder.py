# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""A data set of gestures, made from a camera: asks for one gesture after the other and keeps what is shown."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from contextlib import closing
from dataclasses import dataclass, replace

from hri.live import events
from hri.live.events import Event
from hri.live.frames import FrameSource, TimedFrame
from hri.live.movements import LEARNED_STILL_CHANGE, MovementOptions
from hri.live.sights import GestureEvent, MovementFinder, Sight
from hri.live.sources import require_positive
from hri.live.stream_hands import StreamHands
from hri.live.takes import Takes
from hri.media import write_video

PATTERN = "{label}/{person}_{take}.avi"
"""Pictures of their own: what codecs of moving pictures leave out in the dark changes outlines."""
MIN_SEEN = 0.8
"""Share of a gesture's pictures that must show the hand."""
MIN_QUALITY = 0.4
"""How well the hand must stand out, on average."""
REST_S = 0.4
"""Of the rest before a movement that is recorded with it, so that training sees that it begins at rest."""
FEWEST_FRAMES = 8
"""Below that, hands in clips are not looked for as in longer ones."""


class GestureRecorder:
    """Records gestures, label by label, into a data set that `hri.Dataset.load` reads.

    Gestures are found as `Watcher` finds them, so that models see live what they were trained on. Every label is asked
    for once, then every label again. What is there already stays as it is and is not asked for again. After every
    recording there is a pause in which the hand may go back; what moves before the next prompt is not recorded.

    Parameters
    ----------
    folder, labels, person, takes
        Where to, which gestures by whom, and how many recordings of each; errors as of `Takes`.
    options : MovementOptions, optional
        When a gesture begins and ends.
    held : bool
        The labels are signs: the hand comes into view and holds one. Otherwise they are movements: the hand rests in
        view, moves, and rests again, and its coming is not recorded.
    pause_s : float
        From a recording to the next prompt.
    hand_interval_s : float
        How often the hand's place is told.
    """

    def __init__(
        self,
        folder: str | os.PathLike[str],
        labels: Sequence[str],
        person: str,
        takes: int = 5,
        options: MovementOptions | None = None,
        *,
        held: bool = False,
        pause_s: float = 2.5,
        hand_interval_s: float = 0.1,
    ) -> None:
        require_positive("pause_s", pause_s)
        require_positive("hand_interval_s", hand_interval_s)
        self._takes = Takes(folder, labels, person, takes, "gesture", PATTERN)
        chosen = options or MovementOptions(still_change=LEARNED_STILL_CHANGE)
        before_s = chosen.context_s if held else max(chosen.context_s, REST_S)
        self._options = replace(chosen, arrivals=held, context_s=before_s)
        self._pause_s = pause_s
        self._hand_interval_s = hand_interval_s

    @property
    def num_takes(self) -> int:
        """Recordings that are wanted in all."""
        return len(self._takes)

    def missing(self) -> list[tuple[str, int]]:
        """Label and take of every recording that is not there yet, in the order in which they are asked for."""
        return self._takes.missing()

    def record(self, source: FrameSource, on_sight: Callable[[Sight], None] | None = None) -> Iterator[Event]:
        """Ask, watch and keep until nothing is missing or the source ends, which is closed then.

        `on_sight` is called with every `Sight`, for pictures of what is going on.

        Beside what a watcher tells of a stream, "prompt" says what to show next, "recorded" where it was kept and how
        well the hand was seen, and "refused" why it was not; then the prompt comes again.

        Raises
        ------
        Stalled
            When the source gives no more pictures.
        IoError
            When a recording cannot be written, or somebody else wrote it meanwhile.
        """
        missing = self.missing()
        if not missing:
            source.close()
            return
        self._takes.begin()
        finder = MovementFinder(self._options, StreamHands(), hand_interval_s=self._hand_interval_s)
        seen = _Seen()
        num_lost = 0
        ready_s = 0.0  # when the next prompt is due
        asked_s: float | None = None
        with closing(finder.see(source, folder=str(self._takes.folder))) as sights:
            for sight in sights:
                yield from sight.events
                if on_sight is not None:
                    on_sight(sight)
                seen.push(sight)
                if asked_s is None and sight.time_s >= ready_s and not sight.running:
                    asked_s, num_lost = sight.time_s, source.num_lost
                    yield self._takes.prompt(sight.time_s, missing)
                told = next((event for event in sight.events if event.event == events.MOVEMENT_END), None)
                if told is None or asked_s is None or told.fields["first_s"] < asked_s:
                    continue
                gesture = seen.between(sight.movement)
                reason = _fault(gesture, bool(told.fields["cut"]), source.num_lost - num_lost)
                yield self._keep_or_refuse(sight.time_s, gesture, reason, missing)
                if not missing:
                    return
                ready_s, asked_s = sight.time_s + self._pause_s, None

    def _keep_or_refuse(self, time_s: float, gesture: _Gesture, reason: str, missing: list[tuple[str, int]]) -> Event:
        told: dict[str, object] = {"label": missing[0][0], "take": missing[0][1]}
        measured = {"quality": round(gesture.quality, 3), "hand_seen": round(gesture.seen, 3)}
        if reason:
            return GestureEvent(time_s, events.REFUSED, {**told, "reason": reason, **measured})
        frames = [frame for frame, _ in gesture.frames]
        path = self._takes.keep(*missing.pop(0), lambda part: write_video(part, frames, gesture.fps))
        told |= {"path": str(path), "duration_s": round(gesture.duration_s, 4), "num_frames": len(frames)}
        return GestureEvent(time_s, events.RECORDED, {**told, **measured})


@dataclass(frozen=True)
class _Gesture:
    frames: list[TimedFrame]
    quality: float
    seen: float

    @property
    def duration_s(self) -> float:
        return self.frames[-1][1] - self.frames[0][1]

    @property
    def fps(self) -> float:
        """That at which the pictures came: a webcam's changes with the light."""
        return (len(self.frames) - 1) / self.duration_s if self.duration_s > 0 else 1.0


class _Seen:
    """How well the hand was seen of late."""

    def __init__(self) -> None:
        self._qualities: list[tuple[float, float]] = []

    def push(self, sight: Sight) -> None:
        if sight.mask is None:
            return
        if not sight.running and not sight.movement:
            self._qualities = [one for one in self._qualities if one[0] > sight.time_s - 1.0]
        self._qualities.append((sight.time_s, sight.quality if sight.mask.any() else 0.0))

    def between(self, frames: list[TimedFrame]) -> _Gesture:
        first_s, last_s = frames[0][1], frames[-1][1]
        inside = [quality for time_s, quality in self._qualities if first_s <= time_s <= last_s]
        shown = [quality for quality in inside if quality > 0]
        return _Gesture(frames, sum(shown) / max(1, len(shown)), len(shown) / max(1, len(inside)))


def _fault(gesture: _Gesture, cut: bool, num_lost: int) -> str:
    """What is wrong with a recording; "" if nothing."""
    if cut:
        return "too long for a gesture"
    if num_lost:
        return f"{num_lost} pictures were lost: this computer is too busy"
    if len(gesture.frames) < FEWEST_FRAMES:
        return f"only {len(gesture.frames)} pictures: move more slowly, or use a faster camera"
    if gesture.seen < MIN_SEEN:
        return f"the hand is seen in {100 * gesture.seen:.0f} % of the pictures: stay in view"
    if gesture.quality < MIN_QUALITY:
        return "the hand hardly stands out: more light, or another background"
    return ""
