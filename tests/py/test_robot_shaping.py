# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Motions made from motions, the short form, repairs and plots."""

import numpy as np
import pytest

from hri.core.errors import FormatError, InvalidArgument, IoError
from hri.robot import (
    Trajectory,
    TrajectoryError,
    check_pulse_csv,
    check_trajectory,
    concatenate,
    gesture_trajectory,
    plot_trajectory,
    read_pulse_csv,
    read_short_csv,
    repair_pulse_csv,
    resample,
    slow_to_limits,
    smooth,
    spline,
    write_pulse_csv,
    write_short_csv,
)


def test_a_spline_passes_its_keys_and_rests_at_its_ends():
    times, keys = [0.0, 0.5, 1.2, 2.0], np.array([[0.0, 1.0], [0.6, 0.2], [-0.3, 0.4], [0.1, 0.0]])
    made = spline(["larm_joint_1", "larm_joint_2"], times, keys, 0.001)
    for time_s, key in zip(times, keys, strict=True):
        np.testing.assert_allclose(made.at(time_s), key, atol=1e-12)
    speeds = np.diff(made.positions_rad, axis=0) / 0.001
    assert np.abs(speeds[[0, -1]]).max() < 0.02
    accelerations = np.diff(speeds, axis=0) / 0.001
    assert np.abs(np.diff(accelerations, axis=0)).max() < 0.1, "the acceleration jumps nowhere"
    with pytest.raises(InvalidArgument, match="rise from 0"):
        spline(["a"], [0.0, 0.0], [[0.0], [1.0]])
    with pytest.raises(InvalidArgument, match="keys_rad"):
        spline(["a"], [0.0, 1.0], [[0.0]])


def test_resampling_keeps_what_lies_on_lines():
    ramp = Trajectory(["a"], 0.1, np.linspace(0.0, 1.0, 11)[:, np.newaxis])
    finer = resample(ramp, 0.03)
    assert len(finer) == 35 and finer.positions_rad[-1, 0] == 1.0
    np.testing.assert_allclose(finer.positions_rad[:34, 0], 0.03 * np.arange(34), atol=1e-12)
    with pytest.raises(InvalidArgument, match="period_s"):
        resample(ramp, 0.0)


def test_smoothing_takes_noise_and_leaves_ends_and_lines():
    rng = np.random.default_rng(0)
    line = np.linspace(0.0, 1.0, 301)
    rough = Trajectory(["a"], 0.01, (line + 0.02 * rng.standard_normal(301))[:, np.newaxis])
    fine = smooth(rough, 0.2)
    inner = slice(20, -20)
    left = (fine.positions_rad[:, 0] - line)[inner].std()
    assert left < 0.4 * (rough.positions_rad[:, 0] - line)[inner].std()
    np.testing.assert_allclose(fine.positions_rad[[0, -1]], rough.positions_rad[[0, -1]])
    straight = Trajectory(["a"], 0.01, line[:, np.newaxis])
    np.testing.assert_allclose(smooth(straight, 0.2).positions_rad, straight.positions_rad, atol=1e-12)


def test_a_motion_is_slowed_no_more_than_it_must():
    fast = gesture_trajectory("9")
    fast = Trajectory(fast.joint_names, fast.period_s, fast.positions_rad[::4])
    assert any(finding.severity == "error" for finding in check_trajectory(fast))
    slower = slow_to_limits(fast)
    assert [finding for finding in check_trajectory(slower) if finding.severity == "error"] == []
    assert fast.duration_s < slower.duration_s < 8.0 * fast.duration_s
    np.testing.assert_allclose(slower.positions_rad[-1], fast.positions_rad[-1])
    assert slow_to_limits(slower) is slower
    with pytest.raises(InvalidArgument, match="too rough"):
        slow_to_limits(Trajectory(["larm_joint_1"], 0.01, [[0.0], [1e300], [0.0]]))
    with pytest.raises(InvalidArgument, match="not finite"):
        slow_to_limits(Trajectory(["larm_joint_1"], 0.01, [[0.0], [np.nan], [0.0]]))


def test_motions_follow_one_another_without_a_jump():
    first = Trajectory(["larm_joint_1", "rarm_joint_1"], 0.01, np.full((50, 2), 0.2))
    second = Trajectory(["rarm_joint_1", "larm_joint_1"], 0.02, np.tile([-0.4, 1.0], (30, 1)))
    both = concatenate([first, second, second], 0.3)
    assert check_trajectory(both) == []
    np.testing.assert_allclose(both.positions_rad[-1], [1.0, -0.4])
    assert both.duration_s == pytest.approx(0.49 + 0.3 + 2 * 0.58, abs=0.02)
    hurried = concatenate([first, second], 0.0)
    assert check_trajectory(hurried) == []
    with pytest.raises(InvalidArgument, match="other joints"):
        concatenate([first, Trajectory(["head_joint_1"], 0.1, [[0.0]])])
    with pytest.raises(InvalidArgument, match="no trajectories"):
        concatenate([])


def test_the_short_form_comes_back_and_tells_every_fault(tmp_path):
    path = tmp_path / "short.csv"
    made = gesture_trajectory("wave")
    write_short_csv(path, made)
    read = read_short_csv(path)
    assert read.joint_names == made.joint_names and read.period_s == pytest.approx(made.period_s)
    np.testing.assert_allclose(read.positions_rad, made.positions_rad, atol=np.radians(6e-5))
    path.write_text("# nod\ntime_s, head_joint_2\n0,0\n\n0.5,20\n1,0\n")
    np.testing.assert_allclose(np.degrees(read_short_csv(path).positions_rad[:, 0]), [0, 20, 0])
    path.write_text("time_s,head_joint_2,larm_joint_1\n0,0,x\n0.5,,1\n1,0\n1.5,nan,1\n")
    with pytest.raises(TrajectoryError) as caught:
        read_short_csv(path)
    places = [(finding.row, finding.column) for finding in caught.value.findings]
    assert places == [(2, "C"), (3, "B"), (4, ""), (5, "B")]
    path.write_text("time_s,head_joint_2\n0,0\n0.5,1\n1.6,1\n")
    with pytest.raises(TrajectoryError, match=r"row 3.*uneven|row 3.*even steps"):
        read_short_csv(path)
    path.write_text("time_s,tail,head_joint_1,head_joint_1\n0,0,0,0\n1,0,0,0\n")
    with pytest.raises(TrajectoryError, match=r"tail.*twice"):
        read_short_csv(path)
    with pytest.raises(IoError):
        read_short_csv(tmp_path / "none.csv")


def broken(tmp_path):
    path = tmp_path / "bad.csv"
    constant = Trajectory(["larm_joint_1", "rarm_joint_1"], 0.01, np.radians(np.linspace((80, 70), (60, 90), 50)))
    write_pulse_csv(path, constant)
    rows = [line.split(",") for line in path.read_text().splitlines()]
    place = 18
    rows[20][place] = "?"
    rows[49][8] = str(209 * 152)
    path.write_text("".join(",".join(row) + "\n" for row in rows))
    return path, place


def test_a_repair_tells_every_cell_and_changes_no_other(tmp_path):
    path, place = broken(tmp_path)
    assert any(finding.severity == "error" for finding in check_pulse_csv(path))
    changes = repair_pulse_csv(path, tmp_path / "good.csv")
    assert [(change.row, change.column, change.before) for change in changes] == [(50, "I", "31768"), (21, "S", "?")]
    before, after = path.read_text().splitlines(), (tmp_path / "good.csv").read_text().splitlines()
    assert [number for number in range(50) if before[number] != after[number]] == [20, 49]
    neighbours = [int(after[row].split(",")[place]) for row in (19, 20, 21)]
    assert neighbours[0] < neighbours[1] < neighbours[2]
    found = read_pulse_csv(tmp_path / "good.csv")
    assert np.degrees(found.positions_rad[-1, found.joint_names.index("rarm_joint_1")]) == pytest.approx(151, abs=0.01)
    assert repair_pulse_csv(tmp_path / "good.csv", tmp_path / "again.csv") == []
    assert (tmp_path / "again.csv").read_bytes() == (tmp_path / "good.csv").read_bytes()
    path.write_text("1,2," + "?," * 21 + "60,R,R,R\n")
    with pytest.raises(FormatError, match="no count"):
        repair_pulse_csv(path, tmp_path / "none.csv")


def test_the_commands_repair_plot_and_convert(hri, tmp_path):
    path, _ = broken(tmp_path)
    said = hri("robot", "check", path, "--repair", tmp_path / "good.csv")
    assert "row 21, column S (larm_joint_1): '?' is now" in said.err and said.code == 3  # the limit is reached too fast
    short = tmp_path / "short.csv"
    assert hri("robot", "convert", "wave", short, "--short").code == 0
    assert hri("robot", "check", short).code == 0
    assert short.read_text().startswith("time_s,larm_joint_1")
    pytest.importorskip("matplotlib")
    assert hri("robot", "plot", short, tmp_path / "wave.png").code == 0
    assert (tmp_path / "wave.png").read_bytes().startswith(b"\x89PNG")
    with pytest.raises(IoError):
        plot_trajectory(gesture_trajectory("wave"), tmp_path / "no" / "wave.png")
