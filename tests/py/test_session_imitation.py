# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""A robot whose arms move as those of the person before the camera do, in a session."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

import hri
from conftest import RATE_HZ
from hri.core.errors import InvalidArgument
from hri.live import ArraySource, ClipSource
from hri.robot import NAO, Robot, Trajectory, check_trajectory, open_robot
from hri.robot.imitation import LiveImitation, SeenPerson
from hri.robot.model.arm import MIRROR, arm_of, arm_points
from hri.session import Imitator, Session, SessionOptions
from hri.session.mover import Cause, Guided, Mover
from hri.vision import PersonTracker
from session_people import MOTIONS, speech, train_signs, train_words

pytest.importorskip("cv2")

FPS = 15.0
NOSE = (160.0, 50.0)
FACE_PX = 40.0
HEIGHT_PX = 340.0
HEIGHT = 240


class OneFace:
    """Finds the face where the drawn person has it."""

    def __init__(self, seen: bool = True) -> None:
        self.seen = seen

    def find(self, bgr: np.ndarray) -> Any:
        from hri.vision import Face

        scale = bgr.shape[0] / HEIGHT
        corner = [scale * (place - FACE_PX / 2) for place in NOSE]
        return Face(*corner, scale * FACE_PX) if self.seen else None


def picture(*hands: tuple[float, float]) -> np.ndarray:
    """A person in a room: discs of skin for face and hands."""
    rng = np.random.default_rng(0)
    frame = np.empty((HEIGHT, 320, 3), np.uint8)
    frame[:] = (120, 90, 60)
    y, x = np.mgrid[:240, :320]
    for centre, radius in [(NOSE, 0.55 * FACE_PX), *((hand, 13.0) for hand in hands)]:
        frame[(x - centre[0]) ** 2 + (y - centre[1]) ** 2 < radius**2] = (110, 140, 205)
    return np.clip(frame + rng.normal(0, 4, frame.shape), 0, 255).astype(np.uint8)


def waving(time_s: float) -> tuple[tuple[float, float], tuple[float, float]]:
    """The person's left and right hand."""
    angle = 2.5 * time_s
    return (
        (215.0 + 22 * np.cos(angle), 105.0 + 22 * np.sin(angle)),
        (105.0 - 22 * np.cos(angle), 105.0 + 22 * np.sin(angle)),
    )


@pytest.fixture
def robot() -> Iterator[Robot]:
    with open_robot("kinematic") as opened:
        yield opened


def followed(robot: Robot, people: Any, end_s: float) -> tuple[LiveImitation, np.ndarray]:
    """What a robot was sent that imitates `people(time_s)` as pictures come."""
    arms = LiveImitation()
    rows: list[list[float]] = []
    robot.on_command = lambda _, positions: rows.append([positions[name] for name in arms.joint_names])
    count = 0

    def target_at(time_s: float) -> np.ndarray | None:
        nonlocal count
        while count / FPS <= time_s:
            arms.process(people(count / FPS), count / FPS)
            count += 1
        return arms.target_at(time_s) if time_s < end_s else None

    assert robot.follow(arms.joint_names, target_at)
    return arms, np.array(rows)


def test_hands_go_where_the_persons_are_and_the_motion_is_safe(robot: Robot) -> None:
    def person(time_s: float) -> SeenPerson:
        return SeenPerson(*waving(time_s), NOSE, HEIGHT_PX)

    arms, rows = followed(robot, person, 5.0)
    assert check_trajectory(Trajectory(arms.joint_names, robot.step_s, rows)) == []
    late = round(0.2 / robot.step_s)
    shoulders = np.array((NOSE[0], NOSE[1] + 0.1 * HEIGHT_PX))
    scale = arm_of("left").reach_m / (0.387 * HEIGHT_PX)
    for i, (side, outwards) in enumerate((("left", 1.0), ("right", -1.0))):
        angles = rows[:, 4 * i : 4 * i + 4] * (MIRROR if i else 1.0)
        hands = arm_points(arm_of(side), angles)[1][round(1.5 / robot.step_s) : round(4.5 / robot.step_s)]  # type: ignore[arg-type]
        times = (np.arange(len(hands)) + round(1.5 / robot.step_s) - late) * robot.step_s
        wanted = np.array([waving(t)[i] for t in times]) - shoulders
        places = np.stack((outwards * wanted[:, 0] - 0.1295 * HEIGHT_PX, -wanted[:, 1]), axis=1) * scale
        assert np.sqrt(np.mean(np.sum((hands[:, 1:] - places) ** 2, axis=1))) < 0.03


def test_hands_that_jump_and_meet_stay_safe(robot: Robot) -> None:
    rng = np.random.default_rng(1)
    places = rng.uniform((60, 40), (260, 230), (80, 2, 2))
    places[::7, 1] = places[::7, 0]

    def person(time_s: float) -> SeenPerson | None:
        if int(2 * time_s) % 5 == 4:
            return None
        left, right = places[int(3 * time_s) % len(places)]
        return SeenPerson(tuple(left), None if int(time_s) % 3 == 2 else tuple(right), NOSE, HEIGHT_PX)

    arms, rows = followed(robot, person, 8.0)
    assert check_trajectory(Trajectory(arms.joint_names, robot.step_s, rows)) == []
    assert np.ptp(rows, axis=0).max() > 0.5


def test_a_hand_that_is_gone_goes_to_rest_and_old_pictures_end_it() -> None:
    arms = LiveImitation()
    assert arms.target_at(0.0) is None
    for count in range(60):
        seen = SeenPerson((215.0, 105.0), None, NOSE, HEIGHT_PX) if count < 20 else None
        arms.process(seen, count / FPS)
    last, held, gone = (arms.target_at(count / FPS) for count in (19, 30, 59))
    assert last is not None and held is not None and gone is not None and np.array_equal(held, last)
    assert np.abs(gone[:4] - held[:4]).max() > 0.3 and np.array_equal(gone[4:], held[4:])
    assert arms.target_at(59 / FPS + 1.1) is None
    with pytest.raises(InvalidArgument, match="height"):
        arms.process(SeenPerson(None, None, NOSE, 3.0), 5.0)


def test_the_person_is_found_in_pictures() -> None:
    tracker = PersonTracker(OneFace())
    for count in range(20):
        left, right = waving(count / FPS)
        person = tracker.process(picture(left, right), count / FPS)
    assert person is not None and person.left_px is not None and person.right_px is not None
    assert np.hypot(*np.subtract(person.left_px, left)) < 6 and np.hypot(*np.subtract(person.right_px, right)) < 6
    assert person.face_px == NOSE and person.face_side_px == FACE_PX
    small = np.ascontiguousarray(picture(left, right)[::4, ::4])  # another camera, whose pictures are smaller
    again = tracker.process(small, 20 / FPS)
    assert again is not None and again.face_px == (NOSE[0] / 4, NOSE[1] / 4)
    assert PersonTracker(OneFace(False)).process(picture(), 0.0) is None


@pytest.fixture(scope="module")
def words() -> hri.WordRecognizer:
    return train_words()


@pytest.fixture(scope="module")
def signs() -> hri.GestureRecognizer:
    return train_signs()


def test_a_session_imitates_from_a_word_on_until_stop(words: Any, signs: Any, robot: Robot) -> None:
    options = SessionOptions(imitate_labels=("tall",))
    motions = {label: motion for label, motion in MOTIONS.items() if label != "tall"}
    frames = [picture(*waving(max(0.0, count / FPS - 4.0))) for count in range(round(9 * FPS))]
    found = []
    for _ in range(2):
        session = Session(words, signs, robot, options, motions=motions, faces=OneFace())
        sound = speech([("tall", 1.0), ("stop", 6.0)], 9.0)
        events = list(session.run(ArraySource(sound, RATE_HZ), ClipSource(frames, FPS)))
        (start,) = [event for event in events if event.event == "motion_start"]
        (halt,) = [event for event in events if event.event == "halt"]
        (end,) = [event for event in events if event.event == "motion_end"]
        assert start.fields["label"] == end.fields["label"] == "tall" and not end.fields["completed"]
        assert 1.0 < start.time < 3.0 and 6.0 < halt.time <= end.time < halt.time + 0.4
        assert robot.stopped
        found.append((start.time, end.time, tuple(robot.joint_positions_rad().values())))
        robot.resume()
        robot.reset(dict.fromkeys(robot.table.names, 0.0) | robot.table.rest_rad)
    assert found[0] == found[1]  # the same recording, the same motion to the bit


def test_a_motion_waits_for_its_first_target(robot: Robot) -> None:
    names = LiveImitation().joint_names

    def late(time_s: float) -> np.ndarray | None:
        return np.full(8, 0.2) if 1.0 <= time_s < 2.0 else None

    mover = Mover(robot, {"late": Guided(names, late), "never": Guided(names, lambda _: None)})
    try:
        before = robot.joint_positions_rad()
        mover.begin("late", Cause(0.0, 0.0, 0.0))
        (start,) = mover.advance(0.9)
        assert start.kind == "motion_start" and robot.joint_positions_rad() == before
        (end,) = mover.advance(5.0)
        assert end.completed and end.message == "" and 2.0 <= end.time_s < 2.5
        assert robot.joint_positions_rad() != before
        mover.begin("never", Cause(5.0, 5.0, 0.0))
        _, end = mover.advance(9.0)
        assert not end.completed and not end.fault and "see nothing" in end.message
        assert end.time_s == pytest.approx(8.0, abs=0.1)
    finally:
        mover.close()


def test_what_imitation_needs_is_said(words: Any, robot: Robot, monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(InvalidArgument, match="needs pictures"):
        Session(words, None, robot, SessionOptions(imitate_labels=("tall",)))
    with pytest.raises(InvalidArgument, match="no vocabulary"):
        Session(words, None, robot, SessionOptions(imitate_labels=("nowhere",)))
    with pytest.raises(InvalidArgument, match="NAO's arms are not built as HOAP-2's"):
        LiveImitation(NAO)
    monkeypatch.setattr("hri.vision.faces.find_cascade", lambda: None)
    with pytest.raises(InvalidArgument, match="opencv-data"):
        Imitator()


@pytest.mark.parametrize("target", [np.zeros(7), np.full(8, np.nan), "up"])
def test_a_target_that_is_none_brings_rest_and_is_an_error(robot: Robot, target: Any) -> None:
    names = LiveImitation().joint_names
    calls = iter([np.full(8, 0.2), np.full(8, 0.2), target])
    with pytest.raises((InvalidArgument, ValueError)):
        robot.follow(names, lambda _: next(calls))
    assert not robot.stopped
    assert robot.follow(names, lambda _: None)  # goes on working


def test_follow_is_refused_where_perform_is(robot: Robot) -> None:
    with pytest.raises(InvalidArgument, match="nose"):
        robot.follow(("nose",), lambda _: None)
    robot.stop()
    assert not robot.follow(("rarm_joint_1",), lambda _: np.zeros(1)) and robot.events[-1].kind == "stop"
    robot.resume()
    robot.close()
    with pytest.raises(hri.Error, match="closed"):
        robot.follow(("rarm_joint_1",), lambda _: None)
