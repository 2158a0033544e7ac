# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Decisions on the gestures of a stream."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import closing
from typing import Any

from hri.live import events
from hri.live.events import Event, decision_fields
from hri.live.frames import FrameSource
from hri.live.movements import MovementOptions
from hri.live.sights import GestureEvent, MovementFinder, Sight
from hri.live.sources import require_positive
from hri.recognition import Decision, GestureRecognizer


class Watcher:
    """Recognises every gesture in a stream of pictures.

    Parameters
    ----------
    recognizer : GestureRecognizer
        Trained or loaded.
    options : MovementOptions, optional
        When a movement begins and ends.
    silhouette : hri._native_vision.SilhouetteOptions, optional
        How the hand is found in every picture, to find movements; the recogniser looks for itself.
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
        self._finder = MovementFinder(options, silhouette, hand_interval_s=hand_interval_s, reconnect_s=reconnect_s)
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
        with closing(self._finder.see(source, model=self._model_id)) as sights:
            for sight in sights:
                yield from sight.events
                decided: Event | None = None
                if sight.movement:
                    told = next(event for event in sight.events if event.event == events.MOVEMENT_END)
                    decided = self._decide(sight, told)
                elif not sight.running:
                    partial_s = sight.time_s
                elif sight.time_s - partial_s >= self._partial_interval_s:
                    partial_s = sight.time_s
                    decided = self._so_far(sight)
                newest = newest if decided is None else decided.decision
                if self._on_sight is not None:
                    self._on_sight(sight, newest)
                if decided is not None:
                    yield decided

    def _decide(self, sight: Sight, end: Event) -> Event:
        begun = time.perf_counter()
        decision = self._recognizer.recognise([frame for frame, _ in sight.movement])
        compute_ms = 1000 * (time.perf_counter() - begun)
        fields: dict[str, Any] = {name: end.fields[name] for name in ("first_s", "last_s")}
        fields |= decision_fields(decision, self._locale, self._model_id) | {"compute_ms": round(compute_ms, 3)}
        return GestureEvent(sight.time_s, events.DECISION, fields, decision)

    def _so_far(self, sight: Sight) -> Event:
        """What the movement looks like before its end: for the eye, and not to act on."""
        decision = self._recognizer.recognise([frame for frame, _ in sight.running])
        fields = decision_fields(decision, self._locale, self._model_id)
        fields |= {"incremental": fields["final"], "final": ""}
        return GestureEvent(sight.time_s, events.PARTIAL, fields, decision)
