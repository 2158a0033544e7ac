# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""A data set of gestures, made from a camera: asks for one gesture after the other and keeps what is shown."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from contextlib import closing

from hri.live import events
from hri.live.events import Event
from hri.live.frame_results import FrameResult, frame_results, gesture_event
from hri.live.frames import FrameSource
from hri.live.sources import require_positive
from hri.live.spotting import REST_S, SpottedGesture, SpottingStream, fault_of
from hri.live.takes import Takes
from hri.media import write_video
from hri.recognition import LEARNED_STILL_CHANGE, GestureSegmenterOptions

PATTERN = "{label}/{person}_{take}.avi"
"""Pictures of their own: what codecs of moving pictures leave out in the dark changes outlines."""


class GestureRecorder:
    """Records gestures, label by label, into a data set that `hri.Dataset.load` reads.

    Gestures are found as `Watcher` finds them, so that models see live what they were trained on. Every label is asked
    for once, then every label again. What is there already stays as it is and is not asked for again. After every
    recording there is a pause in which the hand may go back; what moves before the next prompt is not recorded.

    Parameters
    ----------
    folder, labels, person, takes
        Where to, which gestures by whom, and how many recordings of each; errors as of `Takes`.
    segmenter : GestureSegmenterOptions, optional
        When a gesture begins and ends.
    held : bool
        The labels are signs: the hand comes into view and holds one. Otherwise they are dynamic: the hand rests in
        view, moves, and rests again, and its coming is not recorded.
    num_hands : int
        1, or 2 for gestures of both hands: a gesture begins when either moves, and ends when both rest.
    pause_s : float
        From a recording to the next prompt.
    hand_interval_s : float
        How often the hand's place is reported.
    """

    def __init__(
        self,
        folder: str | os.PathLike[str],
        labels: Sequence[str],
        person: str,
        takes: int = 5,
        segmenter: GestureSegmenterOptions | None = None,
        *,
        held: bool = False,
        num_hands: int = 1,
        pause_s: float = 2.5,
        hand_interval_s: float = 0.1,
    ) -> None:
        require_positive("pause_s", pause_s)
        require_positive("hand_interval_s", hand_interval_s)
        self._takes = Takes(folder, labels, person, takes, "gesture", PATTERN)
        fields = {"still_change": LEARNED_STILL_CHANGE} if segmenter is None else segmenter.as_dict()
        chosen = GestureSegmenterOptions(**{**fields, "arrivals": held})
        chosen.context_s = chosen.context_s if held else max(chosen.context_s, REST_S)
        self._options = chosen
        self._num_hands = num_hands
        SpottingStream(chosen, num_hands)  # refuses options out of range now
        self._pause_s = pause_s
        self._hand_interval_s = hand_interval_s

    @property
    def num_takes(self) -> int:
        """Recordings that are wanted in all."""
        return len(self._takes)

    def missing(self) -> list[tuple[str, int]]:
        """Label and take of every recording that is not there yet, in the order in which they are asked for."""
        return self._takes.missing()

    def record(self, source: FrameSource, on_result: Callable[[FrameResult], None] | None = None) -> Iterator[Event]:
        """Ask, watch and keep until nothing is missing or the source ends, which is closed then.

        `on_result` is called with every `FrameResult`, for pictures of what is going on.

        Beside what a watcher reports of a stream, "prompt" says what to show next, "recorded" where it was kept and how
        well the hand was seen, and "refused" why it was not; then the prompt comes again.

        Raises
        ------
        Stalled
            When the source gives no more pictures.
        IoError
            When a recording cannot be written, or another program wrote it meanwhile.
        """
        missing = self.missing()
        if not missing:
            source.close()
            return
        self._takes.begin()
        stream = SpottingStream(self._options, self._num_hands)
        num_lost = 0
        ready_s = 0.0  # when the next prompt is due
        asked_s: float | None = None
        results = frame_results(source, stream, hand_interval_s=self._hand_interval_s, folder=str(self._takes.folder))
        with closing(results):
            for result in results:
                yield from result.events
                if on_result is not None:
                    on_result(result)
                if asked_s is None and result.time_s >= ready_s and not result.in_gesture:
                    asked_s, num_lost = result.time_s, source.num_lost
                    yield self._takes.prompt(result.time_s, missing)
                ended = next((event for event in result.events if event.event == events.GESTURE_END), None)
                if ended is None or asked_s is None or ended.fields["first_s"] < asked_s:
                    continue
                reason = fault_of(stream.gesture, bool(ended.fields["cut"]), source.num_lost - num_lost)
                yield self._keep_or_refuse(result.time_s, stream.gesture, reason, missing)
                if not missing:
                    return
                ready_s, asked_s = result.time_s + self._pause_s, None

    def _keep_or_refuse(
        self, time_s: float, gesture: SpottedGesture, reason: str, missing: list[tuple[str, int]]
    ) -> Event:
        fields: dict[str, object] = {"label": missing[0][0], "take": missing[0][1]}
        measured = {"quality": round(gesture.quality, 3), "hand_seen": round(gesture.seen, 3)}
        if reason:
            return gesture_event(time_s, events.REFUSED, {**fields, "reason": reason, **measured})
        frames = [frame for frame, _ in gesture.frames]
        path = self._takes.keep(*missing.pop(0), lambda part: write_video(part, frames, gesture.fps))
        fields |= {"path": str(path), "duration_s": round(gesture.duration_s, 4), "num_frames": len(frames)}
        return gesture_event(time_s, events.RECORDED, {**fields, **measured})
