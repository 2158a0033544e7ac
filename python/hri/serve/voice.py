# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What the page's microphone hears while the robot speaks: nothing of it is a command, but STOP may be."""

from __future__ import annotations

import queue
import threading
import time
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import Error
from hri.media import Audio
from hri.recognition import CommandRecognizer, WordRecognizer
from hri.recognition.decision import RECOGNISED
from hri.serve.stage import Stage
from hri.signal import ActivityOptions, Endpointer, EndpointerOptions

_MOST_WAITING = 4


class RobotVoice:
    """Keeps the robot's own voice, spoken by the page, from the recogniser of words.

    While it speaks the session hears silence. Sound is tried for STOP alone then, unless the robot names STOP itself,
    as in "Did you mean stop?".

    Parameters
    ----------
    stage : Stage
    clock : callable
        Gives seconds that never fall.
    """

    def __init__(self, stage: Stage, clock: Callable[[], float] = time.monotonic) -> None:
        self._stage = stage
        self._clock = clock
        self._until_s = 0.0
        self._ear: _StopEar | None = None

    def speaks(self, text: str) -> None:
        """The page begins to say something."""
        self._until_s = self._clock() + self._stage.limits.voice_s
        stops = self._stage.session.options.fusion.stop_labels
        named = any(label.casefold() in text.casefold() for label in stops)
        self._end_ear()
        if not named and self._stage.words is not None:
            self._ear = _StopEar(self._stage, self._stage.words)

    def ends(self) -> None:
        """It has ended, or the page is gone."""
        self._until_s = 0.0
        self._end_ear()

    def filtered(self, samples: NDArray[np.float32]) -> NDArray[np.float32]:
        """What the session is to hear of the page's sound."""
        if self._until_s == 0.0:
            return samples
        if self._clock() > self._until_s:  # the page did not say that it has ended
            self.ends()
            return samples
        if self._ear is not None:
            self._ear.hear(samples)
        return np.zeros_like(samples)

    def _end_ear(self) -> None:
        if self._ear is not None:
            self._ear.close()
            self._ear = None


class _StopEar:
    """Stops the robot at a sure STOP; recognises in a thread of its own, as the server's must not wait."""

    def __init__(self, stage: Stage, words: WordRecognizer | CommandRecognizer) -> None:
        self._stage = stage
        self._words = words
        self._rate_hz = stage.microphone.sample_rate_hz
        activity: ActivityOptions = (
            words.words.options.words.activity if isinstance(words, CommandRecognizer) else words.options.activity
        )
        self._endpointer = Endpointer(self._rate_hz, EndpointerOptions(activity=activity))
        self._parts: list[NDArray[np.float32]] = []
        self._clips: queue.Queue[NDArray[np.float32] | None] = queue.Queue(_MOST_WAITING)
        threading.Thread(target=self._recognise, daemon=True, name="hri-stop-ear").start()

    def hear(self, samples: NDArray[np.float32]) -> None:
        """Sound as it comes; bounded by the time that the robot may speak."""
        self._parts.append(samples)
        for end in self._endpointer.push(samples):
            if end.kind == "speech_end" and not self._clips.full():
                heard = np.concatenate(self._parts)
                self._clips.put_nowait(heard[max(0, end.segment_first) : end.segment_last])

    def close(self) -> None:
        """What has been said is still decided on."""
        threading.Thread(target=self._clips.put, args=(None,), daemon=True).start()

    def _recognise(self) -> None:
        options = self._stage.session.options.fusion
        while (clip := self._clips.get()) is not None:
            try:
                decision = self._words.recognise(Audio(clip, self._rate_hz))
            except Error:  # a sound too short for a word
                continue
            least = decision.class_threshold if options.stop_threshold is None else options.stop_threshold
            sure = decision.status == RECOGNISED and decision.confidence >= least
            if sure and decision.label in options.stop_labels:
                self._stage.stop()
