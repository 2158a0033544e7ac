# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What follows from each event of the streams: pairs, the dialogue, motions; the same live, over files and replayed."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection
from typing import Any, Protocol

from hri.core.phrases import phrase
from hri.fusion import LearnedFusion
from hri.language import KnowledgeBase
from hri.live import Event
from hri.live import events as kinds
from hri.recognition.decision import RECOGNISED, plain
from hri.recognition.possibility import nbest_fields
from hri.session import dialogue as acts
from hri.session.dialogue import ACTING, Action, Dialogue
from hri.session.feeds import Arrival, is_over
from hri.session.mover import Cause, Moved
from hri.session.options import SessionOptions
from hri.session.pairing import MODES, Observation, Pair, Pairer
from hri.session.voice import VOICE_END, VOICE_START, OwnVoice

FUSED = "fused"
SAY = "say"
STATE = "state"
IGNORED = "ignored"
STOP = "stop"
REST = "rest"
RESUMED = "resumed"
SENTENCE = "sentence"
ASKED = "asked"
ONLY_STOP = "only_stop"
IMITATE = "imitate"
TICK = "tick"
BY_BUTTON = phrase("by_button")
MOTION_START = "motion_start"
MOTION_END = "motion_end"
HALT = "halt"

_OWN_VOICE = phrase("own_voice")

_BEGINS = frozenset((kinds.SPEECH_START, kinds.GESTURE_START))
_DROPS = frozenset((kinds.SPEECH_DROPPED, kinds.GESTURE_DROPPED))
_JOINS = frozenset((kinds.LISTENING, kinds.WATCHING, kinds.RECONNECTED))


class Body(Protocol):
    """What moves: `Mover`, or what takes its place where there is no robot."""

    def begin(self, label: str, cause: Cause) -> None: ...
    def stop(self, cause: Cause) -> None: ...
    def rest(self, cause: Cause) -> None: ...
    def resume(self) -> None: ...
    def advance(self, time_s: float) -> list[Moved]: ...


class NoRobot:
    """Carries out every motion at once.

    Parameters
    ----------
    reports : bool
        Whether it says so; a replay takes what the recording says.
    """

    def __init__(self, reports: bool = True) -> None:
        self._reports = reports
        self._num_begun = 0
        self._done: list[Moved] = []

    def begin(self, label: str, cause: Cause) -> None:
        """Report the motion as done."""
        self._num_begun += 1
        if self._reports:
            self._done.append(Moved("motion_end", label, cause.time_s, self._num_begun, completed=True))

    def stop(self, cause: Cause) -> None:
        """Do nothing: nothing moves."""

    def rest(self, cause: Cause) -> None:
        """Do nothing: nothing moves."""

    def resume(self) -> None:
        """Do nothing: nothing is stopped."""

    def advance(self, time_s: float) -> list[Moved]:
        """What was done since the last call."""
        done, self._done = self._done, []
        return done


class SessionLogic:
    """Events of the streams in, events of the session out.

    Parameters
    ----------
    options : SessionOptions
    body : Body
    labels : collection of str
        Those that are commands: what the body has motions for.
    on_say : callable of str, optional
        Gets what the robot says.
    fusion : LearnedFusion, optional
        In place of ``options.rule``.
    knowledge : KnowledgeBase, optional
        Stored sentences.
    whole_sentences : bool
        Signs come as sentences, and belong to no word.
    """

    def __init__(
        self,
        options: SessionOptions,
        body: Body,
        labels: Collection[str],
        on_say: Callable[[str], None] | None = None,
        fusion: LearnedFusion | None = None,
        knowledge: KnowledgeBase | None = None,
        whole_sentences: bool = False,
    ) -> None:
        self._body = body
        self._on_say = on_say
        self.pairer = Pairer(options, fusion)
        self.dialogue = Dialogue(options, labels, knowledge)
        self._own_voice = OwnVoice()
        self._num_begun = 0
        self._unsettled: set[str] = set()
        self._whole_sentences = whole_sentences
        self._signing = False
        self._heeded: list[str] = []  # stable words of the sentence that is being signed
        self._state = self.dialogue.state

    def process(self, arrival: Arrival) -> list[Event]:
        """The event, after what the robot did before it, and then what follows from it."""
        event = arrival.event
        out = self.passed(event.time)
        out.append(event)
        cause = Cause(event.time, event.time, arrival.at_s)
        if event.mode == "robot":
            self._moved(event, cause, out)
        elif event.mode == "session":
            self._asked(event, cause, out)
        elif event.mode == "gesture" and self._whole_sentences:
            self._heed_signs(event, cause, out)
        else:
            self._heed(event, cause, out)
        out += self.passed(event.time)
        return out

    def passed(self, time_s: float) -> list[Event]:
        """Time has come to this; what the robot did until then, and what follows."""
        out: list[Event] = []
        while moved := self._body.advance(time_s):
            for one in moved:
                event = moved_event(one)
                out.append(event)
                self._moved(event, Cause(one.time_s, one.time_s, 0.0), out)
        return out

    def _heed(self, event: Event, cause: Cause, out: list[Event]) -> None:
        """Heed an event of a stream."""
        mode, time_s = event.mode, event.time
        pairs: list[Pair] = []
        if event.event in _JOINS:
            self.pairer.join(mode, time_s)
        elif event.event in _BEGINS:
            self.pairer.begin(mode, event.fields["first_s"], time_s)
        elif event.event == kinds.DECISION and event.decision is not None:
            self._unsettled.discard(mode)
            if self._is_own(event):
                out.append(session_event(time_s, IGNORED, label=event.decision.label, reason=_OWN_VOICE))
                pairs = self.pairer.drop(mode, time_s)
            else:
                span = event.fields["first_s"], event.fields["last_s"]
                near, compute_ms = event.fields.get("near", ""), _compute_ms(event)
                pairs = self.pairer.observe(Observation(event.decision, *span, near, compute_ms), time_s)
        elif event.event in _DROPS and mode not in self._unsettled:
            left = event.fields.get("reason") == "left"
            pairs = self.pairer.drop(mode, time_s, event.fields["last_s"] if left else -math.inf)
        elif is_over(event):
            self._unsettled.discard(mode)
            pairs = self.pairer.leave(mode, time_s)
        else:
            if "whole" in event.fields:
                reason = phrase("decided_early")
                out.append(session_event(time_s, IGNORED, label=event.fields["whole"], reason=reason))
            if event.event == kinds.PRELIMINARY:  # what was shown may go on
                self._unsettled.add(mode)
            pairs = self.pairer.tick(mode, time_s)
        self._decide(pairs, cause, out, _compute_ms(event))
        self._time_passes(time_s, cause, out)

    def _decide(self, pairs: list[Pair], cause: Cause, out: list[Event], counted_ms: float = 0.0) -> None:
        """Heed what was decided on at the time of the cause, which counts so much of the time of recognition.

        What waited was recognised before; that it took time counts, too.
        """
        for pair in pairs:
            out.append(fused_event(pair, cause.time_s))
            before_ms = max(0.0, pair.compute_ms - counted_ms)
            decided = Cause(pair.last_s, cause.time_s, cause.computed_s - 1e-3 * before_ms)
            self._do(self.dialogue.decide(pair, cause.time_s), decided, out)

    def _is_own(self, event: Event) -> bool:
        """Whether a decision may be on the robot's own voice."""
        if event.mode != "speech" or event.decision is None:
            return False
        span = event.fields["first_s"], event.fields["last_s"]
        moving = self.dialogue.state == ACTING
        near = self.pairer.is_stop_label(event.fields.get("near", ""))
        stops = near or self.pairer.is_stop(event.decision) if moving else self.pairer.is_sure_stop(event.decision)
        return self._own_voice.may_be(event.decision, *span, stops, moving)

    def _heed_signs(self, event: Event, cause: Cause, out: list[Event]) -> None:
        """Heed an event of a stream of signed sentences."""
        fields, time_s = event.fields, event.time
        if event.event == kinds.GESTURE_START:
            self._signing, self._heeded = True, []
        elif event.event == kinds.SIGNING:
            stable = fields["words"][: fields["num_stable"]]
            self._do(self.dialogue.signing(self._unheeded(stable)), cause, out)
            self._heeded = max(self._heeded, stable, key=len)
        elif event.event == kinds.SIGNED:
            self._signing = False
            words, rest = fields["words"], self._unheeded(fields["words"])
            # A STOP that was heeded as it was signed is not heeded again, nor are the words around it.
            if any(map(self.pairer.is_stop_label, rest)) or not any(map(self.pairer.is_stop_label, words)):
                actions = self.dialogue.signed(words, fields["first_s"], time_s)
                self._do(actions, Cause(fields["last_s"], time_s, cause.computed_s), out)
            self._heeded = []
        elif event.event == kinds.GESTURE_DROPPED or is_over(event):
            self._signing = False
        self._time_passes(time_s, cause, out)

    def _unheeded(self, words: list[str]) -> list[str]:
        """Of the words of the present sentence those after the ones that were heeded; all where these have changed."""
        heeded = len(self._heeded)
        return words[heeded:] if words[:heeded] == self._heeded else words

    def _moved(self, event: Event, cause: Cause, out: list[Event]) -> None:
        if event.event == MOTION_END:
            newest = event.fields.get("number", self._num_begun) == self._num_begun
            self._do(self.dialogue.moved(event.fields["message"], event.fields["fault"], newest), cause, out)
            self._time_passes(event.time, cause, out)

    def _asked(self, event: Event, cause: Cause, out: list[Event]) -> None:
        if event.event == VOICE_START:
            self._own_voice.begin(event.fields["text"], event.time)
        elif event.event == VOICE_END:
            self._own_voice.end(event.fields["text"], event.time)
        command = event.fields["command"] if event.event == ASKED else ""
        if command == STOP:
            self._do(self.dialogue.halt(BY_BUTTON), cause, out)
        elif command == ONLY_STOP:
            self.dialogue.only_stop(event.time + event.fields["for_s"])
        elif command == IMITATE:
            self._do(self.dialogue.imitate(event.time), cause, out)
        elif command == REST:
            self._do(self.dialogue.rest(BY_BUTTON), cause, out)
        elif command == acts.RESUME:
            self._do(self.dialogue.resume(event.time), cause, out)
        self._decide(self.pairer.passed(event.time), cause, out)
        self._time_passes(event.time, cause, out)

    def _time_passes(self, time_s: float, cause: Cause, out: list[Event]) -> None:
        self._do(self.dialogue.tick(time_s), cause, out)
        self._do(self.dialogue.activity(self.pairer.active or self._signing, time_s), cause, out)
        self.pairer.hurried = self.dialogue.state == ACTING

    def _do(self, actions: list[Action], cause: Cause, out: list[Event]) -> None:
        for action in actions:
            if action.kind == acts.MOVE:
                self._num_begun += 1
                self._body.begin(action.label, cause)
                continue
            if action.kind == acts.STOP:
                self._body.stop(cause)
                self.pairer.clear()
            elif action.kind == acts.REST:
                self._body.rest(cause)
            elif action.kind == acts.RESUME:
                self._body.resume()
                self.pairer.clear()
            elif action.kind == acts.SAY and self._on_say is not None:
                self._on_say(action.text)
            out.append(self._event(action, cause.time_s))

    def _event(self, action: Action, time_s: float) -> Event:
        if action.kind == acts.STATE:
            before, self._state = self._state, action.text
            return session_event(time_s, STATE, state=action.text, before=before)
        if action.kind == acts.SAY:
            return session_event(time_s, SAY, text=action.text)
        if action.kind == acts.RESUME:
            return session_event(time_s, RESUMED)
        if action.kind == acts.SENTENCE:
            return sentence_event(action, time_s)
        return session_event(time_s, action.kind, label=action.label, reason=action.text)


def _compute_ms(event: Event) -> float:
    return float(event.fields.get("compute_ms", 0.0))


def session_event(time_s: float, kind: str, **fields: Any) -> Event:
    """An event of the session itself."""
    return Event(time_s, kind, fields, mode="session")


def sentence_event(action: Action, time_s: float) -> Event:
    """The event of a sentence that has ended."""
    found = action.nearest
    nearest = [] if found is None else list(found.sentence.words)
    distance = None if found is None else round(found.distance, 4)
    return session_event(time_s, SENTENCE, words=list(action.words), nearest=nearest, distance=distance)


def fused_event(pair: Pair, time_s: float) -> Event:
    """The event of a decision on a word, a sign or both."""
    fused = pair.fused
    modes = {mode: getattr(fused, mode) for mode in MODES}
    fields = {
        "first_s": round(pair.first_s, 4),
        "last_s": round(pair.last_s, 4),
        "final": fused.label if fused.status == RECOGNISED else "",
        "slots": _slots_of(pair),
        "status": fused.status,
        "confidence": fused.confidence,
        "rule": fused.rule,
        "why": pair.why,
        "carried_by": pair.carried_by,
        "apart_s": round(pair.apart_s, 4),
        **{
            mode: None if d is None else {"label": d.label, "status": d.status, "confidence": d.confidence}
            for mode, d in modes.items()
        },
        "nbest": nbest_fields(fused.nbest),
    }
    return session_event(time_s, FUSED, **plain(fields))


def _slots_of(pair: Pair) -> dict[str, str]:
    """Of the command that was decided on, where it was spoken."""
    spoken = pair.fused.speech
    decided = pair.fused.status == RECOGNISED and spoken is not None and spoken.label == pair.fused.label
    return dict(spoken.slots) if decided and spoken is not None else {}


def moved_event(moved: Moved) -> Event:
    """The event of something that a robot did."""
    fields: dict[str, Any] = {"label": moved.label, "number": moved.number}
    if moved.kind == MOTION_END:
        fields |= {"completed": moved.completed, "message": moved.message, "fault": moved.fault}
    else:
        fields |= {"wait_ms": round(moved.wait_ms, 3), "compute_ms": round(moved.compute_ms, 3)}
    return Event(moved.time_s, moved.kind, fields, mode="robot")
