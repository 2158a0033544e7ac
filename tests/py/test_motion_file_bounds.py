# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Small files of motions and tracks that would need much memory, and motions that a format cannot hold."""

import numpy as np
import pytest

from hri.core.errors import FormatError, InvalidArgument
from hri.robot import (
    Trajectory,
    TrajectoryError,
    check_pulse_csv,
    mirrored,
    read_pulse_csv,
    read_short_csv,
    slow_to_limits,
    write_pulse_csv,
    write_short_csv,
)
from hri.robot.imitation.tracks import read_hand_tracks
from hri.robot.motion.joint_trajectory import trajectory_of_message
from hri.robot.motion.short_csv import check_short_csv
from hri.robot.motion.trajectory import MOST_FINDINGS


def test_faults_of_cells_are_counted_to_a_thousand(tmp_path):
    path = tmp_path / "bad.csv"
    path.write_text("x\n" * 5000)
    findings = check_pulse_csv(path)
    assert len(findings) == MOST_FINDINGS + 1 and findings[-1].message == "the rest of the file was not looked at"
    path.write_text("time_s,head_joint_1\n" + "x,x\n" * 5000)
    findings = check_short_csv(path)
    assert len(findings) == MOST_FINDINGS + 1 and findings[-1].row == 501


def test_frames_that_a_track_leaves_out_are_limited_over_all_videos(tmp_path):
    path = tmp_path / "track.csv"
    header = "video,frame,left-x,left-y,right-x,right-y,nose-x,nose-y\n"
    path.write_text(header + "".join(f"v{i},9999,1,1,1,1,1,1\n" for i in range(10)))
    assert [len(track.left) for track in read_hand_tracks(path).values()] == [10_000] * 10
    path.write_text(header + "".join(f"v{i},9999,1,1,1,1,1,1\n" for i in range(11)))
    with pytest.raises(FormatError, match=r"row 12, column frame: .* more than 100000 are left out"):
        read_hand_tracks(path)


def test_a_message_of_too_many_positions_is_refused_before_any_is_looked_at():
    message = {"joint_names": [0] * 1_000_000, "points": [0] * 500_000}
    with pytest.raises(FormatError, match="500000 points of 1000000 joints"):
        trajectory_of_message(message)


def test_a_motion_is_not_slowed_to_more_rows_than_fit(tmp_path):
    names = [f"{side}arm_joint_{number}" for side in "rl" for number in range(1, 5)]
    rough = np.zeros((15_000, len(names)))
    rough[7_500] = 0.3
    with pytest.raises(InvalidArgument, match=r"it would have 1[0-9]{7} rows"):
        slow_to_limits(Trajectory(names, 0.0004, rough))


def test_what_a_file_cannot_hold_is_written_otherwise_or_refused(tmp_path):
    path = tmp_path / "motion.csv"
    slow = Trajectory(["larm_joint_1"], 10.0, [[0.0], [0.5]])
    write_pulse_csv(path, slow)
    assert read_pulse_csv(path).duration_s == pytest.approx(10.0)
    unknown = Trajectory(["larm_joint_1"], 0.1, [[0.0], [np.nan]])
    with pytest.raises(TrajectoryError, match=r"row 2, column B.* not known"):
        write_short_csv(path, unknown)
    assert read_pulse_csv(path).duration_s == pytest.approx(10.0), "the file is as it was"


def test_files_whose_motion_is_none_are_named(tmp_path):
    path = tmp_path / "idle.csv"
    path.write_text("1,2," + ",".join(["R"] * 21) + ",60,R,R,R\n")
    assert [finding.message for finding in check_pulse_csv(path)] == ["the file commands no joint"]
    for last, said in (("1e-7", "period_s is 1e-07"), ("4000", "period_s is 4000")):
        path.write_text(f"time_s,head_joint_1\n0,0\n# a remark\n{last},0\n")
        with pytest.raises(TrajectoryError, match=f"row 4, column A.*{said}") as caught:
            read_short_csv(path)
        assert str(path) in str(caught.value) and check_short_csv(path) == caught.value.findings


def test_one_arm_becomes_the_other():
    left = Trajectory(["head_joint_1", "larm_joint_1", "larm_joint_2"], 0.1, [[0.1, 0.2, 0.3]])
    right = mirrored(left)
    assert right.joint_names == ("head_joint_1", "rarm_joint_1", "rarm_joint_2")
    assert mirrored(right).joint_names == left.joint_names
    np.testing.assert_array_equal(mirrored(right).positions_rad, left.positions_rad)
