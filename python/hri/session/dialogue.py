# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The dialogue: which decision is a command, when the robot asks, moves and stops; without clocks and threads."""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence
from dataclasses import dataclass

from hri.core.phrases import Phrase, phrase
from hri.fusion import ASK
from hri.language import KnowledgeBase, StoredMatch, StoredSentence
from hri.recognition.decision import NO_INPUT, RECOGNISED, UNKNOWN
from hri.recognition.sentence.transcript import UNKNOWN as UNKNOWN_WORD
from hri.session.options import SessionOptions
from hri.session.pairing import Pair

IDLE = "idle"
ATTENDING = "attending"
LISTENING = "listening"
CONFIRMING = "confirming"
ACTING = "acting"
STOPPED = "stopped"
SENTENCE = "sentence"
STATES = (IDLE, ATTENDING, LISTENING, CONFIRMING, ACTING, STOPPED, SENTENCE)
MAX_SENTENCE_WORDS = 64
_NOT_UNDERSTOOD = phrase("not_understood")
_ONLY_STOP = phrase("only_stop")
_STOPPED = phrase("stopped_until_resume")
_MOVES = phrase("robot_moves")

SAY = "say"
MOVE = "move"
REST = "rest"
STOP = "stop"
RESUME = "resume"
IGNORE = "ignored"
STATE = "state"


@dataclass(frozen=True)
class Action:
    """What is to be done, or has changed.

    Attributes
    ----------
    kind : str
        "say" (voice and screen), "move" (carry out `label`), "rest" (end the motion under way), "stop" (end it, and let
        none begin), "resume", "ignored" (a decision that is no command now), "sentence" (one has ended), or "state".
    label : str
        Of a "move", or of what was ignored.
    text : str
        What to say, the state that is new, or why.
    words : tuple of str
        Of a sentence.
    nearest : StoredMatch, optional
        The stored sentence nearest to them, however far.
    """

    kind: str
    label: str = ""
    text: str = ""
    words: tuple[str, ...] = ()
    nearest: StoredMatch | None = None


class Dialogue:
    """The states of a dialogue, driven by decisions and times.

    ========== ================================================================================================
    idle       nothing goes on; without `SessionOptions.wake_labels` every decision is a command
    attending  the wake word or sign came: a command that begins after it, within `attend_s`, counts
    listening  something that may be a command is being said or shown
    confirming the robot repeats what it understood and waits: the same label or "yes" confirms, "no" takes back,
               another command replaces it, and after `confirm_s` nothing is done
    acting     the robot moves: "no" ends the motion, another command is ignored
    stopped    no motion begins until `resume`, or one of `resume_labels`; what began before that is no command after it
    sentence   words and signs are collected until one of `sentence_end_labels`; then the robot says the stored sentence
               that is nearest to them, and moves as its answer names
    ========== ================================================================================================

    STOP counts in each of them, also while nothing else does (`only_stop`).

    Parameters
    ----------
    options : SessionOptions, optional
    motions : collection of str
        Labels that the robot has a motion for.
    knowledge : KnowledgeBase, optional
        Stored sentences; without them a sentence is said as its words.
    """

    def __init__(
        self,
        options: SessionOptions | None = None,
        motions: Collection[str] = (),
        knowledge: KnowledgeBase | None = None,
    ) -> None:
        self._options = options or SessionOptions()
        self._motions = frozenset(motions)
        self._knowledge = knowledge
        self.state = IDLE
        self._active = False
        self._attend_from_s = self._attend_until_s = self._resumed_s = -math.inf
        self._answer_until_s = -math.inf
        self._asked: tuple[str, ...] = ()
        self._words: list[str] = []
        self._sentence_until_s = -math.inf
        self._answers: list[str] = []
        self._only_stop_until_s = -math.inf

    def only_stop(self, until_s: float) -> None:
        """Ignore what begins before that time, except STOP; the last call counts."""
        self._only_stop_until_s = until_s

    def activity(self, active: bool, time_s: float) -> list[Action]:
        """Something is being said or shown, or waits to be decided on; or no longer."""
        self._active = active
        if active and (self.state == ATTENDING or (self.state == IDLE and not self._options.wake_labels)):
            return self._go(LISTENING)
        if not active and self.state == LISTENING:
            return self._go(ATTENDING if time_s <= self._attend_until_s else IDLE)
        return []

    def tick(self, time_s: float) -> list[Action]:
        """Time has passed."""
        if self.state == ATTENDING and time_s > self._attend_until_s:
            return self._go(IDLE)
        if self.state == CONFIRMING and time_s > self._answer_until_s and not self._active:
            return [Action(SAY, text=phrase("no_answer")), *self._calm()]
        if self.state == SENTENCE and time_s > self._sentence_until_s and not self._active:
            return [Action(SAY, text=phrase("no_end")), *self._calm()]
        return []

    def decide(self, pair: Pair, time_s: float) -> list[Action]:
        """A decision on a word, a sign or both."""
        label, status = pair.fused.label, pair.fused.status
        if label in self._options.fusion.stop_labels and status not in (UNKNOWN, NO_INPUT, ASK):
            return self._ask((label,), time_s) if self._asks_about_stop(pair) else self.halt(pair.fused.rule, label)
        if pair.first_s < self._only_stop_until_s:
            if status == ASK and any(entry.label in self._options.fusion.stop_labels for entry in pair.fused.nbest):
                return self.halt(pair.fused.rule)  # nothing can be asked now
            return [Action(IGNORE, label, _ONLY_STOP)]
        if self.state == STOPPED:
            if label in self._options.resume_labels:
                return self.resume(pair.last_s)
            return [Action(IGNORE, label, _STOPPED)]
        if pair.taken_back and self.state != SENTENCE:  # of whose words "no" is one
            return [Action(IGNORE, label, phrase("taken_back"))]
        if status == NO_INPUT:
            return [Action(IGNORE, label, phrase("no_input"))]
        if status == ASK:
            rest = [Action(REST, text=pair.fused.rule)] if self.state == ACTING else []
            return [*rest, *self._ask(tuple(entry.label for entry in pair.fused.nbest), time_s)]
        if self.state == ACTING:
            if label in self._options.no_labels:
                return [Action(REST, label, phrase("taken_back")), *self._calm()]
            return [Action(IGNORE, label, _MOVES)]
        if pair.first_s < self._resumed_s:
            return [Action(IGNORE, label, _STOPPED)]
        if self.state == CONFIRMING:
            return self._answer(label, status, time_s)
        if self.state == SENTENCE or label in self._options.sentence_begin_labels:
            return self._collect(label, time_s)
        return self._command(pair, time_s)

    def _asks_about_stop(self, pair: Pair) -> bool:
        """Whether STOP may be a word of other people's talk: nothing moves that it could stop."""
        rests = self.state in (IDLE, ATTENDING, LISTENING) and pair.first_s >= self._only_stop_until_s
        return rests and pair.fused.gesture is None and pair.fused.confidence < self._options.stop_at_rest

    def signing(self, words: Sequence[str]) -> list[Action]:
        """Words of a signed sentence that goes on, which stand until its end: STOP among them does not wait for it."""
        stop = self._stop_among(words)
        return self.halt(phrase("stop_among_signs"), stop) if stop and self.state != STOPPED else []

    def signed(self, words: Sequence[str], first_s: float, time_s: float) -> list[Action]:
        """A sentence of signs that was recognised as one, and when it began.

        Where the options have labels that begin and end a sentence, words count between these, which may be in several
        signed sentences; else every signed sentence is one. One of a single label that answers a question, takes back
        or resumes does so. A word that was rejected (``<unk>``) counts as "unknown", as a rejected sign does.
        """
        words = [UNKNOWN if word == UNKNOWN_WORD else word for word in words]
        text, alone = " ".join(words), words[0] if len(words) == 1 else ""
        if self._stop_among(words):
            return self.signing(words) or [Action(IGNORE, text, _STOPPED)]
        if first_s < self._only_stop_until_s:
            return [Action(IGNORE, text, _ONLY_STOP)]
        if self.state == STOPPED:
            return self.resume(time_s) if alone in self._options.resume_labels else [Action(IGNORE, text, _STOPPED)]
        if self.state == ACTING:
            if alone in self._options.no_labels:
                return [Action(REST, alone, phrase("taken_back")), *self._calm()]
            return [Action(IGNORE, text, _MOVES)]
        if first_s < self._resumed_s:
            return [Action(IGNORE, text, _STOPPED)]
        if self.state == CONFIRMING:
            status = UNKNOWN if alone == UNKNOWN else RECOGNISED
            return self._answer(alone, status, time_s) if alone else [Action(IGNORE, text, phrase("not_an_answer"))]
        if self._options.sentence_begin_labels:
            return self._collected(words, time_s)
        if self._options.wake_labels:
            called = words[0] in self._options.wake_labels
            if not called and first_s < self._attend_from_s:
                return [Action(IGNORE, text, phrase("no_wake_word"))]
            attended = called or first_s <= self._attend_until_s
            self._attend_until_s = -math.inf
            if called and len(words) == 1:
                self._attend_from_s, self._attend_until_s = first_s, time_s + self._options.attend_s
            words = words[1:] if called else words
            if not words:
                return self._go(ATTENDING) if self.state != LISTENING else []
            if not attended:
                return [Action(IGNORE, text, phrase("no_wake_word")), *self._calm()]
        self._words = list(words)
        return self._read()

    def _stop_among(self, words: Sequence[str]) -> str:
        return next((word for word in words if word in self._options.fusion.stop_labels), "")

    def _collected(self, words: Sequence[str], time_s: float) -> list[Action]:
        """Of the words of a signed sentence those that stand in one that was begun."""
        done: list[Action] = []
        begun = self.state == SENTENCE
        for word in words:
            if self.state == SENTENCE or word in self._options.sentence_begin_labels:
                begun = True
                done += self._collect(word, time_s)
            elif self.state == ACTING:  # it has ended, and is answered
                break
        return done if begun else [Action(IGNORE, " ".join(words), phrase("no_sentence_begun"))]

    def moved(self, message: str, fault: bool, newest: bool = True) -> list[Action]:
        """The motion has ended: "" as it should, else why not; a fault of the robot's stops it.

        One that another was begun after, as it still came to rest, ends nothing else.
        """
        said = [Action(SAY, text=message)] if message else []
        if fault:
            return [*said, *self.halt(message)]
        if not newest:
            return said
        if self.state == ACTING and self._answers and not message:
            return [Action(MOVE, self._answers.pop(0))]
        return [*said, *(self._calm() if self.state == ACTING else [])]

    def halt(self, why: str, label: str = "") -> list[Action]:
        """STOP."""
        self._asked = ()
        self._answers = []
        return [Action(STOP, label, why), *self._go(STOPPED)]

    def resume(self, time_s: float) -> list[Action]:
        """A person ends STOP at this time; what began before it is no command."""
        if self.state != STOPPED:
            return []
        self._resumed_s = time_s
        return [Action(RESUME), Action(SAY, text=phrase("ready")), *self._calm()]

    def imitate(self, time_s: float) -> list[Action]:
        """A person asks by a button to be imitated: as by the first of `imitate_labels`, without a question."""
        label = next(iter(self._options.imitate_labels), "")
        if label not in self._motions:
            return [Action(SAY, text=phrase("cannot_imitate"))]
        if time_s < self._only_stop_until_s:
            return [Action(IGNORE, label, _ONLY_STOP)]
        if self.state in (STOPPED, ACTING):
            return [Action(IGNORE, label, _STOPPED if self.state == STOPPED else _MOVES)]
        return self._move(label)

    def rest(self, why: str) -> list[Action]:
        """A person ends the motion under way by a button, as "no" does."""
        return [Action(REST, text=why), *self._calm()] if self.state == ACTING else []

    def _command(self, pair: Pair, time_s: float) -> list[Action]:
        fused = pair.fused
        if self._options.wake_labels:
            called = fused.label in self._options.wake_labels
            if not called and pair.first_s < self._attend_from_s:  # the wake word still counts
                return [Action(IGNORE, fused.label, phrase("no_wake_word"))]
            attended = pair.first_s <= self._attend_until_s
            self._attend_until_s = -math.inf
            if called:
                self._attend_from_s, self._attend_until_s = pair.first_s, pair.last_s + self._options.attend_s
                return self._go(ATTENDING) if self.state != LISTENING else []
            if not attended:
                return [Action(IGNORE, fused.label, phrase("no_wake_word")), *self._calm()]
        if fused.status == UNKNOWN:
            return [Action(SAY, text=_NOT_UNDERSTOOD), *self._calm()]
        if fused.label in self._options.control_labels:
            return [Action(IGNORE, fused.label, phrase("nothing_asked")), *self._calm()]
        if fused.label not in self._motions:
            return [Action(SAY, text=phrase("no_motion", label=fused.label)), *self._calm()]
        if self._options.confirm_below == 1 or fused.confidence < self._options.confirm_below:
            return self._ask((fused.label,), time_s)
        return self._move(fused.label)

    def _collect(self, label: str, time_s: float) -> list[Action]:
        """A word or sign that begins a sentence, is of it, or ends it; a rejected one is a word that is not known."""
        if self.state == SENTENCE and label in self._options.sentence_end_labels:
            return self._read()
        self._sentence_until_s = time_s + self._options.sentence_s
        if label in self._options.sentence_begin_labels:
            self._words = []
        elif len(self._words) < MAX_SENTENCE_WORDS:
            self._words.append(label)
        else:
            return [Action(SAY, text=phrase("too_long")), *self._calm()]
        return self._go(SENTENCE)

    def _read(self) -> list[Action]:
        """The sentence has ended: say it, and answer by motions."""
        words = tuple(self._words)
        nearest = self._knowledge.nearest(words) if self._knowledge is not None and words else None
        understood = any(word != UNKNOWN for word in words)
        text, answers = " ".join(words) if understood else _NOT_UNDERSTOOD, []
        if self._knowledge is not None and nearest is not None:
            known = nearest.distance <= self._knowledge.max_distance
            text = _stored(nearest.sentence, self._options.language) if known else _NOT_UNDERSTOOD
            answers = [label for label in nearest.sentence.answer if known and label in self._motions]
        said = [Action(SENTENCE, words=words, nearest=nearest), Action(SAY, text=text)]
        if not answers:
            return [*said, *self._calm()]
        self._answers = answers[1:]
        return [*said, *self._go(ACTING), Action(MOVE, answers[0])]

    def _answer(self, label: str, status: str, time_s: float) -> list[Action]:
        if status == UNKNOWN:
            return self._ask(self._asked, time_s)
        if label in self._options.no_labels:
            return [Action(SAY, text=phrase("nothing_done")), *self._calm()]
        if label in self._options.yes_labels:
            if len(self._asked) == 1 and self._asked[0] in self._options.fusion.stop_labels:
                return self.halt(phrase("confirmed"), self._asked[0])
            return self._move(self._asked[0]) if len(self._asked) == 1 else self._ask(self._asked, time_s)
        if label in self._asked and label in self._motions:
            return self._move(label)
        if label in self._motions:
            return self._ask((label,), time_s)
        return [Action(IGNORE, label, phrase("not_an_answer"))]

    def _ask(self, labels: tuple[str, ...], time_s: float) -> list[Action]:
        self._asked = labels
        self._answer_until_s = time_s + self._options.confirm_s
        return [Action(SAY, text=phrase("did_you_mean", labels=labels)), *self._go(CONFIRMING)]

    def _move(self, label: str) -> list[Action]:
        self._asked = ()
        return [Action(SAY, text=phrase("repeated", label=label)), *self._go(ACTING), Action(MOVE, label)]

    def _calm(self) -> list[Action]:
        """Back to where the next command is waited for."""
        self._asked = ()
        self._answers = []
        return self._go(LISTENING if self._active and not self._options.wake_labels else IDLE)

    def _go(self, state: str) -> list[Action]:
        if state == self.state:
            return []
        self.state = state
        return [Action(STATE, text=state)]


def _stored(sentence: StoredSentence, language: str) -> str:
    """What a stored sentence says in one language, with those in others."""
    text = sentence.text(language)
    return Phrase(text, "stored", {"texts": dict(sentence.texts)}) if sentence.texts else text
