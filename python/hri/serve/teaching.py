# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Words that a person adds at the page: three samples, heard by nothing else, and an undo."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import Error
from hri.robot import load_gestures
from hri.serve.stage import Stage
from hri.signal import Endpointer, EndpointerOptions

NUM_SAMPLES = 3
LONGEST_S = 5.0


class Teacher:
    """Adds words to the recogniser of a stage.

    Parameters
    ----------
    stage : Stage
    """

    def __init__(self, stage: Stage) -> None:
        self._stage = stage
        self._label = ""
        self._clips: list[NDArray[np.float32]] = []
        self._rate_hz = 16000
        self._parts: list[NDArray[np.float32]] | None = None
        self._num_heard = 0
        self._endpointer: Endpointer | None = None
        self._added: list[str] = []
        self._busy = threading.Lock()

    def obey(self, command: dict[str, Any]) -> None:
        """A command of the page: "teach" a label, take a "sample", or "undo"; answers are published."""
        if self._stage.words is None:
            self._answer("there is no recogniser of words", label="")
        elif self._busy.locked():
            self._answer("wait until the last word is added", self._label)
        elif command["type"] == "teach":
            self._begin(command["label"])
        elif command["type"] == "sample":
            self._sample()
        elif command["type"] == "undo":
            self._in_background(self._undo)

    def forget(self) -> None:
        """The page is gone: the samples of a word that is not added yet are dropped."""
        self._label, self._clips, self._parts = "", [], None

    def hear(self, samples: NDArray[np.float32], sample_rate_hz: int) -> bool:
        """Sound of the page; False where it is part of a sample, which is no command."""
        if self._parts is None or self._endpointer is None:
            return True
        self._rate_hz = sample_rate_hz
        self._parts.append(samples)
        self._num_heard += len(samples)
        ends = [end for end in self._endpointer.push(samples) if end.kind == "speech_end"]
        if not ends and self._num_heard < LONGEST_S * sample_rate_hz:
            return False
        heard, self._parts = np.concatenate(self._parts), None
        if ends:
            clip = heard[max(0, ends[0].segment_first) : ends[0].segment_last].copy()
            self._in_background(lambda: self._keep(clip))
        else:
            self._answer("I heard nothing: press Record once more.", self._label)
        return False

    def _begin(self, label: str) -> None:
        assert self._stage.words is not None
        self._clips, self._parts, self._label = [], None, ""
        if label in [str(known) for known in self._stage.words.classes_]:
            self._answer(f"“{label}” is a word already", label)
            return
        self._label = label
        self._answer(f"Say “{label}” after you press Record, {NUM_SAMPLES} times.", label)

    def _sample(self) -> None:
        if not self._label:
            self._answer("first give the word a name", "")
        elif self._parts is None:
            assert self._stage.words is not None
            options = EndpointerOptions(activity=self._stage.words.options.activity)
            self._endpointer = Endpointer(self._stage.microphone.sample_rate_hz, options)
            self._parts, self._num_heard = [], 0
            self._answer("Speak now.", self._label, recording=True)

    def _keep(self, clip: NDArray[np.float32]) -> None:
        words = self._stage.words
        assert words is not None
        decision = words.recognise(clip, self._rate_hz)
        if decision.status == "no_input":
            self._answer("I heard nothing: press Record once more.", self._label)
            return
        self._clips.append(clip)
        known = (
            f" It sounds like “{decision.label}”: another word may be safer." if decision.status == "recognised" else ""
        )
        if len(self._clips) < NUM_SAMPLES:
            self._answer(f"Sample {len(self._clips)} of {NUM_SAMPLES}.{known}", self._label)
            return
        label, clips = self._label, self._clips
        self._label, self._clips = "", []
        words.add_word(label, clips, self._rate_hz)
        self._added.append(label)
        self._renew()
        moves = label in self._stage.session.motions
        does = "" if moves or label not in load_gestures() else " The robot cannot make its motion."
        self._answer(f"“{label}” is added.{known}{does}", "", added=self._added)

    def _undo(self) -> None:
        if not self._added:
            self._answer("there is nothing to undo", "")
            return
        assert self._stage.words is not None
        label = self._added.pop()
        self._stage.words.remove_word(label)
        self._renew()
        self._answer(f"“{label}” is removed.", "", added=self._added)

    def _renew(self) -> None:
        self._stage.renew()

    def _in_background(self, work: Callable[[], None]) -> None:
        def run() -> None:
            with self._busy:
                try:
                    work()
                except Error as error:
                    self._answer(f"That did not work: {error}", self._label)

        threading.Thread(target=run, daemon=True, name="hri-teach").start()

    def _answer(self, text: str, label: str, recording: bool = False, added: list[str] | None = None) -> None:
        message: dict[str, Any] = {"type": "teach", "text": text, "label": label, "recording": recording}
        message["samples"] = len(self._clips)
        if added is not None:
            message["added"] = list(added)
        self._stage.publish(message)
