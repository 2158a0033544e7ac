# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What passes the check keeps every joint's limits when it is carried out; STOP at any moment keeps them too.

Random motions of all kinds, most slowed until they just pass: on the kinematic robot joints are where they are sent, so
its positions, their differences and second differences are what the limits are about.
"""

import itertools
from importlib.util import find_spec

import numpy as np
import pytest

from hri.robot import HOAP2, Trajectory, check_trajectory, open_robot, slow_to_limits, spline
from hri.robot.control.playing import approach_to
from hri.robot.motion.checks import LIMIT_TOLERANCE_RAD
from hri.robot.simulation.kinematic_backend import KinematicRobot

ARMS = [name for name in HOAP2.names if "arm" in name or "head" in name]
PERIODS_S = (0.001, 0.002, 0.005, 0.01, 0.0137, 0.02, 0.033, 0.1, 0.5)
LIMITS = dict(zip(HOAP2.names, HOAP2.limits_rad, strict=True))


def random_motion(rng, legs):
    """Positions within the limits, about rest; speeds are left to chance."""
    names = rng.choice(HOAP2.names if rng.random() < legs else ARMS, rng.integers(1, 6), replace=False).tolist()
    period_s = float(rng.choice(PERIODS_S))
    seconds = float(rng.uniform(max(0.2, 3.0 * period_s), max(2.0, 8.0 * period_s)))
    times = np.arange(0.0, seconds, period_s)
    kind = rng.choice(["spline", "lines", "sines", "wander", "shaking", "steps"])
    low, high = np.array([LIMITS[name] for name in names]).T
    rest = np.array([HOAP2[name].rest_rad for name in names])
    reach = rng.choice([0.1, 0.5, 1.0])
    keys = np.clip(rest + reach * rng.uniform(low - rest, high - rest, (rng.integers(2, 7), len(names))), low, high)
    key_times = np.linspace(0.0, times[-1], len(keys))
    if kind == "spline":
        rows = np.stack([np.interp(times, key_times, column) for column in keys.T], axis=1)
        made = spline(names, key_times, keys, period_s)
        rows = made.positions_rad
    else:
        rows = np.stack([np.interp(times, key_times, column) for column in keys.T], axis=1)
        frequency_hz = rng.uniform(0.5, 0.4 / period_s)
        amplitude = 10.0 ** rng.uniform(-4.0, -0.5)
        if kind == "sines":
            rows = keys[0] + amplitude * np.sin(2.0 * np.pi * rng.uniform(0.3, 8.0, len(names)) * times[:, np.newaxis])
        elif kind == "wander":
            rows = keys[0] + np.cumsum(amplitude * period_s * rng.standard_normal((len(times), len(names))), axis=0)
        elif kind == "shaking":
            rows = rows + 0.1 * amplitude * np.sin(2.0 * np.pi * frequency_hz * times)[:, np.newaxis]
        elif kind == "steps":
            for _ in range(rng.integers(1, 4)):
                rows[rng.integers(1, len(rows)) :, rng.integers(len(names))] += rng.uniform(-0.1, 0.1)
    return Trajectory(names, period_s, np.clip(rows, low, high))


def safe(trajectory):
    return not any(finding.severity == "error" for finding in check_trajectory(trajectory))


def safe_from_rest(trajectory):
    rest = np.array([HOAP2[name].rest_rad for name in trajectory.joint_names])
    approach = approach_to(trajectory, rest, HOAP2)
    return approach is None or safe(approach)


def safe_motions(seed, legs=0.2):
    """Those that pass; most as fast as they may be."""
    rng = np.random.default_rng(seed)
    while True:
        motion = random_motion(rng, legs)
        if rng.random() < 0.8:
            motion = slow_to_limits(motion)
        if motion.duration_s < 30.0 and safe(motion) and safe_from_rest(motion):
            yield motion


class Recorded(KinematicRobot):
    """Keeps every row that was sent, and stops itself before a given one."""

    def __init__(self, step_s=0.01):
        super().__init__()
        self.step_s = step_s
        self.sent = [list(self._positions.values())]
        self.stop_at = None

    def _command(self, positions_rad):
        super()._command(positions_rad)
        self.sent.append(list(self._positions.values()))
        if self.stop_at is not None and len(self.sent) >= self.stop_at:
            self.stop()


def worst(sent, step_s):
    """Shares of the limits of position, speed and acceleration that were used, at most; 1 is a limit."""
    rows = np.array(sent)
    low, high = HOAP2.limits_rad.T
    outside = max((low - rows).max(), (rows - high).max()) / LIMIT_TOLERANCE_RAD
    speed = np.abs(np.diff(rows, axis=0)).max() / step_s / HOAP2.max_speed_rad_s
    acceleration = np.abs(np.diff(rows, 2, axis=0)).max(initial=0.0) / step_s**2 / HOAP2.max_acceleration_rad_s2
    return outside, speed, acceleration


few_and_many = pytest.mark.parametrize("count", [150, pytest.param(1000, marks=pytest.mark.slow)])


@few_and_many
def test_motions_that_pass_keep_every_limit(count):
    motions = safe_motions(1)
    used = []
    with Recorded() as robot:
        for number in range(count):
            trajectory = next(motions)
            first = dict(zip(trajectory.joint_names, trajectory.positions_rad[0].tolist(), strict=True))
            if number % 2:  # else the approach leads there
                robot.reset(HOAP2.rest_rad | {name: np.clip(value, *LIMITS[name]) for name, value in first.items()})
            else:
                robot.reset(HOAP2.rest_rad)
            robot.sent = [list(robot._positions.values())] * 2
            assert robot.perform(trajectory), trajectory
            robot.hold(0.03)
            used.append(worst(robot.sent, robot.step_s))
            assert max(used[-1]) <= 1.0 + 1e-6, (number, trajectory, used[-1])
    used = np.array(used)
    assert (used.max(axis=0) > (-1e-6, 0.99, 0.95 if count >= 1000 else 0.8)).all(), "some come up to the limits"
    assert (used[:, 2] > 0.5).mean() > 0.1


@pytest.mark.parametrize("count", [20, pytest.param(60, marks=pytest.mark.slow)])
@pytest.mark.parametrize("step_s", [0.001, 0.004, 0.02])
def test_the_limits_are_kept_whatever_the_step(step_s, count):
    with Recorded(step_s) as robot:
        for trajectory in itertools.islice(safe_motions(2), count):
            robot.reset(HOAP2.rest_rad)
            robot.sent = [list(robot._positions.values())] * 2
            assert robot.perform(trajectory)
            assert max(worst(robot.sent, step_s)) <= 1.0 + 1e-6, trajectory


@few_and_many
def test_stop_at_random_moments(count):
    rng = np.random.default_rng(5)
    motions = safe_motions(6)
    stopped = moving = 0
    trajectory = next(motions)
    with Recorded() as robot:
        while stopped < count:
            if stopped % 10 == 0:
                trajectory = next(motions)
            robot.resume()
            robot.stop_at = None
            robot.reset(HOAP2.rest_rad)
            robot.sent = [list(robot._positions.values())] * 2
            steps = int(trajectory.duration_s / robot.step_s) + 40
            robot.stop_at = int(rng.integers(2, steps))
            if robot.perform(trajectory):
                assert len(robot.sent) < robot.stop_at
                continue
            stopped += 1
            assert robot.events[-1].kind == "stop" and robot.stopped
            moving += robot.sent[-1] != robot.sent[robot.stop_at - 1]
            assert len(robot.sent) - robot.stop_at <= 0.14 / robot.step_s, "5 rad/s at 40 rad/s2 take 0.125 s"
            held = len(robot.sent)
            assert not robot.perform(trajectory) and len(robot.sent) == held, "it moved while it was stopped"
            robot.hold(0.03)
            assert robot.sent[held:] == [robot.sent[held - 1]] * 3
            assert max(worst(robot.sent, robot.step_s)) <= 1.0 + 1e-6, (trajectory, robot.stop_at)
    assert moving > 0.3 * count, "many stops come while a joint moves"


@pytest.mark.slow
@pytest.mark.skipif(find_spec("pybullet") is None, reason="no pybullet")
def test_joints_with_masses_and_motors_keep_the_limits_too():
    """Joints follow what they are sent with a time constant of 10 ms, and are pushed by one another.

    Legs are left out: those of a held robot touch the floor.
    """
    used = []
    with open_robot("pybullet") as robot:
        command, rows = robot._command, []

        def spy(positions):
            command(positions)
            rows.append(list(robot.joint_positions_rad().values()))

        robot._command = spy
        for trajectory in itertools.islice(safe_motions(4, legs=0.0), 40):
            robot.reset(HOAP2.rest_rad)
            robot.hold(0.3)
            rows.clear()
            assert robot.perform(trajectory)
            sampled = rows[::10]
            used.append(worst(sampled, 0.01)[1:])
            beyond = max((HOAP2.limits_rad[:, 0] - rows).max(), (rows - HOAP2.limits_rad[:, 1]).max())
            assert beyond < np.radians(0.5)
    used = np.array(used)
    assert (used.max(axis=0) <= (1.0, 1.1)).all() and (used.max(axis=0) > 0.5).all(), used.max(axis=0)
