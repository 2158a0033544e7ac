# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Speed, acceleration and jerk over short times: what shakes is an error, a lone glitch of a recording is a warning."""

import numpy as np
import pytest

from hri.core.errors import InvalidArgument
from hri.robot import HOAP2, NAO, Trajectory, check_trajectory, link_poses, open_robot
from hri.robot.control.playing import Playback
from hri.robot.motion.jumps import find_jumps
from hri.robot.motion.rates import calm_joints, short_measures, smoothed_measures


def arm(positions, period_s=0.001):
    return Trajectory(["larm_joint_1"], period_s, np.asarray(positions, dtype=float)[:, np.newaxis])


def errors(trajectory):
    return [finding for finding in check_trajectory(trajectory) if finding.severity == "error"]


def warnings(trajectory):
    return [finding for finding in check_trajectory(trajectory) if finding.severity == "warning"]


def vibration(frequency_hz, amplitude_rad, period_s, seconds=2.0):
    """Grows and fades over half a second, so that its begin is not what is found."""
    times = np.arange(0.0, seconds, period_s)
    ramp = np.minimum(1.0, np.minimum(times, seconds - times) / 0.5)
    return 0.8 + amplitude_rad * ramp * np.sin(2.0 * np.pi * frequency_hz * times + 1.0)


def test_the_vibration_that_a_mean_over_50_ms_does_not_see():
    times = np.arange(0.0, 2.0, 0.001)
    found = errors(arm(0.5 + 0.5 * np.sin(2.0 * np.pi * 20.0 * times)))
    assert found and "rad/s" in found[0].value


@pytest.mark.parametrize("period_s", [0.001, 0.002, 0.004, 0.005, 0.007])
def test_no_vibration_of_half_a_degree_passes(period_s):
    limit_hz = 0.45 / period_s
    tried = 0
    for frequency_hz in (20, 25, 30, 33.3, 40, 50, 60, 66.7, 80, 100, 125, 142.9, 166.7, 200, 250, 333.3, 400, 450):
        if frequency_hz <= limit_hz:
            tried += 1
            slight = vibration(frequency_hz, np.radians(0.7), period_s)
            assert errors(arm(slight, period_s)), f"{frequency_hz} Hz"
            assert errors(arm(vibration(frequency_hz, 0.3, period_s), period_s)), f"{frequency_hz} Hz, strong"
            assert not errors(arm(vibration(frequency_hz, np.radians(0.02), period_s), period_s)), "the check is blind"
    assert tried >= 7


def test_a_shaking_of_every_second_row_is_found():
    rows = 0.5 + 0.002 * (np.arange(500) % 2)  # 2 rad/s to and fro, mean 0
    (found, *_) = errors(arm(rows))
    assert "to and fro" in found.message and found.severity == "error"
    pulses = 0.5 + np.radians(1.0 / 209.0) * (np.arange(500) % 2)  # the last digit of an encoder
    assert check_trajectory(arm(pulses)) == []


def test_root_mean_square_of_the_speed():
    rows = np.full(400, 0.5)
    rows[200:] += 0.014 * np.minimum(np.arange(200) // 2, 3)  # three rows of 14 rad/s with one between: 25 ms worth
    assert any("RMS over 10 ms" in finding.message for finding in errors(arm(rows)))


def test_jerk():
    # 350 rad/s2 for 10 ms, then back: no speed or acceleration is too high.
    acceleration = np.zeros(300)
    acceleration[100:110], acceleration[110:120] = 350.0, -350.0
    rows = 0.5 + np.cumsum(np.cumsum(acceleration)) * 1e-6
    found = errors(arm(rows))
    assert [finding.value.split()[-1] for finding in found] == ["rad/s3"] and 90 < found[0].row < 130


def with_steps(steps):
    """Standing still but for steps to single rows: row and size in radians."""
    rows = np.full(2000, 0.5)
    for row, size in steps:
        rows[row:] += size
    return arm(rows)


@pytest.mark.parametrize(
    "steps",
    [
        [(500, 0.1)],
        [(500, 0.05), (501, -0.05)],  # one bad reading
        [(500, 0.05), (503, -0.05)],
        [(500, 0.05), (560, 0.03)],  # as in the factory's walk
        [(300, 0.05), (900, 0.05), (1500, -0.05)],
    ],
)
def test_an_isolated_glitch_is_a_warning(steps):
    assert errors(with_steps(steps)) == []
    found = warnings(with_steps(steps))
    assert [finding.row for finding in found] == [row + 1 for row, _ in steps]


@pytest.mark.parametrize(
    ("steps", "why"),
    [
        ([(500, 0.05), (530, 0.03)], "with another within 50 ms"),
        ([(500, 0.03), (560, 0.03), (620, 0.03)], "more than 2 within 0.5 s"),
        ([(500, 0.2)], "further than 7.2 deg"),
        ([(500 + row, 0.02) for row in range(8)], "one row after another"),
        ([(500 + 60 * number, 0.03 * (-1) ** number) for number in range(20)], "more than 2 within 0.5 s"),
    ],
)
def test_repeated_and_far_jumps_are_errors(steps, why):
    found = errors(with_steps(steps))
    assert found and why in found[0].message and found[0].row == steps[0][0] + 1


def test_a_period_that_does_not_divide_50_ms_is_measured_exactly():
    rng = np.random.default_rng(8)
    for period_s in (0.0137, 0.033, 0.04, 0.071, 0.3):
        rows = rng.uniform(-1.0, 1.0, (1, 12))
        trajectory = arm(rows[0], period_s)
        largest = {1: 0.0, 2: 0.0}
        for measure in smoothed_measures(rows, period_s, HOAP2):
            largest[measure.order] = max(largest[measure.order], float(np.abs(measure.values).max()))
        speed, acceleration = largest[1], largest[2]
        times = np.arange(-0.2, trajectory.duration_s + 0.2, 2e-5)
        means = (trajectory.at(times + 0.05) - trajectory.at(times))[:, 0] / 0.05
        later, now, earlier = (trajectory.at(times + shift)[:, 0] for shift in (0.05, 0.0, -0.05))
        changes = (later - 2.0 * now + earlier) / 0.05**2
        assert speed == pytest.approx(np.abs(means).max(), rel=2e-3) and speed >= np.abs(means).max() - 1e-9
        assert acceleration == pytest.approx(np.abs(changes).max(), rel=2e-3)
        assert acceleration >= np.abs(changes).max() - 1e-9


def test_a_motion_that_begins_or_ends_at_full_speed_is_found():
    for rows in (np.linspace(0.0, 1.0, 21), np.linspace(1.0, 0.0, 21)):
        (found, *_) = errors(arm(rows, 0.0105))  # 4.8 rad/s at once
        assert "rad/s2" in found.value
    assert errors(arm(np.linspace(0.0, 1.0, 51), 0.01)) == []  # 2 rad/s at once


def test_what_is_sent_has_the_speeds_and_accelerations_that_were_measured():
    rng = np.random.default_rng(3)
    for period_s in (0.001, 0.01, 0.03, 0.2):
        rows = rng.uniform(-1.0, 1.0, (1, 9))
        if period_s < 0.02:
            rows = np.repeat(rows, 40, axis=1)
        limits = {1: 0.0, 2: 0.0}
        for measure in smoothed_measures(rows, period_s, HOAP2):
            limits[measure.order] = max(limits[measure.order], float(np.abs(measure.values).max()))
        for step_s in (0.001, 0.0025, 0.01, 0.02):
            playback = Playback(rows[:, 0], None, arm(rows[0], period_s))
            sent = np.array(list(playback.rows(step_s)))[:, 0]
            assert sent[0] == pytest.approx(rows[0, 0], abs=1e-12) and sent[-1] == pytest.approx(rows[0, -1], abs=1e-12)
            assert np.abs(np.diff(sent)).max() / step_s <= limits[1] * (1.0 + 1e-9)
            assert np.abs(np.diff(sent, 2)).max() / step_s**2 <= limits[2] * (1.0 + 1e-6)


def test_joints_that_are_passed_over_are_calm():
    rng = np.random.default_rng(7)
    calm = 0
    for period_s in (0.001, 0.002, 0.005, 0.01) * 60:
        steps = rng.standard_normal((1, 400)) * (rng.random(400) < rng.choice([0.02, 1.0]))
        rows = 10.0 ** rng.uniform(-5.0, -2.5) * np.cumsum(steps, axis=1)
        if calm_joints(rows, period_s, HOAP2)[0]:
            calm += 1
            assert not find_jumps(rows, period_s, HOAP2)
            for measured in (smoothed_measures, short_measures):
                for measure in measured(rows, period_s, HOAP2):
                    assert np.abs(measure.values).max() <= measure.limit, measure.text
    assert 20 < calm < 220


def test_limits_come_from_the_torque():
    """A waist that moves both straight legs, and a hip that moves one, need nearly all of it."""

    def inertia(table, name):
        poses = link_poses(dict.fromkeys(table.names, 0.0), np.eye(4), table)
        joint = table[name]
        moved = {joint.child}
        for other in table.joints:
            if other.parent in moved:
                moved.add(other.child)
        axis, total = np.array(joint.axis), 0.0
        for link in moved:
            ixx, iyy, izz, ixy, ixz, iyz = table.links[link].inertia_kg_m2
            away = (poses[link] @ (*table.links[link].com_m, 1.0))[:3] - poses[joint.child][:3, 3]
            away = away - axis * (axis @ away)
            own = axis @ np.array([[ixx, ixy, ixz], [ixy, iyy, iyz], [ixz, iyz, izz]]) @ axis
            total += table.links[link].mass_kg * (away @ away) + own
        return total

    assert 0.85 < HOAP2.max_acceleration_rad_s2 * inertia(HOAP2, "body_joint_1") / HOAP2.max_torque_n_m < 1.0
    assert 0.9 < HOAP2.peak_acceleration_rad_s2 * inertia(HOAP2, "lleg_joint_3") / HOAP2.max_torque_n_m < 1.0
    assert 0.9 < NAO.peak_acceleration_rad_s2 * inertia(NAO, "LHipPitch") / NAO.max_torque_n_m < 1.0


def test_an_empty_motion_is_none():
    for names, rows in (([], [[]]), ([], []), (["larm_joint_1"], []), (["larm_joint_1"], [[]])):
        with pytest.raises(InvalidArgument, match=r"shape|no joint"):
            Trajectory(names, 0.1, rows)
    ragged = [[1.0], [1.0, 2.0]]
    for names, rows in ((["a"], [["x"]]), (["a", "b"], ragged), ("ab", [[1.0, 2.0]]), ([3], [[1]])):
        with pytest.raises(InvalidArgument):
            Trajectory(names, 0.1, rows)
    for period_s in (0.0, -1.0, np.nan, np.inf, 1e-300, 1e300):
        with pytest.raises(InvalidArgument, match="period_s"):
            Trajectory(["larm_joint_1"], period_s, [[0.0], [0.1]])


def test_one_row_is_a_motion():
    pose = Trajectory(["head_joint_1"], 0.1, [[0.4]])
    assert check_trajectory(pose) == []
    with open_robot("kinematic") as robot:
        assert robot.perform(pose)
        assert robot.joint_positions_rad()["head_joint_1"] == pytest.approx(0.4, abs=1e-9)
    assert list(short_measures(np.array([[0.4]]), 0.001, HOAP2))


@pytest.mark.parametrize("value", [1e300, -1e300, np.inf, np.nan])
def test_values_beyond_reason_are_errors_and_no_warnings_of_numpy(value):
    rows = np.full(300, 0.5)
    rows[100] = value
    with np.errstate(all="raise"):
        assert errors(arm(rows))
