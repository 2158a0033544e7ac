# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The robot's voice: texts are said one after the other, when each is being said is known, and none names STOP."""

from __future__ import annotations

import math
import threading
import unicodedata
from collections import deque
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass

from hri.core.errors import InvalidArgument
from hri.core.phrases import LANGUAGES, Phrase, in_language, phrase
from hri.recognition.decision import Decision
from hri.session.feeds import what_failed

VOICE_START = "voice_start"
VOICE_END = "voice_end"
TAIL_S = 0.5
"""How long after its end the robot's voice may still be heard: echoes of a room, and sound on its way from a device."""
_MOST_WAITING = 8
_MOST_KEPT = 32
_CLOSE_S = 2.0

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
    any word. STOP has to be sure where nothing moves that could be stopped, and does not count there if the text being
    said has it (`aloud` gives texts that have not).
    """

    def __init__(self) -> None:
        self._sayings: deque[_Saying] = deque(maxlen=_MOST_KEPT)

    def begin(self, text: str, time_s: float) -> None:
        """The robot begins to say a text."""
        self._sayings.append(_Saying(text, time_s, float("inf")))

    def end(self, text: str, time_s: float) -> None:
        """It has said it; where it is being said twice, by two voices, the one that began first has."""
        for saying in self._sayings:
            if saying.text == text and math.isinf(saying.end_s):
                saying.end_s = time_s + TAIL_S
                return

    def may_be(self, decision: Decision, first_s: float, last_s: float, stops: bool, moving: bool) -> bool:
        """Whether a word of this time may be the robot's own, and does not count; `stops`: it is STOP, sure enough."""
        texts = [one.text for one in self._sayings if first_s < one.end_s and one.begin_s < last_s]
        if not texts:
            return False
        return not stops or (not moving and any(_names(text, decision.label) for text in texts))


def aloud(text: str, stop_labels: Collection[str]) -> str:
    """What a voice says of a text where a microphone may take its words for a person's.

    Parameters
    ----------
    text : str
        A `Phrase` is looked at in every language.
    stop_labels : collection of str
        Which none of the words said is: a question about STOP is asked in other words, and of another text is said that
        it is there to read.
    """
    tried = [text]
    if isinstance(text, Phrase) and text.code == "did_you_mean":
        others = tuple(label for label in text.values["labels"] if label not in stop_labels)
        tried.append(phrase("or_freeze", labels=others) if others else phrase("shall_i_freeze"))
    tried.append(phrase("read_it"))
    return next((one for one in tried if not any(_names(one, label) for label in stop_labels)), "")


def _names(text: str, label: str) -> bool:
    """Whether a text has all words of a label, in any language."""
    said = [str(text)]
    if isinstance(text, Phrase) and text.code:
        said += [in_language(text.code, language, text.values) for language in LANGUAGES]
        said += [str(one) for value in text.values.values() if isinstance(value, Mapping) for one in value.values()]
    words = {word for one in said for word in _words(one)}
    named = _words(label)
    return bool(named) and words.issuperset(named)


def _words(text: str) -> list[str]:
    """Letters with their marks, as the vowel signs of Hindi are, and numbers; in one case and form."""
    one_form = unicodedata.normalize("NFC", text.casefold())
    return "".join(c if unicodedata.category(c)[0] in "LMN" else " " for c in one_form).split()
