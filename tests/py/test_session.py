# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Sessions over files and devices: the same recording gives the same decisions, and the robot answers and stops."""

from __future__ import annotations

import gc
import time
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import hri
from conftest import RATE_HZ
from drawn_hands import FPS
from hri.core.errors import FormatError, InvalidArgument, IoError, NotFittedError
from hri.live import ArraySource, ClipSource, Event, Stalled
from hri.robot import HOAP2, NAO, Robot, open_robot, write_short_csv
from hri.session import EventQueue, LabelMotions, Session, SessionOptions, read_motions
from hri.session.mover import Cause, Mover
from hri.studies.endurance import RepeatedPictures, RepeatedSound, memory_bytes
from session_people import MOTIONS, NOD, TURN, signing, speech, train_signs, train_words

pytest.importorskip("cv2")

CAUSE = Cause(0.0, 0.0, 0.0)
SAID = [("flat", 1.5), ("tall", 7.0), ("stop", 10.2)]
SHOWN = [("flat", 1.2)]
LENGTH_S = 13.0


@pytest.fixture(scope="module")
def words() -> hri.WordRecognizer:
    return train_words()


@pytest.fixture(scope="module")
def signs() -> hri.GestureRecognizer:
    return train_signs()


@pytest.fixture(scope="module")
def stream() -> np.ndarray:
    return speech(SAID, LENGTH_S)


@pytest.fixture(scope="module")
def frames() -> list[Any]:
    return signing(SHOWN, LENGTH_S)


@pytest.fixture
def robot() -> Iterator[Robot]:
    with open_robot("kinematic") as opened:
        yield opened


def shape(events: Iterable[Event]) -> list[tuple[Any, ...]]:
    """What may not differ from one run to the next."""
    timed = ("compute_ms", "wait_ms")
    return [(e.time, e.event, e.mode, {k: v for k, v in e.fields.items() if k not in timed}) for e in events]


@pytest.mark.parametrize("stop_first", [True, False])
def test_a_question_in_mid_motion_releases_no_stop(robot: Robot, stop_first: bool) -> None:
    mover = Mover(robot, MOTIONS)
    try:
        mover.begin("tall", CAUSE)
        mover.advance(0.5)
        if stop_first:
            robot.stop()  # as by a button, in another thread
        mover.rest(CAUSE)
        if not stop_first:
            robot.stop()
        mover.advance(5.0)
        assert robot.stopped
        mover.resume()
        mover.begin("flat", CAUSE)
        assert [moved.completed for moved in mover.advance(20.0) if moved.kind == "motion_end"] == [True]
    finally:
        mover.close()


def test_a_question_in_mid_motion_ends_that_motion_alone(robot: Robot) -> None:
    mover = Mover(robot, MOTIONS)
    try:
        mover.begin("tall", CAUSE)
        mover.advance(0.5)
        mover.rest(CAUSE)
        (ended,) = [moved for moved in mover.advance(5.0) if moved.kind == "motion_end"]
        assert not ended.completed and ended.time_s < 1.5 and not robot.stopped
    finally:
        mover.close()


def of(events: Iterable[Event], *kinds: str) -> list[Event]:
    return [event for event in events if event.event in kinds]


def test_a_recorded_scene_is_decided_on_and_carried_out(
    words: Any, signs: Any, stream: Any, frames: Any, robot: Robot
) -> None:
    sent: list[tuple[float, dict[str, float]]] = []
    spoken: list[str] = []
    session = Session(words, signs, robot, motions=MOTIONS, on_say=spoken.append)
    assert session.motions.keys() == {"flat", "tall"} and session.refused == {}
    send = robot._command
    robot._command = lambda positions: (sent.append((robot.time_s, dict(robot._commanded))), send(positions))[1]  # type: ignore[method-assign]
    events = list(session.run(ArraySource(stream, RATE_HZ), ClipSource(frames, FPS)))
    both, alone, stop = of(events, "fused")
    assert (both.fields["final"], both.fields["carried_by"]) == ("flat", "both") and both.fields["speech"]
    assert (alone.fields["final"], alone.fields["gesture"]) == ("tall", None)
    assert stop.fields["rule"] == "stop: recognised in speech"
    states = [e.fields["state"] for e in of(events, "state")]
    assert states[:2] == ["listening", "acting"] and states[-3:] == ["listening", "acting", "stopped"]
    done = [(e.fields["label"], e.fields["completed"]) for e in of(events, "motion_end")]
    assert done == [("flat", True), ("tall", False)] and robot.stopped and spoken == ["flat.", "tall."]
    start = of(events, "motion_start")[1]
    assert start.time == alone.time and 0 < start.fields["wait_ms"] < 2000 and start.fields["compute_ms"] > 0
    (halt,) = of(events, "halt")
    said_until_s = stop.fields["last_s"]
    assert said_until_s == pytest.approx(10.7, abs=0.1)
    assert halt.time - stop.time <= 2 * robot.step_s + 1e-9
    assert halt.fields["wait_ms"] == pytest.approx(1000 * (halt.time - said_until_s), abs=0.1)
    assert all(e.time <= LENGTH_S for e in events) and [e.time for e in events] == sorted(e.time for e in events)
    # In mid-motion, and within the limits until the joints rest.
    rows = np.array([[positions["head_joint_1"]] for _, positions in sent[-40:]])
    speeds = np.diff(rows, axis=0) / robot.step_s
    assert np.abs(speeds[0]).max() > 0.1 or np.abs(speeds).max() > 0.1
    assert np.abs(speeds[-1]).max() < 1e-9
    assert np.abs(np.diff(speeds, axis=0) / robot.step_s).max() <= HOAP2.max_acceleration_rad_s2 * 1.001


def test_the_same_recording_gives_the_same_events(words: Any, signs: Any, stream: Any, frames: Any) -> None:
    runs = []
    for _ in range(2):
        with open_robot("kinematic") as robot:
            session = Session(words, signs, robot, motions=MOTIONS)
            runs.append(shape(session.run(ArraySource(stream, RATE_HZ), ClipSource(frames, FPS))))
    assert runs[0] == runs[1] and len(runs[0]) > 100


def test_each_mode_works_alone(words: Any, signs: Any, stream: Any, frames: Any) -> None:
    session = Session(words, signs)
    heard = of(session.run(sound=ArraySource(stream, RATE_HZ)), "fused")
    assert [e.fields["final"] for e in heard] == ["flat", "tall", "stop"]
    seen = of(session.run(pictures=ClipSource(frames, FPS)), "fused")
    assert [e.fields["final"] for e in seen] == ["flat"] and "no source of speech" in seen[0].fields["why"]


class Vanishing(ArraySource):
    """Sound that is there for a while."""

    def __init__(self, samples: np.ndarray, ends: bool = False) -> None:
        super().__init__(samples, RATE_HZ, "vanishing")
        self.ends = ends

    def read(self) -> Any:
        block = super().read()
        if block is None and not self.ends:
            raise Stalled("vanishing: no sound for 2 s")
        return block


def test_a_source_that_vanishes_leaves_the_other_and_comes_back(words: Any, signs: Any, frames: Any) -> None:
    opened: list[Any] = []

    def open_sound() -> Vanishing:
        opened.append(None)
        if len(opened) == 2:
            raise IoError("still away")
        begin_s = 0.0 if len(opened) == 1 else 4.5
        samples = speech([("tall", 7.0)], LENGTH_S)
        until_s = 0.5 if len(opened) == 1 else LENGTH_S
        return Vanishing(samples[round(begin_s * RATE_HZ) : round(until_s * RATE_HZ)], ends=len(opened) == 3)

    options = SessionOptions(retry_s=2.0)
    events = list(Session(words, signs, options=options).run(open_sound, ClipSource(frames, FPS)))
    (stall,), (back,) = of(events, "stall"), of(events, "reconnected")
    assert (
        stall.mode == "speech" and stall.time == pytest.approx(0.5, abs=0.05) and "no sound" in stall.fields["message"]
    )
    assert back.time == pytest.approx(4.5, abs=0.2) and len(opened) == 3
    signed, said = of(events, "fused")
    assert signed.fields["final"] == "flat" and "no source of speech" in signed.fields["why"]
    assert said.fields["final"] == "tall" and said.fields["first_s"] == pytest.approx(7.0, abs=0.3)
    gone = list(Session(words, signs).run(Vanishing(speech([], 0.5)), ClipSource(frames, FPS)))
    assert [e.fields["final"] for e in of(gone, "fused")] == ["flat"], "one that was given open stays away"


def test_pictures_that_change_their_size_begin_anew(words: Any, signs: Any, frames: Any) -> None:
    import cv2

    small = [cv2.resize(frame, (96, 96)) for frame in frames]
    cut = round(0.8 * FPS)
    mixed = [*small[:cut], *frames[cut:], *small[:3], *frames[:3]]
    events = list(Session(words, signs).run(pictures=ClipSource(mixed, FPS)))
    assert [e.fields["message"] for e in of(events, "stall")][:2] == [
        "frames: pictures of 96 x 96 are now 160 x 160",
        "frames: pictures of 160 x 160 are now 96 x 96",
    ]
    assert len(of(events, "reconnected")) == 3 and events[-1].event == "ended"
    assert [e.fields["final"] for e in of(events, "fused")] == ["flat"]


def test_a_robot_that_raises_in_mid_motion_stops_and_the_session_goes_on(
    words: Any, stream: Any, robot: Robot, monkeypatch: pytest.MonkeyPatch
) -> None:
    session = Session(words, robot=robot, motions=MOTIONS)
    send, count = robot._command, 0

    def fail(positions: Any) -> None:
        nonlocal count
        count += 1
        if count == 20:
            raise OSError("no route to the robot")
        send(positions)

    monkeypatch.setattr(robot, "_command", fail)
    events = list(session.run(ArraySource(stream, RATE_HZ)))
    (end,) = of(events, "motion_end")
    assert end.fields["fault"] and "no route to the robot" in end.fields["message"]
    assert (
        "does not obey" in of(events, "say")[1].fields["text"] and of(events, "state")[-1].fields["state"] == "stopped"
    )
    assert [e.fields["final"] for e in of(events, "fused")] == ["flat", "tall", "stop"]
    assert count == 20 and robot.stopped


def test_stop_and_resume_by_the_caller(words: Any, robot: Robot) -> None:
    stream = speech([("tall", 1.0), ("flat", 4.5), ("flat", 7.0)], 9.0)
    session = Session(words, robot=robot, motions=MOTIONS)
    events = []
    pressed = [(3.0, session.stop), (6.0, session.resume)]
    for event in session.run(ArraySource(stream, RATE_HZ)):
        events.append(event)
        if pressed and event.time >= pressed[0][0]:
            pressed.pop(0)[1]()
    kinds = [e.event for e in of(events, "stop", "ignored", "resumed", "motion_start")]
    assert kinds == ["motion_start", "stop", "ignored", "resumed", "motion_start"]
    assert [e.fields["completed"] for e in of(events, "motion_end")] == [False, True]


@pytest.mark.parametrize("live", [False, True])
@pytest.mark.parametrize("goes_on", [False, True])
def test_stop_is_not_lost_while_a_session_begins(words: Any, robot: Robot, live: bool, goes_on: bool) -> None:
    session = Session(words, robot=robot, motions=MOTIONS)
    begun = session.run(ArraySource(speech([("flat", 0.8)], 2.5), RATE_HZ, paced=live), live=live)
    session.stop()
    if goes_on:
        session.resume()
    events = list(begun)
    assert [e.event for e in of(events, "stop", "resumed")] == (["stop", "resumed"] if goes_on else ["stop"])
    assert len(of(events, "motion_start")) == goes_on and robot.stopped != goes_on
    if not goes_on:
        assert of(events, "ignored")[-1].fields["reason"] == "stopped until resume"


def test_stop_of_before_a_session_comes_before_what_is_heard(words: Any, robot: Robot) -> None:
    class Late(Session):
        def _deliver_to(self, queue: EventQueue) -> None:
            time.sleep(0.5)
            super()._deliver_to(queue)

    session = Late(words, robot=robot, motions=MOTIONS)
    begun = session.run(ArraySource(speech([("flat", 0.8)], 2.5), RATE_HZ), live=True)
    session.stop()
    events = list(begun)
    assert [e.event for e in of(events, "stop", "fused", "ignored")] == ["stop", "fused", "ignored"]


def test_what_was_asked_for_between_two_sessions_is_not_asked_for_again(words: Any, robot: Robot) -> None:
    session = Session(words, robot=robot, motions=MOTIONS)
    sound = speech([("flat", 0.8)], 2.5)
    list(session.run(ArraySource(sound, RATE_HZ), live=True))
    session.stop()
    robot.resume()
    assert of(list(session.run(ArraySource(sound, RATE_HZ))), "stop") == []


def test_what_is_missing_is_refused(words: Any, signs: Any, robot: Robot) -> None:
    sound = ArraySource(speech([], 0.5), RATE_HZ)
    with pytest.raises(InvalidArgument, match="needs a recogniser"):
        Session()
    with pytest.raises(NotFittedError):
        Session(hri.WordRecognizer())
    with pytest.raises(InvalidArgument, match="'robot' is in no vocabulary: flat, stop, tall"):
        Session(words, options=SessionOptions(wake_labels=("robot",)))
    session = Session(signs=signs)
    with pytest.raises(InvalidArgument, match="a source of sound or of pictures"):
        session.run()
    with pytest.raises(InvalidArgument, match="sound needs a recogniser of words"):
        session.run(sound)
    robot.stop()
    with pytest.raises(InvalidArgument, match="resume"):
        Session(words, robot=robot, motions=MOTIONS).run(sound)
    robot.resume()
    one, other = (Session(words, robot=robot, motions=MOTIONS) for _ in range(2))
    running = one.run(ArraySource(speech([], 1.0), RATE_HZ))
    next(running)
    with pytest.raises(InvalidArgument, match="another session moves it"):
        next(other.run(sound))
    with pytest.raises(InvalidArgument, match="running already"):
        next(one.run(sound))
    running.close()  # type: ignore[attr-defined]
    assert robot.on_command is None and list(one.run(ArraySource(speech([], 1.0), RATE_HZ)))


def test_motions_that_the_robot_cannot_make_are_refused_by_name(words: Any, robot: Robot) -> None:
    from hri.robot import Trajectory

    wild = Trajectory(["head_joint_2"], 0.01, [[0.0], [0.5], [0.0]])
    session = Session(words, robot=robot, motions={"flat": wild})
    assert "too fast" in session.refused["flat"] or "rad/s" in session.refused["flat"]
    assert session.refused["tall"] == "it is in no motion" and session.motions == {}
    events = list(session.run(ArraySource(speech([("flat", 1.0)], 4.0), RATE_HZ)))
    assert [e.fields["text"] for e in of(events, "say")] == ["I have no motion for flat."]


def test_motions_of_labels_are_read_and_checked(tmp_path: Path) -> None:
    table, motion = tmp_path / "motions.toml", tmp_path / "nod.csv"
    write_short_csv(motion, NOD)
    table.write_text('pinch = "agree"\nnext = "nod.csv"\n', encoding="utf-8")
    found = read_motions(table)
    assert list(found) == ["pinch", "next"] and found["next"].joint_names == NOD.joint_names
    assert "head_joint_2" in found["pinch"].joint_names
    assert "HeadPitch" in read_motions(only(table), NAO)["a"].joint_names
    (tmp_path / "fast.csv").write_text("time_s,head_joint_2\n0,0\n0.01,30\n0.02,0\n", encoding="utf-8")
    for text, error, message in (
        ("", FormatError, "names no label"),
        ("a = 3", FormatError, "a: must be the name of a gesture or of a file"),
        ("a.b = 'agree'", FormatError, "a: must be the name"),
        ("a = 'agre'", FormatError, "a: no gesture 'agre'; did you mean 'agree'"),
        ("a = 'fast.csv'", FormatError, "a: .*fast.csv: .*rad/s"),
        ("a = 'none.csv'", IoError, "a: .*none.csv"),
        ("a = ", FormatError, "not a TOML file"),
    ):
        table.write_text(text, encoding="utf-8")
        with pytest.raises(error, match=f"motions.toml: {message}"):
            read_motions(table)


def only(table: Path) -> Path:
    """A file beside `table` with one label."""
    other = table.with_stem("one")
    other.write_text('a = "agree"\n', encoding="utf-8")
    return other


def test_labels_that_a_file_of_motions_does_not_name_keep_their_gestures(words: Any, robot: Robot) -> None:
    session = Session(words, robot=robot, motions=LabelMotions(flat=NOD))
    assert list(session.motions) == ["flat"] and session.refused == {"tall": "no gesture has this name"}


@pytest.mark.parametrize("table", [HOAP2, NAO], ids=lambda table: table.name)
def test_the_examples_name_motions_that_the_robots_make(table: Any) -> None:
    folder = Path(__file__).resolve().parents[2] / "examples" / "motions"
    assert {path.name: len(read_motions(path, table)) for path in folder.glob("*.toml")} == {
        "commands.toml": 36,
        "webcam_gestures.toml": 8,
    }


def test_devices_are_heeded_while_the_caller_is_slow(words: Any, signs: Any, frames: Any, robot: Robot) -> None:
    stream = speech([("tall", 0.8), ("stop", 3.2)], 5.0)
    session = Session(words, signs, robot, motions={"tall": TURN})
    events = []
    pictures = ClipSource(frames[:15], FPS, paced=True)
    for event in session.run(lambda: ArraySource(stream, RATE_HZ, paced=True), pictures, live=True):
        events.append(event)
        if event.event == "motion_start":
            time.sleep(2.0)  # STOP is said meanwhile
    assert robot.stopped and [e.fields["completed"] for e in of(events, "motion_end")] == [False]
    (halt,) = of(events, "halt")
    assert halt.fields["wait_ms"] > 50 and halt.fields["compute_ms"] > 0
    assert [e.fields["final"] for e in of(events, "fused")] == ["tall", "stop"]


def test_a_device_that_is_missing_ends_its_mode_alone(words: Any, signs: Any, stream: Any) -> None:
    def no_camera() -> Any:
        raise IoError("camera 0 cannot be opened")

    session = Session(words, signs)
    events = list(session.run(lambda: ArraySource(stream[: 4 * RATE_HZ], RATE_HZ), no_camera, live=True))
    assert [e.fields["message"] for e in of(events, "stall")] == ["camera 0 cannot be opened"]
    assert [e.fields["final"] for e in of(events, "fused")] == ["flat"]


@pytest.mark.slow
@pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="memory is measured on Linux only")
def test_half_an_hour_holds_no_more_memory_and_decides_alike(words: Any, signs: Any, frames: Any, robot: Robot) -> None:
    stream = speech([("flat", 1.5), ("tall", 7.0)], LENGTH_S)
    timed = [(frame, i / FPS) for i, frame in enumerate(frames)]
    rounds = round(1800 / LENGTH_S)
    sound, pictures = RepeatedSound(stream, RATE_HZ, rounds), RepeatedPictures(timed, LENGTH_S, rounds)
    found: list[list[str]] = [[] for _ in range(rounds)]
    held = []
    for event in Session(words, signs, robot, motions={"flat": NOD, "tall": NOD}).run(sound, pictures):
        if event.event == "fused":
            found[int(event.fields["first_s"] // LENGTH_S)].append(event.fields["final"])
        if event.event == "level" and event.time >= (len(held) + 1) * 300:
            gc.collect()
            held.append(memory_bytes())
    assert all(said == ["flat", "tall"] for said in found)
    assert len(held) == 5 and held[-1] <= 1.05 * held[0]


def test_a_queue_misses_first_what_passes() -> None:
    queue = EventQueue(2)
    for number in range(4):
        queue.put(Event(float(number), "level"))
        queue.put(Event(float(number), "decision"))
    queue.close()
    got = []
    while not queue.over:
        arrival = queue.get(0.1)
        assert arrival is not None
        got.append((arrival.event.time, arrival.event.event))
    assert got == [(0, "level"), (0, "decision"), (1, "decision"), (2, "decision"), (3, "decision")]
    assert queue.num_lost == 3 and queue.get(0.01) is None
    for number in range(40):
        queue.put(Event(float(number), "decision"))
    first = queue.get(0.1)
    assert first is not None and first.event.time == 8 and queue.num_lost == 11
    with pytest.raises(InvalidArgument, match="capacity"):
        EventQueue(0)
