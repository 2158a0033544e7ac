# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""A joint that cannot follow what it is sent is named by an event; the motion goes on."""

from dataclasses import replace

import pytest

from hri.robot import HOAP2, MotionLog, Trajectory, gesture_trajectory, open_robot
from hri.robot.control.straining import Straining

pytest.importorskip("pybullet")
LEGS = [name for name in HOAP2.names if "leg" in name]


def test_a_joint_is_reported_after_a_quarter_of_a_second_and_once_until_it_follows_again() -> None:
    straining = Straining()
    reported = [straining.late(["knee"] if step != 70 else [], 0.01 * step) for step in range(150)]
    assert [step for step, names in enumerate(reported) if names] == [25, 96]
    assert straining.late(["knee", "hip"], 1.5) == [] and straining.late(["hip"], 1.8) == ["hip"]


def test_arms_that_are_too_weak_are_named_and_strong_ones_are_not() -> None:
    raised = Trajectory(["rarm_joint_1", "rarm_joint_4"], 1.0, [[1.4, -0.3], [0.2, -0.3], [0.2, -0.3]])
    weak = replace(HOAP2, max_torque_n_m=0.05)
    log = MotionLog()
    with open_robot("pybullet", table=weak, locked=LEGS) as robot:
        assert robot.perform(raised, log=log)
        lags = [event for event in robot.events if event.kind == "lag" and "rarm_joint_1" in event.message]
        assert len(lags) == 1 and lags[0] in log.events and not lags[0].ended_motion
        assert {event.kind for event in robot.events} == {"lag"}
    with open_robot("pybullet", locked=LEGS) as robot:
        assert robot.perform(raised) and robot.perform(gesture_trajectory("wave")) and robot.events == []
