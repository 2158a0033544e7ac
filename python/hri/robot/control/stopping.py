# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""STOP: a latch that any thread and any signal handler may set, and that stays set until it is released."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Protocol

from hri.core.errors import InvalidArgument

STOP_SIGNALS = tuple(
    number for name in ("SIGINT", "SIGTERM", "SIGHUP") if (number := getattr(signal, name, None)) is not None
)


class StopLatch:
    """Whether a robot is stopped.

    Plain attributes instead of a lock: a signal handler may interrupt the very thread that would hold the lock. A
    motion remembers the last stop before it, so that one released before the motion looks again still ends the motion.
    """

    def __init__(self) -> None:
        self._engaged = False
        self._last: object = object()

    @property
    def engaged(self) -> bool:
        """Whether no motion may begin."""
        return self._engaged

    def engage(self) -> None:
        """Stop; in this order, so that no thread sees the latch without the stop that set it."""
        self._last = object()
        self._engaged = True

    def interrupt(self) -> None:
        """End the motion under way as a stop does; the latch stays as it is."""
        self._last = object()

    def release(self) -> None:
        """Allow motions that begin from now on."""
        self._engaged = False

    def mark(self) -> object:
        """What `since` asks for: taken by a motion before it looks at the latch for the first time."""
        return self._last

    def since(self, mark: object) -> bool:
        """Whether there was a stop after the mark was taken, or one is latched."""
        return self._engaged or self._last is not mark


class _Stoppable(Protocol):
    def stop(self) -> None: ...


@contextmanager
def broken_pipes_as_errors() -> Iterator[None]:
    """Let the end of the program that reads the output, or of a robot's link, be a `BrokenPipeError`, as in Python.

    Commands that end silently as soon as their output goes nowhere (SIGPIPE) would leave a robot in mid-motion, and a
    recording without its end. Without effect in another thread than the main one.
    """
    number = getattr(signal, "SIGPIPE", None)
    if number is None or threading.current_thread() is not threading.main_thread():
        yield
        return
    if signal.getsignal(number) is not signal.SIG_DFL:
        yield
        return
    signal.signal(number, signal.SIG_IGN)
    try:
        yield
    finally:
        signal.signal(number, signal.SIG_DFL)


@contextmanager
def stopped_by_signals(robot: _Stoppable) -> Iterator[list[int]]:
    """Let Ctrl-C and a request to end the process (SIGTERM, SIGHUP) stop a robot instead of ending the program.

    A motion under way comes to rest within its limits and the ones after it do not begin; the program goes on and
    should end itself. A second signal of the same kind acts as it did before. Only the main thread can do this.
    A broken pipe is an error meanwhile, and ends no program.

    Parameters
    ----------
    robot : Robot

    Yields
    ------
    list of int
        Numbers of the signals that came, in order.

    Raises
    ------
    InvalidArgument
        In another thread than the main one.
    """
    if threading.current_thread() is not threading.main_thread():
        raise InvalidArgument("signals can only be taken in the main thread")
    came: list[int] = []

    def stop(number: int, frame: object) -> None:
        robot.stop()
        came.append(number)
        signal.signal(number, before[number])

    handlers = {number: signal.getsignal(number) for number in STOP_SIGNALS}
    # One that is ignored (nohup) stays so; one that was not set from Python (None) could not be put back.
    before = {number: handler for number, handler in handlers.items() if handler not in (None, signal.SIG_IGN)}
    try:
        for number in before:
            signal.signal(number, stop)
        with broken_pipes_as_errors():
            yield came
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
