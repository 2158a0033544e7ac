# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""From hand tracks to motions of the arms: geometry, gaps, limits, reach, and what bad tracks give."""

import json
from importlib.util import find_spec

import numpy as np
import pytest

from hri.core.errors import FormatError, InvalidArgument, IoError
from hri.media import read_frames
from hri.robot import HOAP2, check_pulse_csv, check_trajectory, link_poses, open_robot, read_pulse_csv, rest_positions
from hri.robot.imitation import HandTrack, ImitationOptions, film_imitation, imitate, read_hand_tracks
from hri.robot.imitation.body import REACH, SHOULDER_WIDTH
from hri.robot.imitation.pacing import pace, spline
from hri.robot.model.arm import HAND_M, MIRROR, arm_angles, arm_of, arm_points

FPS = 30.0
HEIGHT_PX = 320.0
SHOULDER_PX = 0.5 * SHOULDER_WIDTH * HEIGHT_PX
M_PER_PX = 0.231 / (REACH * HEIGHT_PX)
HEADER = "frame,left-x,left-y,right-x,right-y,nose-x,nose-y"


def person(left, right, **changed):
    """A track with shoulders, from hands in pixels outwards and up from their own shoulder."""
    left, right = np.asarray(left, dtype=float), np.asarray(right, dtype=float)
    places = {
        "left": np.stack((160 + SHOULDER_PX + left[:, 0], 100 - left[:, 1]), axis=1),
        "right": np.stack((160 - SHOULDER_PX - right[:, 0], 100 - right[:, 1]), axis=1),
        "shoulders": np.tile([[160 + SHOULDER_PX, 100], [160 - SHOULDER_PX, 100]], (len(left), 1, 1)),
    }
    return HandTrack("person", FPS, **{**places, **changed})


def circles(frames=90, radius=25.0, turns=2.0):
    angle = np.linspace(0, 2 * np.pi * turns, frames)
    left = np.stack((-20 + radius * np.cos(angle), -40 + radius * np.sin(angle)), axis=1)
    return left, left[::-1].copy()


@pytest.mark.parametrize("side", ["left", "right"])
def test_the_arm_in_closed_form_is_the_arm_of_the_joint_table(side):
    arm = arm_of(side)
    angles = np.random.default_rng(3).uniform(*arm.limits_rad.T, (50, 4))
    elbows, hands = arm_points(arm, angles)
    outwards = np.array([1.0, 1.0 if side == "left" else -1.0, 1.0])
    for row, elbow, hand in zip(angles * (1 if side == "left" else MIRROR), elbows, hands, strict=True):
        poses = link_poses(dict(zip(arm.names, row.tolist(), strict=True)), base=np.eye(4))
        wrist = poses[f"{side[0]}arm_link_5"]
        np.testing.assert_allclose(poses[f"{side[0]}arm_link_4"][:3, 3] - arm.shoulder_m, elbow * outwards, atol=1e-12)
        np.testing.assert_allclose((wrist @ [HAND_M, 0, 0, 1])[:3] - arm.shoulder_m, hand * outwards, atol=1e-12)


def test_the_hand_gets_where_it_is_wanted_and_the_elbow_turns_about_the_line():
    arm = arm_of("left")
    rng = np.random.default_rng(4)
    wanted = rng.normal(0, 1, (200, 3))
    wanted *= rng.uniform(0.06, 0.22, (200, 1)) / np.linalg.norm(wanted, axis=1, keepdims=True)
    _, hands = arm_points(arm, arm_angles(arm, wanted, rng.uniform(-3, 3, 200)))
    np.testing.assert_allclose(hands, wanted, atol=1e-9)
    ahead = np.array([[0.17, 0.0, 0.0]] * 2)
    below, out = arm_points(arm, arm_angles(arm, ahead, np.array([0.0, np.pi / 2])))[0]
    assert below[2] < -0.05 and abs(below[1]) < 1e-9
    assert out[1] > 0.05 and abs(out[2]) < 1e-9
    _, far = arm_points(arm, arm_angles(arm, np.array([[0.5, 0.0, 0.0]]), np.zeros(1)))
    np.testing.assert_allclose(far, [[arm.reach_m, 0, 0]], atol=1e-6)


def test_hands_follow_the_scaled_track_inside_all_limits():
    made = imitate(person(*circles()))
    assert made.targets.height_px == pytest.approx(HEIGHT_PX)
    assert made.targets.metres_per_px == pytest.approx(M_PER_PX)
    assert made.reached.mean() > 0.9
    assert made.rms_m < 0.004
    assert check_trajectory(made.trajectory) == []
    positions, period_s = made.trajectory.positions_rad, made.trajectory.period_s
    assert np.abs(np.diff(positions, axis=0)).max() / period_s < HOAP2.max_speed_rad_s
    assert np.abs(np.diff(positions, 2, axis=0)).max() / period_s**2 <= 50.0
    assert made.clearance_m > 0.0
    # What it says about the hands is what the robot's joint table makes of the angles.
    row = made.trajectory.at(made.frame_times_s[40])
    pose = link_poses(dict(zip(made.trajectory.joint_names, row, strict=True)), base=np.eye(4))["rarm_link_5"]
    hand = (pose @ [HAND_M, 0, 0, 1])[:3] - HOAP2["rarm_joint_1"].origin_m
    np.testing.assert_allclose(hand * (1, -1, 1), made.hands_m[1, 40], atol=2e-4)


def test_a_mirrored_picture_is_put_back():
    left, right = circles(turns=1)
    track = person(left, right - 5.0)
    mirrored = HandTrack(
        "webcam",
        FPS,
        left=(320, 0) + track.left * (-1, 1),
        right=(320, 0) + track.right * (-1, 1),
        shoulders=(320, 0) + track.shoulders * (-1, 1),
    )
    made, back = imitate(track), imitate(mirrored.unmirrored())
    np.testing.assert_allclose(back.trajectory.positions_rad, made.trajectory.positions_rad, atol=1e-9)


def test_a_motion_begins_and_ends_with_the_arms_down_or_in_the_tracks_own_poses():
    track = person(*circles())
    rest = rest_positions()
    made = imitate(track)
    for row in (0, -1):
        wanted = [rest[name] for name in made.trajectory.joint_names]
        np.testing.assert_allclose(made.trajectory.positions_rad[row], wanted, atol=1e-9)
    bare = imitate(track, ImitationOptions(rest_s=0.0))
    assert bare.trajectory.duration_s < made.trajectory.duration_s - 1.5
    assert bare.rms_m < 0.004


def test_a_fast_track_takes_longer_and_a_slow_one_does_not():
    slow, fast = (imitate(person(*circles(turns=turns))).report() for turns in (0.3, 8))
    assert slow["slower"] == pytest.approx(1.0, abs=0.05)
    assert fast["slower"] > 1.2
    assert fast["rms_m"] < 0.02


def test_missing_frames_are_bridged_and_named():
    left, right = circles()
    whole = imitate(person(left, right))
    right[30:34] = np.nan
    left[:3] = np.nan
    made = imitate(person(left, right))
    assert [(gap.what, gap.first, gap.last) for gap in made.gaps] == [("left hand", 0, 2), ("right hand", 30, 33)]
    assert not made.reached[1, 30:34].any() and made.reached[1, 29]
    assert made.report()["seen"] == {
        "left": pytest.approx(87 / 90, abs=1e-3),
        "right": pytest.approx(86 / 90, abs=1e-3),
    }
    assert np.linalg.norm(made.hands_m[1] - whole.hands_m[1], axis=1).max() < 0.02


def test_a_hand_never_seen_rests():
    left, right = circles()
    made = imitate(person(left * np.nan, right))
    rest = rest_positions()
    for column, name in enumerate(made.trajectory.joint_names[:4]):
        np.testing.assert_allclose(made.trajectory.positions_rad[:, column], rest[name], atol=1e-9)
    assert made.report()["reached"]["left"] == 0.0 and made.reached[1].mean() > 0.9


def test_what_is_beyond_reach_is_said_and_the_hand_goes_as_near_as_it_can():
    left, right = circles()
    left[40:60] = (0.0, 150.0)  # more than the straight arm, upwards
    made = imitate(person(left, right))
    assert not made.reached[0, 42:58].any()
    assert made.errors_m[:, :35].max() < 0.01
    away = made.errors_m[0, 50] - (150.0 * M_PER_PX - 0.231)
    assert 0.0 < away < 0.03
    assert check_trajectory(made.trajectory) == []


def test_arms_that_cross_stay_apart():
    side = np.linspace(-1, 1, 60)
    left = np.stack((-41 + 20 * side, -45 + 0 * side), axis=1)
    made = imitate(person(left, left))
    assert made.clearance_m > 0.001
    if find_spec("pybullet") is not None:
        with open_robot("pybullet") as robot:
            for row in made.trajectory.positions_rad[::8].tolist():
                robot.reset(dict(zip(made.trajectory.joint_names, row, strict=True)))
                assert robot.links_nearer_than(0.0) == []


def test_plain_angles_reach_sidewards_and_not_before_the_chest():
    left, right = circles(radius=15)
    aside = np.array([45.0, 0.0])
    plain = ImitationOptions(form="atan2")
    outside = imitate(person(left + aside, right + aside), plain)
    assert outside.reached.all() and outside.rms_m < 0.005
    assert check_trajectory(outside.trajectory) == []
    inside = imitate(person(left, right), plain)
    assert inside.reached.mean() < 0.3
    assert check_trajectory(inside.trajectory) == []
    assert np.isnan(imitate(person(left - aside, right - aside), plain).rms_m)


def test_the_spline_stays_between_its_control_points():
    values = np.random.default_rng(5).uniform(-1, 1, (20, 3))
    curve = spline(values, np.linspace(-1, 20, 500))
    assert (curve <= values.max(axis=0)).all() and (curve >= values.min(axis=0)).all()
    np.testing.assert_allclose(curve[[0, -1]], values[[0, -1]], atol=1e-12)
    np.testing.assert_allclose(spline(np.ones((1, 2)), np.linspace(-1, 1, 9)), 1.0)


def test_pacing_keeps_limits_of_any_path():
    rng = np.random.default_rng(6)
    for speed, acceleration in ((1.0, 5.0), (4.75, 50.0)):
        angles = np.cumsum(rng.normal(0, 0.2, (40, 8)), axis=0)
        paced = pace(angles, FPS, 0.01, speed, acceleration)
        assert np.abs(np.diff(paced.positions_rad, axis=0)).max() / 0.01 <= speed
        assert np.abs(np.diff(paced.positions_rad, 2, axis=0)).max() / 1e-4 <= acceleration * (1 + 1e-9)
        assert (np.diff(paced.frame_times_s) >= 1 / FPS - 1e-9).all()
    still = pace(np.zeros((10, 8)), FPS, 0.01, 1.0, 5.0)
    assert not still.positions_rad.any()


def rows(*lines):
    return "\n".join((HEADER, *lines)) + "\n"


def test_tracks_are_read_with_gaps_and_by_name(tmp_path):
    path = tmp_path / "mine.csv"
    path.write_text(rows("0,1,2,3,4,5,6", "2,,nan,3,4,5,6.5"))
    track = read_hand_tracks(path, 25.0)["mine"]
    assert (len(track), track.fps, track.shoulders) == (3, 25.0, None)
    assert np.isnan(track.left[1:]).all() and np.isnan(track.right[1]).all()
    assert track.right[2].tolist() == [3.0, 4.0] and track.nose[2].tolist() == [5.0, 6.5]
    names = "left-shoulder-x,left-shoulder-y,right-shoulder-x,right-shoulder-y,left-x,left-y,right-x,right-y,video"
    path.write_text(f"{names}\n9,1,7,1,1,2,3,4,b\n9,1,7,1,1,2,3,4,a\n9,1,7,1,1,2,3,4,b\n")
    tracks = read_hand_tracks(path)
    assert {name: len(track) for name, track in tracks.items()} == {"b": 2, "a": 1}
    assert tracks["a"].shoulders.tolist() == [[[9, 1], [7, 1]]] and tracks["a"].nose is None


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "no rows"),
        (HEADER, "no rows"),
        ("a,b\n1,2\n", "row 1: no column left-x"),
        ("left-x,left-y,right-x,right-y\n1,2,3,4\n", "no column nose-x, nose-y"),
        (rows("0,1,2,3,4,5"), "row 2: 6 fields"),
        (rows("0,1,2,x,4,5,6"), "row 2, column right-x: 'x'"),
        (rows("0,1,2,3,4,5,6", "0,1,2,3,4,5,6"), "row 3, column frame: '0'"),
        (rows("0,1,2,3,4,5,1e9"), "row 2, column nose-y"),
        (rows("0,1,2,inf,4,5,6"), "row 2, column right-x"),
        (rows(",1,2,3,4,5,6"), "row 2, column frame"),
    ],
)
def test_bad_track_files_are_named_by_row_and_column(tmp_path, text, message):
    path = tmp_path / "bad.csv"
    path.write_text(text)
    with pytest.raises(FormatError, match=message):
        read_hand_tracks(path)


def test_bad_tracks_and_options(tmp_path):
    with pytest.raises(IoError, match=r"none\.csv"):
        read_hand_tracks(tmp_path / "none.csv")
    (tmp_path / "raw.csv").write_bytes(b"\xff\xfe" * 40)
    with pytest.raises(FormatError, match="UTF-8"):
        read_hand_tracks(tmp_path / "raw.csv")
    left, right = circles()
    with pytest.raises(InvalidArgument, match="neither nose nor shoulders"):
        person(left, right, shoulders=None)
    with pytest.raises(InvalidArgument, match="nose has shape"):
        person(left, right, nose=np.zeros((3, 2)))
    with pytest.raises(InvalidArgument, match="no hand is seen"):
        imitate(person(left * np.nan, right * np.nan))
    with pytest.raises(InvalidArgument, match="shoulders are not seen"):
        imitate(person(left, right, shoulders=np.full((90, 2, 2), np.nan)))
    with pytest.raises(InvalidArgument, match="height_px is 3"):
        imitate(person(left, right), ImitationOptions(height_px=3.0))
    for options in ({"form": "x"}, {"period_s": 0.0}, {"smoothing_s": float("nan")}, {"rest_s": -1.0}):
        with pytest.raises(InvalidArgument, match=next(iter(options))):
            ImitationOptions(**options)


def write_track(path, videos=("",)):
    low = np.array([-25.0, -95.0])  # 0.4 of the height below the nose
    rise = np.concatenate((np.zeros(6), np.linspace(0, 1, 12)))[:, np.newaxis]
    left, right = (np.concatenate((low + rise * (points[0] - low), points)) for points in circles(45, turns=1))
    lines = [HEADER if videos == ("",) else f"video,{HEADER}"]
    for video in videos:
        track = person(left, right)
        for frame in range(len(track)):
            cells = [frame, *track.left[frame], *track.right[frame], 160, 68]
            lines.append(",".join(([video] if video else []) + [f"{cell:g}" for cell in cells]))
    path.write_text("\n".join(lines) + "\n")


def test_the_command_writes_a_motion_that_passes_the_check(hri, tmp_path):
    write_track(tmp_path / "hands.csv")
    out, report = tmp_path / "motion.csv", tmp_path / "report.json"
    result = hri("robot", "imitate", tmp_path / "hands.csv", "--out", out, "--json", report, "--height-px", HEIGHT_PX)
    assert (result.code, result.out) == (0, f"{out}\n")
    assert "within reach" in result.err and "height: 320 px, as given" in result.err
    assert check_pulse_csv(out) == []
    assert json.loads(report.read_text())["rms_m"] < 0.005
    assert read_pulse_csv(out).duration_s == pytest.approx(json.loads(report.read_text())["motion_s"])
    assert hri("robot", "imitate", tmp_path / "hands.csv", "--out", tmp_path / "other.csv", "--mirrored").code == 0
    assert not np.array_equal(read_pulse_csv(tmp_path / "other.csv").positions_rad, read_pulse_csv(out).positions_rad)
    printed = hri("robot", "imitate", tmp_path / "hands.csv", "--out", out, "--json", "-", "--height-px", HEIGHT_PX)
    assert json.loads(printed.out) == json.loads(report.read_text())
    write_track(tmp_path / "two.csv", ("b", "a"))
    several = hri("robot", "imitate", tmp_path / "two.csv", "--out", out)
    assert several.code == 3 and "--track chooses one: b, a" in several.err
    assert hri("robot", "imitate", tmp_path / "two.csv", "--out", out, "--track", "a").code == 0
    assert hri("robot", "imitate", tmp_path / "two.csv", "--out", out, "--track", "c").code == 3


def test_film_shows_person_and_robot_side_by_side(tmp_path):
    pytest.importorskip("cv2")
    left, right = circles(30, turns=0.5)
    left[3] = np.nan
    track = person(left, right)
    made = imitate(track, ImitationOptions(rest_s=0.3))
    frames = film_imitation(track, made, tmp_path / "both.mp4", fps=8, size=(96, 80))
    clip = read_frames(tmp_path / "both.mp4")
    assert len(clip.frames) == frames == int(made.trajectory.duration_s * 8 + 1e-6) + 1
    assert clip.frames[0].shape == (80, 192, 3)
    middle, end = clip.frames[frames // 2].astype(int), clip.frames[-1].astype(int)
    for half in (np.s_[:, :96], np.s_[:, 96:]):
        assert np.abs(middle[half] - end[half]).max() > 60


def test_the_study_measures_a_small_collection(hri, tmp_path):
    (tmp_path / "asl_sentences").mkdir()
    write_track(tmp_path / "asl_sentences" / "hands.csv", ("1", "2"))
    result = hri("study", "imitation", "--data", tmp_path, "--only", "form=search", "--json", tmp_path / "found.json")
    assert result.code == 0
    found = json.loads((tmp_path / "found.json").read_text())
    assert found["limits"]["search"]["sentences"] == 2 and found["limits"]["search"]["findings_in_files"] == 0
    assert all(row["rms_cm_mean"] < 0.5 and row["reached_percent_mean"] > 50 for row in found["rows"])
