# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The page's own voice, in the session that runs: while it speaks the microphone goes on, and only STOP counts."""

from __future__ import annotations

import math
import threading
import time
from collections.abc import Callable

from hri.session import Session
from hri.session.voice import TAIL_S, VOICE_END, VOICE_START


class PageVoice:
    """What the page says aloud, as the voice of one session after the other; called by several threads.

    Parameters
    ----------
    longest_s : float
        A text that is said for longer counts as said: the page did not report its end.
    clock : callable
        Gives seconds that never fall.
    """

    def __init__(self, longest_s: float, clock: Callable[[], float] = time.monotonic) -> None:
        self._longest_s = longest_s
        self._clock = clock
        self._turn = threading.RLock()
        self._session: Session | None = None
        self._text = ""
        self._until_s = -math.inf
        self._timer: threading.Timer | None = None

    def begins(self, text: str) -> None:
        """The page begins to say a text, in place of one that it may be saying."""
        with self._turn:
            self.ends()
            self._text = text
            self._until_s = self._clock() + self._longest_s
            self._timer = threading.Timer(self._longest_s, self._expires, (self._until_s,))
            self._timer.daemon = True
            self._timer.start()
            self._report(VOICE_START)

    def ends(self) -> None:
        """It has ended, or the page is gone."""
        with self._turn:
            if not self._text:
                return
            self._report(VOICE_END)
            self._text = ""
            self._until_s = min(self._until_s, self._clock())
            if self._timer is not None:
                self._timer.cancel()

    def attach(self, session: Session) -> None:
        """Another session runs from now on; it learns what is being said."""
        with self._turn:
            self._session = session
            if self._text:
                self._report(VOICE_START)

    @property
    def may_be_heard(self) -> bool:
        """Whether sound that comes now may be of this voice."""
        with self._turn:
            return self._clock() < self._until_s + TAIL_S

    def _expires(self, until_s: float) -> None:
        with self._turn:
            if self._text and self._until_s == until_s:
                self.ends()

    def _report(self, kind: str) -> None:
        if self._session is not None:
            self._session.voiced(kind, self._text)
