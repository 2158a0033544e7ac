# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Devices as they come: a thread for each mode, and queues that never make one of them wait."""

from __future__ import annotations

import threading
import time
from collections import deque
from typing import Any

from hri.core.errors import InvalidArgument
from hri.live import Event
from hri.live.events import HAND, LEVEL, PARTIAL, STALL
from hri.session.feeds import Arrival, Feed, what_failed

PASSING = frozenset((LEVEL, HAND, PARTIAL))
"""Events that the next of their kind replaces: what a slow reader misses first."""
_CLOSE_S = 2.0


class EventQueue:
    """Events between two threads; the writer never waits.

    A reader that falls behind by more than `capacity` misses events that pass (levels, places of hands); one that falls
    behind by 16 times as much misses the oldest of the others, too. Both are counted. Decisions, and what the session
    says or is asked for, STOP above all, go last: only where nothing else is left to drop.

    Parameters
    ----------
    capacity : int
        At least 1.
    """

    def __init__(self, capacity: int = 256) -> None:
        if capacity < 1:
            raise InvalidArgument(f"capacity must be at least 1, got {capacity}")
        self._capacity = capacity
        self._arrivals: deque[Arrival] = deque()
        self._closed = False
        self._ready = threading.Condition()
        self.num_lost = 0
        """Events that the reader missed."""

    def put(self, event: Event) -> None:
        """Add an event."""
        with self._ready:
            waiting = len(self._arrivals)
            if waiting >= self._capacity and event.event in PASSING:
                self.num_lost += 1
                return
            if waiting >= 16 * self._capacity:
                self._drop_one()
            self._arrivals.append(
                Arrival(event, time.perf_counter() - 1e-3 * float(event.fields.get("compute_ms", 0.0)))
            )
            self._ready.notify()

    def _drop_one(self) -> None:
        lesser = (i for i, arrival in enumerate(self._arrivals) if not _matters(arrival.event))
        del self._arrivals[next(lesser, 0)]
        self.num_lost += 1

    def get(self, timeout_s: float) -> Arrival | None:
        """The oldest event; None when there is none for `timeout_s`, or the queue is closed and empty."""
        with self._ready:
            self._ready.wait_for(lambda: self._arrivals or self._closed, timeout_s)
            return self._arrivals.popleft() if self._arrivals else None

    def close(self) -> None:
        """Nothing follows."""
        with self._ready:
            self._closed = True
            self._ready.notify_all()

    @property
    def over(self) -> bool:
        """Whether the queue is closed and empty."""
        with self._ready:
            return self._closed and not self._arrivals


def _matters(event: Event) -> bool:
    return event.decision is not None or event.mode == "session"


class LiveFeeds:
    """Runs each feed in a thread of its own, from `start` on; one that is lost is opened again until `close`.

    Parameters
    ----------
    feeds : list of Feed
    retry_s : float
        From one attempt to open a source to the next.
    """

    def __init__(self, feeds: list[Feed[Any]], retry_s: float) -> None:
        self.queue = EventQueue()
        self._retry_s = retry_s
        self._closed = threading.Event()
        self._running = len(feeds)
        self._lock = threading.Lock()
        self._threads = [
            threading.Thread(target=self._run, args=(feed,), daemon=True, name=f"hri-{feed.mode}") for feed in feeds
        ]

    def start(self) -> None:
        """Begin; what is put in the queue before comes before all that is heard and seen."""
        for thread in self._threads:
            thread.start()

    def close(self) -> None:
        """Let the devices go; returns in bounded time, also where a driver hangs."""
        self._closed.set()
        until_s = time.monotonic() + _CLOSE_S
        for thread in self._threads:
            if thread.ident is not None:  # it was started
                thread.join(max(0.0, until_s - time.monotonic()))

    def _run(self, feed: Feed[Any]) -> None:
        try:
            while not self._closed.is_set():
                opened_s = time.monotonic()
                for event in feed.events():
                    self.queue.put(event)
                    if self._closed.is_set():
                        return
                if not feed.lost:
                    return
                # One that fails as soon as it is open must not be opened again and again without a rest.
                left_s = opened_s + self._retry_s - time.monotonic()
                while self._closed.wait(max(0.0, left_s)) or not feed.returns():
                    if self._closed.is_set():
                        return
                    left_s = self._retry_s
        except Exception as error:  # a source of the caller's own may raise anything; the other mode goes on
            self.queue.put(Event(feed.time_s, STALL, {"message": what_failed(error)}, mode=feed.mode))
        finally:
            with self._lock:
                self._running -= 1
                if self._running == 0:
                    self.queue.close()
