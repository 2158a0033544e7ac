# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""NAO's camera as a source, a session in which NAO sees a sign and answers, and the commands, over its own protocol."""

from __future__ import annotations

import numpy as np
import pytest

pytest.importorskip("qi")

from drawn_hands import FPS
from hri.core.errors import Error, InvalidArgument, IoError
from hri.live import Stalled
from hri.robot import NaoqiRobot, Trajectory
from hri.session import NaoCamera, Session
from nao_services import Nao

NOD = Trajectory(["HeadPitch"], 0.3, [[0.0], [0.1], [0.0]])


@pytest.fixture
def nao():
    made = Nao()
    yield made
    made.close()


def test_pictures_come_with_their_times(nao):
    source = NaoCamera(nao.url, "CameraBottom", fps=10, stall_s=20.0)
    timed = [source.read() for _ in range(4)]
    assert [time_s for _, time_s in timed] == pytest.approx([0.0, 0.1, 0.2, 0.3], abs=1e-5)
    frame = timed[0][0]
    assert frame.shape == (480, 640, 3) and frame.dtype == np.uint8
    assert tuple(frame[100, 100]) == (31, 31, 31) and (frame[0] == (1, 128, 255)).all(axis=1).sum() == 1
    nao.video.number += 4
    assert source.read()[1] == pytest.approx(0.8, abs=1e-5) and source.num_lost == 4
    nao.video.number = -500  # the robot's clock is set back
    later = [source.read()[1] for _ in range(2)]
    assert later == pytest.approx([0.9, 1.0], abs=1e-5)
    assert len(nao.video.subscribers) == 1
    source.close()
    source.close()
    assert nao.video.subscribers == {} and source.read() is None and source.reconnect() is False


def test_a_smaller_picture(nao):
    source = NaoCamera(nao.url, size=(160, 120), stall_s=20.0)
    assert source.read()[0].shape == (120, 160, 3)
    source.close()


def test_a_camera_that_stands_still_vanishes_or_sends_nonsense(nao):
    source = NaoCamera(nao.url, size=(160, 120), stall_s=4.0)
    source.read()
    nao.video.frozen = True
    with pytest.raises(Stalled, match=r"same picture for 4 s"):
        source.read()
    nao.video.frozen, nao.video.broken = False, True
    with pytest.raises(Stalled, match="no picture of 160 x 120"):
        source.read()
    nao.video.broken = False
    assert source.reconnect() and source.read()[1] > 0.0
    url = nao.url
    nao.close()
    with pytest.raises(Stalled, match="NAO at tcp"):
        source.read()
    assert source.reconnect() is False
    again = Nao(url=url)
    try:
        assert source.reconnect() and source.read() is not None
    finally:
        source.close()
        again.close()


def test_what_no_camera_has_is_refused(nao):
    for values in ({"camera": "CameraFront"}, {"size": (641, 480)}, {"fps": 0}, {"fps": 31}, {"stall_s": 0.0}):
        with pytest.raises(InvalidArgument, match=next(iter(values))):
            NaoCamera(nao.url, **values)
    with pytest.raises(IoError, match="no NAO"):
        NaoCamera("tcp://127.0.0.1:1")
    nao.video.subscribers = {str(number): None for number in range(8)}
    with pytest.raises(Error, match="too many subscribers"):
        NaoCamera(nao.url)
    without = Nao(services=["ALMotion"])
    with pytest.raises(Error, match="no service ALVideoDevice"):
        NaoCamera(without.url)
    without.close()


def test_nao_sees_a_sign_says_so_and_answers_by_a_motion(nao):
    from session_people import signing, train_signs

    drawn = signing([("flat", 1.0)], 4.0, hold_s=1.2)
    nao.video.frames = [np.pad(np.kron(frame, np.ones((3, 3, 1), np.uint8)), ((0, 0), (80, 80), (0, 0)), "edge")
                        for frame in drawn]  # fmt: skip
    with NaoqiRobot(nao.url, timeout_s=20.0) as robot:
        session = Session(signs=train_signs(), robot=robot, motions={"flat": NOD}, on_say=robot.say_later)
        assert session.motions.keys() == {"flat"} and session.refused.keys() == {"tall"}
        source = NaoCamera(nao.url, fps=round(FPS), stall_s=4.0)
        events = list(session.run(pictures=source))
        robot.say("the end")  # after what was to be said before
    finals = [event.fields["final"] for event in events if event.event == "fused"]
    done = [event.fields["completed"] for event in events if event.event == "motion_end"]
    assert finals == ["flat"] and done == [True] and robot.events == []
    assert [text for text, _ in nao.voice.said] == ["flat.", "the end"]
    pitch = np.array([asked["HeadPitch"] for _, asked in nao.motion.sent])
    assert pitch.max() == pytest.approx(0.1, abs=0.02) and abs(pitch[-1]) < 1e-6 and nao.motion.clamped == []


def test_a_gesture_of_the_vocabulary_is_naos_own(nao):
    import hri
    from drawn_hands import stills

    signs = hri.GestureRecognizer(false_reject_rate=0.0)
    signs.fit([stills(sign, seed) for seed in range(4) for sign in ("flat", "tall")], ["house", "nonsense"] * 4)
    with NaoqiRobot(nao.url, timeout_s=20.0) as robot:
        session = Session(signs=signs, robot=robot)
    assert session.motions["house"].joint_names[0] == "LShoulderPitch"
    assert session.refused == {"nonsense": "no gesture has this name"}


def test_commands_move_a_real_nao(nao, hri, tmp_path):
    pytest.importorskip("click")
    from session_people import train_signs

    model = tmp_path / "signs.hri"
    train_signs().save(model)
    turn = tmp_path / "turn.csv"
    turn.write_text("time_s,HeadYaw\n0,0\n0.3,6\n0.6,6\n", encoding="utf-8")
    ran = hri("robot", "play", turn, "--robot", "nao", "--url", nao.url, "--wake-up", "--rest")
    assert ran.code == 0 and nao.motion.postures == ["wakeUp", "rest"]
    assert len(ran.out.splitlines()) == 24 and ran.out.startswith("HeadYaw\t"), "nothing but joints on stdout"
    assert nao.motion.sent[-1][1]["HeadYaw"] == pytest.approx(np.radians(6.0), abs=1e-6)
    url = nao.url
    nao.close()
    failed = hri("robot", "play", turn, "--robot", "nao", "--url", url)
    assert (failed.code, failed.out) == (3, "") and "no NAO can be reached" in failed.err
    failed = hri("session", "--robot", "nao", "--url", url, "--camera", "nao", "--no-speech", "--gesture-model", model)
    assert (failed.code, failed.out) == (3, "") and "no NAO can be reached" in failed.err
    failed = hri("robot", "play", turn, "--robot", "nao", "--url", "nao.local")
    assert (failed.code, failed.out) == (3, "") and "no address of a NAO" in failed.err
    assert hri("session", "--url", url).code == 2 and hri("session", "--camera", "nao").code == 2
