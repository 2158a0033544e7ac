# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""NAO over its own protocol: motions, STOP, speech, and a robot that is silent, refuses, is switched off or another."""

from __future__ import annotations

import subprocess
import sys
import threading
import time
from itertools import count
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("qi")

from conftest import until
from hri.core.errors import Error, InvalidArgument, IoError
from hri.robot import NAO, NaoqiRobot, Trajectory, TrajectoryError
from hri.robot.nao.link import NaoqiLink, require_nao_url
from hri.session.mover import Cause, Mover
from nao_services import Nao

TURN = Trajectory(["HeadYaw"], 0.2, [[0.0], [0.1], [0.0]])
LONG = Trajectory(["HeadYaw"], 2.0, [[0.0], [1.0], [0.0], [1.0], [0.0]])


@pytest.fixture
def nao():
    made = Nao()
    yield made
    made.close()


@pytest.fixture
def robot(nao):
    with NaoqiRobot(nao.url, timeout_s=30.0) as opened:
        yield opened


def sent(nao, joint="HeadYaw"):
    return np.array([asked[joint] for _, asked in list(nao.motion.sent)])


def in_mid_motion(nao, do):
    """Do something in another thread as soon as the robot has been sent ten positions."""

    def run():
        while len(nao.motion.sent) < 10:
            time.sleep(0.005)
        do()

    thread = threading.Thread(target=run)
    thread.start()
    return thread


def test_a_motion_is_carried_out_within_the_limits(nao, robot):
    wave = Trajectory(["RShoulderPitch", "RElbowRoll", "HeadYaw"], 0.5, [[1.2, 0.4, 0.0], [0.8, 0.8, 0.3]])
    assert nao.motion.stiffness["RElbowRoll"] == 0.0
    assert robot.perform(wave) and robot.events == []
    stiff = {name for name, value in nao.motion.stiffness.items() if value > 0}
    assert stiff == {*wave.joint_names}, "only what moves is switched on"
    until(lambda: abs(robot.joint_positions_rad()["HeadYaw"] - 0.3) < 1e-3)  # the last step is on its way
    found = robot.joint_positions_rad()
    assert [found[name] for name in wave.joint_names] == pytest.approx([0.8, 0.8, 0.3], abs=1e-3)
    assert found.keys() == set(NAO.names) and robot.state().positions_rad.keys() == found.keys()
    pitch = sent(nao, "RShoulderPitch")
    assert pitch[0] == pytest.approx(NAO["RShoulderPitch"].rest_rad, abs=0.01), "it begins where the joint was"
    for joint in wave.joint_names:
        speeds = np.diff(sent(nao, joint)) / robot.step_s
        assert np.abs(speeds).max() <= NAO.max_speed_rad_s
        assert np.abs(np.diff(speeds)).max() / robot.step_s <= NAO.max_acceleration_rad_s2
    times = np.array([at for at, _ in nao.motion.sent])
    assert np.median(np.diff(times)) > 0.9 * robot.step_s
    assert nao.motion.clamped == []


def test_what_is_beyond_a_limit_is_refused_before_anything_moves(nao, robot):
    beyond = [
        Trajectory(["LElbowRoll"], 0.5, [[-0.3], [-1.6]]),
        Trajectory(["HeadYaw"], 0.1, [[0.0], [1.0]]),
        Trajectory(["HeadYaw", "HeadPitch"], 1.0, [[0.0, 0.0], [1.5, 0.4]]),  # the shell is in the way
        Trajectory(["LHipYawPitch"], 1.0, [[0.0], [-0.2]]),  # one motor for both
        Trajectory(["larm_joint_1"], 1.0, [[0.0], [0.1]]),
        Trajectory(["HeadYaw"], 1.0, [[0.0], [np.nan]]),
    ]
    for motion in beyond:
        with pytest.raises(TrajectoryError):
            robot.perform(motion)
        with pytest.raises(TrajectoryError):
            robot.prepare(motion)
    assert nao.motion.sent == [] and not any(nao.motion.stiffness.values())
    with pytest.raises(Error, match="perform"):
        robot.reset({"HeadYaw": 0.1})
    with pytest.raises(Error, match="NaoCamera"):
        robot.render()


def test_the_way_to_the_first_row_respects_the_shell(nao, robot):
    nao.motion.positions |= {"HeadYaw": 2.0, "HeadPitch": 0.28}
    with pytest.raises(TrajectoryError, match="HeadYaw is"):
        robot.perform(Trajectory(["HeadYaw", "HeadPitch"], 1.0, [[0.9, 0.28], [0.9, 0.25]]))
    nao.motion.positions |= {"HeadYaw": 0.0, "HeadPitch": 0.45}
    with pytest.raises(TrajectoryError, match="HeadYaw is"):
        robot.perform(Trajectory(["HeadYaw"], 1.0, [[0.0], [0.8]]))  # nods where it is
    assert nao.motion.sent == []


def test_the_robots_own_limits_count_where_they_are_stricter(nao):
    nao.motion.limits["HeadYaw"] = [-0.5, 3.0, 2.0, 1.0]
    with NaoqiRobot(nao.url, timeout_s=20.0) as robot:
        assert (robot.table["HeadYaw"].lower_rad, robot.table["HeadYaw"].upper_rad) == (-0.5, NAO["HeadYaw"].upper_rad)
        assert robot.table.max_speed_rad_s == 2.0
        with pytest.raises(TrajectoryError, match=r"-28\.6"):
            robot.perform(Trajectory(["HeadYaw"], 1.0, [[0.0], [-0.6]]))


def test_stop_in_mid_motion_brakes_and_latches(nao, robot):
    asked_s = []
    thread = in_mid_motion(nao, lambda: (robot.stop(), asked_s.append(time.monotonic())))
    assert robot.perform(LONG) is False and robot.stopped
    thread.join()
    count = len(nao.motion.sent)
    assert sum(at_s > asked_s[0] for at_s, _ in nao.motion.sent) <= 12, "a few steps, and the 0.13 s of braking"
    way = sent(nao)
    speeds = np.diff(way) / robot.step_s
    assert abs(speeds[-1]) < 1e-6 and count < 0.9 * LONG.duration_s / robot.step_s
    assert np.abs(np.diff(speeds)).max() / robot.step_s <= NAO.max_acceleration_rad_s2 * 1.001
    assert robot.perform(TURN) is False and robot.wake_up() is False and robot.rest() is False
    assert len(nao.motion.sent) == count and nao.motion.postures == []
    robot.resume()
    assert robot.perform(TURN)


def test_joints_whose_limits_depend_on_others_follow_nothing(nao, robot):
    for names in (["HeadYaw", "LElbowYaw"], ["LHipYawPitch"]):
        with pytest.raises(InvalidArgument, match=names[0]):
            robot.follow(names, lambda time_s: None)
    assert not nao.motion.sent


def test_the_joints_follow_a_hand_while_they_have_no_power(nao, robot):
    nao.motion.positions["HeadYaw"] = 0.7  # turned after the robot was opened
    assert robot.perform(TURN)
    assert sent(nao)[0] == pytest.approx(0.7, abs=0.01)


def test_it_stands_up_and_rests_by_itself(nao, robot):
    assert robot.wake_up() and robot.perform(TURN) and robot.rest()
    assert nao.motion.postures == ["wakeUp", "rest"] and not any(nao.motion.stiffness.values())
    nao.motion.posture_s = 30.0
    nao.motion.standing_up.clear()
    thread = threading.Thread(target=lambda: (nao.motion.standing_up.wait(60.0), robot.stop()))
    thread.start()
    assert robot.wake_up() is False and nao.motion.killed.is_set()
    thread.join()
    assert nao.motion.postures == ["wakeUp", "rest"] and robot.events[-1].kind == "stop"


def test_it_speaks(nao, robot):
    robot.say("seven")
    robot.stop()
    robot.say("sept", "French")
    robot.say_later("\\later\0")
    with pytest.raises(Error, match="not installed"):
        robot.say("nein", "German")
    for text in ("", "  ", "\\rspd=50\\ fast", "a\0b", "x" * 1001, 7):
        with pytest.raises(InvalidArgument, match="a text to say"):
            robot.say(text)
    robot.say("more")  # after what was to be said before
    said = [("seven", "English"), ("sept", "French"), (" later ", "English"), ("more", "English")]
    assert nao.voice.said == said and robot.events == []
    nao.voice.hoarse = True
    robot.say_later("eight")
    with pytest.raises(Error, match="refuses"):
        robot.say("nine")
    until(lambda: robot.events)  # by a thread of qi
    assert [event.kind for event in robot.events] == ["fault"] and "hoarse" in robot.events[0].message


def test_a_robot_that_falls_silent_in_mid_motion_is_an_error(nao):
    with NaoqiRobot(nao.url, timeout_s=4.0) as robot:
        thread = in_mid_motion(nao, nao.motion.silent.set)
        begun_s = time.monotonic()
        with pytest.raises(IoError, match=r"does not answer ALMotion\.setAngles within 4 s"):
            robot.perform(LONG)
        assert time.monotonic() - begun_s < 60.0 and robot.stopped and robot.events[-1].kind == "fault"
        thread.join()
        count = len(nao.motion.sent)
        assert robot.perform(TURN) is False
        robot.resume()
        with pytest.raises(IoError):
            robot.perform(TURN)
        nao.motion.silent.clear()
        until(lambda: len(nao.motion.sent) > count)  # the call that hung is carried out
        nao.motion.positions["HeadYaw"] = nao.motion.targets["HeadYaw"] = 0.3  # turned by hand meanwhile
        robot.resume()
        assert robot.wake_up() and not robot.stopped, "it is connected to again"
        nao.motion.positions["HeadYaw"] = nao.motion.targets["HeadYaw"] = 0.3
        assert robot.perform(TURN)
        assert abs(sent(nao)[-1]) < 1e-6 and np.abs(sent(nao)[count + 1 :]).max() == pytest.approx(0.3, abs=0.01)


def test_a_robot_that_is_switched_off_in_mid_motion_leaves_the_session_alive(nao):
    with NaoqiRobot(nao.url, timeout_s=20.0) as robot:
        mover = Mover(robot, {"long": LONG})
        try:
            mover.begin("long", Cause(0.0, 0.0, 0.0))
            thread = in_mid_motion(nao, nao.close)
            (start, ended) = mover.advance(30.0)
            thread.join()
            assert (start.kind, ended.kind, ended.completed, ended.fault) == ("motion_start", "motion_end", False, True)
            assert "does not obey" in ended.message and "NAO at tcp" in ended.message and not mover.busy
        finally:
            mover.close()
        robot.say_later("anyone?")
        assert robot.events[-1].message.startswith("not said") and robot.stopped
        with pytest.raises(IoError):
            robot.say("anyone?")
        with pytest.raises(IoError):
            robot.hold(0.1)


def test_a_robot_whose_process_dies_in_mid_motion_is_an_error():
    program = Path(__file__).with_name("nao_services.py")
    with subprocess.Popen(
        [sys.executable, program], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    ) as process:
        url = process.stdout.readline().strip()
        with NaoqiRobot(url, timeout_s=20.0) as robot:
            steps = count()
            robot.on_command = lambda *_: process.kill() if next(steps) == 10 else None
            with pytest.raises(IoError, match=f"NAO at {url}"):
                robot.perform(LONG)
            assert robot.stopped and robot.events[-1].kind == "fault"
    with pytest.raises(IoError, match="no NAO can be reached"):
        NaoqiRobot(url)


def test_a_program_that_dies_in_mid_motion_leaves_the_joints_where_they_were_sent_last(nao):
    program = "import sys; from hri.robot import *; robot = NaoqiRobot(sys.argv[1]);" \
        "robot.perform(Trajectory(['HeadYaw'], 20.0, [[0.0], [1.0], [0.0]]))"  # fmt: skip
    with subprocess.Popen([sys.executable, "-c", program, nao.url]) as process:
        in_mid_motion(nao, process.kill).join()
    until(lambda: nao.motion.getAngles("HeadYaw", True) == [sent(nao)[-1]])  # the last step is on its way
    assert 0.0 < sent(nao)[-1] < 0.9


@pytest.mark.parametrize(
    "url",
    ["", "nao.local", "http://nao.local", "tcp://", "tcp://:9559", "tcp://nao:0", "tcp://nao:99999", "tcp://nao:x",
     "tcp://nao/path", "tcp://a b", None, 9559],
)  # fmt: skip
def test_another_address_is_refused(url):
    with pytest.raises(InvalidArgument, match="no address of a NAO"):
        NaoqiRobot(url)


def test_addresses_get_naos_port():
    assert require_nao_url("tcp://nao.local") == "tcp://nao.local:9559"
    assert require_nao_url("tcp://[::1]:7") == "tcp://[::1]:7"


def test_values_out_of_range_are_refused():
    for values in ({"timeout_s": 0.0}, {"timeout_s": np.nan}, {"stiffness": 0.0}, {"stiffness": 1.1}):
        with pytest.raises(InvalidArgument, match=next(iter(values))):
            NaoqiRobot("tcp://127.0.0.1:1", **values)


def test_nothing_at_the_address():
    for url in ("tcp://127.0.0.1:1", "tcp://nowhere.invalid"):
        with pytest.raises(IoError, match="no NAO"):
            NaoqiRobot(url, timeout_s=2.0)


def test_services_that_are_missing_are_named():
    nao = Nao(services=["ALMotion"])
    with NaoqiRobot(nao.url, timeout_s=20.0) as robot, pytest.raises(Error, match="has no service ALTextToSpeech"):
        robot.say("hello")
    nao.close()
    nao = Nao(services=["ALTextToSpeech"])
    with pytest.raises(Error, match="has no service ALMotion"):
        NaoqiRobot(nao.url)
    link = NaoqiLink(nao.url)
    with pytest.raises(Error, match=r"has no ALTextToSpeech\.shout: its NAOqi is another version"):
        link.call("ALTextToSpeech", "shout")
    link.close()
    nao.close()


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda motion: motion.body.remove("LWristYaw"), "is no NAO H25: it has no LWristYaw"),
        (lambda motion: motion.limits.update(HeadYaw=[1.0, float("nan"), 1.0, 1.0]), "getLimits"),
        (lambda motion: motion.limits.update(HeadYaw=[0.5, 0.4, 1.0, 1.0]), "HeadYaw that leave no room"),
        (lambda motion: motion.limits.update(HeadYaw=[-0.5, 0.4, 0.0, 1.0]), "cannot move"),
        (lambda motion: motion.positions.update(HeadYaw=float("inf")), "getAngles"),
    ],
)
def test_another_robot_and_nonsense_are_errors(nao, change, message):
    change(nao.motion)
    with pytest.raises(Error, match=message):
        NaoqiRobot(nao.url)


def test_what_nao_refuses_is_an_error_that_stops(nao, robot):
    nao.motion.limits.pop("RHand")
    del nao.motion.limits["HeadYaw"]
    with pytest.raises(Error, match=r"refuses ALMotion\.\w+: ALMotion: HeadYaw is not a valid joint name"):
        robot.perform(TURN)
