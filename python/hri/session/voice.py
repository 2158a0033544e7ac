# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The robot's voice: texts are said one after the other, and when each is being said is known."""

from __future__ import annotations

import re
import threading
from collections import deque
from collections.abc import Callable, Collection
from dataclasses import dataclass

from hri.core.errors import InvalidArgument
from hri.recognition.decision import RECOGNISED, Decision
from hri.session.feeds import what_failed

VOICE_START = "voice_start"
VOICE_END = "voice_end"
TAIL_S = 0.5
"""How long after its end the robot's voice may still be heard: echoes of a room, and sound on its way from a device."""
_MOST_WAITING = 8
_MOST_KEPT = 32
_CLOSE_S = 2.0
_WORDS = re.compile(r"\w+")

OnVoice = Callable[[str, str, str], None]


class Voice:
    """Says texts in a thread of its own.

    Parameters
    ----------
    speak : callable of str
        Says a text and returns when it has been said. What it raises is reported, and the next text is said.
    """

    def __init__(self, speak: Callable[[str], None]) -> None:
        self._speak = speak
        self._waiting: deque[str] = deque(maxlen=_MOST_WAITING)
        self._listener: OnVoice | None = None
        self._ready = threading.Condition()
        self._closed = False
        self._thread = threading.Thread(target=self._run, daemon=True, name="hri-voice")
        self._thread.start()

    def say(self, text: str) -> None:
        """Begin to say a text as soon as those before it are said; returns at once. Of more than 8 the oldest go."""
        with self._ready:
            self._waiting.append(text)
            self._ready.notify_all()

    def attach(self, listener: OnVoice) -> None:
        """Report to one listener: "voice_start" or "voice_end", the text, and why it was not said ("" if it was).

        Raises InvalidArgument while there is another one.
        """
        with self._ready:
            if self._listener is not None:
                raise InvalidArgument("the voice is in use: another session speaks by it")
            self._listener = listener

    def detach(self) -> None:
        """Report no more."""
        with self._ready:
            self._listener = None

    def close(self) -> None:
        """Say nothing more; what is being said is waited for, though not for long."""
        with self._ready:
            self._closed = True
            self._waiting.clear()
            self._ready.notify_all()
        self._thread.join(_CLOSE_S)

    def _run(self) -> None:
        while True:
            with self._ready:
                self._ready.wait_for(lambda: self._waiting or self._closed)
                if self._closed:
                    return
                text = self._waiting.popleft()
            self._report(VOICE_START, text, "")
            failed = ""
            try:
                self._speak(text)
            except Exception as error:  # a voice of the caller's own may raise anything; the session goes on
                failed = what_failed(error)
            self._report(VOICE_END, text, failed)

    def _report(self, kind: str, text: str, message: str) -> None:
        with self._ready:
            listener = self._listener
        if listener is not None:
            listener(kind, text, message)


@dataclass
class _Saying:
    text: str
    begin_s: float
    end_s: float


class OwnVoice:
    """What of the words that are heard may be the robot's own; without clocks and threads.

    While it speaks, and for `TAIL_S` after, nothing spoken counts but STOP: the robot's voice, misrecognised, may be
    any word. STOP counts unless the robot says that label itself while nothing moves that could be stopped.
    """

    def __init__(self) -> None:
        self._sayings: deque[_Saying] = deque(maxlen=_MOST_KEPT)

    def begin(self, text: str, time_s: float) -> None:
        """The robot begins to say a text."""
        self._sayings.append(_Saying(text, time_s, float("inf")))

    def end(self, time_s: float) -> None:
        """It has said it."""
        for saying in self._sayings:
            saying.end_s = min(saying.end_s, time_s + TAIL_S)

    def may_be(
        self, decision: Decision, first_s: float, last_s: float, stop_labels: Collection[str], moving: bool
    ) -> bool:
        """Whether a word of this time may be the robot's own, and does not count."""
        texts = [one.text for one in self._sayings if first_s < one.end_s and one.begin_s < last_s]
        if not texts:
            return False
        if decision.status != RECOGNISED or decision.label not in stop_labels:
            return True
        said = {word for text in texts for word in _WORDS.findall(text.casefold())}
        return not moving and said.issuperset(_WORDS.findall(decision.label.casefold()))
