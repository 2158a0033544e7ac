# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The studies of sessions: what they play, and that they would see what goes wrong."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from typing import Any

import numpy as np
import pytest

from hri.cli.study import _summary
from hri.live import Event
from hri.robot import HOAP2, rest_positions
from hri.session.logic import session_event
from hri.studies.endurance import rounds_of, same
from hri.studies.session import latencies
from hri.studies.session_judging import Decided, decided_in, judge
from hri.studies.session_soak import decision_of_session
from hri.studies.session_stop import Commands, within_limits
from hri.studies.session_talk import alarms
from hri.studies.session_turns import APART_S, CASES, FPS, PAUSE_S, Talk, Turn, pictures_of, plan, sound_of

WORDS = [(str(digit), 0.4) for digit in range(10)]
SIGNS = [str(digit) for digit in range(10)] * 2


def test_turns_are_up_to_a_second_apart_with_pauses_between_them():
    turns, talk = plan(WORDS, SIGNS, 400, 0)
    assert (turns, talk) == plan(WORDS, SIGNS, 400, 0) != plan(WORDS, SIGNS, 400, 1) and talk == []
    of = {case: [turn for turn in turns if turn.case == case] for case in CASES}
    assert all(num - 25 < len(of[case]) < num + 25 for case, num in zip(CASES, (80, 80, 90, 90, 60), strict=True))
    assert {turn.modes for turn in of["word alone"]} == {(True, False)}
    assert {turn.modes for turn in of["sign alone"]} == {(False, True)}
    for case, gaps in (
        ("word first", [turn.sign_s[0] - turn.word_s[1] for turn in of["word first"]]),
        ("sign first", [turn.word_s[0] - turn.sign_s[1] for turn in of["sign first"]]),
    ):
        assert 0 <= min(gaps) < 0.1 and 0.9 < max(gaps) <= APART_S, f"{case}: from the end of one to the other"
    for turn in of["overlapping"]:
        assert turn.word_s[0] < turn.sign_s[1] and turn.sign_s[0] < turn.word_s[1]
    assert all(SIGNS[turn.sign] == turn.label == WORDS[turn.word][0] for turn in turns if all(turn.modes))
    pauses = [after.span_s[0] - before.span_s[1] for before, after in pairwise(turns)]
    assert PAUSE_S[0] <= min(pauses) and max(pauses) <= PAUSE_S[1]


def test_other_words_come_between_turns_from_their_end_on():
    turns, talk = plan(WORDS, SIGNS, 300, 0, [0.5, 0.9])
    assert 200 < len(talk) < 400
    afters = []
    for one in talk:
        afters.append(one.span_s[0] - max(turn.span_s[1] for turn in turns if turn.span_s[1] <= one.span_s[0]))
        after = min((turn.span_s[0] for turn in turns if turn.span_s[0] > one.span_s[0]), default=np.inf)
        assert after - one.span_s[1] >= PAUSE_S[0]
        assert one.span_s[1] - one.span_s[0] == pytest.approx((0.5, 0.9)[one.word])
    assert 0 <= min(afters) < 0.1 and sum(after_s < APART_S for after_s in afters) > 50
    sound = sound_of(turns[:1], [np.full(400, 0.5, "f4")] * 10, 800, 0, talk[:1], [np.full(400, 0.5, "f4")] * 2)
    first, last = (round(800 * time_s) for time_s in talk[0].span_s)
    assert np.abs(sound[first : min(last, first + 400)]).min() > 0.15 > np.abs(sound[last + 1 :]).max()


def test_latencies_are_counted_by_what_led_to_a_motion():
    def moves(label: str, wait_ms: float) -> Any:
        return Event(9.0, "motion_start", {"label": label, "wait_ms": wait_ms, "compute_ms": 1.0}, mode="robot")

    events = [
        *(fused(1.0, 2.0, "1", "g"), moves("1", 500.0), fused(3.0, 4.0, "2", "sg"), moves("2", 300.0)),
        *(fused(5.0, 6.0, "", "s", "unknown"), fused(7.0, 8.0, "3", "s"), moves("3", 250.0)),
    ]
    assert latencies(events) == {"word": [(250.0, 1.0)], "sign": [(500.0, 1.0)], "both": [(300.0, 1.0)]}


def test_streams_hold_words_and_signs_at_their_times():
    turns = [Turn("1", 0, 0, (1.0, 1.5), (1.2, 3.2)), Turn("2", -1, 1, (6.0, 6.5), (6.0, 8.0))]
    sound = sound_of(turns, [np.full(4000, 0.5, "f4")], 8000, 0)
    assert np.abs(sound[8000:12000]).min() > 0.15 > 0.02 > np.abs(sound[12000:]).max()
    stills = [np.full((50, 50, 3), 40, np.uint8), np.full((50, 50, 3), 200, np.uint8)]
    for still, inside in zip(stills, (90, 220), strict=True):
        still[20:40, 20:40] = inside
    frames = list(pictures_of(turns, stills, 0))
    means = [float(frame[20:40, 20:40].mean()) for frame in frames]
    shown = [i / FPS for i, mean in enumerate(means) if abs(mean - 90) < 2]
    assert 1.5 <= shown[0] <= 1.7 and 2.7 <= shown[-1] <= 2.9
    assert abs(means[round(7.0 * FPS)] - 220) < 2 and abs(means[0] - 40) < 2 and abs(means[round(5.0 * FPS)] - 200) < 2


def fused(first_s: float, last_s: float, label: str, modes: str, status: str = "recognised") -> Any:
    said, shown = ({"label": label} if mode in modes else None for mode in "sg")
    final = label if status == "recognised" else ""
    fields = {"first_s": first_s, "last_s": last_s, "final": final, "status": status, "speech": said, "gesture": shown}
    return session_event(last_s, "fused", **fields)


PAIR = Turn("1", 0, 0, (1.0, 1.5), (1.2, 3.2))
WORD = Turn("2", 1, -1, (6.0, 6.5), (6.0, 8.0))
SIGN = Turn("3", -1, 1, (10.0, 10.4), (10.0, 12.0))
TALK = Talk(0, (12.3, 12.8))
WHOLE = Decided("1", (1.0, 1.5), (1.3, 2.4), False)
ALONE = Decided("2", (6.0, 6.5), None, False)
SHOWN = Decided("3", None, (10.1, 11.2), False)


def faults(*decided: Decided) -> list[set[str]]:
    """Of a pair, a word and a sign: what is wrong with each."""
    found = judge([PAIR, WORD, SIGN], [TALK], decided)
    return [{name for name in ("joined", "beside_rejected", "apart", "missed") if one[name]} for one in found]


def test_what_is_joined_taken_apart_and_missed_is_seen():
    right = judge([PAIR, WORD, SIGN], [TALK], [WHOLE, ALONE, SHOWN, Decided("7", (12.3, 12.8), None, False)])
    assert [one["label"] for one in right] == ["1", "2", "3"]
    assert faults(WHOLE, ALONE, SHOWN) == [set(), set(), set()]
    apart = Decided("1", (1.0, 1.5), None, False), Decided("1", None, (1.3, 2.4), False)
    assert faults(*apart, ALONE, SHOWN) == [{"apart"}, set(), set()]
    assert faults(Decided("1", (6.0, 6.5), (1.3, 2.4), False), SHOWN) == [{"joined", "missed"}, {"joined"}, set()]
    assert faults(Decided("1", (1.0, 1.5), None, False), SHOWN) == [{"missed"}, {"missed"}, set()]
    beside = Decided("3", (12.3, 12.8), (10.1, 11.2), False)
    assert faults(WHOLE, ALONE, beside) == [set(), set(), {"joined"}]
    assert faults(WHOLE, ALONE, replace(beside, rejected=True)) == [set(), set(), {"joined", "beside_rejected"}]
    noise = Decided("2", (6.0, 6.5), (7.0, 8.0), False)
    assert faults(WHOLE, noise, SHOWN) == [set(), {"joined"}, set()], "a sign that was not shown"


def test_talk_that_is_found_with_a_word_as_one_is_joined_to_it():
    talk = [Talk(0, (6.52, 6.9))]
    (found,) = judge([WORD], talk, [Decided("", (6.0, 6.9), None, True)])
    assert found["joined"] and not found["beside_rejected"]


def test_what_was_decided_on_together_is_found_by_the_decisions_of_both_modes():
    def decision(mode: str, first_s: float, last_s: float, confidence: float) -> Any:
        return Event(last_s, "decision", {"first_s": first_s, "last_s": last_s, "confidence": confidence}, mode=mode)

    given = {"label": "1", "status": "recognised", "confidence": 0.8}
    events = [
        *(decision("speech", 1.0, 1.5, 0.8), decision("gesture", 1.3, 2.4, 0.7), decision("speech", 2.0, 2.5, 0.9)),
        session_event(
            2.6, "fused", first_s=1.0, last_s=2.4, final="1", status="recognised",
            speech=given, gesture={**given, "confidence": 0.7},
        ),
        session_event(
            3.9, "fused", first_s=2.0, last_s=2.5, final="", status="unknown",
            speech={"label": "unknown", "status": "unknown", "confidence": 0.9}, gesture=None,
        ),
    ]  # fmt: skip
    assert decided_in(events) == [WHOLE, Decided("", (2.0, 2.5), None, True)]
    with pytest.raises(AssertionError, match="nothing was decided on"):
        decided_in(events[1:])


def test_commands_beyond_the_limits_are_seen():
    def sent(course: Any) -> list[list[float]]:
        kept = Commands()
        for step, angle in enumerate(course):
            kept.joints(0.01 * step, dict.fromkeys(HOAP2.names, 0.0) | rest_positions() | {"head_joint_1": angle})
        return kept.rows

    calm = 0.2 * (1 - np.cos(np.linspace(0, np.pi, 100)))
    assert within_limits(sent(calm.tolist() + [0.4] * 3), 0.01)
    assert not within_limits(sent(calm[:60]), 0.01), "does not end at rest"
    assert not within_limits(sent([0.0, 0.0, 0.04, 0.04, 0.04]), 0.01), "400 rad/s2"
    assert not within_limits(sent([1.2, 1.2, 1.2, 1.2]), 0.01), "beyond the joint's limit"


def test_false_stops_and_commands_of_talk_are_counted():
    heard = [
        fused(1.0, 1.5, "forward", "s"),
        fused(2.0, 2.5, "forward", "s", "unknown"),
        fused(3.0, 3.5, "stop", "s"),
        session_event(3.5, "stop", label="stop", reason="speech"),
        fused(5.0, 5.5, "yes", "s"),
    ]
    assert alarms(iter(heard)) == {"commands": 2, "stops": 1}


def test_what_a_session_decides_in_each_round_is_compared():
    events = [fused(10.0 * turn + 1.0, 10.0 * turn + 1.5, "forward", "s") for turn in range(4)]
    events[2] = fused(21.0, 21.5, "left", "s")
    rounds = list(rounds_of(events, 10.0, decision_of_session))
    assert [same(said, rounds[0]) for said in rounds] == [True, True, False, True]
    assert rounds[0] == [(1.0, "forward", "recognised")]


@pytest.mark.parametrize("name", ["session-digits", "session-soak", "session-stop", "session-talk"])
def test_the_studies_are_listed(name: str):
    from hri.studies import get_study

    assert get_study(name).folds


def test_what_stands_beside_the_rows_is_printed():
    result = {
        "latency": {"stop_wait_ms": {"median": 100.0, "95 %": 250.0, "most": 260.0}},
        "stream_against_file": {"num_words": 67, "substitutions": 7, "deletions": 1, "insertions": 2},
    }
    lines = [line.strip() for line in _summary(result)]
    assert lines[1:3] == ["stop_wait_ms", "median\t100, 95 % 250, most 260"]
    assert lines[4] == "of 67 words\t7 substitutions, 1 deletions, 2 insertions"
