# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Words that a person adds at the page: while one is recorded, only STOP is a command."""

from __future__ import annotations

import copy
from abc import abstractmethod
from collections import Counter
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.core.phrases import phrase
from hri.media import Audio
from hri.recognition import Decision, WordRecognizer
from hri.recognition.decision import NO_INPUT, RECOGNISED
from hri.serve.stage import Stage
from hri.serve.teacher import NUM_SAMPLES, Teacher
from hri.signal import ActivityOptions, Endpointer, EndpointerOptions

LONGEST_S = 5.0
PAUSE_S = 1.0
"""By which the last sound of a sample may come late."""
_NOTHING = phrase("heard_nothing")


class SpokenTeacher(Teacher):
    """Takes samples of words by the microphone of the page.

    Parameters
    ----------
    stage : Stage
    """

    mode = "speech"
    noun = phrase("word")
    alike_code = "sample_sounds_like"

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

    def _prompt(self, label: str) -> str:
        return phrase("say_after_record", label=label, most=NUM_SAMPLES)

    def _sample(self) -> None:
        if self._parts is None:
            options = EndpointerOptions(activity=self._activity())
            self._endpointer = Endpointer(self._stage.microphone.sample_rate_hz, options)
            self._stage.only_stop(LONGEST_S + PAUSE_S)
            self._parts, self._num_heard = [], 0
            self._answer(phrase("speak_now"), recording=True)

    @property
    def _is_recording(self) -> bool:
        return self._parts is not None

    def _end_sample(self) -> bool:
        parts, self._parts = self._parts, None
        if parts is not None:
            self._stage.only_stop(0.0)
        return parts is not None

    def _keep(self, clip: Audio) -> None:
        decision = self._decide(clip)
        if decision.status == NO_INPUT:
            self._answer(_NOTHING)
        elif not self._is_stop(decision):
            self._keep_clip(clip, decision)

    @abstractmethod
    def _activity(self) -> ActivityOptions:
        """How the recogniser finds speech."""

    @abstractmethod
    def _decide(self, clip: Audio) -> Decision:
        """What the recogniser takes a sample for, which may be STOP."""

    @abstractmethod
    def _keep_clip(self, clip: Audio, decision: Decision) -> None:
        """Keep a sample."""


class WordTeacher(SpokenTeacher):
    """Adds words to the `WordRecognizer` of a stage.

    Parameters
    ----------
    stage : Stage
    """

    @property
    def _words(self) -> WordRecognizer:
        assert self._stage.spoken is not None
        return self._stage.spoken

    def _labels(self) -> list[str] | None:
        return None if self._stage.spoken is None else [str(label) for label in self._words.classes_]

    def _activity(self) -> ActivityOptions:
        return self._words.options.activity

    def _decide(self, clip: Audio) -> Decision:
        return self._words.recognise(clip)

    def _keep_clip(self, clip: Audio, decision: Decision) -> None:
        if decision.status == RECOGNISED:
            self._keep_sample(clip, decision.label)
        else:
            self._keep_sample(clip)

    def _mistaken(self, label: str, samples: list[Any]) -> Counter[str]:
        return self._mistaken_by(self._best_of, label, samples)

    def _best_of(self, sample: Audio, added: dict[str, list[Audio]]) -> str:
        words = copy.copy(self._words)
        for label in (*self._added, self._full):
            words.remove_word(label)
        for label, samples in added.items():
            words.add_word(label, samples)
        return str(words.recognise(sample).nbest[0].label)

    def _add(self, label: str, samples: list[Any]) -> None:
        self._words.add_word(label, samples)

    def _remove(self, label: str) -> None:
        self._words.remove_word(label)
