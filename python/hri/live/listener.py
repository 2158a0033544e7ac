# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Live recognition of the words in an audio stream."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Collection, Iterator
from contextlib import closing
from dataclasses import replace

import numpy as np

from hri.core.errors import InvalidArgument
from hri.live import events
from hri.live.attention import COMMAND, WAKE, Attention, AttentionTracker, with_threshold
from hri.live.events import Event, decision_fields
from hri.live.sources import AudioSource
from hri.live.utterances import Samples, UtteranceFinder
from hri.recognition import CommandRecognizer, WordRecognizer
from hri.recognition.decision import RECOGNISED, UNKNOWN, Decision
from hri.signal import EndpointerOptions

NEAR = 0.5
"""By how much an urgent word may miss the threshold and still be near: in log odds, as scores of words are."""


class Listener:
    """Recognises every utterance of a stream.

    Parameters
    ----------
    recognizer : WordRecognizer or CommandRecognizer
        Trained or loaded.
    options : EndpointerOptions, optional
        When an utterance begins and ends. By default its `activity` is the recogniser's own, and commands of several
        words end with a longer pause.
    attention : Attention, optional
        Which utterances are commands: by default every one, with the model's own threshold.
    level_interval_s : float
        Interval between level events.
    locale : str
        Language of the vocabulary, such as "hi" or "en"; passed on with decisions.
    model_id : str
        Which model decided; passed on with decisions.
    urgent : collection of str
        Labels that are decided on before an utterance has ended. Of a `WordRecognizer` these count at the first pause
        (`EndpointerOptions.pause_ms`; with 0 there is none) at which what was said so far is one of them, and is
        `sure`; the decision on one that was rejected by at most `NEAR` names it in its field `near`, for those to whom
        missing it is worse. Commands of several words end with a long pause; labels of a `CommandRecognizer` given here
        count at one as short as behind a single word, and by themselves at the first pause, too, and need no more than
        `CommandRecognizer.recognise_early` and `attention` ask for. What else is said until the end is then not decided
        on.
    sure : callable of Decision, optional
        Which decisions of a `WordRecognizer` on urgent words count at a pause: by default all that are recognised.

    Raises
    ------
    InvalidArgument
        For a wake word outside the vocabulary, and for words that are always commands, other than the default of
        `Attention` (lists the vocabulary).
    """

    def __init__(
        self,
        recognizer: WordRecognizer | CommandRecognizer,
        options: EndpointerOptions | None = None,
        *,
        attention: Attention | None = None,
        level_interval_s: float = 0.1,
        locale: str = "",
        model_id: str = "",
        urgent: Collection[str] = (),
        sure: Callable[[Decision], bool] | None = None,
    ) -> None:
        self._attention = attention or Attention()
        wake, labels = self._attention.wake, [str(label) for label in recognizer.classes_]
        if wake and wake not in labels:
            raise InvalidArgument(f"wake word '{wake}' is not in the vocabulary: {', '.join(labels)}")
        always = self._attention.always
        if wake and always != Attention.always:  # few vocabularies have the default's
            for word in always:
                if word not in labels:
                    raise InvalidArgument(f"'{word}', always a command, is not in the vocabulary: {', '.join(labels)}")
        if isinstance(urgent, str):
            raise InvalidArgument(f"urgent must be a collection of labels, got {urgent!r}")
        self._recognizer = recognizer
        self._urgent = frozenset(urgent).intersection(labels)
        self._sure = sure
        endpointer = options or endpointer_of(recognizer)
        pauses = None
        if self._urgent and isinstance(recognizer, CommandRecognizer):
            short = EndpointerOptions(activity=recognizer.endpointer.activity)
            pauses = short if short.hangover_ms < endpointer.hangover_ms else None
        self._finder = UtteranceFinder(endpointer, level_interval_s, pauses)
        self._locale = locale
        self._model_id = model_id
        self._is_warm = False

    def listen(self, source: AudioSource) -> Iterator[Event]:
        """Events until the source ends; it is closed then, and also when the caller stops early.

        Raises
        ------
        Stalled
            When the source gives no more samples, after an event that says so.
        """
        tracker = AttentionTracker(self._attention)
        early: Event | None = None
        begun_s = math.inf
        with closing(self._finder.process(source, model=self._model_id)) as results:
            for event, said in results:
                if said is None:
                    if event.event == events.SPEECH_START:
                        begun_s = event.fields["first_s"]
                        self._warm_up()
                    elif event.event == events.SPEECH_DROPPED:
                        begun_s = math.inf
                    yield event
                    continue
                known = early if early is not None and _overlap(event, early) else None
                if event.event == events.PAUSE:
                    decide = self._decide_early
                    decided = None if known else decide(event, said, source.sample_rate_hz, tracker, begun_s)
                    if decided is not None:
                        early = decided
                        yield decided
                    continue
                begun_s = math.inf
                if known is not None:
                    yield self._with_whole(event, said, source.sample_rate_hz, known)
                else:
                    yield event
                    yield self._decide(event, said, source.sample_rate_hz, tracker)

    def _warm_up(self) -> None:
        """Recognise a buzz while the first word is being said.

        The first recognition takes three times as long as others, as nothing of the models is in memory's caches yet.
        """
        if not self._is_warm:
            self._is_warm = True
            self._recognizer.recognise(*_buzz())

    def _decide_early(
        self, event: Event, said: Samples, rate: int, tracker: AttentionTracker, begun_s: float
    ) -> Event | None:
        """The decision on what has been said of an utterance that began at `begun_s`, where that is urgent."""
        if not self._urgent:
            return None
        begun = time.perf_counter()
        decided: Decision | None
        if isinstance(self._recognizer, CommandRecognizer):
            decided = self._recognizer.recognise_early(said, self._urgent, rate)
        else:
            decided = self._recognizer.recognise(said, rate)
        if decided is None:
            return None
        decision = with_threshold(decided, self._attention.min_score)
        if decision.status != RECOGNISED or decision.label not in self._urgent:
            return None
        if self._sure is not None and isinstance(self._recognizer, WordRecognizer) and not self._sure(decision):
            return None
        # Of commands a part may have been said: whether it counts depends on when the utterance began, as at its end.
        if not tracker.judge_early(min(begun_s, event.fields["first_s"]), event.fields["last_s"], decision):
            return None
        compute_ms = 1000 * (time.perf_counter() - begun)
        fields = event.fields | decision_fields(decision, self._locale, self._model_id)
        return Event(event.time, events.DECISION, fields | {"compute_ms": round(compute_ms, 3)}, decision)

    def _with_whole(self, event: Event, utterance: Samples, rate: int, early: Event) -> Event:
        """The end of an utterance that was decided on early, with what the whole of it is, where that differs."""
        if isinstance(self._recognizer, CommandRecognizer):  # what was urgent is one of several words
            return event
        label = self._recognizer.recognise(utterance, rate).label
        return event if label == early.fields["final"] else replace(event, fields=event.fields | {"whole": label})

    def _decide(self, event: Event, utterance: Samples, rate: int, tracker: AttentionTracker) -> Event:
        # With the noise around it: the recogniser finds the end points as it did in training.
        begun = time.perf_counter()
        decision = self._recognizer.recognise(utterance, rate)
        if decision.status == UNKNOWN and self._urgent and isinstance(self._recognizer, CommandRecognizer):
            decision = self._recognizer.recognise_early(utterance, self._urgent, rate) or decision
        compute_ms = 1000 * (time.perf_counter() - begun)
        fields = {name: event.fields[name] for name in ("first_s", "last_s")}
        meant, decision = tracker.judge(fields["first_s"], fields["last_s"], decision)
        fields |= decision_fields(decision, self._locale, self._model_id) | {"compute_ms": round(compute_ms, 3)}
        if self._is_near(decision):
            fields["near"] = decision.nbest[0].label
        if meant == COMMAND:
            return Event(event.time, events.DECISION, fields, decision)
        # Without a decision, so that callers who act on decisions do not act on these.
        return Event(event.time, events.WAKE if meant == WAKE else events.IGNORED, fields | {"final": ""})

    def _is_near(self, decision: Decision) -> bool:
        """Whether an urgent word was rejected by little; never without held-out words, which make scores log odds."""
        words, min_score = self._recognizer, self._attention.min_score
        if decision.status != UNKNOWN or not decision.nbest:
            return False
        if not isinstance(words, WordRecognizer) or words.held_out is None:
            return False
        threshold = words.threshold if min_score is None else min_score
        return decision.nbest[0].label in self._urgent and decision.score >= threshold - NEAR


def _buzz() -> tuple[Samples, int]:
    """What sounds like a voice: 0.6 s of pulses at 120 Hz in a quiet second, and its rate."""
    rate_hz = 16000
    times_s = np.arange(int(0.6 * rate_hz)) / rate_hz
    samples = 1e-4 * np.random.default_rng(0).standard_normal(rate_hz + len(times_s) // 3).astype(np.float32)
    voice = 0.1 * np.hanning(len(times_s)) * np.sign(np.sin(2 * np.pi * 120 * times_s))
    samples[rate_hz // 4 : rate_hz // 4 + len(voice)] += voice.astype(np.float32)
    return samples, rate_hz


def _overlap(event: Event, early: Event) -> bool:
    one, other = event.fields, early.fields
    return bool(one["first_s"] < other["last_s"] and other["first_s"] < one["last_s"])


def endpointer_of(recognizer: WordRecognizer | CommandRecognizer) -> EndpointerOptions:
    """When an utterance begins and ends, unless a caller says it."""
    if isinstance(recognizer, CommandRecognizer):
        return recognizer.endpointer
    return EndpointerOptions(activity=recognizer.options.activity)
