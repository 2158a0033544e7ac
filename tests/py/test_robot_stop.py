# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""STOP latches until `resume`, from whichever thread and whenever: nothing moves meanwhile."""

import os
import signal
import subprocess
import sys
import threading
import time
from importlib.util import find_spec

import numpy as np
import pytest

from conftest import WAIT_S
from hri.core.errors import Error, InvalidArgument
from hri.robot import HOAP2, MotionLog, Trajectory, gesture_trajectory, open_robot, stopped_by_signals
from hri.robot.simulation.kinematic_backend import KinematicRobot

needs_pybullet = pytest.mark.skipif(find_spec("pybullet") is None, reason="no pybullet")
NOD = Trajectory(["head_joint_2"], 0.1, np.array([[0.0], [0.1], [0.2], [0.1], [0.0]]))
LONG = Trajectory(["head_joint_1"], 10.0, [[0.0], [0.5], [-0.5], [0.5], [0.0]] * 50)


@pytest.fixture(params=[pytest.param("pybullet", marks=needs_pybullet), "kinematic"])
def robot(request):
    with open_robot(request.param) as opened:
        yield opened


def commanded(robot):
    """Positions of every command from now on."""
    sent, command = [], robot._command

    def spy(positions):
        sent.append(dict(robot._commanded))
        command(positions)

    robot._command = spy
    return sent


def test_a_stop_before_a_motion_is_kept_until_resume(robot):
    robot.stop()
    sent = commanded(robot)
    log = MotionLog()
    for _ in range(3):
        assert robot.perform(gesture_trajectory("9"), log=log) is False
    assert sent == [] and robot.stopped and log.states == []
    assert [event.kind for event in robot.events] == ["stop"] * 3 == [event.kind for event in log.events]
    assert "resume()" in robot.events[0].message
    with pytest.raises(Error, match="stopped until resume"):
        robot.reset({"head_joint_1": 0.1})
    assert robot.hold(0.05), "the joints are held meanwhile"
    assert all(positions == sent[0] for positions in sent)
    robot.resume()
    assert not robot.stopped and robot.perform(NOD)


def test_a_stop_ends_the_whole_queue(robot):
    sent = commanded(robot)
    queue = [NOD, gesture_trajectory("1"), gesture_trajectory("9"), NOD]
    done = []
    for number, motion in enumerate(queue):
        done.append(robot.perform(motion))
        if number == 0:
            robot.stop()
            moved = len(sent)
    assert done == [True, False, False, False] and len(sent) == moved


def test_a_stop_released_at_once_still_ends_the_motion_under_way(robot):
    def on_frame(image, time_s):
        if time_s > 0.2:
            robot.stop()
            robot.resume()

    assert robot.perform(LONG, on_frame, fps=10, size=(16, 16)) is False
    assert [event.kind for event in robot.events] == ["stop"] and robot.time_s < 2.0
    assert robot.perform(NOD)


def test_the_end_of_a_motion_does_not_latch(robot):
    def on_frame(image, time_s):
        if time_s > 0.2:
            robot.end_motion()

    assert robot.perform(LONG, on_frame, fps=10, size=(16, 16)) is False and robot.time_s < 2.0
    assert not robot.stopped and robot.perform(NOD)


def test_the_end_of_a_motion_releases_no_stop(robot):
    def on_frame(image, time_s):
        if time_s > 0.2:
            robot.stop()
            robot.end_motion()

    assert robot.perform(LONG, on_frame, fps=10, size=(16, 16)) is False
    assert robot.stopped and robot.perform(NOD) is False


def test_stops_of_many_threads_are_all_kept(robot):
    def press():
        time.sleep(0.05)
        for _ in range(200):
            robot.stop()

    threads = [threading.Thread(target=press) for _ in range(8)]
    for thread in threads:
        thread.start()
    assert robot.perform(LONG) is False
    for thread in threads:
        thread.join()
    assert robot.stopped and robot.perform(NOD) is False


def test_only_one_motion_at_a_time(robot):
    refused = []

    def on_frame(image, time_s):
        for attempt in (lambda: robot.perform(NOD), lambda: robot.hold(0.1), lambda: robot.reset({}), robot.close):
            with pytest.raises(Error, match="motion") as caught:
                attempt()
            refused.append(str(caught.value))
        robot.stop()

    assert robot.perform(NOD, on_frame, size=(16, 16)) is False
    assert len(refused) == 4


def test_another_thread_cannot_move_it_but_close_it():
    robot = open_robot("kinematic")
    begun, went_on = threading.Event(), []
    command = robot._command

    def slow(positions):
        begun.set()
        time.sleep(0.001)
        command(positions)

    robot._command = slow
    mover = threading.Thread(target=lambda: went_on.append(robot.perform(LONG)))
    mover.start()
    assert begun.wait(WAIT_S)
    with pytest.raises(Error, match="one at a time"):
        robot.perform(NOD)
    robot.close()
    mover.join(WAIT_S)
    assert went_on == [False] and robot.events[-1].kind == "stop"


def test_a_closed_robot_does_nothing(robot):
    robot.close()
    robot.close()
    for attempt in (
        lambda: robot.perform(NOD),
        lambda: robot.hold(0.1),
        lambda: robot.reset({}),
        robot.state,
        robot.joint_positions_rad,
        robot.render,
    ):
        with pytest.raises(Error, match="closed"):
            attempt()
    robot.stop()


@pytest.mark.parametrize("seconds", [float("nan"), float("inf"), -1.0])
def test_a_time_to_hold_is_finite(robot, seconds):
    with pytest.raises(InvalidArgument, match="duration_s"):
        robot.hold(seconds)


def test_an_exception_brings_the_joints_to_rest(robot):
    sent = commanded(robot)

    def on_frame(image, time_s):
        if time_s > 0.7:
            raise KeyError("mine")

    with pytest.raises(KeyError, match="mine"):
        robot.perform(gesture_trajectory("9"), on_frame, fps=10, size=(16, 16))
    arm = np.array([positions["larm_joint_1"] for positions in sent])
    speeds = np.diff(arm) / robot.step_s
    assert np.abs(speeds).max() > 0.5 and abs(speeds[-1]) < 0.3, "it moved, and slowed down"
    assert robot.hold(0.1) and not robot.stopped


def test_an_interrupt_while_following_brings_the_joints_to_rest(robot):
    sent = commanded(robot)
    command = robot._command

    def interrupted(positions):
        command(positions)
        if sent[-1]["head_joint_2"] > 0.1 and robot._command is interrupted:
            robot._command = command
            raise KeyboardInterrupt  # as it comes while a robot's link sleeps

    robot._command = interrupted
    with pytest.raises(KeyboardInterrupt):
        robot.follow(["head_joint_2"], lambda time_s: np.array([0.8]))
    head = np.array([positions["head_joint_2"] for positions in sent])
    speeds = np.diff(head) / robot.step_s
    assert 0.1 < head[-1] < 0.7 and speeds.max() > 0.5 and abs(speeds[-1]) < 0.1, "it moved, and slowed down"
    assert np.abs(np.diff(speeds)).max() / robot.step_s <= 1.01 * HOAP2.max_acceleration_rad_s2
    assert robot.hold(0.1) and not robot.stopped


def test_a_robot_that_takes_no_commands_is_stopped_and_found_again():
    with open_robot("kinematic") as robot:
        command, count = robot._command, [0]

        def failing(positions):
            count[0] += 1
            if count[0] == 60:
                raise OSError("unplugged")
            command(positions)

        robot._command = failing
        with pytest.raises(OSError, match="unplugged"):
            robot.perform(gesture_trajectory("9"))
        assert count[0] == 60, "nothing is sent after a failure"
        assert robot.stopped and robot.events[-1].kind == "fault"
        assert robot.perform(gesture_trajectory("9")) is False
        robot._positions["larm_joint_1"] = 0.9  # moved by hand meanwhile
        robot.resume()
        sent = commanded(robot)
        assert robot.perform(gesture_trajectory("rest"))
        assert sent[0]["larm_joint_1"] == pytest.approx(0.9, abs=0.01)


# Under nohup SIGHUP is ignored, and a program that is started there ignores it, too.
QUEUE_UNDER_SIGNALS = """
import signal, sys, time
from hri.robot import Trajectory, open_robot, stopped_by_signals
from hri.robot.simulation.kinematic_backend import KinematicRobot

command = KinematicRobot._command
def slow(robot, positions):
    time.sleep(0.002)
    command(robot, positions)
KinematicRobot._command = slow
signal.signal(signal.SIGHUP, signal.SIG_DFL)
nod = Trajectory(["head_joint_2"], 0.5, [[0.0], [0.4], [0.0]])
with open_robot({backend!r}) as robot, stopped_by_signals(robot) as signals:
    print("moving", flush=True)
    done = [robot.perform(nod) for _ in range(1000)]
    print(done.index(False), any(done[done.index(False):]), signals, [event.kind for event in robot.events[:1]])
"""


@pytest.mark.parametrize("backend", [pytest.param("pybullet", marks=needs_pybullet), "kinematic"])
@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT, signal.SIGHUP])
def test_a_signal_from_another_process_stops_the_queue(backend, number):
    code = QUEUE_UNDER_SIGNALS.format(backend=backend)
    with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True) as process:
        lines = iter(line for line in process.stdout if "build time" not in line)
        assert next(lines) == "moving\n"
        time.sleep(0.4)
        process.send_signal(number)
        done = next(lines).split()
    assert process.returncode == 0 and done[1:] == ["False", f"[{int(number)}]", "['stop']"]


def enter(robot, interrupts):
    with stopped_by_signals(robot) as signals:
        for _ in range(interrupts):
            signal.raise_signal(signal.SIGINT)
            assert signals == [signal.SIGINT] and robot.stopped


def test_a_second_signal_ends_the_program_and_handlers_are_put_back():
    before = signal.getsignal(signal.SIGINT)
    with open_robot("kinematic") as robot:
        enter(robot, 1)
        assert signal.getsignal(signal.SIGINT) is before
        with pytest.raises(KeyboardInterrupt):
            enter(robot, 2)
        assert signal.getsignal(signal.SIGINT) is before


def test_signals_are_for_the_main_thread():
    found = []

    def elsewhere():
        with open_robot("kinematic") as robot:
            try:
                enter(robot, 0)
            except InvalidArgument as error:
                found.append(str(error))

    thread = threading.Thread(target=elsewhere)
    thread.start()
    thread.join()
    assert len(found) == 1 and "main thread" in found[0]


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT])
def test_the_play_command_ends_with_the_signals_code(number, monkeypatch):
    testing = pytest.importorskip("click.testing")
    from hri.cli.robot import robot as group

    command, sent = KinematicRobot._command, []

    def interrupted(robot, positions):
        sent.append(positions)
        if len(sent) == 50:
            signal.raise_signal(number)
        command(robot, positions)

    monkeypatch.setattr(KinematicRobot, "_command", interrupted)
    result = testing.CliRunner().invoke(group, ["play", "9", "--backend", "kinematic"])
    assert result.exit_code == 128 + number and len(sent) < 100


@pytest.mark.parametrize(
    ("positions", "posture", "named"),
    [
        ({"larm_joint_1": float("nan")}, None, "larm_joint_1"),
        ({"larm_joint_1": float("inf")}, None, "larm_joint_1"),
        ({"larm_joint_1": 10**400}, None, "larm_joint_1"),
        ({"larm_joint_1": "0.1"}, None, "larm_joint_1: '0.1' is no number"),
        ({"larm_joint_1": None}, None, "no number"),
        ({"larm_joint_1": [0.1]}, None, "no number"),
        ({"larm_joint_1": 3.0}, None, r"larm_joint_1: 3\.0 rad is outside .*-91\.0 to 151\.0 deg"),
        ({"head_joint_1": 0.1, "larm_joint_4": 0.5}, "standing", "larm_joint_4"),
        ({"head_joint_1": 0.1, "tail": 0.5}, None, "tail"),
        ({"head_joint_1": 0.1}, "sitting", "posture"),
    ],
)
def test_reset_refuses_what_no_joint_can_do(robot, positions, posture, named):
    before = robot.joint_positions_rad()
    with pytest.raises(InvalidArgument, match=named):
        robot.reset(positions, posture)
    assert robot.joint_positions_rad() == before and robot._commanded["head_joint_1"] == 0.0
    with pytest.raises(InvalidArgument, match="no joint"):
        robot.reset({"leg": 0.0})
    robot.reset({joint.name: joint.lower_rad for joint in HOAP2.joints})


@pytest.mark.skipif(not hasattr(signal, "SIGPIPE"), reason="no SIGPIPE here")
def test_a_broken_pipe_ends_no_program_that_moves_a_robot() -> None:
    before = signal.signal(signal.SIGPIPE, signal.SIG_DFL)  # as the command line has it
    try:
        with open_robot("kinematic") as robot, stopped_by_signals(robot):
            read, write = os.pipe()
            os.close(read)
            with pytest.raises(BrokenPipeError):
                os.write(write, b"a line")
            os.close(write)
        assert signal.getsignal(signal.SIGPIPE) is signal.SIG_DFL
    finally:
        signal.signal(signal.SIGPIPE, before)
