# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Both simulated robots: they move as commanded, refuse what is unsafe, stop, and take pictures."""

import subprocess
import sys
import threading
import time
from importlib.util import find_spec
from xml.etree import ElementTree

import numpy as np
import pytest

from hri.core.errors import InvalidArgument
from hri.media import read_frames
from hri.robot import (
    BACKENDS,
    HOAP2,
    Trajectory,
    TrajectoryError,
    gesture_trajectory,
    link_poses,
    load_gestures,
    open_robot,
    render_still,
    render_video,
    rest_positions,
    urdf_text,
)

pytest.importorskip("cv2")
needs_pybullet = pytest.mark.skipif(find_spec("pybullet") is None, reason="no pybullet")


@pytest.fixture(params=[pytest.param("pybullet", marks=needs_pybullet), "kinematic"])
def robot(request):
    with open_robot(request.param) as opened:
        yield opened


def test_importing_the_package_loads_no_simulator():
    code = (
        "import sys, hri.robot as r; r.gesture_trajectory('1');"
        "sys.exit('pybullet' in sys.modules or 'cv2' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


def test_urdf_is_well_formed_with_short_lines():
    text = urdf_text()
    root = ElementTree.fromstring(text)
    assert len(root.findall("joint")) == 25 and len(root.findall("link")) == 26
    assert max(map(len, text.splitlines())) < 200


def test_arms_point_where_the_table_says():
    shoulder = np.array([-0.034, 0.0995, HOAP2.standing_height_m + 0.09])
    for pitch, direction in ((0.0, (1, 0, 0)), (np.pi / 2, (0, 0, -1)), (-np.pi / 2, (0, 0, 1))):
        hand = link_poses({"larm_joint_1": pitch})["larm_link_5"][:3, 3]
        np.testing.assert_allclose(hand - shoulder, 0.201 * np.array(direction), atol=1e-9)
    sole = link_poses({})["lleg_link_6"][2, 3]
    assert sole == pytest.approx(0.0405, abs=1e-9)


@needs_pybullet
def test_links_are_where_pybullet_has_them():
    generator = np.random.default_rng(3)
    low, high = HOAP2.limits_rad.T
    with open_robot("pybullet") as robot:
        for _ in range(5):
            positions = dict(zip(HOAP2.names, generator.uniform(low, high).tolist(), strict=True))
            robot.reset(positions)
            poses = link_poses(positions)
            for name, origin in robot.link_positions_m().items():
                np.testing.assert_allclose(poses[HOAP2[name].child][:3, 3], origin, atol=1e-6)


@needs_pybullet
def test_no_gesture_touches_the_robot_itself():
    with open_robot("pybullet") as robot:
        for name in load_gestures():
            trajectory = gesture_trajectory(name)
            for row in trajectory.positions_rad[::5].tolist():
                robot.reset(dict(zip(trajectory.joint_names, row, strict=True)))
                assert robot.links_nearer_than(0.0) == [], name
        robot.reset({"larm_joint_1": 0.6, "larm_joint_3": 1.5, "larm_joint_4": -1.9})
        assert robot.links_nearer_than(0.05), "the check sees nothing"


def test_a_gesture_is_carried_out_and_filmed(robot):
    trajectory = gesture_trajectory("7")
    seen = []

    def on_frame(image, time_s):
        positions = robot.joint_positions_rad()
        seen.append((image, time_s, [positions[name] for name in trajectory.joint_names]))

    assert robot.perform(trajectory, on_frame, fps=5, size=(160, 120))
    times = [time_s for _, time_s, _ in seen]
    np.testing.assert_allclose(times, np.arange(int(trajectory.duration_s * 5 + 1e-6) + 1) / 5, atol=robot.step_s)
    for image, time_s, positions in seen:
        assert image.shape == (120, 160, 3) and image.dtype == np.uint8
        np.testing.assert_allclose(positions, trajectory.at(time_s), atol=0.12)
    moved = np.abs(seen[0][0].astype(int) - seen[6][0]).max(axis=2) > 40
    assert 50 < moved.sum() < 5000


def test_an_unsafe_motion_moves_nothing(robot):
    before = robot.joint_positions_rad()
    rows = np.radians(np.linspace(80, 170, 300))[:, np.newaxis]
    with pytest.raises(TrajectoryError, match="column S"):
        robot.perform(Trajectory(["larm_joint_1"], 0.01, rows))
    assert robot.joint_positions_rad() == before


def test_the_robot_goes_to_the_first_row_by_itself(robot):
    away = Trajectory(["rarm_joint_1", "head_joint_1"], 0.1, np.zeros((2, 2)))
    assert robot.perform(away)
    positions = robot.joint_positions_rad()
    assert abs(positions["rarm_joint_1"]) < 0.08
    assert positions["larm_joint_1"] == pytest.approx(rest_positions()["larm_joint_1"], abs=0.02)


def test_stop_slows_down_and_holds(robot):
    trajectory = gesture_trajectory("9")
    index = trajectory.joint_names.index("larm_joint_1")
    commanded = []
    command = robot._command

    def spy(positions):
        commanded.append(positions["larm_joint_1"])
        command(positions)

    robot._command = spy

    def on_frame(image, time_s):
        if time_s > 0.7:
            robot.stop()

    assert robot.perform(trajectory, on_frame, fps=10, size=(32, 24)) is False
    speeds = np.diff(commanded) / robot.step_s
    assert np.abs(speeds).max() <= HOAP2.max_speed_rad_s
    assert abs(speeds[-1]) < 0.3, "it slows down"
    assert len(commanded) < 1.2 / robot.step_s
    assert abs(commanded[-1] - trajectory.positions_rad[-1, index]) > 0.5
    assert not robot.perform(gesture_trajectory("rest")) and robot.stopped
    robot.resume()
    assert robot.perform(gesture_trajectory("rest")), "it moves again when commanded"


def test_a_stop_while_a_motion_is_checked_is_not_lost(monkeypatch):
    from hri.robot.control import backend

    with open_robot("kinematic") as robot:
        begin, check = robot.joint_positions_rad(), backend.require_safe

        def stopped_meanwhile(*arguments, **more):
            robot.stop()
            return check(*arguments, **more)

        monkeypatch.setattr(backend, "require_safe", stopped_meanwhile)
        assert robot.perform(gesture_trajectory("9")) is False
        assert [event.kind for event in robot.events] == ["stop"] and robot.joint_positions_rad() == begin


@pytest.mark.parametrize("part", [0.2, 0.5])
def test_stop_from_any_gesture_keeps_the_limits(part):
    for name in load_gestures():
        with open_robot("kinematic") as robot:
            trajectory = gesture_trajectory(name)
            sent, command = [], robot._command

            def spy(positions, robot=robot, sent=sent, command=command, last=part * trajectory.duration_s):
                sent.append([robot._commanded[joint] for joint in HOAP2.names])
                command(positions)
                if robot.time_s > last:
                    robot.stop()

            robot._command = spy
            assert robot.perform(trajectory) is False
            robot._command = command
            speeds = np.diff(sent, axis=0) / robot.step_s
            assert np.abs(speeds).max() <= HOAP2.max_speed_rad_s, name
            mean = (np.array(sent[5:]) - sent[:-5]) / 0.05
            assert np.abs(mean[5:] - mean[:-5]).max() / 0.05 <= HOAP2.max_acceleration_rad_s2, name
            held = robot.joint_positions_rad()
            assert robot.hold(0.2) and robot.joint_positions_rad() == held, name


def test_stop_from_another_thread(robot):
    slow = Trajectory(["head_joint_1"], 10.0, [[0.0], [0.5], [-0.5], [0.5], [0.0]] * 50)
    timer = threading.Timer(0.2, robot.stop)
    timer.start()
    begin = time.monotonic()
    assert robot.perform(slow) is False
    assert time.monotonic() - begin < 60.0


def test_pictures_show_the_whole_robot_on_a_light_ground(robot):
    image = robot.render(240, 180)
    assert image.shape == (180, 240, 3)
    assert image[:8].min() > 200
    hands = (image[..., 0] > 180) & (image[..., 2] < 120)
    assert hands[:, :120].sum() > 30 and hands[:, 120:].sum() > 30
    with pytest.raises(InvalidArgument, match="width"):
        robot.render(4, 180)
    with pytest.raises(InvalidArgument, match=r"no joint|fps"):
        robot.perform(gesture_trajectory("rest"), fps=0)


@pytest.mark.parametrize("backend", [pytest.param("pybullet", marks=needs_pybullet), "kinematic"])
def test_a_video_is_filmed(tmp_path, backend):
    path = tmp_path / "two.mp4"
    progress = []
    trajectory = gesture_trajectory("2")
    frames = render_video(trajectory, path, backend, progress=lambda *at: progress.append(at))
    assert frames == int(trajectory.duration_s * 12 + 1e-6) + 1 and progress[-1] == (frames, frames)
    clip = read_frames(path)
    assert len(clip.frames) == frames


def test_films_and_stills_keep_the_time():
    """A film may have more pictures than the robot has steps; a still is no row of the motion."""
    nod = Trajectory(["head_joint_2"], 0.5, [[0.0], [0.1], [0.0]])
    shown = []
    with open_robot("kinematic") as robot:
        assert robot.perform(nod, lambda image, time_s: shown.append(time_s), fps=250.0, size=(16, 16))
    assert len(shown) == 1 + round(nod.duration_s * 250) and shown == sorted(shown)
    assert np.abs(np.array(shown) - np.arange(len(shown)) / 250.0).max() <= 0.01 + 1e-9


def test_a_still_is_taken_at_its_time(tmp_path, monkeypatch):
    nod = Trajectory(["head_joint_2"], 2.0, [[0.0], [0.8], [0.0]])
    seen = []
    monkeypatch.setattr(
        "hri.robot.simulation.kinematic_backend.KinematicRobot._render",
        lambda robot, width, height: (
            seen.append(robot._positions["head_joint_2"]) or np.zeros((height, width, 3), "u1")
        ),
    )
    for at_s, expected in ((0.5, 0.2), (0.0, 0.0), (3.0, 0.4)):
        render_still(nod, tmp_path / "still.png", at_s, "kinematic", (16, 16))
        assert seen[-1] == pytest.approx(expected, abs=0.01)


def test_what_cannot_be_opened():
    assert BACKENDS == ("pybullet", "kinematic")
    with pytest.raises(InvalidArgument, match="pybullet, kinematic"):
        open_robot("webots")
    with pytest.raises(InvalidArgument, match="window"):
        open_robot("kinematic", gui=True)
    with pytest.raises(InvalidArgument, match="feet"):
        open_robot("kinematic", fixed_base=False)
