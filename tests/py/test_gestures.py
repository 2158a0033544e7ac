# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Gestures: the digits and words there are, that each is safe and differs from the others, and their gallery."""

from pathlib import Path

import numpy as np
import pytest

from hri.core.errors import InvalidArgument
from hri.media import read_frames, read_image
from hri.robot import (
    GESTURE_JOINTS,
    HOAP2,
    check_pulse_csv,
    check_trajectory,
    gesture_trajectory,
    load_gestures,
    rest_positions,
    write_gallery,
    write_pulse_csv,
)
from hri.robot.model.arm import HAND_M
from hri.robot.model.kinematics import link_poses
from hri.robot.motion.gestures import parse_gestures
from hri.robot.simulation.gallery import gallery_page, shown_poses

DOCS = Path(__file__).resolve().parents[2] / "docs"
# Section 3.1.1 of the thesis: the words that HOAP-2 shows.
WORDS = {
    "above",
    "below",
    "across",
    "aboard",
    "add",
    "advance",
    "afraid",
    "after",
    "all",
    "all-gone",
    "arrest",
    "arrive-here",
    "arrive-there",
    "baby",
    "coffee",
    "cold",
    "color",
    "come",
    "depart",
    "die",
    "distant",
    "dive",
    "dog",
    "effort",
    "end",
    "escape",
    "fight",
    "flag",
    "give",
    "grow",
    "half",
    "house",
    "how-many",
    "keep",
    "many",
    "many-times",
    "meet",
    "oath",
    "opposite",
    "question",
    "quiet-down",
    "thick",
    "thin",
    "up",
    "wait",
    "walk",
    "watch",
}
# Of its sentences, figure 4.6 and table 5.1, and of figure 3.23.
SENTENCE_WORDS = {
    "i",
    "you",
    "your",
    "this",
    "it",
    "big",
    "small",
    "car",
    "sad",
    "today",
    "hearing",
    "studying",
    "agree",
    "not",
    "closed",
    "own",
    "room",
    "why",
    "how",
    "arise",
    "child",
    "miss",
    "finished",
    "minute",
    "weak",
    "bless",
    "please",
    "switch",
    "light",
}
HEAD = """period_s = 0.01
speed_rad_s = 3.0
acceleration_rad_s2 = 20.0
least_move_s = 0.45
[arms]
down = [80, 8, 0, -18]
[[gesture]]
name = "mine"
meaning = "something"
"""


def hand_m(pose, side):
    """Where the middle of a hand is, from the middle between the shoulders, y to its own side."""
    wrist = link_poses(dict(zip(GESTURE_JOINTS, pose, strict=True)), base=np.eye(4))[f"{side[0]}arm_link_5"]
    place = (wrist @ [HAND_M, 0, 0, 1])[:3] - (-0.034, 0, 0.09)
    return place * (1, 1 if side == "left" else -1, 1)


def test_the_digits_and_the_vocabulary_are_there():
    assert len(WORDS) > 30
    assert set(load_gestures()) == {*map(str, range(11)), *WORDS, *SENTENCE_WORDS, "namaste", "wave", "stop", "rest"}
    assert all(gesture.meaning for gesture in load_gestures().values())


@pytest.mark.parametrize("name", load_gestures())
def test_a_gesture_is_inside_all_limits_and_goes_from_rest_to_rest(name, tmp_path):
    trajectory = gesture_trajectory(name)
    assert check_trajectory(trajectory) == []
    assert 1.5 <= trajectory.duration_s <= 7.0
    rest = [rest_positions()[joint] for joint in trajectory.joint_names]
    np.testing.assert_allclose(trajectory.positions_rad[[0, -1]], [rest, rest], atol=1e-12)
    period_s = trajectory.period_s
    assert np.abs(np.diff(trajectory.positions_rad, axis=0)).max() / period_s <= 3.0 + 1e-9
    assert np.abs(np.diff(trajectory.positions_rad, 2, axis=0)).max() / period_s**2 <= 20.0 + 1e-6
    left_out = write_pulse_csv(tmp_path / "g.csv", trajectory)
    assert left_out == ("larm_joint_5", "rarm_joint_5", "head_joint_1", "head_joint_2")
    assert check_pulse_csv(tmp_path / "g.csv") == []


def test_every_two_gestures_can_be_told_apart():
    """Each has a moment at which some joint is 15 degrees and more from all of the other one."""
    ways = {}
    for name in load_gestures():
        trajectory = gesture_trajectory(name)
        ways[name] = np.array([trajectory.at(t) for t in np.linspace(0, trajectory.duration_s, 50)])
    names = list(ways)
    for i, first in enumerate(names):
        for second in names[:i]:
            apart = np.abs(ways[first][:, np.newaxis] - ways[second]).max(axis=2)
            unlike = max(apart.min(axis=0).max(), apart.min(axis=1).max())
            assert unlike > np.radians(15), (first, second)


def test_hands_are_where_the_words_say():
    def moments(name, side):
        return np.array([hand_m(pose, side) for pose in shown_poses(load_gestures()[name])])

    above, below = moments("above", "right")[-1], moments("below", "right")[-1]
    assert above[2] > moments("above", "left")[-1][2] + 0.1
    assert below[2] < moments("below", "left")[-1][2] - 0.1
    assert (np.diff(moments("grow", "right")[:, 2]) > 0.05).all()
    assert moments("up", "right")[-1][2] > 0.2
    assert moments("give", "right")[-1][0] > moments("give", "right")[0][0] + 0.05
    assert moments("come", "right")[1][0] < moments("come", "right")[0][0] - 0.05
    for name in ("house", "meet", "thin", "namaste"):
        assert abs(moments(name, "left")[-1][1] - moments(name, "right")[-1][1]) < 1e-9, name
        assert 0.0 < moments(name, "left")[-1][1] < 0.04, name
    assert (moments("child", "right")[:, 2] < -0.08).all() and moments("light", "right")[0][2] > 0.15
    assert moments("switch", "right")[1][2] < moments("switch", "right")[0][2] - 0.04
    assert moments("finished", "left")[-1][1] > moments("finished", "left")[0][1] + 0.1
    for name in ("miss", "please"):  # the hand at the chin, and on the breast
        assert moments(name, "right")[-1][0] < 0.11, name
    for name in ("minute", "weak"):  # the left hand stays, the right one moves before it or upon it
        assert np.ptp(moments(name, "left"), axis=0).max() < 1e-9, name
        assert np.ptp(moments(name, "right"), axis=0).max() > 0.025, name
    assert moments("thick", "left")[0][1] > 2 * moments("thin", "left")[-1][1]


def test_a_place_is_reached_with_the_elbow_nearest_to_the_one_wanted():
    for elbow in (0, 60):
        keys = f"keys = [{{ left = {{ at_cm = [15, 9, 2], elbow = {elbow}, hand = 30 }}, hold_s = 1 }}]"
        (gesture,) = parse_gestures(HEAD + keys).values()
        pose = gesture.poses_rad[1]
        np.testing.assert_allclose(hand_m(pose, "left"), (0.15, 0.09, 0.02), atol=1e-9)
        assert np.degrees(pose[4]) == pytest.approx(30)
        poses = link_poses(dict(zip(GESTURE_JOINTS, pose, strict=True)), base=np.eye(4))
        out = poses["larm_link_4"][1, 3] - HOAP2["larm_joint_1"].origin_m[1]
        assert (out > 0.04) == (elbow == 60)
    assert gesture.times_s[2] - gesture.times_s[1] == pytest.approx(1.0)


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ('[{ left = "nowhere" }]', "key 1, left: no arm pose 'nowhere'"),
        ('[{}, { right = "down", hold = 2 }]', "key 2: no field hold"),
        ("[{ right = [1, 2] }]", "key 1, right: must be a list of 4 or 5 numbers"),
        ("[{ left = [200, 0, 0, 0] }]", "key 1: larm_joint_1 would be at 200.0 degrees"),
        ("[{ left = { at_cm = [30, 0, 0] } }]", r"key 1, left: the arm reaches \[30, 0, 0\] cm not at all"),
        ("[{ left = { at_cm = [3, 0.5, -9] } }]", "left: the arm reaches .* only through the body"),
        ("[{ left = { elbow = 3 } }]", "left: at_cm is missing"),
        ("[", "gestures: "),
    ],
)
def test_a_wrong_pose_is_named(keys, message):
    with pytest.raises(InvalidArgument, match=message):
        parse_gestures(f"{HEAD}keys = {keys}")
    with pytest.raises(InvalidArgument, match="no gesture 'salute'; "):
        gesture_trajectory("salute")


def test_the_gallery_in_the_docs_shows_the_gestures_as_they_are():
    assert (DOCS / "gallery.md").read_text(encoding="utf-8") == gallery_page(load_gestures()), "hri robot gallery docs"
    pictures = sorted((DOCS / "images" / "gallery").iterdir())
    assert {picture.stem for picture in pictures} == set(load_gestures())
    assert sum(picture.stat().st_size for picture in pictures) < 2_000_000


def test_a_gallery_is_drawn(tmp_path, monkeypatch):
    pytest.importorskip("cv2")
    few = {name: load_gestures()[name] for name in ("8", "come")}
    monkeypatch.setattr("hri.robot.simulation.gallery.load_gestures", lambda: few)
    done = []
    page = write_gallery(tmp_path / "new", videos=True, progress=lambda *counts: done.append(counts))
    assert page.read_text(encoding="utf-8") == gallery_page(few) and done == [(1, 2), (2, 2)]
    for name, gesture in few.items():
        strip = read_image(tmp_path / "new" / "images" / "gallery" / f"{name}.jpg")
        assert strip.shape[1] == 230 * len(shown_poses(gesture))
        film = read_frames(tmp_path / "new" / "images" / "gallery" / f"{name}.webm").frames
        assert len(film) == int(gesture.times_s[-1] * 12 + 1e-6) + 1
    first, second = np.hsplit(strip[:, :460].astype(int), 2)
    assert (np.abs(first - second).max(axis=2) > 60).sum() > 200
    shifted = few["8"].__class__(**{**few["8"].__dict__, "poses_rad": few["8"].poses_rad + 0.01})
    assert gallery_page({**few, "8": shifted}) != gallery_page(few), "a changed pose makes the page stale"
