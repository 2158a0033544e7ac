# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What waits in one mode keeps what may belong to it in the other waiting, until both are decided on."""

from __future__ import annotations

import math
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hri.live import Event
from hri.recognition.decision import RECOGNISED, Decision, NBest
from hri.session import Observation, Pair, Pairer, SessionOptions
from hri.session.feeds import Arrival
from hri.session.logic import NoRobot, SessionLogic
from hri.session.mover import Cause

OTHER = {"speech": "gesture", "gesture": "speech"}


def one(mode: str, label: str, first_s: float, last_s: float) -> Observation:
    nbest = (NBest(label, 0.9, math.log(0.9)), NBest("else", 0.1, math.log(0.1)))
    return Observation(Decision(mode, label, RECOGNISED, 0.9, nbest=nbest, class_threshold=0.6), first_s, last_s)


def pairer(window_s: float = 1.0, **options: Any) -> Pairer:
    made = Pairer(SessionOptions(window_s=window_s, **options))
    for mode in OTHER:
        made.join(mode, 0.0)
    return made


def labels(pair: Pair) -> tuple[str, str]:
    """Of the word and of the sign; empty for the one that is missing."""
    speech, gesture = pair.fused.speech, pair.fused.gesture
    return ("" if speech is None else speech.label, "" if gesture is None else gesture.label)


def held(earlier: str, **options: Any) -> Pairer:
    """One of 1.0 to 1.4 s, and one of the other mode of 2.0 to 2.5 s, while something goes on since 2.3 s that may be
    nearer to the second."""
    made = pairer(**options)
    assert made.observe(one(earlier, "first", 1.0, 1.4), 1.6) == []
    made.begin(OTHER[earlier], 2.0, 2.1)
    made.begin(earlier, 2.3, 2.35)
    assert made.observe(one(OTHER[earlier], "second", 2.0, 2.5), 2.6) == []
    return made


@pytest.mark.parametrize("earlier", OTHER)
def test_what_a_pair_waits_for_does_not_take_it_apart(earlier: str) -> None:
    both = ("first", "second") if earlier == "speech" else ("second", "first")
    made = held(earlier)
    # The other mode is long past the window of the first: 1.4 + 1.0 + 0.25 s.
    for time_s in (2.7, 3.0, 4.0):
        assert made.tick(OTHER[earlier], time_s) == []
    assert [labels(pair) for pair in made.drop(earlier, 4.1)] == [both]
    assert made.waiting == 0


@pytest.mark.parametrize("earlier", OTHER)
def test_what_went_on_takes_the_nearer_one(earlier: str) -> None:
    made = held(earlier)
    assert made.tick(OTHER[earlier], 3.0) == []
    alone, pair = made.observe(one(earlier, "third", 2.3, 2.9), 3.2)
    assert set(labels(alone)) == {"first", ""} and "another one was nearer" in alone.why
    assert set(labels(pair)) == {"second", "third"} and made.waiting == 0


@pytest.mark.parametrize("earlier", OTHER)
def test_a_pair_outlives_the_source_of_its_second(earlier: str) -> None:
    made = held(earlier)
    assert made.leave(OTHER[earlier], 2.7) == []
    assert [set(labels(pair)) for pair in made.drop(earlier, 4.1)] == [{"first", "second"}]


def test_nothing_waits_longer_than_max_wait_s() -> None:
    made = held("gesture", max_wait_s=3.0)
    assert made.tick("speech", 4.39) == []
    (alone,) = made.tick("speech", 4.41)
    assert labels(alone) == ("", "first") and "more than 3 s" in alone.why
    assert made.tick("gesture", 5.49) == []
    (alone,) = made.tick("gesture", 5.51)
    assert labels(alone) == ("second", "") and made.waiting == 0


def shown() -> Pairer:
    """A sign that was held from 1.0 to 2.0 s and decided on, and whose hand began to move away at 2.5 s."""
    made = pairer()
    made.begin("gesture", 1.0, 1.2)
    assert made.observe(one("gesture", "sign", 1.0, 2.0), 2.0) == []
    made.begin("gesture", 2.5, 2.6)
    return made


@pytest.mark.parametrize(("word_s", "paired"), [(2.4, True), (3.2, True), (3.79, True), (3.85, False)])
def test_a_sign_that_is_taken_away_ends_then(word_s: float, paired: bool) -> None:
    made = shown()
    assert made.drop("gesture", 3.1, 2.8) == []
    assert made.tick("speech", min(3.9, word_s)) == made.tick("gesture", min(3.9, word_s)) == []
    made.begin("speech", word_s, word_s + 0.1)
    pairs = made.tick("gesture", 4.1) + made.observe(one("speech", "word", word_s, word_s + 0.5), word_s + 0.8)
    assert [labels(pair) for pair in pairs] == [("word", "sign") if paired else ("", "sign")]
    if paired:
        assert pairs[0].apart_s == pytest.approx(max(0.0, word_s - 2.8))
        assert pairs[0].last_s == max(2.0, word_s + 0.5), "it was found to end before that"


def test_a_sign_waits_while_it_may_be_taken_away_and_no_longer() -> None:
    made = shown()
    for time_s in (3.0, 3.5, 3.9):
        assert made.tick("speech", time_s) == made.tick("gesture", time_s) == []
    (alone,) = made.tick("gesture", 4.01)  # what has gone on for 1.5 s is another gesture
    assert labels(alone) == ("", "sign")
    held = pairer()
    held.observe(one("gesture", "sign", 1.0, 2.0), 2.0)
    assert held.tick("speech", 3.2) == []
    (alone,) = held.tick("speech", 3.3)
    assert labels(alone) == ("", "sign"), "one that is held on does not wait for its end"


@pytest.mark.parametrize("gone_s", [-math.inf, 2.9])
def test_what_comes_after_it_was_taken_away_does_not_prolong_a_sign(gone_s: float) -> None:
    made = shown()
    assert made.drop("gesture", 3.0, gone_s) == []
    made.begin("gesture", 3.1, 3.2)
    if gone_s > 0:
        assert made.drop("gesture", 3.5, 3.45) == []
        (alone,) = made.tick("speech", 4.2)  # 2.9 + 1.0 + 0.25 s
        assert labels(alone) == ("", "sign")
    else:
        made.drop("gesture", 3.5)
        assert [labels(pair) for pair in made.tick("speech", 3.5)] == [("", "sign")]


def test_an_unsure_stop_is_not_held_back_by_the_hand_that_showed_it() -> None:
    made = pairer()
    stop = Decision("gesture", "stop", RECOGNISED, 0.4, nbest=(NBest("stop", 0.4, -0.9), NBest("up", 0.3, -1.2)))
    assert made.observe(Observation(stop, 1.0, 2.0), 2.0) == []
    made.begin("gesture", 2.5, 2.6)
    made.hurried = True
    assert [labels(pair) for pair in made.tick("gesture", 2.7)] == [("", "stop")]


class Caused(NoRobot):
    """Keeps what each motion answers."""

    def __init__(self) -> None:
        super().__init__()
        self.causes: list[Cause] = []

    def begin(self, label: str, cause: Cause) -> None:
        self.causes.append(cause)
        super().begin(label, cause)


@pytest.mark.parametrize("paired", [False, True])
def test_what_waited_counts_the_time_that_recognising_it_took(paired: bool) -> None:
    body = Caused()
    logic = SessionLogic(SessionOptions(confirm_below=0.0, window_s=1.0), body, ("up",))

    def heed(mode: str, kind: str, time_s: float, at_s: float, found: Observation | None = None, **fields: Any) -> None:
        if found is not None:
            fields |= {"first_s": found.first_s, "last_s": found.last_s}
        logic.process(Arrival(Event(time_s, kind, fields, found and found.decision, mode), at_s))

    heed("speech", "listening", 0.0, 90.0)
    heed("gesture", "watching", 0.0, 90.0)
    heed("speech", "decision", 1.8, 100.0, one("speech", "up", 1.0, 1.5), compute_ms=40.0)
    assert body.causes == []
    if paired:  # an arrival's time is that of before the sign was recognised
        heed("gesture", "decision", 2.6, 101.0, one("gesture", "up", 1.7, 2.4), compute_ms=30.0)
    else:
        heed("gesture", "hand", 2.8, 101.0)
    (cause,) = body.causes
    assert (cause.last_s, cause.time_s) == ((2.4, 2.6) if paired else (1.5, 2.8))
    assert cause.computed_s == pytest.approx(101.0 - 0.04)


TURNS = st.lists(
    st.tuples(
        st.sampled_from(sorted(OTHER)), st.floats(0.0, 1.5), st.floats(0.1, 2.0), st.floats(0.0, 0.5), st.booleans()
    ),
    min_size=2,
    max_size=12,
)


@settings(max_examples=200, deadline=None)
@given(TURNS)
def test_nothing_is_let_go_beside_what_may_belong_to_it(turns: list[tuple[str, float, float, float, bool]]) -> None:
    """Of each mode: a pause, how long something goes on, how late it is decided on, and whether it is anything."""
    window_s, most_s = 1.0, 6.0
    made = pairer(window_s=window_s, max_wait_s=most_s)
    heard = dict.fromkeys(OTHER, 0.0)
    events = []
    for number, (mode, pause_s, length_s, late_s, real) in enumerate(turns):
        first_s, last_s = heard[mode] + pause_s, heard[mode] + pause_s + length_s
        heard[mode] = last_s + late_s
        events.append((first_s, number, 0, mode, first_s, last_s, real))
        events.append((heard[mode], number, 1, mode, first_s, last_s, real))
    end_s = max(heard.values())
    ticks = [(0.1 * i, -1, 2, mode, 0.0, 0.0, False) for i in range(round(10 * end_s) + 80) for mode in OTHER]
    num_real = sum(real for *_, real in turns)
    found = 0
    for time_s, number, kind, mode, first_s, last_s, real in sorted(events + ticks):
        before = {m: [*made._streams[m].waiting] for m in OTHER}
        if kind == 0:
            made.begin(mode, first_s, time_s)
            pairs = []
        elif kind == 1 and real:
            new = one(mode, str(number), first_s, last_s)
            before[mode].append(new)
            pairs = made.observe(new, time_s)
        else:
            pairs = made.drop(mode, time_s) if kind == 1 else made.tick(mode, time_s)
        paired = {name for pair in pairs if "" not in labels(pair) for name in labels(pair)}
        for pair in pairs:
            found += 2 - labels(pair).count("")
            if "" not in labels(pair) or time_s >= pair.last_s + most_s or "nearer" in pair.why:
                continue
            alone = "speech" if pair.fused.speech is not None else "gesture"
            for other in before[OTHER[alone]]:
                apart_s = max(0.0, pair.first_s - other.last_s, other.first_s - pair.last_s)
                gone = other.decision.label in paired or time_s >= other.last_s + most_s
                assert apart_s > window_s or gone, f"{labels(pair)} at {time_s}: {pair.why}"
    assert found == num_real and made.waiting == 0
