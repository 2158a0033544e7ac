# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Motions are checked from where the joints are: those that they do not name, and the way to their first row."""

import json
from functools import cache
from importlib.util import find_spec

import numpy as np
import pytest

from hri.robot import (
    HOAP2,
    MotionLog,
    Trajectory,
    TrajectoryError,
    check_trajectory,
    gesture_trajectory,
    load_gestures,
    open_robot,
    self_collisions,
    spline,
)

needs_pybullet = pytest.mark.skipif(find_spec("pybullet") is None, reason="no pybullet")
SIDES = {"left": [f"larm_joint_{number}" for number in (1, 2, 3, 4)]}
SIDES["right"] = [name.replace("larm", "rarm") for name in SIDES["left"]]
MIRROR = np.array([1.0, -1.0, -1.0, 1.0])
INWARD = np.radians([1.4, 0.0, 61.2, -82.1])  # a forearm before the chest, its hand beyond the middle


@pytest.fixture(params=[pytest.param("pybullet", marks=needs_pybullet), "kinematic"])
def robot(request):
    with open_robot(request.param) as opened:
        yield opened


def reach(side, end=INWARD):
    """Bring one forearm before the chest."""
    names = SIDES[side]
    rest = np.array([HOAP2[name].rest_rad for name in names])
    goal = end * (MIRROR if side == "right" else 1.0)
    return spline(names, [0.0, 1.0, 2.0], [rest, 0.5 * (rest + goal), goal])


def test_two_motions_that_are_safe_alone_are_not_one_after_the_other(robot):
    for side in SIDES:
        assert check_trajectory(reach(side)) == []
    assert robot.perform(reach("left"))
    held = robot.joint_positions_rad()
    with pytest.raises(TrajectoryError, match="larm_link_5 and rarm_link_5 overlap"):
        robot.perform(reach("right"))
    assert robot.joint_positions_rad() == held and robot._commanded["rarm_joint_4"] == HOAP2["rarm_joint_4"].rest_rad
    assert robot.perform(gesture_trajectory("rest")) and robot.perform(reach("right")), "the other way is free"


def test_the_check_is_told_where_the_other_joints_are():
    left = dict(zip(SIDES["left"], INWARD.tolist(), strict=True))
    found = check_trajectory(reach("right"), others_rad=left)
    assert found and all("overlap" in finding.message for finding in found)
    assert [touch.row for touch in self_collisions(reach("right"), others_rad=left)] == [
        finding.row - 1 for finding in found
    ]
    assert check_trajectory(reach("right"), others_rad=HOAP2.rest_rad) == []


@cache
def through_the_chest():
    """Two poses of a left arm that touch nothing, with the chest between them."""
    rng = np.random.default_rng(4)  # whose first poses are such
    names = SIDES["left"]
    low, high = np.array([HOAP2.limits_rad[HOAP2.index(name)] for name in names]).T
    while True:
        ends = rng.uniform(low, high, (2, len(names)))
        if any(self_collisions(Trajectory(names, 1.0, [end])) for end in ends):
            continue
        between = np.linspace(*ends, 200)
        if any(touch.depth_m > 0.01 for touch in self_collisions(Trajectory(names, 0.1, between))):
            return names, ends


def test_the_way_to_the_first_row_is_checked(robot):
    names, (begin, goal) = through_the_chest()
    robot.reset(dict(zip(names, begin.tolist(), strict=True)))
    before = robot.joint_positions_rad()
    there = Trajectory(names, 0.1, [goal, goal])
    assert check_trajectory(there) == []
    with pytest.raises(TrajectoryError, match=r"row 1.*: on the way to this row, .* overlap by") as caught:
        robot.perform(there)
    assert {finding.row for finding in caught.value.findings} == {1}
    assert robot.joint_positions_rad() == before and robot.events == []
    assert robot.perform(Trajectory(names, 0.1, [begin, begin]))


def test_links_that_overlap_at_the_begin_may_move_apart():
    names = SIDES["left"] + SIDES["right"]
    crossed = np.concatenate((INWARD, INWARD * MIRROR))
    with open_robot("kinematic") as robot:
        robot.reset(dict(zip(names, crossed.tolist(), strict=True)))
        assert robot.perform(gesture_trajectory("rest"))


@needs_pybullet
def test_links_that_touch_are_reported(tmp_path):
    names = SIDES["left"] + SIDES["right"]
    log = MotionLog()
    with open_robot("pybullet") as robot:
        assert robot.perform(gesture_trajectory("wave"), log=log) and robot.self_contacts == []
        assert log.as_dict()["self_contacts"] == []
        begin_s = robot.time_s
        robot.reset(dict(zip(names, np.concatenate((INWARD, INWARD * MIRROR)).tolist(), strict=True)))
        assert robot.perform(gesture_trajectory("rest"), log=log)
        (contact,) = robot.self_contacts
    assert (contact.link, contact.other) == ("larm_link_5", "rarm_link_5") and contact.force_n > 0.0
    assert begin_s < contact.first_s <= contact.last_s < begin_s + 1.0
    assert log.touched.found() == [contact]
    log.write(tmp_path / "log.json")
    assert json.loads((tmp_path / "log.json").read_text())["self_contacts"][0]["link"] == "larm_link_5"


def test_from_any_moment_of_any_gesture_there_is_a_way_to_rest():
    rng = np.random.default_rng(2)
    with open_robot("kinematic") as robot:
        for name in load_gestures():
            trajectory = gesture_trajectory(name)
            for _ in range(2):
                row = trajectory.positions_rad[rng.integers(len(trajectory))]
                robot.reset(dict(zip(trajectory.joint_names, row.tolist(), strict=True)))
                assert robot.perform(gesture_trajectory("rest")), name
