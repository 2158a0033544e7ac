# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""A session's logic without devices: what is paired, what is a command, and that STOP counts in every state."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hri.core.errors import InvalidArgument
from hri.fusion import FusionOptions
from hri.recognition.decision import NO_INPUT, UNKNOWN, Decision, NBest
from hri.session import Action, Dialogue, Observation, Pair, Pairer, SessionOptions

MOTIONS = ("5", "7", "wave")


def decision(mode: str, label: str, confidence: float = 0.95, status: str = "recognised", threshold: float = 0.6):
    other = "7" if label != "7" else "5"
    nbest = tuple(NBest(name, p, math.log(p)) for name, p in ((label, confidence), (other, 1 - confidence)))
    shown = label if status == "recognised" else status
    return Decision(mode, shown, status, confidence, nbest=nbest, class_threshold=threshold)


def word(label: str, first_s: float, last_s: float, **fields: Any) -> Observation:
    return Observation(decision("speech", label, **fields), first_s, last_s)


def sign(label: str, first_s: float, last_s: float, **fields: Any) -> Observation:
    return Observation(decision("gesture", label, **fields), first_s, last_s)


def pairer(modes: tuple[str, ...] = ("speech", "gesture"), **options: Any) -> Pairer:
    made = Pairer(SessionOptions(**options))
    for mode in modes:
        made.join(mode, 0.0)
    return made


def advance(made: Pairer, until_s: float, step_s: float = 0.1) -> list[tuple[float, Pair]]:
    """Both streams go on; when each pair came."""
    begin_s = made._now_s
    times = begin_s + step_s * np.arange(1, round((until_s - begin_s) / step_s) + 1)
    return [(float(t), pair) for t in times for mode in ("speech", "gesture") for pair in made.tick(mode, float(t))]


@pytest.mark.parametrize("gap_s", [-0.5, 0.0, 0.4, 0.99])
@pytest.mark.parametrize("speech_first", [True, False])
def test_what_is_up_to_a_second_apart_is_paired_at_once(gap_s: float, speech_first: bool) -> None:
    made = pairer()
    one, other = (word, sign) if speech_first else (sign, word)
    first, second = one("7", 1.0, 1.8), other("7", 1.8 + gap_s, 3.0)
    made.begin(first.mode, 1.0, 1.1)
    assert made.observe(first, 2.1) == [] and made.waiting == 1
    made.begin(second.mode, second.first_s, 3.0)
    (pair,) = made.observe(second, 3.3)
    assert pair.fused.label == "7" and pair.fused.speech is not None and pair.fused.gesture is not None
    assert pair.apart_s == pytest.approx(max(0.0, gap_s)) and pair.carried_by == "both"
    assert (pair.first_s, pair.last_s) == (1.0, 3.0) and not made.active


def test_what_is_further_apart_stays_alone() -> None:
    made = pairer(window_s=1.0)
    made.observe(word("7", 1.0, 1.8), 2.1)
    made.begin("gesture", 2.9, 3.0)
    ((when, alone),) = advance(made, 3.2)
    assert alone.fused.speech is not None and alone.fused.gesture is None and alone.carried_by == "speech"
    assert when == pytest.approx(3.1), "a sign within the window would have been reported by then"
    assert "nothing else within 1 s" in alone.why
    assert made.observe(sign("5", 2.9, 3.5), 4.0) == []
    assert [pair.fused.label for _, pair in advance(made, 6.0)] == ["5"]


def test_what_is_a_second_apart_belongs_together_though_ends_are_found_early() -> None:
    made = pairer()
    made.observe(word("7", 1.0, 1.8), 2.1)  # of a word that was said until 2.0
    made.begin("gesture", 3.0, 3.1)
    assert advance(made, 3.2) == []
    (pair,) = made.observe(sign("7", 3.0, 3.6), 4.0)
    assert pair.fused.speech is not None and pair.fused.gesture is not None


def test_a_mode_without_a_source_is_not_waited_for() -> None:
    (pair,) = pairer(("speech",)).observe(word("7", 1.0, 1.8), 2.1)
    assert pair.fused.label == "7" and "no source of gesture" in pair.why
    made = pairer()
    made.begin("gesture", 1.5, 1.6)
    assert made.observe(word("7", 1.0, 1.8), 2.1) == []
    (pair,) = made.leave("gesture", 2.2)
    assert pair.fused.label == "7"
    made.join("gesture", 5.0)
    assert made.observe(word("7", 5.0, 5.5), 5.8) == []


def test_what_has_begun_is_waited_for_until_it_is_dropped_or_takes_too_long() -> None:
    made = pairer()
    made.observe(word("7", 1.0, 1.8), 2.1)
    made.begin("gesture", 2.5, 2.6)
    assert advance(made, 4.5) == []
    (pair,) = made.drop("gesture", 4.6)
    assert pair.fused.gesture is None

    made = pairer(max_wait_s=3.0)
    made.observe(word("7", 1.0, 1.8), 2.1)
    made.begin("gesture", 2.5, 2.6)
    ((when, pair),) = advance(made, 6.0)
    assert when == pytest.approx(4.8, abs=0.11) and "more than 3 s" in pair.why


def test_of_several_the_nearest_is_paired() -> None:
    made = pairer()
    made.observe(word("5", 1.0, 1.4), 1.7)
    made.begin("speech", 2.05, 2.1)
    made.begin("gesture", 2.0, 2.2)
    assert made.observe(sign("7", 2.0, 2.4), 2.6) == [], "the word that is being said is nearer than the one before"
    alone, pair = made.observe(word("7", 2.05, 2.5), 2.8)
    assert alone.fused.label == "5" and alone.fused.gesture is None and "nearer" in alone.why
    assert pair.fused.speech is not None and pair.fused.speech.label == "7" and pair.apart_s == 0


def test_rejected_and_missing_input_are_kept_apart() -> None:
    made = pairer()
    (pair,) = made.observe(sign("5", 0.5, 1.0, status=NO_INPUT), 1.5)
    assert pair.fused.status == NO_INPUT
    made.observe(word("7", 1.1, 1.8, status=UNKNOWN), 2.1)
    (pair,) = made.observe(sign("5", 1.0, 2.0), 2.2)
    assert pair.fused.label == "5" and pair.carried_by == "gesture"
    made.observe(word("7", 5.0, 5.5, status=UNKNOWN), 5.8)
    assert [pair.fused.status for _, pair in advance(made, 8.0)] == [UNKNOWN]


def test_a_sure_stop_waits_for_nothing_and_an_unsure_one_asks() -> None:
    made = pairer()
    made.begin("gesture", 1.0, 1.1)
    (pair,) = made.observe(word("stop", 1.0, 1.5, confidence=0.9), 1.8)
    assert pair.fused.label == "stop" and pair.fused.rule == "stop: recognised in speech"

    made = pairer()
    assert made.observe(word("stop", 1.0, 1.5, confidence=0.43), 1.8) == []
    (pair,) = made.observe(sign("5", 1.0, 2.0, confidence=0.97), 2.6)
    assert pair.fused.status == "ask" and [n.label for n in pair.fused.nbest] == ["stop", "5"]

    made = pairer()
    assert made.observe(word("stop", 1.0, 1.5, confidence=0.49, threshold=0.0), 1.8) == [], "below chance is unsure"
    options = FusionOptions(stop_threshold=0.3)
    (pair,) = pairer(fusion=options).observe(word("stop", 1.0, 1.5, confidence=0.43), 1.8)
    assert pair.fused.label == "stop"


def test_an_unsure_stop_does_not_wait_for_what_has_not_begun_while_the_robot_moves() -> None:
    made = pairer()
    made.hurried = True
    (pair,) = made.observe(word("stop", 1.0, 1.5, confidence=0.43), 1.8)
    assert pair.fused.label == "stop" and "unsure" in pair.fused.rule
    made.begin("gesture", 2.0, 2.1)
    assert made.observe(word("stop", 2.0, 2.5, confidence=0.43), 2.8) == []
    (pair,) = made.observe(sign("5", 2.0, 2.6, confidence=0.97), 3.1)
    assert pair.fused.status == "ask"


@pytest.mark.parametrize("moving", [False, True])
@pytest.mark.parametrize("near", ["", "stop", "7"])
def test_a_stop_that_was_rejected_by_little_counts_while_the_robot_moves(near: str, moving: bool) -> None:
    made = pairer()
    made.hurried = moving
    rejected = replace(word(near or "stop", 1.0, 1.5, status=UNKNOWN), near=near)
    found = made.observe(rejected, 1.8)
    if near == "stop" and moving:
        (pair,) = found
        assert pair.fused.label == "stop" and pair.carried_by == "speech" and "by little" in pair.why
    else:
        assert found == []
        assert [pair.fused.status for _, pair in advance(made, 4.0)] == [UNKNOWN]


def test_a_stop_that_was_rejected_by_little_and_is_unsure_asks_beside_a_sure_sign() -> None:
    made = pairer()
    made.hurried = True
    made.begin("gesture", 1.0, 1.1)
    assert made.observe(replace(word("stop", 1.0, 1.5, status=UNKNOWN, confidence=0.43), near="stop"), 1.8) == []
    (pair,) = made.observe(sign("5", 1.0, 1.6, confidence=0.97), 2.1)
    assert pair.fused.status == "ask"


def test_labels_that_lead_the_dialogue_are_not_paired() -> None:
    made = pairer(wake_labels=("robot",))
    made.begin("gesture", 1.6, 1.7)
    for label in ("robot", "yes", "no"):
        (pair,) = made.observe(word(label, 1.0, 1.5), 1.8)
        assert pair.fused.label == label and pair.fused.gesture is None


@settings(max_examples=150, deadline=None)
@given(
    st.lists(
        st.tuples(
            st.floats(2.5, 6.0), st.floats(0.2, 1.0), st.floats(0.2, 1.2), st.floats(-0.9, 0.9), st.sampled_from("psg")
        ),
        min_size=1,
        max_size=12,
    )
)
def test_pairs_are_found_whatever_their_times(turns: list[tuple[float, float, float, float, str]]) -> None:
    """Every turn comes out once, in order, whole: nothing lost, taken apart or joined to another turn."""
    events: list[tuple[float, int, str, Any]] = []
    at_s, expected = 0.0, []
    for number, (pause_s, word_s, sign_s, offset_s, kind) in enumerate(turns):
        label = str(number)
        begin_s = at_s + pause_s + 1.0
        sign_begin_s = begin_s + word_s + offset_s if offset_s >= 0 else begin_s - sign_s + offset_s
        parts = []
        if kind != "g":
            parts.append(("speech", word(label, begin_s, begin_s + word_s), 0.3))
        if kind != "s":
            parts.append(("gesture", sign(label, sign_begin_s, sign_begin_s + sign_s), 0.6))
        for mode, observation, late_s in parts:
            events.append((observation.first_s + 0.15, len(events), mode, None))
            events.append((observation.last_s + late_s, len(events), mode, observation))
        at_s = max(observation.last_s for _, observation, _ in parts)
        expected.append((label, len(parts)))
    made, found = pairer(), []
    for time_s, _, mode, observation in sorted(events, key=lambda event: event[:2]):
        found += [pair for _, pair in advance(made, time_s, 0.05)]
        if observation is None:
            made.begin(mode, time_s - 0.15, time_s)
        else:
            found += made.observe(observation, time_s)
    found += [pair for _, pair in advance(made, at_s + 3.0)]
    modes = [(p.fused.label, sum(d is not None for d in (p.fused.speech, p.fused.gesture))) for p in found]
    assert modes == expected and made.waiting == 0


def pair(label: str, *, confidence: float = 0.95, first_s: float = 1.0, **fields: Any) -> Pair:
    (found,) = pairer(("speech",)).observe(word(label, first_s, first_s + 0.5, confidence=confidence, **fields), 2.0)
    return found


def ask() -> Pair:
    made = pairer()
    made.observe(word("stop", 1.0, 1.5, confidence=0.43), 1.8)
    (found,) = made.observe(sign("5", 1.0, 2.0, confidence=0.97), 2.6)
    return found


def kinds(actions: list[Action]) -> list[tuple[str, str]]:
    return [(action.kind, action.label or action.text) for action in actions]


def test_a_command_is_repeated_and_carried_out() -> None:
    talk = Dialogue(motions=MOTIONS)
    assert kinds(talk.activity(True, 1.0)) == [("state", "listening")]
    assert kinds(talk.decide(pair("7"), 2.0)) == [("say", "7."), ("state", "acting"), ("move", "7")]
    assert kinds(talk.decide(pair("5"), 3.0)) == [("ignored", "5")]
    assert talk.activity(False, 3.0) == []
    assert kinds(talk.moved("", False)) == [("state", "idle")]
    assert "no motion for 9" in talk.decide(pair("9"), 4.0)[0].text and talk.state == "idle"
    assert "not understand" in talk.decide(pair("5", status=UNKNOWN), 5.0)[0].text
    assert kinds(talk.decide(pair("5", status=NO_INPUT), 5.0)) == [("ignored", "no_input")]


def test_the_wake_word_precedes_every_command() -> None:
    options = SessionOptions(wake_labels=("robot",), attend_s=3.0)
    talk = Dialogue(options, MOTIONS)
    assert talk.activity(True, 0.5) == [] and talk.activity(False, 1.0) == []
    (ignored,) = talk.decide(pair("7", first_s=1.0), 2.0)
    assert ignored.kind == "ignored" and "wake" in ignored.text
    awake = pair("7", first_s=5.0)
    (wake,) = pairer(("speech",), wake_labels=("robot",)).observe(word("robot", 4.0, 4.5), 4.8)
    assert kinds(talk.decide(wake, 4.8)) == [("state", "attending")]
    assert kinds(talk.activity(True, 5.1)) == [("state", "listening")]
    assert ("move", "7") in kinds(talk.decide(awake, 6.0))
    talk.moved("", False)
    assert kinds(talk.decide(awake, 6.5)) == [("ignored", "7")], "attention ends with one command"
    talk.decide(wake, 4.8)
    assert talk.tick(7.4) == [] and kinds(talk.tick(7.6)) == [("state", "idle")]


def test_an_unsure_command_is_asked_for() -> None:
    answers = {
        "yes": [("say", "7."), ("state", "acting"), ("move", "7")],
        "7": [("say", "7."), ("state", "acting"), ("move", "7")],
        "no": [("say", "I do nothing."), ("state", "idle")],
        "5": [("say", "Did you mean 5?")],
        "other": [("ignored", "other")],
    }
    for answer, then in answers.items():
        talk = Dialogue(SessionOptions(confirm_below=0.8), MOTIONS)
        assert kinds(talk.decide(pair("7", confidence=0.7), 2.0)) == [
            ("say", "Did you mean 7?"),
            ("state", "confirming"),
        ]
        assert kinds(talk.decide(pair(answer), 4.0)) == then
    talk = Dialogue(SessionOptions(confirm_below=1, confirm_s=5.0), MOTIONS)
    talk.decide(pair("7", confidence=1 - 1e-9), 2.0)
    assert talk.tick(7.0) == [] and kinds(talk.tick(7.1)) == [("say", "No answer: I do nothing."), ("state", "idle")]
    assert kinds(talk.decide(pair("yes"), 8.0)) == [("ignored", "yes")]


def test_a_weak_stop_beside_a_sure_sign_asks() -> None:
    for moving in (False, True):
        talk = Dialogue(motions=MOTIONS)
        if moving:
            talk.decide(pair("7"), 1.0)
        done = talk.decide(ask(), 2.6)
        assert ("rest" in [action.kind for action in done]) == moving and talk.state == "confirming"
        assert "stop" not in [action.kind for action in done] and "Did you mean stop or 5?" in [a.text for a in done]
        assert talk.moved("", False) == []
        assert kinds(talk.decide(pair("yes"), 3.0)) == [("say", "Did you mean stop or 5?")], "yes to which?"
        assert ("move", "5") in kinds(talk.decide(pair("5"), 4.0))


def test_an_unsure_stop_is_asked_about_only_where_that_is_wanted_and_nothing_moves() -> None:
    def talk() -> Dialogue:
        return Dialogue(SessionOptions(stop_at_rest=0.99), MOTIONS)

    unsure, sure = pair("stop", confidence=0.98), pair("stop", confidence=0.99)
    assert kinds(Dialogue(SessionOptions(), MOTIONS).decide(unsure, 3.0))[0] == ("stop", "stop")
    assert kinds(talk().decide(sure, 3.0))[0] == ("stop", "stop")
    asked = talk()
    assert kinds(asked.decide(unsure, 3.0)) == [("say", "Did you mean stop?"), ("state", "confirming")]
    assert kinds(asked.decide(unsure, 4.0))[0] == ("stop", "stop"), "said again, it counts"
    confirmed, denied, unanswered, moving, shown, paused = (talk() for _ in range(6))
    for one in (confirmed, denied, unanswered):
        one.decide(unsure, 3.0)
    assert kinds(confirmed.decide(pair("yes"), 4.0))[0] == ("stop", "stop") and confirmed.state == "stopped"
    assert kinds(denied.decide(pair("no"), 4.0))[0] == ("say", "I do nothing.") and denied.state == "idle"
    assert unanswered.tick(99.0) and unanswered.state == "idle"
    moving.decide(pair("7"), 2.0)
    assert moving.state == "acting" and kinds(moving.decide(unsure, 3.0))[0] == ("stop", "stop")
    (signed,) = pairer(("gesture",)).observe(sign("stop", 1.0, 1.5, confidence=0.6), 2.0)
    assert kinds(shown.decide(signed, 3.0))[0] == ("stop", "stop")
    paused.only_stop(9.0)
    assert kinds(paused.decide(unsure, 3.0))[0] == ("stop", "stop"), "nothing can be asked now"
    for bad in (-0.1, 1.1, float("nan")):
        with pytest.raises(InvalidArgument, match="stop_at_rest"):
            SessionOptions(stop_at_rest=bad)


@pytest.mark.parametrize("state", ["idle", "attending", "listening", "confirming", "acting", "stopped"])
def test_stop_counts_in_every_state(state: str) -> None:
    options = SessionOptions(wake_labels=("robot",), confirm_below=0.8)
    talk = Dialogue(options, MOTIONS)
    if state != "idle":
        (wake,) = pairer(("speech",), wake_labels=("robot",)).observe(word("robot", 0.0, 0.5), 0.8)
        talk.decide(wake, 0.8)
    if state == "listening":
        talk.activity(True, 0.9)
    if state in ("confirming", "acting"):
        talk.decide(pair("7", confidence=0.7 if state == "confirming" else 0.95), 2.0)
    if state == "stopped":
        talk.decide(pair("stop"), 2.0)
    assert talk.state == state
    done = talk.decide(pair("stop"), 3.0)
    assert done[0].kind == "stop" and talk.state == "stopped"
    assert kinds(talk.decide(pair("7"), 4.0)) == [("ignored", "7")] and talk.state == "stopped"
    assert talk.moved("", False) == [] and talk.tick(99.0) == [] and talk.activity(True, 99.0) == []
    assert [action.kind for action in talk.resume(0.0)] == ["resume", "say", "state"] and talk.resume(0.0) == []


def test_only_stop_counts_in_what_begins_while_a_sample_is_recorded() -> None:
    talk = Dialogue(SessionOptions(resume_labels=("start",)), MOTIONS)
    talk.only_stop(10.0)
    for ignored in (pair("7", first_s=9.9), pair("9"), pair("5", status=UNKNOWN), pair("5", status=NO_INPUT)):
        (action,) = talk.decide(ignored, 12.0)
        assert action.kind == "ignored" and talk.state == "idle"
    assert talk.decide(ask(), 2.6)[0].kind == "stop", "a weak STOP, as nothing can be asked"
    talk.resume(0.0)
    assert talk.decide(pair("stop"), 3.0)[0].kind == "stop" and talk.state == "stopped"
    assert kinds(talk.decide(pair("start"), 4.0)) == [("ignored", "start")] and talk.state == "stopped"
    talk.resume(0.0)
    assert ("move", "7") in kinds(talk.decide(pair("7", first_s=10.0), 11.0))
    talk.moved("", False)
    talk.only_stop(12.0)
    talk.only_stop(5.0)  # the last call counts
    assert ("move", "7") in kinds(talk.decide(pair("7", first_s=6.0), 13.0))


def test_a_label_may_resume_and_no_ends_a_motion() -> None:
    talk = Dialogue(SessionOptions(resume_labels=("start",)), MOTIONS)
    assert kinds(talk.decide(pair("start"), 1.0)) == [("ignored", "start")]
    talk.decide(pair("stop"), 2.0)
    assert talk.decide(pair("start"), 3.0)[0].kind == "resume" and talk.state == "idle"
    talk.decide(pair("7", first_s=3.2), 4.0)
    assert kinds(talk.decide(pair("no", first_s=4.2), 5.0)) == [("rest", "no"), ("state", "idle")]


def test_a_button_begins_imitation_where_nothing_stands_against_it_and_ends_it() -> None:
    assert kinds(Dialogue(motions=MOTIONS).imitate(0.0)) == [("say", "I cannot imitate you.")]
    talk = Dialogue(SessionOptions(imitate_labels=("7",), wake_labels=("robot",), confirm_below=1.0), MOTIONS)
    assert talk.rest("asked for") == []
    talk.only_stop(2.0)
    assert kinds(talk.imitate(1.9)) == [("ignored", "7")] and talk.state == "idle"
    assert ("move", "7") in kinds(talk.imitate(2.1)) and talk.state == "acting"
    assert kinds(talk.imitate(2.2)) == [("ignored", "7")]
    assert kinds(talk.rest("asked for")) == [("rest", "asked for"), ("state", "idle")]
    talk.imitate(3.0)
    assert talk.halt("asked for")[0].kind == "stop" and talk.state == "stopped"
    assert kinds(talk.imitate(4.0)) == [("ignored", "7")] and talk.rest("asked for") == [] and talk.state == "stopped"


def test_a_fault_of_the_robot_stops_it_and_a_refused_motion_does_not() -> None:
    talk = Dialogue(motions=MOTIONS)
    talk.decide(pair("7"), 1.0)
    assert [a.kind for a in talk.moved("no link", True)] == ["say", "stop", "state"] and talk.state == "stopped"
    talk.resume(0.0)
    talk.decide(pair("7"), 2.0)
    assert kinds(talk.moved("refused", False)) == [("say", "refused"), ("state", "idle")]


@pytest.mark.parametrize(
    ("fields", "message"),
    [
        ({"window_s": -0.1}, "window_s"),
        ({"window_s": math.nan}, "window_s"),
        ({"onset_s": 0.0}, "onset_s"),
        ({"max_wait_s": math.inf}, "max_wait_s"),
        ({"confirm_below": 1.1}, "confirm_below"),
        ({"rule": "tabel_6_9"}, "did you mean 'table_6_9'"),
        ({"wake_labels": "robot"}, "wake_labels"),
        ({"wake_labels": ("stop",)}, "'stop' is one of fusion.stop_labels"),
        ({"yes_labels": ("no",)}, "'no' is one of yes_labels"),
        ({"fusion": None}, "FusionOptions"),
    ],
)
def test_options_are_checked(fields: dict[str, Any], message: str) -> None:
    with pytest.raises(InvalidArgument, match=message):
        SessionOptions(**fields)


def test_times_and_modes_are_checked() -> None:
    with pytest.raises(InvalidArgument, match="times"):
        word("7", 2.0, 1.0)
    with pytest.raises(InvalidArgument, match="times"):
        word("7", math.nan, 1.0)
    with pytest.raises(InvalidArgument, match="no mode 'touch'"):
        Pairer().tick("touch", 1.0)
