# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Joint table, trajectories, the pulse CSV and the checks before a motion."""

import numpy as np
import pytest

from conftest import robot_data
from hri.core.errors import FormatError, InvalidArgument, IoError
from hri.robot import (
    HOAP2,
    Trajectory,
    TrajectoryError,
    check_pulse_csv,
    check_trajectory,
    read_pulse_csv,
    require_safe,
    write_pulse_csv,
)


def test_the_table_holds_the_whole_robot():
    assert len(HOAP2) == 25
    mass = HOAP2.base.mass_kg + sum(joint.link.mass_kg for joint in HOAP2.joints)
    assert mass == pytest.approx(7.160, abs=1e-3)
    assert [joint.column_index for joint in HOAP2.counted] == list(range(2, 23))
    assert sorted(joint.column_index for joint in HOAP2.joints) == list(range(2, 27))
    assert HOAP2["body_joint_1"].pulses_per_degree == 209
    known = {HOAP2.base.name}
    for joint in HOAP2.joints:
        assert joint.parent in known
        assert joint.lower_rad < 0.0 < joint.upper_rad
        assert min(joint.link.inertia_kg_m2[:3]) >= 2e-5
        known.add(joint.child)
    with pytest.raises(InvalidArgument, match="no joint 'tail'"):
        HOAP2["tail"]


def csv_row(counts=(0,) * 21, period="1", idle="60,R,R,R"):
    return f"{period},2,{','.join(str(count) for count in counts)},{idle}\n"


def test_any_counts_come_back_byte_for_byte(tmp_path):
    counts = np.random.default_rng(5).integers(-30000, 30000, (200, 21))
    source, copy = tmp_path / "a.csv", tmp_path / "b.csv"
    source.write_text("".join(csv_row(row) for row in counts))
    trajectory = read_pulse_csv(source)
    assert trajectory.positions_rad.shape == (200, 21)
    assert trajectory.period_s == 0.001
    assert write_pulse_csv(copy, trajectory) == ()
    assert copy.read_bytes() == source.read_bytes()


def test_a_count_has_the_sign_of_its_joint(tmp_path):
    counts = [0] * 21
    counts[HOAP2["larm_joint_1"].column_index - 2] = -209 * 90
    counts[HOAP2["body_joint_1"].column_index - 2] = 209 * 45
    (tmp_path / "a.csv").write_text(csv_row(counts))
    trajectory = read_pulse_csv(tmp_path / "a.csv")
    positions = dict(zip(trajectory.joint_names, trajectory.positions_rad[0], strict=True))
    assert positions["larm_joint_1"] == pytest.approx(np.pi / 2)
    assert positions["body_joint_1"] == pytest.approx(np.pi / 4)


def test_no_command_keeps_the_last_position(tmp_path):
    path = tmp_path / "a.csv"
    rows = [[209] + ["R"] * 20, [" R "] + ["R"] * 20, [418] + ["R"] * 20]
    path.write_text("".join(csv_row(row, "20", " 60 , R,R,R ") for row in rows))
    trajectory = read_pulse_csv(path)
    assert trajectory.joint_names == ("rleg_joint_1",)
    np.testing.assert_allclose(np.degrees(trajectory.positions_rad[:, 0]), [1, 1, 2])
    path.write_text(csv_row(rows[1]) + csv_row(rows[0]))
    (finding,) = check_pulse_csv(path)
    assert (finding.row, finding.column, finding.severity) == (1, "C", "error")


@pytest.mark.parametrize(
    ("row", "index", "cell", "column"),
    [
        (1, 0, "0", "A"),
        (3, 0, "2", "A"),
        (2, 1, "x", "B"),
        (2, 2, "", "C"),
        (4, 9, "1.5", "J"),
        (4, 22, "nan", "W"),
        (2, 12, "1_0", "M"),
        (5, 23, "61", "X"),
        (5, 26, "", "AA"),
    ],
)
def test_a_bad_cell_is_named_by_file_row_and_column(tmp_path, row, index, cell, column):
    rows = [csv_row().rstrip("\n").split(",") for _ in range(5)]
    rows[row - 1][index] = cell
    path = tmp_path / "bad.csv"
    path.write_text("".join(",".join(cells) + "\n" for cells in rows))
    with pytest.raises(FormatError, match=rf"bad\.csv: row {row if index or row > 1 else 1}, "):
        read_pulse_csv(path)
    finding = check_pulse_csv(path)[0]
    assert (finding.row, finding.column, finding.value) == (row, column, cell)


def test_missing_columns_and_files(tmp_path):
    path = tmp_path / "bad.csv"
    path.write_text(csv_row() + csv_row((0,) * 20) + csv_row())
    with pytest.raises(TrajectoryError, match=r"row 2, column AA: has 26 columns") as caught:
        read_pulse_csv(path)
    assert len(caught.value.findings) == 1
    path.write_text("")
    with pytest.raises(FormatError, match="empty"):
        read_pulse_csv(path)
    path.write_bytes(np.random.default_rng(1).bytes(2000))
    with pytest.raises(FormatError):
        read_pulse_csv(path)
    with pytest.raises(IoError, match=r"none\.csv"):
        read_pulse_csv(tmp_path / "none.csv")


def arm(degrees, period_s=0.001):
    return Trajectory(["larm_joint_1"], period_s, np.radians(degrees)[:, np.newaxis])


def test_limits_speeds_and_unknown_positions_are_errors():
    assert check_trajectory(arm(np.linspace(0, 90, 1000))) == []
    (beyond,) = check_trajectory(arm(np.linspace(100, 160, 1000)))
    assert (beyond.column, beyond.joint, beyond.severity) == ("S", "larm_joint_1", "error")
    assert "160.0 deg is outside" in beyond.message and 840 < beyond.row < 860
    (fast,) = check_trajectory(arm(np.linspace(0, 90, 200)))
    assert "rad/s" in fast.value and fast.severity == "error"
    degrees = np.zeros(100)
    degrees[40:43] = np.nan
    (unknown,) = check_trajectory(arm(degrees))
    assert unknown.row == 41 and "to row 43" in unknown.message
    with pytest.raises(TrajectoryError, match="row 41, column S"):
        require_safe(arm(degrees))
    with pytest.raises(TrajectoryError, match="no such joint"):
        require_safe(Trajectory(["tail"], 0.1, [[0.0]]))


def test_a_single_jump_is_a_warning_and_a_slow_rate_has_no_window():
    degrees = np.zeros(200)
    degrees[100:] = 1.0
    (jump,) = require_safe(arm(degrees))
    assert (jump.row, jump.severity) == (101, "warning")
    (fast,) = check_trajectory(arm([0.0, 60.0], 0.1))
    assert fast.severity == "error"


def test_a_trajectory_refuses_what_is_none():
    with pytest.raises(InvalidArgument, match="twice"):
        Trajectory(["a", "a"], 0.1, [[0, 0]])
    with pytest.raises(InvalidArgument, match="period_s"):
        Trajectory(["a"], 0.0, [[0]])
    with pytest.raises(InvalidArgument, match="shape"):
        Trajectory(["a"], 0.1, np.zeros((0, 1)))
    trajectory = Trajectory(["a"], 0.5, [[0.0], [1.0]])
    assert [trajectory.at(t)[0] for t in (-1, 0, 0.25, 0.5, 9)] == [0.0, 0.0, 0.5, 1.0, 1.0]


@pytest.mark.parametrize("name", ["walk.csv", "stand_up_back.csv"])
def test_factory_motions_are_safe_and_come_back_byte_for_byte(tmp_path, name):
    path = robot_data(name)
    findings = check_pulse_csv(path)
    assert findings and {finding.severity for finding in findings} == {"warning"}
    write_pulse_csv(tmp_path / name, read_pulse_csv(path))
    assert (tmp_path / name).read_bytes() == path.read_bytes()
