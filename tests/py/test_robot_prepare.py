# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Motions that are checked in advance, and what is seen of every command."""

from __future__ import annotations

import numpy as np
import pytest

from hri.core.errors import Error
from hri.robot import Trajectory, TrajectoryError, open_robot
from hri.robot.control import backend

NOD = Trajectory(["head_joint_2"], 0.1, np.array([[0.0], [0.1], [0.2], [0.1], [0.0]]))
LOOK = Trajectory(["head_joint_1"], 1.0, [[0.0], [0.4]])


@pytest.fixture
def checks(monkeypatch: pytest.MonkeyPatch) -> list[Trajectory]:
    """The motions that were checked."""
    seen: list[Trajectory] = []
    require = backend.require_safe

    def spy(trajectory: Trajectory, *arguments: object, **others: object) -> None:
        seen.append(trajectory)
        require(trajectory, *arguments, **others)

    monkeypatch.setattr(backend, "require_safe", spy)
    return seen


def test_a_prepared_motion_is_checked_again_only_from_elsewhere(checks: list[Trajectory]) -> None:
    with open_robot("kinematic") as robot:
        robot.prepare(NOD)
        assert checks == [NOD] and robot.time_s == 0
        assert robot.perform(NOD) and robot.perform(NOD) and checks == [NOD]
        assert robot.perform(LOOK) and checks == [NOD, LOOK]
        assert robot.perform(NOD) and checks == [NOD, LOOK, NOD], "another joint is elsewhere now"
        same = Trajectory(NOD.joint_names, NOD.period_s, NOD.positions_rad)
        assert robot.perform(same) and checks[-1] is same


def test_what_is_not_safe_is_refused_however_often(checks: list[Trajectory]) -> None:
    wild = Trajectory(["head_joint_2"], 0.01, [[0.0], [0.5], [0.0]])
    with open_robot("kinematic") as robot:
        for _ in range(2):
            with pytest.raises(TrajectoryError):
                robot.prepare(wild)
            with pytest.raises(TrajectoryError):
                robot.perform(wild)
        unknown = Trajectory(["tail"], 0.1, [[0.0], [0.0]])
        with pytest.raises(TrajectoryError, match="no such joint"):
            robot.perform(unknown)
        assert len(checks) == 5 and robot.time_s == 0
    with pytest.raises(Error, match="closed"):
        robot.prepare(NOD)


def test_few_prepared_motions_are_remembered(checks: list[Trajectory], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(backend, "_MOST_PREPARED", 2)
    motions = [Trajectory(["head_joint_2"], 0.1, [[0.0], [0.01 * n], [0.0]]) for n in range(3)]
    with open_robot("kinematic") as robot:
        for motion in motions:
            robot.prepare(motion)
        assert robot.perform(motions[2]) and robot.perform(motions[1]) and len(checks) == 3
        assert robot.perform(motions[0]) and len(checks) == 4


def test_every_command_is_seen_before_it_is_sent() -> None:
    with open_robot("kinematic") as robot:
        seen: list[tuple[float, float, float]] = []
        robot.on_command = lambda time_s, positions: seen.append(
            (time_s, positions["head_joint_2"], robot.joint_positions_rad()["head_joint_2"])
        )
        assert robot.perform(NOD)
        times, sent, there = map(np.array, zip(*seen, strict=True))
    assert np.allclose(np.diff(times), robot.step_s) and sent.max() > 0.15
    assert np.allclose(sent[:-1], there[1:]), "where it is when the next command comes"
