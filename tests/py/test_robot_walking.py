# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Legs in closed form, walking, and the motions of commands with slots."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

from hri.core.errors import InvalidArgument
from hri.robot import (
    HOAP2,
    NAO,
    MotionLog,
    Physics,
    Trajectory,
    check_trajectory,
    command_trajectory,
    gesture_trajectory,
    link_poses,
    mirrored,
    open_robot,
    walking_trajectory,
)
from hri.robot.model.arm import SIDES
from hri.robot.model.leg import leg_angles, leg_of
from hri.studies.robot_motions import offsets


def test_a_leg_brings_a_level_sole_to_its_place() -> None:
    rng = np.random.default_rng(0)
    for side in SIDES:
        leg = leg_of(side)
        below = np.column_stack([rng.uniform(-0.06, 0.06, (50, 2)), rng.uniform(-0.18, -0.13, 50)])
        for ankle, angles in zip(leg.hip_m + below, leg_angles(leg, leg.hip_m + below), strict=True):
            pose = link_poses(dict(zip(leg.names, angles.tolist(), strict=True)), np.eye(4))[f"{side[0]}leg_link_6"]
            assert np.allclose(pose[:3, :3], np.eye(3), atol=1e-12) and np.allclose(pose[:3, 3], ankle, atol=1e-12)
    with pytest.raises(InvalidArgument, match=r"the foot is out of reach: 0.210 m from the hip"):
        leg_angles(leg, leg.hip_m - np.array([0.0, 0.0, 0.21]))
    with pytest.raises(InvalidArgument, match="no legs of HOAP-2's kind"):
        leg_of("left", NAO)


@pytest.mark.parametrize("step_m", [0.05, 0.01, -0.04])
def test_a_walk_passes_the_checks_and_begins_and_ends_standing(step_m: float) -> None:
    walk = walking_trajectory(3, step_m)
    assert check_trajectory(walk) == []
    assert np.allclose(walk.positions_rad[[0, -1]], 0.0)
    feet = [[], []]
    for row in walk.positions_rad[::20]:
        poses = link_poses(dict(zip(walk.joint_names, row.tolist(), strict=True)), np.eye(4))
        for foot, link in enumerate(HOAP2.feet):
            assert np.allclose(poses[link][:3, :3], np.eye(3), atol=1e-3)  # soles are level throughout
            feet[foot].append(poses[link][0, 3])
    apart = np.subtract(*feet)
    assert np.abs(apart).max() == pytest.approx(abs(step_m), abs=2e-3) and abs(apart[-1]) < 1e-6
    # The right foot goes first, then they take turns: the left one is behind, before, behind.
    assert np.sign(apart[np.argmax(np.abs(apart) > 0.9 * abs(step_m))]) == -np.sign(step_m)


def test_the_robot_walks_three_steps() -> None:
    pytest.importorskip("pybullet")
    walk = command_trajectory({"walk": "forward", "steps": "3"})
    idle = [name for name in HOAP2.names if name not in walk.joint_names]
    with open_robot("pybullet", fixed_base=False, locked=idle) as robot:
        begin = robot.state()
        log = MotionLog(0.05)
        assert robot.on_feet and robot.perform(walk, log=log)
        end = robot.state()
        way = np.subtract(end.base_position_m, begin.base_position_m)
        assert 0.10 < way[0] < 0.13 and abs(way[1]) < 0.02 and abs(way[2]) < 0.005
        assert np.degrees(np.abs([state.base_rpy_rad[:2] for state in log.states]).max()) < 3.0
        assert robot.events == [] and robot.self_contacts == []
        # Three times one foot alone carries the robot and then the other; a fourth time the last one comes beside it.
        alone = [links for state in log.states if len(links := {c.link for c in state.contacts}) == 1]
        changes = 1 + sum(a != b for a, b in itertools.pairwise(alone))
        assert changes == 4


@pytest.mark.slow
@pytest.mark.parametrize(
    ("sign", "physics", "least_m", "most_turn_deg"),
    [
        (1, Physics(friction=0.6), 0.11, 2.0),
        (-1, Physics(), 0.11, 2.0),
        (1, Physics(joint_offsets_rad=offsets(600)), 0.09, 6.0),
        (1, Physics(joint_offsets_rad=offsets(601)), 0.09, 6.0),
        (1, Physics(joint_offsets_rad=offsets(602)), 0.09, 6.0),
    ],
)
def test_it_walks_on_smooth_floors_backward_and_with_joints_that_are_off(
    sign: int, physics: Physics, least_m: float, most_turn_deg: float
) -> None:
    pytest.importorskip("pybullet")
    walk = walking_trajectory(3, 0.04 * sign)
    idle = [name for name in HOAP2.names if name not in walk.joint_names]
    with open_robot("pybullet", fixed_base=False, locked=idle, physics=physics) as robot:
        begin = robot.state()
        log = MotionLog(0.05)
        assert robot.perform(walk, log=log)
        end = robot.state()
        assert least_m < sign * (end.base_position_m[0] - begin.base_position_m[0]) < 0.13
        assert np.degrees(np.abs([state.base_rpy_rad[:2] for state in log.states]).max()) < 2.0
        assert abs(np.degrees(end.base_rpy_rad[2] - begin.base_rpy_rad[2])) < most_turn_deg
        assert not any(event.kind == "fall" for event in robot.events) and robot.self_contacts == []


def test_slots_choose_the_arm_and_how_often() -> None:
    once = gesture_trajectory("up")
    right = command_trajectory({"gesture": "up", "side": "right", "times": "2"})
    assert np.array_equal(right.positions_rad, np.tile(once.positions_rad, (2, 1)))
    left = command_trajectory({"gesture": "up", "side": "left"})
    moves = dict(zip(left.joint_names, np.ptp(left.positions_rad, axis=0).tolist(), strict=True))
    assert moves["larm_joint_1"] > 1.0 and moves["rarm_joint_1"] < 1e-9
    assert check_trajectory(left) == []
    assert np.allclose(mirrored(left).positions_rad, once.positions_rad)
    turned = mirrored(Trajectory(["head_joint_1", "head_joint_2"], 0.1, [[0.2, 0.1]]))
    assert turned.positions_rad.tolist() == [[-0.2, 0.1]]
    back = command_trajectory({"walk": "backward"})
    assert np.array_equal(back.positions_rad, walking_trajectory(1, -0.04).positions_rad)


@pytest.mark.parametrize(
    ("slots", "message"),
    [
        ({}, "needs the slot 'gesture' or 'walk', and has none"),
        ({"side": "left"}, "and has side"),
        ({"gesture": "up", "steps": "2"}, "the slot 'steps' says nothing about a gesture"),
        ({"walk": "forward", "times": "2"}, "the slot 'times' says nothing about a walk"),
        ({"gesture": "up", "times": "11"}, "is 11, must lie in 1..10"),
        ({"gesture": "up", "times": "two"}, "is 'two', must be a whole number from 1"),
        ({"walk": "forward", "steps": "0"}, "is '0', must be a whole number from 1"),
        ({"walk": "forward", "steps": "21"}, "num_steps is 21, must lie in 1..20"),
        ({"walk": "up"}, "is 'up', must be forward or backward"),
        ({"gesture": "up", "side": "both"}, "is 'both', must be left or right"),
        ({"gesture": "namaste", "side": "left"}, "'namaste' is not made by one arm"),
        ({"gesture": "upp"}, "upp"),
    ],
)
def test_commands_that_cannot_be_carried_out_are_refused(slots: dict[str, str], message: str) -> None:
    with pytest.raises(InvalidArgument, match=message):
        command_trajectory(slots)


def test_only_hoap2_walks() -> None:
    with pytest.raises(InvalidArgument, match="no legs of HOAP-2's kind"):
        command_trajectory({"walk": "forward"}, NAO)
    with pytest.raises(InvalidArgument, match="'side' is for HOAP-2 alone"):
        command_trajectory({"gesture": "up", "side": "left"}, NAO)
    for step_m in (0.0, 0.06, float("nan")):
        with pytest.raises(InvalidArgument, match="step_m is"):
            walking_trajectory(1, step_m)
