# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Bad files are reported cell by cell; accelerations and overlaps of links are found before a joint moves."""

from importlib.util import find_spec

import numpy as np
import pytest

from hri.robot import (
    HOAP2,
    Physics,
    Trajectory,
    check_pulse_csv,
    check_trajectory,
    gesture_trajectory,
    load_gestures,
    open_robot,
    read_pulse_csv,
    write_pulse_csv,
)
from hri.robot.motion.pulse_csv import column_letter
from hri.robot.motion.self_collision import self_collisions

BAD_COUNTS = [
    "",
    "x",
    "1.5",
    "nan",
    "1e3",
    "+5",
    "--5",
    "5-",
    "-",
    "1_0",
    "0x1f",
    "12 3",
    "1234567890",
    "r",
    "\x00",
    "60.",
    "é",
]


def write(path, rows, newline="\n"):
    path.write_bytes("".join(",".join(row) + newline for row in rows).encode("latin-1"))


def plain_rows(rng, count):
    counts = rng.integers(-15000, 15000, (count, 21))
    return [["1", "2", *map(str, row), "60", "R", "R", "R"] for row in counts]


def test_every_bad_row_of_200_files_is_told_by_row_and_column(tmp_path):
    rng = np.random.default_rng(2)
    path = tmp_path / "bad.csv"
    for _ in range(200):
        rows = plain_rows(rng, int(rng.integers(1, 60)))
        bad = {}
        for row in rng.choice(len(rows), min(len(rows), int(rng.integers(1, 6))), replace=False).tolist():
            kind = rng.integers(5)
            if kind == 0:
                cut = int(rng.integers(1, 26))
                rows[row] = rows[row][:cut]
                bad[row + 1] = column_letter(cut)
            elif kind == 1:
                rows[row] += ["0"]
                bad[row + 1] = column_letter(27)
            elif kind == 2:
                place = int(rng.integers(23, 27))
                rows[row][place] = str(rng.choice(["61", "", "S", "0", "-60"]))
                bad[row + 1] = column_letter(place)
            elif kind == 3:
                rows[row][1] = str(rng.choice(["-2", "", "2.0"]))
                bad[row + 1] = "B"
            else:
                place = int(rng.integers(2, 23))
                rows[row][place] = BAD_COUNTS[int(rng.integers(len(BAD_COUNTS)))]
                bad[row + 1] = column_letter(place)
        write(path, rows, "\r\n" if rng.random() < 0.3 else "\n")
        findings = check_pulse_csv(path)
        assert {finding.row: finding.column for finding in findings} == bad
        assert len(findings) == len(bad) and {finding.severity for finding in findings} == {"error"}


def test_blanks_and_line_ends_change_nothing(tmp_path):
    rng = np.random.default_rng(3)
    rows = plain_rows(rng, 40)
    path = tmp_path / "a.csv"
    write(path, rows)
    plain = read_pulse_csv(path).positions_rad
    write(path, rows, "\r\n")
    np.testing.assert_array_equal(read_pulse_csv(path).positions_rad, plain)
    spaced = [[f" {cell} " for cell in row] for row in rows]
    write(path, spaced)
    np.testing.assert_array_equal(read_pulse_csv(path).positions_rad, plain)
    path.write_bytes(path.read_bytes().removesuffix(b"\n") + b"\n\n")
    np.testing.assert_array_equal(read_pulse_csv(path).positions_rad, plain)


@pytest.mark.slow
def test_a_million_rows_come_back_byte_for_byte(tmp_path):
    rng = np.random.default_rng(6)
    source, copy = tmp_path / "a.csv", tmp_path / "b.csv"
    for _ in range(10):
        counts = rng.integers(-999_999, 1_000_000, (100_000, 21)).astype("U8")
        source.write_text("".join(f"1,2,{','.join(row)},60,R,R,R\n" for row in counts.tolist()))
        write_pulse_csv(copy, read_pulse_csv(source))
        assert copy.read_bytes() == source.read_bytes()


def test_an_acceleration_within_the_speed_limit_is_found():
    times = np.arange(0.0, 1.0, 0.001)
    swing = 0.2 + 0.08 * np.cos(2 * np.pi * 7.0 * times)  # 3.5 rad/s, 155 rad/s2
    (finding, *_) = found = check_trajectory(Trajectory(["larm_joint_1"], 0.001, swing[:, np.newaxis]))
    assert all("rad/s2" in finding.value and finding.severity == "error" for finding in found)
    assert finding.joint == "larm_joint_1" and finding.column == "S"
    assert check_trajectory(Trajectory(["larm_joint_1"], 0.001, 0.5 * swing[:, np.newaxis])) == []


def test_links_that_overlap_are_found_by_row():
    names = ["larm_joint_1", "larm_joint_3", "larm_joint_4"]
    part = np.linspace(0.0, 1.0, 200)[:, np.newaxis]
    into_the_chest = part * np.array([0.9, 1.5, -1.9])
    findings = check_trajectory(Trajectory(names, 0.01, into_the_chest))
    assert findings and all("overlap by" in finding.message for finding in findings)
    assert findings[0].joint.startswith("larm") and 20 < findings[0].row <= 200
    assert findings[0].row == min(finding.row for finding in findings)


def closing_legs(*roll_rad: float) -> Trajectory:
    return Trajectory(["lleg_joint_2"], 0.1, [[roll] for roll in roll_rad])


def test_legs_that_come_within_5_mm_are_a_warning_and_arms_are_not():
    assert check_trajectory(closing_legs(0.1, -0.01, 0.1)) == []
    steps = closing_legs(0.1, -0.035, 0.1, -0.04, 0.1)
    warnings = [finding for finding in check_trajectory(steps) if "lleg_link_6 and rleg_link_6" in finding.message]
    assert [(w.row, w.joint, w.severity) for w in warnings] == [(4, "lleg_joint_6", "warning")], "the nearest alone"
    gap_m = 0.078 - 2 * 0.0325 - 0.2 * 0.04  # the soles hang 0.2 m below the hips
    assert float(warnings[0].value.removesuffix(" mm")) == pytest.approx(1000.0 * gap_m, abs=1.5)
    overlap = check_trajectory(closing_legs(0.1, -0.1, 0.1))
    assert {finding.severity for finding in overlap if "lleg_link_6 and rleg_link_6" in finding.message} == {"error"}
    still = Trajectory(["lleg_joint_1"], 0.1, [[0.0], [0.0]])
    close = {"lleg_joint_2": -0.04}
    assert {finding.severity for finding in check_trajectory(still, others_rad=close)} == {"warning"}
    assert check_trajectory(Trajectory(["larm_joint_1"], 0.1, [[0.9], [0.9]]), others_rad=close) == []


@pytest.mark.skipif(find_spec("pybullet") is None, reason="no pybullet")
def test_legs_that_the_check_warns_of_touch_when_a_hip_is_off_by_a_degree_and_are_reported():
    bent = {"leg_joint_3": -0.3, "leg_joint_4": 0.6, "leg_joint_5": -0.3}  # soles clear of the floor
    bent = {side + name: angle for side in "lr" for name, angle in bent.items()}
    near = closing_legs(*np.linspace(0.0, -0.05, 6), -0.05, -0.05, -0.05)
    assert {finding.severity for finding in check_trajectory(near, others_rad=bent)} == {"warning"}

    def touching(off_deg: float) -> set[frozenset[str]]:
        with open_robot("pybullet", physics=Physics(joint_offsets_rad={"lleg_joint_2": np.radians(off_deg)})) as robot:
            robot.reset(bent)
            assert robot.perform(near)
            return {frozenset((contact.link, contact.other)) for contact in robot.self_contacts}

    assert touching(0.0) == set()
    assert frozenset(HOAP2.feet) in touching(-1.0)


def test_gestures_touch_nothing():
    for name in load_gestures():
        assert self_collisions(gesture_trajectory(name)) == [], name


@pytest.mark.skipif(find_spec("pybullet") is None, reason="no pybullet")
def test_overlaps_are_those_that_pybullet_sees():
    rng = np.random.default_rng(1)
    low, high = HOAP2.limits_rad.T
    seen = 0
    with open_robot("pybullet") as robot:
        for _ in range(150):
            pose = rng.uniform(low, high)
            robot.reset(dict(zip(HOAP2.names, pose.tolist(), strict=True)))
            carriers = {joint.child: joint.name for joint in HOAP2.joints}
            theirs = {frozenset(pair) for pair in robot.links_nearer_than(0.0)}
            deep = {frozenset(pair) for pair in robot.links_nearer_than(-0.003)}
            touches = self_collisions(Trajectory(HOAP2.names, 0.1, [pose]))
            ours = {frozenset(carriers.get(link, "base") for link in (t.link, t.other)) for t in touches}
            assert deep <= ours <= theirs
            seen += len(ours)
    assert seen > 100


@pytest.mark.parametrize(("pulses", "outside"), [(1.4, False), (1.6, True)])
@pytest.mark.parametrize("name", ["larm_joint_1", "rleg_joint_4", "head_joint_2"])
@pytest.mark.parametrize("end", ["lower", "upper"])
def test_limits_hold_to_a_pulse_and_a_half(name, end, pulses, outside):
    """A degree is 209 pulses."""
    joint = HOAP2[name]
    beyond_rad = np.radians(pulses / 209)
    at_rad = joint.lower_rad - beyond_rad if end == "lower" else joint.upper_rad + beyond_rad
    found = [
        finding for finding in check_trajectory(Trajectory([name], 1.0, [[at_rad]])) if "is outside" in finding.message
    ]
    assert [(finding.row, finding.joint) for finding in found] == [(1, name)] * outside
