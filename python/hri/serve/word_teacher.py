# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Words that a person adds at the page: while one is recorded, only STOP is a command."""

from __future__ import annotations

import copy
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.media import Audio
from hri.serve.stage import Stage
from hri.serve.teacher import NUM_SAMPLES, Teacher
from hri.signal import Endpointer, EndpointerOptions

LONGEST_S = 5.0
PAUSE_S = 1.0
"""By which the last sound of a sample may come late."""
_NOTHING = "I heard nothing: press Record once more."


class WordTeacher(Teacher):
    """Adds words to the recogniser of a stage.

    Parameters
    ----------
    stage : Stage
    """

    mode = "speech"
    noun = "word"

    def __init__(self, stage: Stage) -> None:
        super().__init__(stage)
        self._parts: list[NDArray[np.float32]] | None = None
        self._num_heard = 0
        self._endpointer: Endpointer | None = None

    def forget(self) -> None:
        """The page is gone, or another word begins: samples of a word that is not added yet are dropped."""
        super().forget()
        self._end_sample()

    def hear(self, samples: NDArray[np.float32], sample_rate_hz: int) -> None:
        """Sound of the page, by the server's thread."""
        parts = self._parts
        if parts is None or self._endpointer is None:
            return
        parts.append(samples)
        self._num_heard += len(samples)
        ends = [end for end in self._endpointer.push(samples) if end.kind == "speech_end"]
        if not ends and self._num_heard < LONGEST_S * sample_rate_hz:
            return
        if not self._end_sample():  # by STOP, meanwhile
            return
        heard = np.concatenate(parts)
        if ends:
            clip = Audio(heard[max(0, ends[0].segment_first) : ends[0].segment_last].copy(), sample_rate_hz)
            self._in_background(lambda: self._keep(clip))
        else:
            self._answer(_NOTHING)

    def _labels(self) -> list[str] | None:
        return None if self._stage.spoken is None else [str(label) for label in self._stage.spoken.classes_]

    def _prompt(self, label: str) -> str:
        return f"Say “{label}” after you press Record, {NUM_SAMPLES} times."

    def _sample(self) -> None:
        if self._parts is None:
            assert self._stage.spoken is not None
            options = EndpointerOptions(activity=self._stage.spoken.options.activity)
            self._endpointer = Endpointer(self._stage.microphone.sample_rate_hz, options)
            self._stage.only_stop(LONGEST_S + PAUSE_S)
            self._parts, self._num_heard = [], 0
            self._answer("Speak now.", recording=True)

    def _end_sample(self) -> bool:
        parts, self._parts = self._parts, None
        if parts is not None:
            self._stage.only_stop(0.0)
        return parts is not None

    def _keep(self, clip: Audio) -> None:
        assert self._stage.spoken is not None
        decision = self._stage.spoken.recognise(clip)
        if decision.status == "no_input":
            self._answer(_NOTHING)
            return
        if self._is_stop(decision):
            return
        self._keep_sample(clip, decision, f" It sounds like “{decision.label}”: another word may be safer.")

    def _best_of(self, sample: Audio, added: dict[str, list[Audio]]) -> str:
        words = copy.copy(self._stage.spoken)
        assert words is not None
        for label in (*self._added, self._full):
            words.remove_word(label)
        for label, samples in added.items():
            words.add_word(label, samples)
        return str(words.recognise(sample).nbest[0].label)

    def _add(self, label: str, samples: list[Any]) -> None:
        assert self._stage.spoken is not None
        self._stage.spoken.add_word(label, samples)

    def _remove(self, label: str) -> None:
        assert self._stage.spoken is not None
        self._stage.spoken.remove_word(label)
