# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Sessions when something goes wrong: sources that fail again and again, STOP in a flood, motions that end late."""

from __future__ import annotations

import math
import threading
import time
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest

import hri
from conftest import RATE_HZ
from drawn_hands import FPS
from hri.core.errors import FormatError, InvalidArgument, IoError
from hri.fusion import FusionOptions
from hri.live import ArraySource, ClipSource, Event, Listener, Stalled
from hri.live.events import STALL
from hri.recognition.decision import Decision, NBest
from hri.robot import Robot, Trajectory, open_robot
from hri.robot.imitation import LiveImitation, SeenPerson
from hri.session import EventQueue, Session, SessionOptions
from hri.session.dialogue import ACTING, IDLE
from hri.session.feeds import Alignment, Feed, merge
from hri.session.live import LiveFeeds
from hri.session.logic import NoRobot, SessionLogic, moved_event
from hri.session.mover import Cause, Moved, Mover
from session_people import MOTIONS, signing, speech, train_signs, train_words

pytest.importorskip("cv2")

CAUSE = Cause(0.0, 0.0, 0.0)
RETRY_S = 0.1


@pytest.fixture(scope="module")
def words() -> hri.WordRecognizer:
    return train_words()


@pytest.fixture
def robot() -> Iterator[Robot]:
    with open_robot("kinematic") as opened:
        yield opened


class Broken:
    """A source that opens, and whose watcher raises `error`; it counts how often it was opened."""

    name, sample_rate_hz, num_lost = "broken", RATE_HZ, 0

    def __init__(self, error: Exception) -> None:
        self.error, self.num_opened = error, 0

    def __call__(self) -> Broken:
        self.num_opened += 1
        return self

    def watch(self, source: Any) -> Iterator[Event]:
        yield Event(0.0, "listening", {}, mode="speech")
        raise self.error

    def close(self) -> None:
        """It stays open."""


def run_live(error: Exception) -> tuple[Broken, list[Event], float]:
    broken = Broken(error)
    begin_s = time.monotonic()
    feeds = LiveFeeds([Feed("speech", broken, broken.watch, lambda: time.monotonic() - begin_s)], RETRY_S)
    feeds.start()
    while broken.num_opened < 4 and time.monotonic() < begin_s + 60.0:
        time.sleep(RETRY_S / 4)
    feeds.close()
    passed_s = time.monotonic() - begin_s
    events = []
    while (arrival := feeds.queue.get(0.0)) is not None:
        events.append(arrival.event)
    return broken, events, passed_s


@pytest.mark.parametrize("error", [FormatError("samples are NaN"), Stalled("gone"), RuntimeError("driver")])
def test_a_source_that_fails_as_soon_as_it_is_open_is_opened_again_at_the_rate_that_is_asked_for(
    error: Exception,
) -> None:
    broken, events, passed_s = run_live(error)
    assert 4 <= broken.num_opened <= 1 + passed_s / RETRY_S
    stalls = [event.fields["message"] for event in events if event.event == STALL]
    if isinstance(error, Stalled):
        assert stalls == []
    else:
        assert stalls and set(stalls) == {"RuntimeError: driver" if type(error) is RuntimeError else str(error)}


def test_what_a_source_of_a_recording_raises_is_not_hidden() -> None:
    broken = Broken(RuntimeError("driver"))
    with pytest.raises(RuntimeError, match="driver"):
        list(Feed("speech", broken, broken.watch).events())


@pytest.mark.parametrize("error", [FormatError("damaged"), Stalled("gone")])
def test_a_recording_that_brings_nothing_new_is_given_up(error: Exception) -> None:
    broken = Broken(error)
    arrivals = []
    for arrival in merge([Feed("speech", broken, broken.watch)], RETRY_S):
        arrivals.append(arrival)
        assert len(arrivals) < 50
    assert broken.num_opened == 2


def test_two_sessions_cannot_read_one_source(words: hri.WordRecognizer) -> None:
    shared = ArraySource(speech([("flat", 1.5)], 4.0), RATE_HZ, name="the microphone")
    first = Session(words).run(shared)
    next(first)
    with pytest.raises(IoError, match="the microphone is in use: another session reads it"):
        list(Session(words).run(shared))
    live = list(Session(words).run(lambda: shared, live=True))
    assert [e.fields["message"] for e in live if e.event == STALL and "in use" in e.fields["message"]]
    assert "flat" in [e.fields["final"] for e in first if e.event == "fused"], "the first goes on"
    assert list(Session(words).run(shared)), "it is free again"


def test_a_second_session_of_one_camera_is_refused_and_hears_and_the_first_goes_on(words: hri.WordRecognizer) -> None:
    signs = train_signs()
    shared = ClipSource(signing([("tall", 1.2)], 4.0), FPS, name="the camera")
    first = Session(words, signs).run(ArraySource(speech([], 4.0), RATE_HZ), shared)
    next(first)
    with pytest.raises(IoError, match="the camera is in use: another session reads it"):
        list(Session(None, signs).run(pictures=shared))
    second = list(
        Session(words, signs).run(ArraySource(speech([("flat", 1.5)], 4.0), RATE_HZ), lambda: shared, live=True)
    )
    message = {e.fields["message"] for e in second if e.event == STALL and e.mode == "gesture"}
    assert message == {"the camera is in use: another session reads it; give each session a source of its own"}
    assert "flat" in [e.fields["final"] for e in second if e.event == "fused"], "its microphone goes on"
    assert "tall" in [e.fields["final"] for e in first if e.event == "fused"], "so does the first session"


def test_a_source_is_back_when_it_is_open_again() -> None:
    _, events, _ = run_live(Stalled("gone"))
    times = [event.time for event in events if event.event == "reconnected"]
    assert len(times) >= 2 and times[0] >= RETRY_S / 2 and times[1] >= times[0] + RETRY_S / 2


class Busy:
    """A recorder that takes no session."""

    def begin(self, about: Any) -> None:
        raise IoError("no place to write")


@pytest.mark.parametrize("live", [False, True])
def test_what_was_given_open_is_closed_where_a_session_cannot_begin(words: hri.WordRecognizer, live: bool) -> None:
    class Closing(ArraySource):
        closed = False

        def close(self) -> None:
            self.closed = True

    sound = Closing(speech([("flat", 0.8)], 2.5), RATE_HZ)
    with pytest.raises(IoError, match="no place"):
        list(Session(words).run(sound, live=live, recorder=Busy()))  # type: ignore[arg-type]
    assert sound.closed
    session, heard = Session(words), Closing(speech([("flat", 0.8)], 2.5), RATE_HZ)
    first = session.run(heard)
    next(first)
    with pytest.raises(InvalidArgument, match="running already"):
        list(session.run(heard))
    assert not heard.closed, "the first session reads it"
    first.close()  # type: ignore[attr-defined]


def delays(gap_s: float = 0.0, late_s: float = 0.0, counted: bool = False) -> list[float]:
    """Offsets of 12 s of blocks of 20 ms; at 3 s something is lost, or the reader is late and makes up for it."""
    now_s = 0.0
    alignment = Alignment(math.inf, lambda: now_s)
    found = []
    free_s = 0.0
    for number in range(600):
        lost_s = gap_s if number == 150 else 0.0
        come_s = 0.02 * (number + 1) + (gap_s if number >= 150 else 0.0) + 0.01 * (number % 4)
        free_s = now_s = max(come_s, free_s) + (late_s if number == 150 else 0.001)
        alignment.note(0.02 * (number + 1), 0.02, lost_s if counted else 0.0)
        found.append(alignment.offset_s)
    return found


@pytest.mark.parametrize("counted", [False, True])
def test_what_is_lost_shifts_the_time_of_what_comes_after_it(counted: bool) -> None:
    found = delays(gap_s=1.5, counted=counted)
    assert found[149] == pytest.approx(0.0, abs=0.02)
    assert found[-1] == pytest.approx(1.5, abs=0.02) and found[150 + 200] == pytest.approx(1.5, abs=0.02)


def test_a_reader_that_is_late_shifts_no_times() -> None:
    assert max(delays(late_s=3.0)) < 0.02 and max(delays(gap_s=0.2)) < 0.05


def decided(label: str) -> Event:
    decision = Decision("speech", label, "recognised", 0.9, nbest=(NBest(label, 0.9, 0.0),))
    return Event(0.0, "decision", {}, decision=decision, mode="speech")


def test_a_flood_of_stalls_drops_no_decision_and_no_button() -> None:
    events = EventQueue(capacity=1)
    kept = [decided("stop"), Event(0.0, "asked", {"command": "stop"}, mode="session")]
    for event in kept:
        events.put(event)
    for number in range(100):
        events.put(Event(float(number), STALL, {"message": ""}, mode="gesture"))
    got = []
    while (arrival := events.get(0.0)) is not None:
        got.append(arrival.event)
    assert got[:2] == kept and len(got) == 16 and got[-1].time == 99.0
    assert events.num_lost == 102 - 16


def begun(logic: SessionLogic, label: str) -> None:
    logic._do(logic.dialogue._move(label), CAUSE, [])


@pytest.mark.parametrize(("number", "state"), [(1, ACTING), (2, IDLE)])
def test_the_end_of_an_earlier_motion_is_not_that_of_the_newest(number: int, state: str) -> None:
    logic = SessionLogic(SessionOptions(), NoRobot(reports=False), ("flat", "tall"))
    begun(logic, "flat")
    logic._do(logic.dialogue._calm(), CAUSE, [])  # taken back; it still brakes
    begun(logic, "tall")
    logic._moved(moved_event(Moved("motion_end", "flat", 1.0, number)), CAUSE, [])
    assert logic.dialogue.state == state


def test_a_fault_in_an_earlier_motion_stops_the_newest() -> None:
    logic = SessionLogic(SessionOptions(), NoRobot(reports=False), ("flat", "tall"))
    begun(logic, "flat")
    begun(logic, "tall")
    out: list[Event] = []
    logic._moved(moved_event(Moved("motion_end", "flat", 1.0, 1, "It is off.", True)), CAUSE, out)
    assert logic.dialogue.state == "stopped" and "stop" in [event.event for event in out]


@pytest.mark.parametrize(("moving", "confidence", "own"), [(False, 0.4, True), (True, 0.4, False), (False, 0.9, False)])
def test_while_the_robot_speaks_stop_has_to_be_sure_unless_it_moves(moving: bool, confidence: float, own: bool) -> None:
    logic = SessionLogic(SessionOptions(), NoRobot(reports=False), ("flat", "tall"))
    logic._own_voice.begin("flat.", 1.0)
    if moving:
        begun(logic, "flat")
    heard = Decision("speech", "stop", "recognised", confidence, nbest=())
    assert logic._is_own(Event(2.5, "decision", {"first_s": 1.5, "last_s": 2.0}, heard, "speech")) is own


def test_stop_drops_a_motion_that_waits(robot: Robot) -> None:
    mover = Mover(robot, MOTIONS)
    try:
        mover.begin("tall", CAUSE)
        mover.advance(0.5)
        mover.begin("flat", CAUSE)
        mover.stop(CAUSE)
        ended = [moved for moved in mover.advance(5.0) if moved.kind == "motion_end"]
        mover.resume()
        ended += [moved for moved in mover.advance(20.0) if moved.kind == "motion_end"]
        assert [(moved.label, moved.number, moved.completed) for moved in ended] == [("tall", 1, False)]
    finally:
        mover.close()


def test_a_mover_that_is_closed_begins_nothing(robot: Robot) -> None:
    mover = Mover(robot, MOTIONS)
    mover.close()
    mover.begin("tall", CAUSE)
    assert not mover.busy and mover.advance(5.0) == []


def test_a_new_session_does_not_imitate_what_was_seen_in_the_one_before() -> None:
    imitation = LiveImitation()
    person = SeenPerson((300.0, 100.0), (100.0, 100.0), (200.0, 60.0), 300.0)
    imitation.process(person, 5.0)
    assert imitation.target_at(5.0) is not None
    imitation.reset()
    assert imitation.target_at(5.0) is None
    imitation.process(person, 5.0)
    imitation.process(None, 1.0)  # another stream has begun
    assert imitation.target_at(5.5) is None and imitation.target_at(1.0) is not None


def test_a_caller_that_leaves_in_mid_motion_stops_the_robot(words: Any, robot: Robot) -> None:
    slow = Trajectory(["head_joint_1"], 100.0, [[0.0], [0.5], [0.0]])
    session = Session(words, None, robot, motions={**MOTIONS, "flat": slow})
    source = ArraySource(speech([("flat", 0.5)], 3.0), RATE_HZ)
    events: Any = session.run(lambda: source, live=True)
    moves = False
    for event in events:
        if event.event == "motion_start":
            moves = True
            break
    assert moves, "the word moves the robot"
    begin_s = time.monotonic()
    events.close()
    ended = [event for event in robot.events if event.ended_motion]
    assert ended and time.monotonic() - begin_s < slow.duration_s / 2


def test_a_signal_may_ask_while_its_thread_does(words: Any) -> None:
    session = Session(words)

    def interrupted() -> None:
        with session._asking:
            session.stop()

    thread = threading.Thread(target=interrupted, daemon=True)
    thread.start()
    thread.join(60.0)
    assert not thread.is_alive()


@pytest.mark.parametrize("for_s", [None, "3", float("nan"), float("inf"), -1.0])
def test_only_stop_takes_times(words: Any, for_s: Any) -> None:
    with pytest.raises(InvalidArgument, match="for_s"):
        Session(words).only_stop(for_s)


@pytest.mark.parametrize(
    "make",
    [
        lambda words: SessionOptions(window_s="1"),
        lambda words: SessionOptions(stop_at_rest=None),
        lambda words: SessionOptions(retry_s=True),
        lambda words: SessionOptions(rule=5),
        lambda words: SessionOptions(language=None),
        lambda words: FusionOptions(stop_labels=None),
        lambda words: FusionOptions(stop_labels=("",)),
        lambda words: Listener(words, urgent="stop"),
    ],
)
def test_options_of_another_type_are_refused_by_name(words: Any, make: Callable[[Any], Any]) -> None:
    with pytest.raises(InvalidArgument, match=r"window_s|stop_at_rest|retry_s|rule|language|stop_labels|urgent"):
        make(words)


def test_numbers_of_numpy_are_numbers() -> None:
    assert SessionOptions(window_s=np.float32(1.0), stop_at_rest=np.float64(0.5)).stop_at_rest == 0.5
