# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Decisions on the gestures of a stream."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import closing
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri import _native
from hri.live import events
from hri.live.events import Event, decision_fields
from hri.live.frames import FrameSource, TimedFrame
from hri.live.movements import LEARNED_STILL_CHANGE, MovementOptions
from hri.live.sights import GestureEvent, MovementFinder, Sight
from hri.live.sources import require_positive
from hri.live.stream_hands import HandFinder, PlainHands, StreamHands
from hri.recognition import Decision, GestureRecognizer

_PAUSE_S = 2.5
"""After a longer pause, the movement before it is another gesture."""


class Watcher:
    """Recognises every gesture in a stream of pictures.

    Hands are found as in training: in every picture by itself for still signs, by colours learned from the stream for
    movements. Features are computed as the pictures come, so that a decision stands at once when a movement ends. Where
    the gestures trained on pause, a movement is decided by itself and with the one before it; the surer answer stands.

    Parameters
    ----------
    recognizer : GestureRecognizer
        Trained or loaded.
    options : MovementOptions, optional
        When a movement begins and ends; by default as suits how hands are found and whether the recogniser's gestures
        begin at rest.
    silhouette : hri._native_vision.SilhouetteOptions, optional
        Find the hand in every picture by itself, like this.
    hand_interval_s : float
        How often the hand's place is told.
    partial_interval_s : float
        How often it is told what a movement looks like so far.
    reconnect_s : float
        For how long a camera that stalled is opened again and again; 0 gives up at once.
    locale : str
        Passed on with decisions.
    model_id : str
        Which model decided; passed on with decisions.
    on_sight : callable, optional
        Called with every `Sight` and the newest `Decision` (None before the first), for pictures of what is going on.
    """

    def __init__(
        self,
        recognizer: GestureRecognizer,
        options: MovementOptions | None = None,
        silhouette: Any = None,
        *,
        hand_interval_s: float = 0.1,
        partial_interval_s: float = 0.5,
        reconnect_s: float = 0.0,
        locale: str = "",
        model_id: str = "",
        on_sight: Callable[[Sight, Decision | None], None] | None = None,
    ) -> None:
        require_positive("partial_interval_s", partial_interval_s)
        self._recognizer = recognizer
        learns = silhouette is None and recognizer.knows_movements
        if options is None:
            options = MovementOptions(
                still_change=LEARNED_STILL_CHANGE if learns else MovementOptions.still_change,
                arrivals=not recognizer.starts_at_rest,
            )
        self._options = options
        self._silhouette = silhouette
        self._learns = learns
        self._intervals = {"hand_interval_s": hand_interval_s, "reconnect_s": reconnect_s}
        self._finder()  # refuses intervals out of range now rather than when watching
        self._partial_interval_s = partial_interval_s
        self._locale = locale
        self._model_id = model_id
        self._on_sight = on_sight

    def watch(self, source: FrameSource) -> Iterator[Event]:
        """Events until the source ends; it is closed then, and also when the caller stops early.

        Raises
        ------
        Stalled
            When the source gives no more pictures and does not come back, after an event that says so.
        """
        newest: Decision | None = None
        partial_s = 0.0
        rows = _Rows(self._recognizer, self._options.context_s)
        with closing(self._finder().see(source, model=self._model_id)) as sights:
            for sight in sights:
                rows.push(sight)
                yield from sight.events
                decided: Event | None = None
                if sight.movement:
                    told = next(event for event in sight.events if event.event == events.MOVEMENT_END)
                    decided = self._decide(sight, told, rows)
                elif not sight.running:
                    partial_s = sight.time_s
                elif sight.time_s - partial_s >= self._partial_interval_s:
                    partial_s = sight.time_s
                    decided = self._so_far(sight, rows)
                newest = newest if decided is None else decided.decision
                if self._on_sight is not None:
                    self._on_sight(sight, newest)
                if decided is not None:
                    yield decided

    def _finder(self) -> MovementFinder:
        hands: HandFinder = StreamHands() if self._learns else PlainHands(self._silhouette)
        return MovementFinder(self._options, hands, **self._intervals)

    def _decide(self, sight: Sight, end: Event, rows: _Rows) -> Event:
        begun = time.perf_counter()
        decision = rows.decide(sight.movement)
        compute_ms = 1000 * (time.perf_counter() - begun)
        fields: dict[str, Any] = {name: end.fields[name] for name in ("first_s", "last_s")}
        fields |= decision_fields(decision, self._locale, self._model_id) | {"compute_ms": round(compute_ms, 3)}
        return GestureEvent(sight.time_s, events.DECISION, fields, decision)

    def _so_far(self, sight: Sight, rows: _Rows) -> Event:
        """What the movement looks like before its end: for the eye, and not to act on."""
        decision = rows.recognise(sight.running)
        fields = decision_fields(decision, self._locale, self._model_id)
        fields |= {"incremental": fields["final"], "final": ""}
        return GestureEvent(sight.time_s, events.PARTIAL, fields, decision)


class _Rows:
    """Features of the pictures that may belong to a movement, computed once, as they come."""

    def __init__(self, recognizer: GestureRecognizer, context_s: float) -> None:
        self._recognizer = recognizer
        self._context_s = context_s
        self._by_pictures = recognizer.options.source == _native.GestureSource.silhouettes
        self._rows: deque[tuple[float, NDArray[np.float32]]] = deque()
        self._before: tuple[float, float] | None = None  # the movement before the pause

    def push(self, sight: Sight) -> None:
        if sight.silhouette is None or not self._by_pictures:
            return
        kept = sight.running or sight.movement
        first_s = kept[0][1] if kept else sight.time_s - self._context_s
        if self._before is not None:
            if first_s - self._before[1] > _PAUSE_S:
                self._before = None
            else:
                first_s = self._before[0]
        while self._rows and self._rows[0][0] < first_s - 1.0:
            self._rows.popleft()
        self._rows.append((sight.time_s, self._recognizer.silhouette_features([sight.silhouette])))

    def decide(self, frames: list[TimedFrame]) -> Decision:
        """On a movement that has ended."""
        alone = self.recognise(frames)
        if not self._by_pictures or not self._recognizer.pauses:
            return alone
        before, self._before = self._before, (frames[0][1], frames[-1][1])
        if before is None or frames[0][1] - before[1] > _PAUSE_S:
            return alone
        both = self._recognise(before[0], frames[-1][1])
        return both if both.score > alone.score else alone

    def recognise(self, frames: list[TimedFrame]) -> Decision:
        """On a movement by itself."""
        if not self._by_pictures:
            return self._recognizer.recognise([frame for frame, _ in frames])
        return self._recognise(frames[0][1], frames[-1][1])

    def _recognise(self, first_s: float, last_s: float) -> Decision:
        found = [row for time_s, row in self._rows if first_s <= time_s <= last_s]
        return self._recognizer.recognise_features(np.concatenate(found))
