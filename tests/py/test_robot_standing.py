# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""A robot on its feet: it settles, keeps its balance, falls when nothing holds it, stops, and writes a log."""

import json
from importlib.util import find_spec

import numpy as np
import pytest

from conftest import robot_data
from hri.core.errors import InvalidArgument, IoError
from hri.robot import HOAP2, MotionLog, Physics, Trajectory, gesture_trajectory, open_robot
from hri.robot.control.braking import brake
from hri.robot.model.postures import base_pose

needs_pybullet = pytest.mark.skipif(find_spec("pybullet") is None, reason="no pybullet")
FEET = set(HOAP2.feet)


def squat(depth_rad, seconds=2.0):
    """Bends and stretches the knees."""
    times = np.arange(0.0, seconds + 0.005, 0.01)
    bend = depth_rad * 0.5 * (1 - np.cos(2 * np.pi * times / seconds))
    sides = [("lleg_joint_3", -0.5), ("lleg_joint_4", 1.0), ("lleg_joint_5", -0.5)]
    sides += [(name.replace("lleg", "rleg"), part) for name, part in sides]
    return Trajectory([name for name, _ in sides], 0.01, np.stack([part * bend for _, part in sides], axis=1))


def test_soles_lie_flat_on_the_floor():
    bent = {"lleg_joint_3": -0.4, "rleg_joint_3": -0.4, "lleg_joint_4": 0.6, "rleg_joint_4": 0.6, "body_joint_1": 0.2}
    from hri.robot import link_poses

    base = base_pose(bent, "standing", HOAP2)
    for foot in HOAP2.feet:
        pose = link_poses(bent, base)[foot]
        np.testing.assert_allclose(pose[:3, 2], (0, 0, 1), atol=1e-9)
        assert pose[2, 3] == pytest.approx(0.0405, abs=1e-9)
    lying = base_pose({}, "back", HOAP2)
    np.testing.assert_allclose(lying[:3, 0], (0, 0, 1), atol=1e-12)
    with pytest.raises(InvalidArgument, match="posture"):
        base_pose({}, "sitting", HOAP2)


def test_braking_keeps_every_limit():
    rng = np.random.default_rng(4)
    limits = HOAP2.limits_rad
    for _ in range(50):
        positions = rng.uniform(limits[:, 0], limits[:, 1])
        # A joint that keeps the limits is never nearer to one than the hardest braking needs.
        room = np.minimum(positions - limits[:, 0], limits[:, 1] - positions)
        speeds = rng.uniform(-1, 1, 25) * np.minimum(5.0, np.sqrt(2 * 99.0 * room))
        rows = brake(positions, speeds, limits, 5.0, 100.0, 0.001)
        assert (rows >= limits[:, 0]).all() and (rows <= limits[:, 1]).all()
        velocity = np.diff(np.vstack((positions - 0.001 * speeds, positions, rows, rows[-1:])), axis=0) / 0.001
        assert np.abs(velocity).max() <= 5.0 + 1e-6
        assert np.abs(np.diff(velocity, axis=0)).max() / 0.001 <= 100.0 + 1e-6
        assert np.abs(velocity[-1]).max() == 0.0


@needs_pybullet
def test_it_stands_squats_and_tells_what_it_does(tmp_path):
    log = MotionLog(0.02)
    with open_robot("pybullet", fixed_base=False) as robot:
        begin = robot.state()
        assert {(contact.link, contact.other) for contact in begin.contacts} == {(foot, "floor") for foot in FEET}
        assert sum(contact.force_n for contact in begin.contacts) == pytest.approx(7.16 * 9.81, rel=0.05)
        assert robot.perform(squat(0.8), log=log) and robot.events == []
        assert robot.hold(0.5, log)
    heights = [state.base_position_m[2] for state in log.states]
    assert min(heights) < begin.base_position_m[2] - 0.01 and abs(heights[-1] - heights[0]) < 0.01
    assert len(log.states) == pytest.approx((2.0 + 0.1 + 0.5) / 0.02, abs=2)  # 0.1 s is the smoothing's
    assert max(abs(state.torques_n_m["lleg_joint_4"]) for state in log.states) > 0.1
    log.write(tmp_path / "log.json")
    read = json.loads((tmp_path / "log.json").read_text())
    assert read["states"][-1]["positions_rad"]["lleg_joint_4"] == log.states[-1].positions_rad["lleg_joint_4"]
    with pytest.raises(IoError, match="log"):
        log.write(tmp_path / "none" / "log.json")
    with pytest.raises(InvalidArgument, match="period_s"):
        MotionLog(0.0)


@needs_pybullet
def test_after_a_fall_the_motors_hold_and_an_event_says_so():
    lean = np.linspace(0.0, -0.9, 150)
    topple = Trajectory(["lleg_joint_5", "rleg_joint_5"], 0.01, np.stack((lean, lean), axis=1))
    log = MotionLog(0.02)
    with open_robot("pybullet", fixed_base=False) as robot:
        assert robot.hold(0.7)
        assert robot.perform(topple, log=log) is False
        assert [event.kind for event in robot.events] == ["fall"] == [event.kind for event in log.events]
        held = robot.joint_positions_rad()
        assert robot.state().torques_n_m["lleg_joint_4"] != 0.0
        robot.hold(0.5)
        for name, position in robot.joint_positions_rad().items():
            assert position == pytest.approx(held[name], abs=0.05)


@needs_pybullet
def test_balance_is_kept_when_joints_are_off():
    off = {"lleg_joint_5": 0.03, "rleg_joint_5": 0.03, "lleg_joint_3": 0.02, "rleg_joint_3": 0.02}

    def pitch(balance):
        with open_robot("pybullet", fixed_base=False, physics=Physics(joint_offsets_rad=off, balance=balance)) as robot:
            robot.hold(2.0)
            assert robot.state().positions_rad["lleg_joint_5"] != pytest.approx(off["lleg_joint_5"], abs=1e-3)
            return abs(robot.state().base_rpy_rad[1])

    assert pitch(True) < 0.9 * pitch(False)


@needs_pybullet
def test_the_simulation_is_built_in_one_order_whatever_the_hashes_are(monkeypatch):
    import pybullet

    pairs, filter_pair = [], pybullet.setCollisionFilterPair

    def spy(body, other, first, second, *arguments, **more):
        pairs.append((first, second))
        return filter_pair(body, other, first, second, *arguments, **more)

    monkeypatch.setattr(pybullet, "setCollisionFilterPair", spy)
    with open_robot("pybullet") as robot:
        built = [tuple(robot._links[index] for index in pair) for pair in pairs]
    assert built == sorted(built) and {frozenset(pair) for pair in built} == HOAP2.adjoining


@needs_pybullet
def test_physics_counts():
    with open_robot("pybullet", fixed_base=False, physics=Physics(mass_scale=1.5)) as robot:
        weight = sum(contact.force_n for contact in robot.state().contacts)
    assert weight == pytest.approx(1.5 * 7.16 * 9.81, rel=0.05)
    with pytest.raises(InvalidArgument, match="friction"):
        Physics(friction=0.0)
    for offset in (float("nan"), float("inf"), -2.0):
        with pytest.raises(InvalidArgument, match="joint_offsets_rad of head_joint_1"):
            Physics(joint_offsets_rad={"head_joint_1": offset})
    with pytest.raises(InvalidArgument, match="solver_iterations"):
        Physics(solver_iterations=0)
    with pytest.raises(InvalidArgument, match="no joint 'tail'"):
        open_robot("pybullet", locked=["tail"])


@needs_pybullet
def test_locked_joints_rest_and_refuse():
    with open_robot("pybullet", locked=["head_joint_1", "rarm_joint_1"]) as robot:
        assert robot.joint_positions_rad()["rarm_joint_1"] == HOAP2["rarm_joint_1"].rest_rad
        with pytest.raises(InvalidArgument, match="head_joint_1 is locked"):
            robot.perform(Trajectory(["head_joint_1"], 0.1, [[0.0], [0.1], [0.2]]))
        left = Trajectory(["larm_joint_1"], 0.1, [[1.4], [1.3]])
        assert robot.perform(left)


@needs_pybullet
@pytest.mark.slow
def test_stop_in_mid_walk_ends_in_a_held_pose():
    from hri.robot import read_pulse_csv

    path = robot_data("walk.csv")
    walk = read_pulse_csv(path)
    idle = [name for name in HOAP2.names if name not in walk.joint_names]
    with open_robot("pybullet", fixed_base=False, locked=idle) as robot:
        robot.reset(dict(zip(walk.joint_names, walk.positions_rad[0].tolist(), strict=True)), "standing")
        log = MotionLog(0.002)

        def on_frame(image, time_s):
            if time_s > 5.0:
                robot.stop()

        assert robot.perform(walk, on_frame, 10, (16, 16), log) is False
        robot.hold(1.0, log)
        assert [event.kind for event in robot.events] == ["stop"]
    arms = np.array([[v for n, v in s.positions_rad.items() if "arm" in n] for s in log.states])
    assert np.abs(np.diff(arms, axis=0)).max() / 0.002 < HOAP2.max_speed_rad_s
    mean_speed = (arms[25:] - arms[:-25]) / 0.05
    assert np.abs(mean_speed[25:] - mean_speed[:-25]).max() / 0.05 < HOAP2.max_acceleration_rad_s2
    assert np.abs(mean_speed[1000:3000]).max() > 0.1  # they did move
    assert np.abs(arms[-1] - arms[-100]).max() < 0.01


def test_gestures_need_no_posture():
    with open_robot("kinematic") as robot:
        robot.reset({"larm_joint_1": 0.5}, "standing")
        state = robot.state()
        assert state.positions_rad["larm_joint_1"] == 0.5 and state.contacts == ()
        assert robot.hold(0.05) and robot.time_s == pytest.approx(0.05)
        assert robot.perform(gesture_trajectory("rest"))
