# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What leads the dialogue does not overtake what was said before it, and nothing said before counts after it."""

from __future__ import annotations

import math
from typing import Any

import pytest

from hri.live import Event
from hri.recognition.decision import UNKNOWN, Decision, NBest
from hri.session import Dialogue, Observation, Pair, Pairer, SessionOptions
from hri.session.feeds import Arrival
from hri.session.logic import NoRobot, SessionLogic, session_event

MOTIONS = ("wave", "5")


def decision(mode: str, confidence: float = 0.95, **others: float) -> Decision:
    """Of the first of `others`, which have the probabilities that they are given, or else this one."""
    probabilities = {label: p or confidence for label, p in others.items()}
    nbest = tuple(NBest(label, p, math.log(p)) for label, p in probabilities.items())
    return Decision(mode, nbest[0].label, "recognised", nbest[0].probability, nbest=nbest, class_threshold=0.6)


class Scene:
    """Words and signs of a session in which both modes have a source; what it did, in words."""

    def __init__(self, whole_sentences: bool = False, **options: Any) -> None:
        self.logic = SessionLogic(
            SessionOptions(**options), NoRobot(reports=False), MOTIONS, whole_sentences=whole_sentences
        )
        self.done: list[str] = []
        self.heed("listening", 0.0)
        self.heed("watching", 0.0, mode="gesture")

    def heed(self, kind: str, time_s: float, decision: Decision | None = None, mode: str = "speech", **fields: Any):
        self.process(Event(time_s, kind, fields, decision, mode))

    def process(self, event: Event) -> None:
        for one in self.logic.process(Arrival(event, 0.0)):
            if one.event in ("stop", "resumed", "ignored"):
                self.done.append(" ".join(filter(None, (one.event, one.fields.get("label")))))
            elif one.event == "state" and one.fields["state"] in ("acting", "attending"):
                self.done.append(one.fields["state"])

    def said(self, label: str, first_s: float, confidence: float = 0.95, mode: str = "speech") -> None:
        """A word or sign of 0.4 s."""
        self.heed("speech_start" if mode == "speech" else "gesture_start", first_s + 0.1, mode=mode, first_s=first_s)
        found = decision(mode, confidence, **{label: 0.0})
        self.heed("decision", first_s + 0.7, found, mode, first_s=first_s, last_s=first_s + 0.4)

    def waited(self, until_s: float) -> None:
        """Nothing more is heard or seen."""
        self.heed("level", until_s)
        self.heed("hand", until_s, mode="gesture")

    def asked(self, command: str, time_s: float) -> None:
        self.process(session_event(time_s, "asked", command=command))


@pytest.mark.parametrize("mode", ["speech", "gesture"])
@pytest.mark.parametrize("button", [False, True])
def test_a_command_of_before_resume_is_none_after_it(mode: str, button: bool) -> None:
    scene = Scene(resume_labels=("start",))
    scene.said("stop", 0.5)
    scene.said("wave", 1.6, mode=mode)
    scene.asked("resume", 2.5) if button else scene.said("start", 2.4)
    scene.waited(6.0)
    assert "resumed" in scene.done and "acting" not in scene.done
    scene.said("5", 7.0)
    scene.waited(10.0)
    assert scene.done[-1] == "acting"


def test_a_sign_that_began_before_resume_is_no_command_and_stop_is() -> None:
    scene = Scene()
    scene.said("stop", 0.5)
    scene.heed("gesture_start", 1.7, mode="gesture", first_s=1.6)
    scene.asked("resume", 2.0)
    scene.heed("decision", 3.0, decision("gesture", wave=0.95), "gesture", first_s=1.6, last_s=2.6)
    scene.waited(6.0)
    assert scene.done == ["stop stop", "resumed", "ignored wave"]
    scene.asked("stop", 7.0)
    scene.heed("gesture_start", 7.2, mode="gesture", first_s=7.1)
    scene.asked("resume", 7.3)
    scene.heed("decision", 8.0, decision("gesture", stop=0.95), "gesture", first_s=7.1, last_s=7.6)
    assert scene.done[-1] == "stop stop"


@pytest.mark.parametrize("mode", ["speech", "gesture"])
def test_no_takes_back_a_command_that_waits(mode: str) -> None:
    scene = Scene()
    scene.said("wave", 0.5, mode=mode)
    scene.said("no", 1.3)
    scene.waited(6.0)
    assert scene.done == ["ignored wave", "ignored no"]


def test_no_takes_back_no_stop_and_no_word_of_a_sentence() -> None:
    scene = Scene()
    scene.said("stop", 0.5, confidence=0.43)
    assert scene.done == [], "it waits for a sign"
    scene.said("no", 1.3)
    assert scene.done[0] == "stop stop"

    begins = SessionOptions(sentence_begin_labels=("start",), sentence_end_labels=("end",))
    made, talk = Pairer(begins), Dialogue(begins, MOTIONS)
    for mode in ("speech", "gesture"):
        made.join(mode, 0.0)
    for number, label in enumerate(("start", "you", "no", "end")):
        one = Observation(decision("speech", **{label: 0.95}), number, number + 0.4)
        actions = [a for pair in made.observe(one, number + 0.7) for a in talk.decide(pair, number + 0.7)]
    assert [action.words for action in actions if action.kind == "sentence"] == [("you", "no")]


@pytest.mark.parametrize("mode", ["speech", "gesture"])
def test_a_word_of_before_the_wake_word_is_no_command_and_takes_no_attention(mode: str) -> None:
    scene = Scene(wake_labels=("robot",))
    scene.said("wave", 0.5, mode=mode)
    scene.said("robot", 1.3)
    scene.waited(2.2)
    scene.said("5", 2.4)
    scene.waited(6.0)
    assert "ignored wave" in scene.done and scene.done.count("acting") == 1
    assert scene.logic.dialogue.state == "acting"


def test_every_stop_of_a_signed_sentence_is_heeded_once() -> None:
    def signing(time_s: float, *words: str, num_stable: int) -> None:
        scene.heed("signing", time_s, mode="gesture", first_s=1.0, words=list(words), num_stable=num_stable)

    scene = Scene(whole_sentences=True)
    scene.heed("gesture_start", 1.1, mode="gesture", first_s=1.0)
    signing(2.0, "stop", num_stable=1)
    scene.asked("resume", 3.0)
    signing(4.0, "stop", "you", num_stable=2)
    assert scene.done == ["stop stop", "resumed"], "the first one was heeded"
    signing(5.0, "stop", "you", "stop", num_stable=3)
    assert scene.done[2:] == ["stop stop"]
    scene.asked("resume", 6.0)
    scene.heed("signed", 7.0, mode="gesture", words=["stop", "you", "stop"], first_s=1.0, last_s=6.5)
    assert scene.done[3:] == ["resumed"]
    for last, stops in (("you", False), ("stop", True)):
        scene = Scene(whole_sentences=True)
        scene.heed("gesture_start", 1.1, mode="gesture", first_s=1.0)
        signing(2.0, "stop", "you", num_stable=1)
        scene.asked("resume", 3.0)
        scene.heed("signed", 7.0, mode="gesture", words=["stop", last], first_s=1.0, last_s=6.5)
        assert scene.done[2:] == (["stop stop"] if stops else [])


def fused_by_product(label: str) -> Pair:
    """Of a word and a sign that both rank this label second."""
    made = Pairer(SessionOptions(rule="product", wake_labels=("robot",), resume_labels=("start",)))
    for mode in ("speech", "gesture"):
        made.join(mode, 0.0)
    made.observe(Observation(decision("speech", wave=0.5, **{label: 0.45, "5": 0.05}), 1.0, 1.5), 1.8)
    shown = decision("gesture", **{"5": 0.5, label: 0.45, "wave": 0.05})
    (found,) = made.observe(Observation(shown, 1.2, 2.0), 2.5)
    return found


@pytest.mark.parametrize("label", ["start", "yes", "robot"])
def test_what_ends_stop_confirms_or_wakes_is_what_a_mode_has_decided_on(label: str) -> None:
    found = fused_by_product(label).fused
    assert (found.label, found.status, found.confidence) == (UNKNOWN, UNKNOWN, 0.0) and found.nbest[0].label == label
    talk = Dialogue(SessionOptions(resume_labels=("start",)), MOTIONS)
    talk.halt("a test")
    assert [action.kind for action in talk.decide(fused_by_product(label), 2.5)] == ["ignored"]


@pytest.mark.parametrize("label", ["stop", "no", "left"])
def test_stop_no_and_commands_may_be_what_both_modes_together_say(label: str) -> None:
    assert fused_by_product(label).fused.label == label


def test_an_unsure_stop_waits_no_longer_than_it_may_where_no_stream_goes_on() -> None:
    scene = Scene(max_wait_s=6.0)
    scene.said("stop", 0.5, confidence=0.55)
    for tick_s in range(2, 7):
        scene.process(session_event(float(tick_s), "tick"))
    assert scene.done == []
    scene.process(session_event(7.0, "tick"))
    assert scene.done == ["stop stop"]


def pairer(**options: Any) -> Pairer:
    """Both modes have a source."""
    made = Pairer(SessionOptions(**options))
    for mode in ("speech", "gesture"):
        made.join(mode, 0.0)
    return made


def observed(mode: str, label: str, first_s: float, last_s: float, confidence: float = 0.95) -> Observation:
    return Observation(decision(mode, confidence, **{label: 0.0}), first_s, last_s)


def heard_and_seen(pair: Pair) -> tuple[str, str]:
    """The label of the word and of the sign, "" for none."""
    speech, gesture = (one.label if one is not None else "" for one in (pair.fused.speech, pair.fused.gesture))
    return speech, gesture


@pytest.mark.parametrize(("last_s", "taken"), [(1.5, True), (1.6, False)])
def test_no_takes_back_no_sign_that_had_not_ended_before_it(last_s: float, taken: bool) -> None:
    made = pairer()
    assert made.observe(observed("gesture", "wave", 0.8, last_s), 1.9) == []
    found = made.observe(observed("speech", "no", 1.5, 1.9), 2.2)
    assert [(pair.fused.label, pair.taken_back) for pair in found] == [("wave", True)] * taken + [("no", False)]
    assert made.waiting == (not taken)


def test_of_two_words_that_overlap_a_sign_the_one_that_began_with_it_is_paired() -> None:
    made = pairer()
    made.begin("gesture", 1.9, 2.0)
    assert made.observe(observed("speech", "left", 1.0, 2.0), 2.3) == []
    assert made.observe(observed("speech", "5", 2.05, 2.8), 3.1) == []
    found = made.observe(observed("gesture", "wave", 1.9, 3.0), 3.4)
    assert [heard_and_seen(pair) for pair in found] == [("left", ""), ("5", "wave")]


def test_what_may_not_wait_any_longer_is_paired_with_what_is_there() -> None:
    """A word that goes on is nearer to the sign, and the session comes to the end of all waiting in one step."""
    made = pairer(max_wait_s=3.0)
    made.begin("gesture", 2.0, 1.6)
    assert made.observe(observed("speech", "left", 1.0, 1.4), 1.7) == []
    made.begin("speech", 2.2, 2.3)
    assert made.observe(observed("gesture", "wave", 2.0, 2.4), 2.6) == []
    assert [heard_and_seen(pair) for pair in made.passed(10.0)] == [("left", "wave")]


def test_an_unsure_stop_stays_beside_a_sign_that_waits_while_the_robot_moves() -> None:
    made = pairer()
    made.hurried = True
    made.begin("gesture", 1.8, 1.75)
    assert made.observe(observed("speech", "stop", 1.0, 1.5, confidence=0.43), 1.8) == []
    made.begin("speech", 2.1, 2.2)
    assert made.observe(observed("gesture", "5", 1.8, 2.5), 2.6) == [], "the word that is being said is nearer"
    (pair,) = made.drop("speech", 2.7)
    assert heard_and_seen(pair) == ("stop", "5") and pair.fused.status == "ask"


def test_a_late_report_does_not_set_a_stream_back() -> None:
    made = pairer()
    made.tick("gesture", 5.0)
    made.tick("gesture", 1.0)
    assert [heard_and_seen(pair) for pair in made.observe(observed("speech", "wave", 1.0, 1.8), 2.1)] == [("wave", "")]


def test_a_source_that_ends_in_mid_word_leaves_nothing_begun() -> None:
    made = pairer()
    made.begin("speech", 1.0, 1.1)
    assert made.active
    assert made.leave("speech", 1.3) == [] and not made.active
    made.join("speech", 2.0)
    assert made.observe(observed("gesture", "wave", 2.0, 2.4), 2.5) == []
    assert [heard_and_seen(pair) for pair in made.tick("speech", 4.0)] == [("", "wave")]
