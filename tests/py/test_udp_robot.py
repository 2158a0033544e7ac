# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The example of a robot behind a UDP port, against a controller of our own on this machine."""

import gc
import importlib.util
import json
import socket
import threading
import warnings
from pathlib import Path

import numpy as np
import pytest

from hri.core.errors import Error, IoError
from hri.robot import HOAP2, MotionLog, Trajectory, TrajectoryError

EXAMPLE = Path(__file__).resolve().parents[2] / "examples" / "udp_robot" / "udp_robot.py"


@pytest.fixture
def udp_robot():
    spec = importlib.util.spec_from_file_location("udp_robot", EXAMPLE)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.UdpRobot


class Controller(threading.Thread):
    """Joints are where they are sent; remembers what was sent, and falls silent after some datagrams."""

    def __init__(self, answers=10**9):
        super().__init__(daemon=True)
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.bind(("127.0.0.1", 0))
        self.port = self.socket.getsockname()[1]
        self.positions = dict(HOAP2.rest_rad)
        self.received = []
        self.answers = answers
        self.on_received = lambda number: None
        self.start()

    def run(self):
        while True:
            data, sender = self.socket.recvfrom(65536)
            if not data.startswith(b"{"):
                return
            message = json.loads(data)
            self.received.append(message["positions_rad"])
            self.positions.update(message["positions_rad"])
            self.on_received(len(self.received))
            if len(self.received) <= self.answers:
                stale = {"step": message["step"] - 1, "positions_rad": {}}
                fresh = {"step": message["step"], "positions_rad": self.positions}
                for answer in (stale, fresh):
                    self.socket.sendto(json.dumps(answer).encode(), sender)


@pytest.fixture
def controller():
    made = Controller()
    yield made
    socket.socket(socket.AF_INET, socket.SOCK_DGRAM).sendto(b"end", ("127.0.0.1", made.port))
    made.join(5.0)


def test_a_motion_is_sent_from_where_the_robot_stands(udp_robot, controller):
    nod = Trajectory(["head_joint_2"], 0.1, [[0.3], [0.2], [0.0]])
    log = MotionLog(0.02)
    with udp_robot("127.0.0.1", controller.port) as robot:
        assert robot.joint_positions_rad() == HOAP2.rest_rad
        assert robot.perform(nod, log=log)
        with pytest.raises(Error, match="perform"):
            robot.reset({"head_joint_2": 0.0})
        with pytest.raises(TrajectoryError):
            robot.perform(Trajectory(["head_joint_2"], 0.1, [[0.0], [2.0]]))
    assert controller.received[0] == {}, "the first datagram commands nothing"
    sent = np.array([positions["head_joint_2"] for positions in controller.received if positions])
    assert abs(sent[0]) < 0.01 and sent.max() == pytest.approx(0.3, abs=0.01) and sent[-1] == pytest.approx(0.0)
    assert np.abs(np.diff(sent)).max() / 0.02 <= HOAP2.max_speed_rad_s
    assert len(log.states) == len(sent)


def test_a_silent_controller_is_an_error(udp_robot):
    controller = Controller(answers=5)
    with udp_robot("127.0.0.1", controller.port, timeout_s=1.0) as robot, pytest.raises(IoError, match="not answer"):
        robot.hold(1.0)
    asked = controller.received[5:]
    assert 1 < len(asked) < 10 and all(positions == asked[0] for positions in asked), "asked again, and then no more"


def test_stop_and_resume(udp_robot, controller):
    slow = Trajectory(["head_joint_2"], 5.0, [[0.0], [1.0]])
    with udp_robot("127.0.0.1", controller.port) as robot:
        controller.on_received = lambda number: robot.stop() if number == 20 else None
        assert robot.perform(slow) is False
        at_rest = controller.positions["head_joint_2"]
        assert 0.0 < at_rest < 0.5
        count = len([positions for positions in controller.received if positions])
        assert [robot.perform(slow) for _ in range(3)] == [False] * 3
        assert len([positions for positions in controller.received if positions]) == count, "nothing was sent"
        robot.hold(0.1)
        assert controller.positions["head_joint_2"] == at_rest
        robot.resume()
        assert robot.perform(Trajectory(["head_joint_2"], 0.1, [[at_rest], [at_rest]]))


def test_a_lost_link_stops_and_the_joints_are_asked_for_afterwards(udp_robot, controller):
    nod = Trajectory(["head_joint_2"], 0.1, [[0.3], [0.2], [0.1]])
    with udp_robot("127.0.0.1", controller.port, timeout_s=1.0) as robot:
        controller.answers = 10
        with pytest.raises(IoError, match="not answer"):
            robot.perform(nod)
        assert robot.stopped and robot.events[-1].kind == "fault" and robot.perform(nod) is False
        controller.answers = 10**9
        controller.positions |= {"head_joint_1": 0.2}  # the head was turned meanwhile
        count = len(controller.received)
        assert robot.hold(0.1) and robot.stopped
        assert controller.received[count] == {}
        assert {positions["head_joint_1"] for positions in controller.received[count + 1 :]} == {0.2}, "held as found"
        controller.answers = len(controller.received)
        with pytest.raises(IoError, match="not answer"):
            robot.hold(0.1)
        controller.answers = 10**9
        controller.positions |= {"head_joint_1": 0.5, "head_joint_2": 0.9}
        robot.resume()
        count = len(controller.received)
        assert robot.perform(nod)
    assert controller.received[count] == {}
    sent = controller.received[count + 1 :]
    assert sent[0]["head_joint_2"] == pytest.approx(0.9, abs=0.01), "it begins where the joints are"
    assert {positions["head_joint_1"] for positions in sent} == {0.5}, "and the others stay"


def test_a_position_that_is_no_number_is_an_error(udp_robot, controller):
    controller.positions["head_joint_2"] = float("nan")
    with pytest.raises(IoError, match="nonsense"):
        udp_robot("127.0.0.1", controller.port)


@pytest.mark.parametrize(
    "answer", [b"[" * 60000, b'{"step": 1, "positions_rad": {"head_joint_1": 1' + b"0" * 400 + b"}}"]
)
def test_any_nonsense_is_an_error_and_leaves_no_socket_open(udp_robot, answer):
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as odd:
        odd.bind(("127.0.0.1", 0))
        thread = threading.Thread(target=lambda: odd.sendto(answer, odd.recvfrom(65536)[1]))
        thread.start()
        with warnings.catch_warnings():
            warnings.simplefilter("error", ResourceWarning)
            with pytest.raises(IoError, match="nonsense"):
                udp_robot("127.0.0.1", odd.getsockname()[1], timeout_s=20.0)
            gc.collect()
        thread.join()
    with pytest.raises(IoError, match="no-such-host"):
        udp_robot("no-such-host.invalid", 1)


def test_a_lost_answer_does_no_harm(udp_robot, controller):
    nod = Trajectory(["head_joint_2"], 0.1, [[0.1], [0.1]])
    lost = []

    def on_received(number):
        controller.answers = 10**9 if number % 7 else 0
        if number % 7 == 0:
            lost.append(number)

    controller.on_received = on_received
    with udp_robot("127.0.0.1", controller.port, timeout_s=4.0) as robot:
        assert robot.perform(nod) and len(lost) > 2


def test_chatter_is_no_answer(udp_robot, controller):
    """Datagrams that answer nothing keep no motion, and no STOP, waiting."""
    ends = threading.Event()

    def chatter(number):
        if number == 6:
            controller.answers = 0
            while not ends.wait(0.01):
                controller.socket.sendto(b'{"step": 0, "positions_rad": {}}', ("127.0.0.1", robots[0]))

    robots = []
    with udp_robot("127.0.0.1", controller.port, timeout_s=1.0) as robot:
        robots.append(robot._socket.getsockname()[1])
        controller.on_received = chatter
        with pytest.raises(IoError, match="does not answer within 1 s"):
            robot.hold(10.0)
        ends.set()


def test_where_the_joints_are_is_known_during_a_motion(udp_robot, controller):
    """A page asks for it from another thread, all the time; the controller is not asked then."""
    slow = Trajectory(["head_joint_2"], 0.5, [[0.0], [0.3]])
    seen = []
    with udp_robot("127.0.0.1", controller.port) as robot:
        assert robot.known_positions_rad() == HOAP2.rest_rad
        assert robot.perform(Trajectory(["head_joint_2"], 0.1, [[0.0], [0.0]]))
        ends = threading.Event()

        def ask():
            while not ends.wait(0.001):
                seen.append(robot.known_positions_rad()["head_joint_2"])

        thread = threading.Thread(target=ask)
        thread.start()
        count = len(controller.received)
        assert robot.perform(slow)
        ends.set()
        thread.join()
        assert all(controller.received[count:]) and seen == sorted(seen) and seen[-1] > 0.2
