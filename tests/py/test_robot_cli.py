# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The commands of ``hri robot``."""

import pytest

from hri.errors import InvalidArgument, IoError
from hri.robot import HOAP2, gesture_trajectory, load_gestures, read_pulse_csv

testing = pytest.importorskip("click.testing")


@pytest.fixture
def run():
    from hri.robot.cli import robot

    def invoke(*arguments):
        return testing.CliRunner().invoke(robot, [str(argument) for argument in arguments])

    return invoke


def test_a_converted_gesture_passes_the_check_and_a_broken_one_does_not(run, tmp_path):
    path = tmp_path / "g.csv"
    result = run("convert", "namaste", path)
    assert result.exit_code == 0 and str(path) in result.output
    assert "head_joint_1" in result.output
    assert len(read_pulse_csv(path)) == len(gesture_trajectory("namaste"))
    assert run("check", path).exit_code == 0
    lines = path.read_text().splitlines()
    lines[6] = lines[6].removesuffix("R") + "?"
    path.write_text("\n".join(lines))
    result = run("check", path)
    assert result.exit_code == 3
    assert result.output.startswith("error\t7\tAA\thead_joint_2\t")


def test_convert_writes_degrees(run, tmp_path):
    path = tmp_path / "g.tsv"
    assert run("convert", "1", path).exit_code == 0
    lines = path.read_text().splitlines()
    assert lines[0].startswith("time_s\tlarm_joint_1_deg")
    assert lines[1].split("\t")[:2] == ["0", "80.0000"] and len(lines) == len(gesture_trajectory("1")) + 1
    assert isinstance(run("convert", "1", tmp_path / "g.txt").exception, InvalidArgument)
    assert isinstance(run("convert", "1", tmp_path / "no" / "g.tsv").exception, IoError)


def test_play_and_render(run, tmp_path):
    pytest.importorskip("cv2")
    result = run("play", "1", "--backend", "kinematic")
    assert result.exit_code == 0 and len(result.output.splitlines()) == 25
    path = tmp_path / "v.mp4"
    result = run("render", "1", path, "--backend", "kinematic", "--fps", 4, "--size", 64, 48)
    assert result.exit_code == 0 and path.stat().st_size > 500
    assert isinstance(run("play", "salute").exception, InvalidArgument)
    assert isinstance(run("play", "none.csv").exception, IoError)


def test_lists(run):
    listed = run("gestures").output.splitlines()
    assert [line.split("\t")[0] for line in listed] == list(load_gestures())
    assert f"9\t{gesture_trajectory('9').duration_s:.1f}\tboth arms high" in listed
    assert len(run("joints").output.splitlines()) == len(HOAP2) + 1
    assert "| head_joint_2 | head pitch" in run("joints", "--markdown").output
