# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""NAO's arms move as those of the person before the camera: within limits, clear of itself, over its own protocol."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest

import hri
from conftest import RATE_HZ
from hri.core.errors import InvalidArgument
from hri.live import ArraySource, ClipSource
from hri.robot import HOAP2, NAO, Robot, Trajectory, check_trajectory, open_robot
from hri.robot.imitation import LiveImitation, SeenPerson
from hri.robot.model.kinematics import link_poses
from hri.robot.motion.self_collision import self_collisions
from hri.robot.nao.imitation import NaoImitation, live_imitation
from hri.session import Session, SessionOptions
from session_people import speech, train_signs, train_words
from test_session_imitation import FPS, HEIGHT_PX, NOSE, OneFace, picture, waving

REACH_M = 0.10607 + 0.1137
"""From NAO's shoulder to the elbow, and from there to the middle of the hand."""


def waves(time_s: float) -> SeenPerson:
    return SeenPerson(*waving(time_s), NOSE, HEIGHT_PX)


def jumps() -> Callable[[float], SeenPerson | None]:
    """Hands that are anywhere, meet, and vanish."""
    rng = np.random.default_rng(1)
    places = rng.uniform((60, 40), (260, 230), (80, 2, 2))
    places[::7, 1] = places[::7, 0]

    def person(time_s: float) -> SeenPerson | None:
        if int(2 * time_s) % 5 == 4:
            return None
        left, right = places[int(3 * time_s) % len(places)]
        return SeenPerson(tuple(left), None if int(time_s) % 3 == 2 else tuple(right), NOSE, HEIGHT_PX)

    return person


def followed(robot: Robot, person: Callable[[float], SeenPerson | None], end_s: float) -> tuple[NaoImitation, Any]:
    """What a robot was sent that imitates, pictures coming by its own time."""
    arms = NaoImitation(robot.table)
    rows: list[list[float]] = []
    robot.on_command = lambda _, positions: rows.append([positions[name] for name in arms.joint_names])
    count, begin_s = 0, robot.time_s

    def target_at(time_s: float) -> np.ndarray | None:
        nonlocal count
        while count / FPS <= time_s - begin_s:
            arms.process(person(count / FPS), count / FPS)
            count += 1
        return arms.target_at(time_s - begin_s) if time_s - begin_s < end_s else None

    assert robot.follow(arms.joint_names, target_at)
    return arms, np.array(rows)


@pytest.fixture
def robot() -> Iterator[Robot]:
    with open_robot("kinematic", table=NAO) as opened:
        yield opened


def hand_m(side: str, angles: dict[str, float]) -> np.ndarray:
    """The middle of a hand from its shoulder, in the torso's frame; by the joint table alone."""
    letter = side[0].upper()
    poses = link_poses(angles, base=np.eye(4), table=NAO)
    wrist = poses[f"{side[0]}_wrist"] @ (0.05775, 0.0, 0.0, 1.0)
    return (wrist - poses[f"{letter}Shoulder"][:, 3])[:3]


def test_hands_are_where_the_persons_are_from_their_shoulders() -> None:
    arms = NaoImitation()
    errors = []
    for number in range(60):
        arms.process(waves(number / FPS), number / FPS)
        found = arms.target_at(number / FPS)
        assert found is not None
        limits = NAO.limits_rad[[NAO.index(name) for name in arms.joint_names]]
        assert np.all((limits[:, 0] <= found) & (found <= limits[:, 1]))
        if number < 20:
            continue
        joints = NAO.rest_rad | dict(zip(arms.joint_names, found.tolist(), strict=True))
        for i, (side, outwards) in enumerate((("left", 1.0), ("right", -1.0))):
            hand = hand_m(side, joints) * (1.0, outwards, 1.0)
            x, y = np.subtract(waving(number / FPS)[i], (NOSE[0], NOSE[1] + 0.1 * HEIGHT_PX))
            place = np.array((outwards * x - 0.1295 * HEIGHT_PX, -y)) * REACH_M / (0.387 * HEIGHT_PX)
            errors.append(hand[1:] - place)
            assert hand[0] > 0.0, "before the body"
    assert np.sqrt(np.mean(np.sum(np.square(errors), axis=1))) < 0.015


@pytest.mark.parametrize(("person", "end_s"), [(waves, 4.0), (jumps(), 8.0)])
def test_the_motion_is_safe_whatever_the_person_does(robot: Robot, person: Any, end_s: float) -> None:
    arms, rows = followed(robot, person, end_s)
    assert check_trajectory(Trajectory(arms.joint_names, robot.step_s, rows), NAO) == []
    assert np.ptp(rows, axis=0).max() > 0.5 and robot.events == []


def test_a_hand_that_is_gone_goes_where_naos_rests() -> None:
    arms = NaoImitation()
    for number in range(60):
        arms.process(waves(0.0) if number < 20 else None, number / FPS)
    held, gone = arms.target_at(30 / FPS), arms.target_at(59 / FPS)
    assert held is not None and gone is not None and np.abs(gone - held).max() > 0.3
    assert gone == pytest.approx([NAO[name].rest_rad for name in arms.joint_names])
    arms.reset()
    assert arms.target_at(59 / FPS) is None


def test_each_robot_has_its_own() -> None:
    assert type(live_imitation(HOAP2)) is LiveImitation
    assert live_imitation(NAO).joint_names[:2] == ("LShoulderPitch", "LShoulderRoll")
    with pytest.raises(InvalidArgument, match="HOAP-2 is no NAO"):
        NaoImitation(HOAP2)


def test_limits_that_a_robot_reports_are_kept() -> None:
    from dataclasses import replace

    joints = tuple(replace(j, upper_rad=0.2) if j.name == "LShoulderRoll" else j for j in NAO.joints)
    own, usual = NaoImitation(replace(NAO, joints=joints)), NaoImitation()
    for arms in (own, usual):
        arms.process(SeenPerson((300.0, 100.0), (20.0, 100.0), NOSE, HEIGHT_PX), 0.0)
    found, other = own.target_at(0.0), usual.target_at(0.0)
    assert found is not None and other is not None and found[1] <= 0.2 < other[1]


def test_a_nao_whose_arms_were_moved_by_hand_begins_where_they_are() -> None:
    pytest.importorskip("qi")
    from hri.robot import NaoqiRobot
    from nao_services import Nao

    nao = Nao()
    try:
        with NaoqiRobot(nao.url, timeout_s=30.0) as robot:
            nao.motion.positions["LShoulderPitch"] = 0.4  # after it was opened; the motors are off
            _, rows = followed(robot, waves, 1.0)
        assert rows[0, 0] == pytest.approx(0.4, abs=0.02) and nao.motion.clamped == []
        assert np.abs(np.diff(rows, axis=0)).max() / robot.step_s <= NAO.max_speed_rad_s
    finally:
        nao.close()


def test_a_nao_on_the_wire_imitates_in_a_session_until_stop() -> None:
    pytest.importorskip("qi")
    pytest.importorskip("cv2")
    from hri.robot import NaoqiRobot
    from nao_services import Nao

    nao = Nao()
    try:
        with NaoqiRobot(nao.url, timeout_s=30.0) as robot:
            words: hri.WordRecognizer = train_words()
            session = Session(
                words, train_signs(), robot, SessionOptions(imitate_labels=("tall",)), motions={}, faces=OneFace()
            )
            assert session.refused.keys() == {"flat"}
            frames = [picture(*waving(max(0.0, number / FPS - 2.5))) for number in range(round(6.5 * FPS))]
            sound = speech([("tall", 1.0), ("stop", 4.5)], 6.5)
            events = list(session.run(ArraySource(sound, RATE_HZ), ClipSource(frames, FPS)))
            (start,) = [event for event in events if event.event == "motion_start"]
            (end,) = [event for event in events if event.event == "motion_end"]
            assert start.fields["label"] == end.fields["label"] == "tall" and start.time < 3.0
            assert not end.fields["completed"] and not end.fields["fault"] and 4.5 < end.time < 6.5
            assert robot.stopped
        names = NaoImitation().joint_names
        sent = [asked for _, asked in nao.motion.sent]
        assert sent and all(asked.keys() == set(names) for asked in sent), "legs and head stay where they are"
        rows = np.array([[asked[name] for name in names] for asked in sent])
        speeds = np.diff(rows, axis=0) / robot.step_s
        assert np.abs(speeds).max() <= NAO.max_speed_rad_s and nao.motion.clamped == []
        assert np.abs(np.diff(speeds, axis=0)).max() / robot.step_s <= NAO.max_acceleration_rad_s2
        assert self_collisions(Trajectory(names, robot.step_s, rows), NAO) == []
        assert np.ptp(rows, axis=0).max() > 0.5
        stiff = {name for name, value in nao.motion.stiffness.items() if value > 0.0}
        assert stiff == set(names)
    finally:
        nao.close()
