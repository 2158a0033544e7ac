# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The example of a ROS 1 node, with roscore and a controller as a node of its own on this machine."""

from __future__ import annotations

import contextlib
import json
import os
import shutil
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from xmlrpc.client import ServerProxy

import numpy as np
import pytest

from hri.robot import HOAP2, gesture_trajectory

ROOT = Path(__file__).resolve().parents[2]
EXAMPLE = ROOT / "examples" / "ros1_robot" / "ros1_robot.py"
CONTROLLER = Path(__file__).with_name("ros1_controller.py")
# Where Debian puts ROS; behind everything of this environment, whose NumPy goes first.
DEBIANS = "/usr/lib/python3/dist-packages"

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(not (shutil.which("roscore") and Path(DEBIANS, "rospy").exists()), reason="no ROS 1 (ros-core)"),
]
Start = Callable[..., subprocess.Popen[str]]


@pytest.fixture
def port() -> int:
    """Where the master of one test listens."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        return int(free.getsockname()[1])


@pytest.fixture
def start(port: int, tmp_path: Path) -> Iterator[Start]:
    """Starts programs that see ROS; all of them end with the test."""
    environment = os.environ | {
        "ROS_MASTER_URI": f"http://127.0.0.1:{port}",
        "ROS_IP": "127.0.0.1",
        "ROS_HOME": str(tmp_path / "ros"),
    }
    started = []

    def begin(program: Path | str, *arguments: object) -> subprocess.Popen[str]:
        if program == "roscore":
            command = ["roscore", "-p", str(port)]
        else:
            seen = f"import sys, runpy; sys.path.append({DEBIANS!r}); sys.argv = sys.argv[1:]; "
            command = [sys.executable, "-c", seen + "runpy.run_path(sys.argv[0], run_name='__main__')", str(program)]
        into = subprocess.PIPE if program == EXAMPLE else subprocess.DEVNULL
        process = subprocess.Popen(
            [*command, *map(str, arguments)], env=environment, text=True, stdout=into, stderr=into
        )
        started.append(process)
        return process

    yield begin
    for process in reversed(started):
        process.send_signal(signal.SIGINT)  # roscore ends what it has started itself
        try:
            process.wait(20)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
        for stream in (process.stdout, process.stderr):
            if stream is not None:
                stream.close()


@pytest.fixture
def roscore(start: Start, port: int) -> None:
    start("roscore")
    until = time.monotonic() + 60
    master = ServerProxy(f"http://127.0.0.1:{port}")
    while True:
        with contextlib.suppress(OSError):
            if master.lookupNode("/test", "/rosout")[0] == 1:  # the last thing that roscore starts
                return
        assert time.monotonic() < until
        time.sleep(0.05)


def sent(written: Path) -> np.ndarray:
    return np.array([json.loads(line)[1] for line in written.read_text().splitlines()])


def test_a_gesture_is_performed_from_where_the_joints_are(start: Start, roscore: None, tmp_path: Path) -> None:
    written = tmp_path / "commands"
    start(CONTROLLER, written)
    node = start(EXAMPLE, "namaste")
    out, err = node.communicate(timeout=120)
    assert node.returncode == 0, err
    begun, done = (json.loads(line) for line in out.splitlines())
    assert begun["begins_at_rad"] == HOAP2.rest_rad and done["finished"] is True
    motion = gesture_trajectory("namaste")
    for name, angle in zip(motion.joint_names, motion.positions_rad[-1], strict=True):
        assert done["joints_rad"][name] == pytest.approx(angle, abs=1e-6)
    rows = sent(written)
    assert len(rows) > 50 and rows.shape[1] == len(HOAP2.names)
    assert np.abs(np.diff(rows, axis=0)).max() / 0.02 <= HOAP2.max_speed_rad_s
    assert {json.loads(line)[0] for line in written.read_text().splitlines()} == {0.02}


def test_ctrl_c_stops_in_mid_motion_and_the_joints_hold(start: Start, roscore: None, tmp_path: Path) -> None:
    written = tmp_path / "commands"
    start(CONTROLLER, written)
    node = start(EXAMPLE, "namaste")
    assert node.stdout is not None
    assert node.stdout.readline().startswith('{"begins_at_rad"')
    until = time.monotonic() + 60
    while not written.exists() or len(sent(written)) < 20:
        assert time.monotonic() < until
        time.sleep(0.01)
    node.send_signal(signal.SIGINT)
    out, err = node.communicate(timeout=60)
    assert node.returncode == 0, err
    assert json.loads(out.splitlines()[-1])["finished"] is False
    rows = sent(written)
    assert np.abs(np.diff(rows, axis=0)).max() / 0.02 <= HOAP2.max_speed_rad_s
    np.testing.assert_array_equal(rows[-5:], np.repeat(rows[-1:], 5, axis=0))


def test_a_controller_that_dies_in_mid_motion_is_an_error(start: Start, roscore: None, tmp_path: Path) -> None:
    written = tmp_path / "commands"
    controller = start(CONTROLLER, written)
    node = start(EXAMPLE, "namaste")
    until = time.monotonic() + 60
    while not written.exists() or len(sent(written)) < 20:
        assert time.monotonic() < until
        time.sleep(0.01)
    controller.kill()
    out, err = node.communicate(timeout=60)
    assert node.returncode == 3 and "joint states are silent for 0.5 s" in err, err
    assert len(out.splitlines()) == 1


def test_what_is_missing_is_named(start: Start, tmp_path: Path) -> None:
    node = start(EXAMPLE, "namaste")
    assert node.communicate(timeout=60)[1].startswith("ros1_robot: no ROS master answers at http://127.0.0.1:")
    assert node.returncode == 3


@pytest.mark.parametrize(
    ("silent", "message"),
    [((), "joint states are silent for 5 s"), (("head_joint_1",), "joint states lack head_joint_1")],
)
def test_states_that_are_missing_are_named(
    start: Start, roscore: None, tmp_path: Path, silent: tuple[str, ...], message: str
) -> None:
    if silent:
        start(CONTROLLER, tmp_path / "commands", *silent)
    node = start(EXAMPLE, "namaste")
    assert message in node.communicate(timeout=60)[1] and node.returncode == 3
