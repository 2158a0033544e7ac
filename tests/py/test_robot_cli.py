# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The commands of ``hri robot``."""

import json
import signal

import numpy as np
import pytest

from hri.core.errors import InvalidArgument, IoError
from hri.robot import HOAP2, TrajectoryError, gesture_trajectory, load_gestures, read_pulse_csv, read_short_csv

testing = pytest.importorskip("click.testing")


@pytest.fixture
def run():
    from hri.cli.messages import set_verbosity
    from hri.cli.robot import robot

    set_verbosity(0)

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
    assert run("check", path).output == f"{path}: 0 errors, 0 warnings\n"
    back = read_short_csv(path)
    assert back.joint_names == gesture_trajectory("1").joint_names
    np.testing.assert_allclose(back.positions_rad, gesture_trajectory("1").positions_rad, atol=1e-6)
    assert run("play", path, "--backend", "kinematic").exit_code == 0
    assert run("convert", "1", tmp_path / "g.txt").exit_code == 2
    assert isinstance(run("convert", "1", tmp_path / "no" / "g.tsv").exception, IoError)


@pytest.mark.parametrize("suffix", [".json", ".mcap"])
def test_a_message_of_ros_passes_the_check_and_plays(run, tmp_path, suffix):
    pytest.importorskip("mcap_ros2")
    path, back = tmp_path / f"g{suffix}", tmp_path / "g.csv"
    for robot in ("hoap2", "nao"):
        assert run("convert", "1", path, "--robot", robot).exit_code == 0
        assert run("check", path, "--robot", robot).exit_code == 0
        assert run("play", path, "--robot", robot, "--backend", "kinematic").exit_code == 0
        assert run("convert", path, back, "--short", "--robot", robot).exit_code == 0
        assert run("check", back, "--robot", robot).exit_code == 0
    result = run("check", path)  # NAO's joints are not HOAP-2's
    assert result.exit_code == 3 and "HOAP-2 has no such joint" in result.output
    assert run("check", path, "--repair", back).exit_code == 2
    assert isinstance(run("convert", "1", back, "--robot", "nao").exception, InvalidArgument)


def test_no_message_of_an_unsafe_motion_is_written(run, tmp_path):
    path, out = tmp_path / "fast.csv", tmp_path / "fast.json"
    path.write_text("# by hand\ntime_s,larm_joint_1\n0,80\n0.1,0\n")
    error = run("convert", path, out).exception
    assert isinstance(error, TrajectoryError) and str(error).startswith(f"{path}: row 4, column B") and not out.exists()
    result = run("convert", path, out, "--slow")
    assert result.exit_code == 0 and "slowed from 0.1" in result.output and run("check", out).exit_code == 0


def test_many_motions_are_checked_and_findings_of_a_kind_are_counted(run, tmp_path):
    path, report = tmp_path / "bad.csv", tmp_path / "found.json"
    path.write_text("10,2\n" * 40)
    result = run("check", path, "--json", report)
    assert result.exit_code == 3
    rows = [line.split("\t") for line in result.stdout.splitlines()]
    assert [row[1] for row in rows] == ["1", "2", "3", ""] and rows[3][4] == "and 37 more like this one"
    (found,) = json.loads(report.read_text())["motions"]
    assert found["errors"] == len(found["findings"]) == 40 and found["findings"][39]["row"] == 40
    result = run("check", "wave", path)
    assert result.exit_code == 3 and "wave: 0 errors" in result.output
    assert result.stdout.startswith(f"{path}\terror\t1\t")
    assert run("check", "wave", "namaste", "--robot", "nao").exit_code == 0
    assert run("check", "wave", "--repair", tmp_path / "good.csv").exit_code == 2
    assert isinstance(run("check", "salute").exception, InvalidArgument)


def test_urdf_is_written(run, tmp_path):
    for robot, joint in (("hoap2", "larm_joint_1"), ("nao", "LShoulderPitch")):
        path = tmp_path / f"{robot}.urdf"
        assert run("urdf", path, "--robot", robot).exit_code == 0
        assert f'<joint name="{joint}" type="revolute">' in path.read_text() and "capsule" not in path.read_text()


def test_play_and_render(run, tmp_path):
    pytest.importorskip("cv2")
    result = run("play", "1", "--backend", "kinematic")
    assert result.exit_code == 0 and len(result.output.splitlines()) == 25
    path = tmp_path / "v.mp4"
    result = run("render", "1", path, "--backend", "kinematic", "--fps", 4, "--size", 64, 48)
    assert result.exit_code == 0 and path.stat().st_size > 500
    assert isinstance(run("play", "salute").exception, InvalidArgument)
    assert isinstance(run("play", "none.csv").exception, IoError)


def test_ctrl_c_stops_the_robot_within_its_limits_and_ends_the_program_after(run, monkeypatch):
    from hri.robot.simulation.kinematic_backend import KinematicRobot

    command, sent = KinematicRobot._command, []

    def interrupted(robot, positions):
        sent.append(positions["larm_joint_1"])
        if len(sent) == 50:
            signal.raise_signal(signal.SIGINT)
        command(robot, positions)

    monkeypatch.setattr(KinematicRobot, "_command", interrupted)
    before = signal.getsignal(signal.SIGINT)
    result = run("play", "9", "--backend", "kinematic")
    assert result.exit_code == 130 and "stop: stopped on request" in result.output
    assert 51 < len(sent) < 100 and abs(sent[-1] - sent[-2]) < abs(sent[49] - sent[48]), "it slowed down"
    assert signal.getsignal(signal.SIGINT) is before


def test_a_motion_that_is_not_safe_is_named_by_its_file(run, tmp_path):
    path = tmp_path / "far.csv"
    path.write_text("time_s,larm_joint_4\n0,0\n1,90\n")
    for command in (("play", path), ("render", path, tmp_path / "v.mp4")):
        error = run(*command, "--backend", "kinematic").exception
        assert isinstance(error, TrajectoryError) and str(error).startswith(f"{path}: row 3, column B")


def test_lists(run):
    listed = run("gestures").output.splitlines()
    assert [line.split("\t")[0] for line in listed] == list(load_gestures())
    assert f"9\t{gesture_trajectory('9').duration_s:.1f}\tboth arms high" in listed
    assert len(run("joints").output.splitlines()) == len(HOAP2) + 1
    assert "| head_joint_2 | head pitch" in run("joints", "--markdown").output
    as_json = json.loads(run("joints", "--json", "-").stdout)
    assert [joint["joint"] for joint in as_json["joints"]] == list(HOAP2.names)
    as_json = json.loads(run("gestures", "--robot", "nao", "--json", "-").stdout)
    assert as_json["robot"] == "NAO" and [one["gesture"] for one in as_json["gestures"]] == list(load_gestures())
    assert all(one["hand_m"] >= 0 for one in as_json["gestures"])


def test_motions_of_both_robots_are_drawn(run, tmp_path):
    pytest.importorskip("matplotlib")
    for robot in ("hoap2", "nao"):
        assert run("plot", "wave", tmp_path / f"{robot}.svg", "--robot", robot).exit_code == 0
    assert (tmp_path / "hoap2.svg").read_bytes() != (tmp_path / "nao.svg").read_bytes()


def test_a_stop_label_moves_no_robot(tmp_path):
    from hri.cli.recognise import _answer
    from hri.fusion import FusedDecision
    from hri.session import LabelMotions

    stop = FusedDecision("stop", "recognised", 0.9, "stop: recognised in speech", (), None, None)
    answer = _answer(stop, tmp_path / "stop.png", "kinematic", gui=False, motions=LabelMotions())
    assert answer == {"moved": False, "reason": "stop"} and not (tmp_path / "stop.png").exists()
