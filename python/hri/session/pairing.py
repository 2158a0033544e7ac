# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Which word and which sign belong together; by the times of the streams alone, without clocks and threads."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field, replace

from hri.core.errors import InvalidArgument
from hri.core.phrases import phrase
from hri.fusion import FusedDecision, LearnedFusion, fuse
from hri.recognition.decision import NO_INPUT, RECOGNISED, UNKNOWN, Decision
from hri.session.options import SessionOptions

MODES = ("speech", "gesture")
CHANCE = 0.5
"""A stop label below this confidence is unsure, even where training set no threshold: more likely wrong than right."""
_TAKE_AWAY_S = 1.5
"""A hand that has begun to move, and is in view for longer, is not being taken away."""
_OTHER = {"speech": "gesture", "gesture": "speech"}


@dataclass(frozen=True)
class Observation:
    """A word or a sign that was decided on.

    Attributes
    ----------
    decision : Decision
        Its mode is the mode of the observation.
    first_s, last_s : float
        When it was said or shown, in the session's time.
    near : str
        The label that was rejected by little, if it is an urgent one, see `hri.live.Listener`.
    compute_ms : float
        What recognising it took.
    gone_s : float
        Of a sign that was held, and then taken away: when the hand was gone.
    """

    decision: Decision
    first_s: float
    last_s: float
    near: str = ""
    compute_ms: float = 0.0
    gone_s: float = -math.inf

    def __post_init__(self) -> None:
        if not (math.isfinite(self.first_s) and self.first_s <= self.last_s < math.inf):
            raise InvalidArgument(f"a word or sign from {self.first_s} to {self.last_s} s: times must not fall")

    @property
    def mode(self) -> str:
        """The mode, "speech" or "gesture"."""
        return self.decision.mode

    @property
    def end_s(self) -> float:
        """Until when it goes on: a sign is decided on while it is held, and shown until it is taken away."""
        return max(self.last_s, self.gone_s)


@dataclass(frozen=True)
class Pair:
    """What was decided on together, or alone.

    Attributes
    ----------
    fused : FusedDecision
        Its `speech` and `gesture` are what was paired; None for the mode that was not there.
    first_s, last_s : float
        From the beginning of the first to the end of the last.
    apart_s : float
        Between the end of one and the beginning of the other; 0 where they overlap, and for one alone.
    why : str
        Why they were paired, or why one was not waited for any longer.
    taken_back : bool
        One of `SessionOptions.no_labels` followed while it waited.
    compute_ms : float
        What recognising both took.
    """

    fused: FusedDecision
    first_s: float
    last_s: float
    apart_s: float
    why: str
    taken_back: bool = False
    compute_ms: float = 0.0

    @property
    def carried_by(self) -> str:
        """The mode whose best class is the decision: "speech", "gesture", "both", or "" for neither."""
        modes = (self.fused.speech, self.fused.gesture)
        carriers = [d.mode for d in modes if d is not None and d.nbest and d.nbest[0].label == self.fused.label]
        return "both" if len(carriers) == 2 else "".join(carriers)


@dataclass
class _Stream:
    """What is known of one mode."""

    present: bool = False
    now_s: float = -math.inf
    begun_s: float | None = None
    waiting: list[Observation] = field(default_factory=list)


class Pairer:
    """Pairs the words and the signs of two streams.

    Times are the session's; those of one mode never fall, and neither mode has to wait for the other. A word and a
    sign belong together when at most `SessionOptions.window_s` lies between them; of several the nearest. What stays
    alone is decided on as soon as nothing that belongs to it can come any more: at once where the other mode has no
    source. A sign that is held ends when it is taken away, if that begins within the window after it was recognised.

    Where a learned fusion is given it decides in place of `SessionOptions.rule`.

    A sure STOP and labels that lead the dialogue wait for nothing; what was said before such a label, or shown before
    such a sign, comes before it, and waits no longer. An unsure STOP while the robot moves waits for what
    has begun in the other mode, and never for what may come. While it moves a STOP that was rejected by little counts,
    too: to halt for another word costs less than to go on.
    """

    def __init__(self, options: SessionOptions | None = None, fusion: LearnedFusion | None = None) -> None:
        self._options = options or SessionOptions()
        self._fusion = fusion
        self._streams = {mode: _Stream() for mode in MODES}
        self._now_s = 0.0
        self.hurried = False
        """Set while the robot moves."""

    @property
    def waiting(self) -> int:
        """How many words and signs wait."""
        return sum(len(stream.waiting) for stream in self._streams.values())

    @property
    def active(self) -> bool:
        """Whether something is being said or shown, or waits."""
        return self.waiting > 0 or any(stream.begun_s is not None for stream in self._streams.values())

    def join(self, mode: str, time_s: float) -> None:
        """A source of this mode begins, or is back."""
        self._streams[mode].present = True
        self._pass(mode, time_s)

    def leave(self, mode: str, time_s: float) -> list[Pair]:
        """The source of this mode has ended or vanished: it is waited for no longer."""
        self._pass(mode, time_s)
        self._streams[mode].present, self._streams[mode].begun_s = False, None
        return list(self._resolve())

    def begin(self, mode: str, first_s: float, time_s: float) -> None:
        """A word or sign has begun; it ends with `observe` or `drop`."""
        self._pass(mode, time_s)
        stream = self._streams[mode]
        stream.begun_s = first_s if stream.begun_s is None else min(first_s, stream.begun_s)

    def drop(self, mode: str, time_s: float, gone_s: float = -math.inf) -> list[Pair]:
        """What had begun was no word or sign; where it was a hand that was taken away, since when that is gone."""
        self._pass(mode, time_s)
        stream = self._streams[mode]
        if stream.waiting and self._may_be_taken_away(stream.waiting[-1]):
            stream.waiting[-1] = replace(stream.waiting[-1], gone_s=gone_s)
        stream.begun_s = None
        return list(self._resolve())

    def tick(self, mode: str, time_s: float) -> list[Pair]:
        """The stream of this mode has come to this time."""
        self._pass(mode, time_s)
        return list(self._resolve())

    def passed(self, time_s: float) -> list[Pair]:
        """The session has come to this time, whether or not either stream has."""
        self._now_s = max(self._now_s, time_s)
        return list(self._resolve())

    def is_stop_label(self, label: str) -> bool:
        """Whether a label is STOP."""
        return label in self._options.fusion.stop_labels

    def is_stop(self, decision: Decision) -> bool:
        """Whether a decision is STOP, sure or not."""
        return decision.status == RECOGNISED and self.is_stop_label(decision.label)

    def is_sure_stop(self, decision: Decision) -> bool:
        """Whether a decision is STOP, and as sure of it as `SessionOptions` ask."""
        threshold = self._options.fusion.stop_threshold
        sure = self._strict(decision).class_threshold if threshold is None else threshold
        return self.is_stop(decision) and decision.confidence >= sure

    def observe(self, observation: Observation, time_s: float) -> list[Pair]:
        """A word or sign was decided on."""
        self._pass(observation.mode, time_s)
        stream = self._streams[observation.mode]
        stream.begun_s = None
        decision, why = observation.decision, "STOP waits for nothing"
        if self.hurried and self.is_stop_label(observation.near):
            decision = replace(decision, label=observation.near, status=RECOGNISED)
            why = "a STOP that was rejected by little counts while the robot moves"
        decision = self._strict(decision)
        observation = replace(observation, decision=decision)
        if self.is_sure_stop(decision):
            return [self._alone(observation, why)]
        if decision.status == RECOGNISED and decision.label in self._options.control_labels:
            return [*self._before(observation), self._alone(observation, "it leads the dialogue")]
        if decision.status == NO_INPUT:  # belongs to nothing, and must not take the place of what does
            return [*self._resolve(), self._alone(observation, "no input")]
        stream.waiting.append(observation)
        return list(self._resolve())

    def clear(self) -> None:
        """Forget what waits, as after STOP and what ends it."""
        for stream in self._streams.values():
            stream.waiting.clear()

    def _before(self, leading: Observation) -> Iterator[Pair]:
        """What waits and came before a label that leads the dialogue, though something may belong to it.

        Without this a command would be heeded after what ends STOP, takes it back, or wakes the robot. "No" also takes
        back what had ended in the other mode before it began.
        """
        yield from self._resolve()
        denies = leading.decision.label in self._options.no_labels
        sentence = leading.decision.label in self._options.sentence_labels
        why = "a sentence begins or ends" if sentence else f"{leading.decision.label} follows it"
        waiting = sorted((o for s in self._streams.values() for o in s.waiting), key=lambda o: (o.last_s, o.mode))
        for one in waiting:
            if one.mode == leading.mode or (denies and one.last_s <= leading.first_s):
                self._streams[one.mode].waiting.remove(one)
                yield replace(self._alone(one, why), taken_back=denies)

    def _pass(self, mode: str, time_s: float) -> None:
        if mode not in self._streams:
            raise InvalidArgument(f"no mode {mode!r}; there are: {', '.join(MODES)}")
        self._streams[mode].now_s = max(self._streams[mode].now_s, time_s)
        self._now_s = max(self._now_s, time_s)

    def _strict(self, decision: Decision) -> Decision:
        stop = decision.label in self._options.fusion.stop_labels
        return replace(decision, class_threshold=max(CHANCE, decision.class_threshold)) if stop else decision

    def _resolve(self) -> Iterator[Pair]:
        while True:
            nearest = self._nearest()
            if nearest is not None and not self._may_come_nearer(*nearest):
                word, sign = nearest
                # What came before these in its mode can belong to nothing that comes after them.
                for mode, partner in (("speech", word), ("gesture", sign)):
                    waiting = self._streams[mode].waiting
                    for earlier in waiting[: waiting.index(partner)]:
                        yield self._alone(earlier, "another one was nearer")
                    del waiting[: waiting.index(partner) + 1]
                yield self._together(word, sign)
                continue
            alone = self._due()
            if alone is None:
                return
            observation, why = alone
            self._streams[observation.mode].waiting.remove(observation)
            yield self._alone(observation, why)

    def _nearest(self) -> tuple[Observation, Observation] | None:
        words, signs = (self._streams[mode].waiting for mode in MODES)
        pairs = [(w, s) for w in words for s in signs if _apart(w, s) <= self._options.window_s]
        # Of those that overlap, the two that began at about the same time.
        return min(pairs, key=lambda p: (_apart(*p), abs(p[0].first_s - p[1].first_s)), default=None)

    def _may_come_nearer(self, word: Observation, sign: Observation) -> bool:
        """Whether what is still being said or shown is nearer to one of the two than they are to each other."""
        apart = _apart(word, sign)
        for one, other in ((word, sign), (sign, word)):
            begun_s = self._streams[other.mode].begun_s
            if begun_s is not None and max(0.0, begun_s - one.end_s) < apart and not self._too_late(one):
                return True
        return False

    def _due(self) -> tuple[Observation, str] | None:
        """The first that need not wait any longer, and why."""
        waiting = sorted((o for s in self._streams.values() for o in s.waiting), key=lambda o: (o.last_s, o.mode))
        for observation in waiting:
            other = self._streams[_OTHER[observation.mode]]
            until_s = observation.end_s + self._options.window_s
            too_late = self._too_late(observation)
            # What it may be paired with waits, too: only until something that is nearer is known, or is none.
            if not too_late and any(_apart(observation, o) <= self._options.window_s for o in other.waiting):
                continue
            if not other.present:
                return observation, phrase("why_no_source", mode=phrase(_OTHER[observation.mode]))
            if too_late:
                return observation, phrase("why_too_late", seconds=f"{self._options.max_wait_s:g}")
            if other.begun_s is not None and other.begun_s <= until_s:
                continue
            hurried = self.hurried and self.is_stop(observation.decision)
            if self._may_be_taken_away(observation) and not hurried:
                continue
            if other.now_s >= until_s + self._options.onset_s:
                return observation, phrase("why_nothing_else", seconds=f"{self._options.window_s:g}")
            if hurried and not other.waiting:
                return observation, phrase("why_hurried")
        return None

    def _may_be_taken_away(self, observation: Observation) -> bool:
        """Whether what goes on in its own mode may be the hand that showed it, on its way out of view."""
        stream = self._streams[observation.mode]
        if observation.mode != "gesture" or stream.begun_s is None or stream.waiting[-1] is not observation:
            return False
        after_s = stream.begun_s - observation.end_s
        in_time = 0 <= after_s <= self._options.window_s + self._options.onset_s
        return in_time and observation.gone_s < observation.last_s and stream.now_s <= stream.begun_s + _TAKE_AWAY_S

    def _too_late(self, observation: Observation) -> bool:
        return self._now_s >= observation.last_s + self._options.max_wait_s

    def _fused(self, speech: Decision | None, gesture: Decision | None) -> FusedDecision:
        return fuse(speech, gesture, rule=self._fusion or self._options.rule, options=self._options.fusion)

    def _alone(self, observation: Observation, why: str) -> Pair:
        fused = self._fused(*(observation.decision if mode == observation.mode else None for mode in MODES))
        why = phrase("why_alone", why=why)
        return Pair(fused, observation.first_s, observation.last_s, 0.0, why, compute_ms=observation.compute_ms)

    def _together(self, word: Observation, sign: Observation) -> Pair:
        fused = self._fused(word.decision, sign.decision)
        if fused.label in self._options.control_labels.difference(self._options.no_labels):
            # What a mode decides on by itself is never paired: neither means it, and above all it must not end STOP.
            fused = replace(fused, label=UNKNOWN, status=UNKNOWN, confidence=0.0)
        apart = _apart(word, sign)
        why = phrase("why_apart", seconds=f"{apart:.2f}") if apart else phrase("why_at_once")
        span = min(word.first_s, sign.first_s), max(word.last_s, sign.last_s)
        return Pair(fused, *span, apart, why, compute_ms=word.compute_ms + sign.compute_ms)


def _apart(one: Observation, other: Observation) -> float:
    return max(0.0, one.first_s - other.end_s, other.first_s - one.end_s)
