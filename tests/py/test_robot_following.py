# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Joints that follow targets stay within all limits and come to rest before what is not clear, whatever the targets."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from hri.robot.control.following import JointFollower, longest_way
from hri.robot.model.joints import HOAP2
from hri.robot.motion.checks import check_trajectory
from hri.robot.motion.trajectory import Trajectory

Floats = NDArray[np.float64]
LIMITS = np.array([[-1.0, 0.5], [-0.2, 2.0]])


def follower(begin: Floats | None = None, step_s: float = 0.001, clear: object = None) -> JointFollower:
    at = np.zeros(2) if begin is None else begin
    return JointFollower(at, LIMITS, 4.0, 50.0, step_s, clear or (lambda rows: True))  # type: ignore[arg-type]


def test_the_longest_way_is_the_longest() -> None:
    change = 0.005
    for room in np.random.default_rng(0).uniform(0, 0.4, 500):
        way = float(longest_way(np.array(room), change))
        left = np.arange(way, 0, -change).sum()
        assert left == pytest.approx(room, abs=1e-12)


@pytest.mark.parametrize("step_s", [0.001, 0.004, 0.02])
def test_targets_are_met_and_the_joints_rest_there(step_s: float) -> None:
    joints = follower(step_s=step_s)
    for target in ([0.4, 1.5], [-0.9, 0.0], [0.4, 1.5]):
        rows = np.vstack([joints.tick(np.array(target)) for _ in range(round(1.5 / joints.tick_s))])
        np.testing.assert_allclose(rows[-1], target, atol=1e-9)
        # They come from one side and stay.
        assert (np.diff(rows, axis=0) * np.sign(np.array(target) - rows[0]) >= -1e-12).all()
    while not joints.rests:
        joints.tick(None)


@pytest.mark.parametrize("seed", range(5))
def test_no_limit_is_passed_whatever_the_targets(seed: int) -> None:
    rng = np.random.default_rng(seed)
    joints = follower()
    rows = [np.zeros((1, 2))]
    while len(rows) < 400:
        target = None if rng.random() < 0.1 else rng.uniform(-5, 5, 2)
        rows += [joints.tick(target) for _ in range(rng.integers(1, 20))]
    sent = np.vstack(rows)
    assert (sent >= LIMITS[:, 0] - 1e-12).all() and (sent <= LIMITS[:, 1] + 1e-12).all()
    assert np.abs(np.diff(sent, axis=0)).max() / 0.001 <= 4.0 * (1 + 1e-6)
    assert np.abs(np.diff(sent, 2, axis=0)).max() / 0.001**2 <= 50.0 * (1 + 1e-6)


def test_the_joints_rest_before_what_is_not_clear() -> None:
    """A wall across the plane of both joints, a target behind it, and one beside it."""
    joints = follower(clear=lambda rows: bool((rows.sum(axis=1) <= 0.8013).all()))
    sent = np.vstack([joints.tick(np.array([0.4, 1.5])) for _ in range(200)])
    assert 0.7 < sent.sum(axis=1).max() <= 0.8013 + 1e-9
    assert np.abs(np.diff(sent[-50:], axis=0)).max() < 1e-4
    sent = np.vstack([joints.tick(np.array([-0.5, 1.0])) for _ in range(200)])
    np.testing.assert_allclose(sent[-1], [-0.5, 1.0], atol=1e-9)


def test_a_target_of_nothing_brings_rest_within_limits() -> None:
    joints = follower()
    before = np.vstack([joints.tick(np.array([0.4, 1.5])) for _ in range(20)])
    assert np.abs(np.diff(before[-10:], axis=0)).max() / 0.001 > 3.0
    after = []
    while not joints.rests:
        after.append(joints.tick(None))
    assert len(after) * joints.tick_s < 0.25
    assert np.abs(np.diff(np.vstack([before, *after]), 2, axis=0)).max() / 0.001**2 <= 50.0 * (1 + 1e-6)


def test_what_is_sent_passes_the_check_of_motions() -> None:
    names = ("rarm_joint_1", "larm_joint_1")
    limits = np.array([(HOAP2[name].lower_rad, HOAP2[name].upper_rad) for name in names])
    begin = np.array([HOAP2.rest_rad[name] for name in names])
    most = 0.99 * HOAP2.max_speed_rad_s, 0.99 * HOAP2.max_acceleration_rad_s2
    joints = JointFollower(begin, limits, *most, 0.001, lambda rows: True)
    rng = np.random.default_rng(3)
    rows = [begin[np.newaxis]]
    for _ in range(40):
        target = rng.uniform(-1.2, 1.2, 2)
        rows += [joints.tick(target) for _ in range(8)]
    rows += [joints.tick(None) for _ in range(30)]
    found = check_trajectory(Trajectory(names, 0.001, np.vstack(rows)))
    assert [finding for finding in found if "overlap" not in finding.message] == []
