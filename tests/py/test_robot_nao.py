# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""NAO from its own table: it has the maker's numbers, stands, makes gestures that its arms allow, and is drawn."""

import sys
from importlib.util import find_spec

import numpy as np
import pytest

from hri.core.errors import InvalidArgument
from hri.robot import (
    GESTURE_JOINTS,
    HOAP2,
    NAO,
    NaoqiRobot,
    Trajectory,
    check_trajectory,
    gesture_trajectory,
    link_poses,
    load_gestures,
    nao_gesture,
    nao_gesture_trajectory,
    open_robot,
    render_still,
    self_collisions,
    urdf_text,
    with_nao_arms,
)
from hri.robot.model.arm import HAND_M, arm_of
from hri.robot.nao import gestures as nao_gestures
from hri.robot.nao.couplings import coupling_findings
from hri.robot.nao.gestures import HAND_TOLERANCE_M, HEAD_TOLERANCE_DEG

NAO_REACH_M = float(np.hypot(0.105, 0.015) + 0.05595 + 0.05775)
needs_pybullet = pytest.mark.skipif(find_spec("pybullet") is None, reason="no pybullet")


def errors(trajectory):
    return [finding for finding in check_trajectory(trajectory, NAO) if finding.severity == "error"]


def test_the_table_has_the_makers_numbers():
    assert len(NAO) == 24 and not NAO.counted
    assert sum(link.mass_kg for link in NAO.links.values()) == pytest.approx(5.195, abs=0.005)
    poses = link_poses({}, table=NAO)
    # Sole below ankle 45.19 mm, thigh 100, tibia 102.9, hip 85 below the torso's middle.
    assert poses["l_sole"][2, 3] == pytest.approx(0.04519, abs=1e-6)
    np.testing.assert_allclose(poses["l_wrist"][:3, 3] - poses["LBicep"][:3, 3], (0.16095, 0.015, 0.0), atol=1e-9)
    for name in ("ShoulderRoll", "ElbowRoll", "HipRoll"):
        left, right = NAO["L" + name], NAO["R" + name]
        assert (left.lower_rad, left.upper_rad) == pytest.approx((-right.upper_rad, -right.lower_rad))
    for joint in NAO.joints:
        assert joint.lower_rad <= joint.rest_rad <= joint.upper_rad, joint.name
        assert np.linalg.norm(joint.axis) == pytest.approx(1.0)
    for camera in NAO.cameras:
        assert np.degrees(camera.field_of_view_rad) == pytest.approx((60.97, 47.64))
        assert camera.size_px == (640, 480) and camera.link in NAO.links
    assert 'name="NAO"' in urdf_text(NAO)


def test_nothing_touches_at_rest_and_a_hand_in_the_body_is_found():
    names = ["LShoulderPitch", "LElbowRoll"]
    rest = Trajectory(names, 0.1, [[NAO[name].rest_rad for name in names]] * 2)
    assert errors(rest) == [] and self_collisions(rest, NAO) == []
    inside = Trajectory(["LShoulderPitch", "LElbowYaw", "LElbowRoll", "LShoulderRoll"], 5.0, [[1.2, 0, -1.5, -0.3]] * 2)
    assert {touch.other for touch in self_collisions(inside, NAO)} >= {"torso"}


def test_arms_point_as_those_of_hoap2():
    gesture = gesture_trajectory("house")
    moved = with_nao_arms(gesture)
    for row in range(0, len(gesture), 25):
        theirs = link_poses(dict(zip(gesture.joint_names, gesture.positions_rad[row], strict=True)))
        ours = link_poses(dict(zip(moved.joint_names, moved.positions_rad[row], strict=True)), table=NAO)
        for side, nao in (("l", "L"), ("r", "R")):
            for link, other in ((f"{side}arm_link_3", f"{nao}Bicep"), (f"{side}arm_link_4", f"{nao}ForeArm")):
                np.testing.assert_allclose(ours[other][:3, 0], theirs[link][:3, 0], atol=1e-9)


@pytest.mark.parametrize("name", ["house", "3", "namaste", "arrive-here", "sad", "wave"])
def test_a_gesture_is_made_with_naos_own_arms(name):
    made, gesture = nao_gesture(name), load_gestures()[name]
    assert made.why_not == "" and errors(made.trajectory) == [] and made.trajectory is not None
    assert coupling_findings(made.trajectory, {}) == []
    assert made.hand_m <= HAND_TOLERANCE_M and made.head_deg <= HEAD_TOLERANCE_DEG
    for row in (0, -1):
        np.testing.assert_allclose(
            made.trajectory.positions_rad[row], [NAO[name].rest_rad for name in made.trajectory.joint_names], atol=1e-9
        )
    assert made.trajectory.duration_s >= gesture.times_s[-1] - 1e-9
    theirs, ours = hands_of(gesture, made)
    # In proportion to the arm the hands are where HOAP-2's are: as measured by the chain of links, not by our formulas.
    away = np.linalg.norm(ours - theirs, axis=-1).max()
    assert away == pytest.approx(made.hand_m, abs=1e-6)


def hands_of(gesture, made):
    """Hands that do not rest, from their shoulders at the key poses, of HOAP-2 in NAO's size and of NAO: (hands, 3)."""
    theirs, ours = [], []
    for pose, row in zip(gesture.poses_rad, np.round(made.times_s / gesture.period_s).astype(int), strict=True):
        hoap2 = link_poses(dict(zip(GESTURE_JOINTS, pose, strict=True)))
        positions = made.trajectory.positions_rad[row]
        nao = link_poses(dict(zip(made.trajectory.joint_names, positions, strict=True)), table=NAO)
        for side, own in (("l", slice(0, 5)), ("r", slice(5, 10))):
            if np.array_equal(pose[own], gesture.poses_rad[0, own]):  # an arm at rest is where NAO's rests
                assert positions[own] == pytest.approx([NAO[n].rest_rad for n in made.trajectory.joint_names[own]])
                continue
            hand = (hoap2[f"{side}arm_link_5"] @ [HAND_M, 0, 0, 1])[:3] - hoap2[f"{side}arm_link_1"][:3, 3]
            theirs.append(hand * NAO_REACH_M / arm_of("left").reach_m)
            ours.append((nao[f"{side}_wrist"] @ [0.05775, 0, 0, 1])[:3] - nao[f"{side.upper()}Shoulder"][:3, 3])
    return np.array(theirs), np.array(ours)


def test_a_gesture_that_departs_too_far_is_refused_with_the_reason(monkeypatch):
    nao_gesture.cache_clear()
    monkeypatch.setattr(nao_gestures, "HAND_TOLERANCE_M", 0.01)
    monkeypatch.setattr(nao_gestures, "HEAD_TOLERANCE_DEG", 5.0)
    why_not = nao_gesture("sad").why_not
    assert "the left hand stays 1.8 cm from its place" in why_not and "the head stays 11 deg" in why_not
    with pytest.raises(InvalidArgument, match="NAO cannot make 'sad': the left hand stays"):
        nao_gesture_trajectory("sad")
    assert nao_gesture("house").why_not == ""
    with pytest.raises(InvalidArgument, match="did you mean"):
        nao_gesture("hause")
    nao_gesture.cache_clear()


def test_nao_makes_every_gesture():
    made = [nao_gesture(name) for name in load_gestures()]
    assert [(one.name, one.why_not) for one in made if one.why_not] == []
    hands_cm = 100.0 * np.array([one.hand_m for one in made])
    # As docs/nao.md says.
    assert [(hands_cm <= most).sum() for most in (0.5, 1.0, 2.0, 3.0)] == [35, 42, 58, 91]
    most = [max(getattr(one, name) for one in made) for name in ("forearm_deg", "palm_deg", "head_deg")]
    assert np.ceil(most).tolist() == [14.0, 27.0, 11.0]


def test_angles_taken_over_directly_stay_as_they_are():
    beyond = errors(with_nao_arms(gesture_trajectory("namaste")))
    assert beyond and all("outside" in finding.message or "touch" in finding.message for finding in beyond)
    with pytest.raises(InvalidArgument, match="lleg_joint_1"):
        with_nao_arms(Trajectory(["lleg_joint_1"], 0.1, [[0.0], [0.0]]))


def test_a_still_is_taken(tmp_path):
    import cv2

    motion = with_nao_arms(gesture_trajectory("house"))
    for at_s in (0.0, 1.0):
        render_still(motion, tmp_path / f"{at_s}.png", at_s, "kinematic", (160, 120), NAO)
    first, second = (cv2.imread(str(tmp_path / f"{at_s}.png")) for at_s in (0.0, 1.0))
    assert first.shape == (120, 160, 3) and (first != second).any()
    with pytest.raises(InvalidArgument, match="at_s"):
        render_still(motion, tmp_path / "late.png", 1e3, "kinematic", table=NAO)
    odd = Trajectory(motion.joint_names, 0.0137, motion.positions_rad)  # ends between two steps
    render_still(odd, tmp_path / "end.png", odd.duration_s, "kinematic", (160, 120), NAO)
    render_still(odd, tmp_path / "middle.png", odd.duration_s / 2.0, "kinematic", (160, 120), NAO)
    end, middle = (cv2.imread(str(tmp_path / f"{name}.png")) for name in ("end", "middle"))
    assert np.abs(end.astype(int) - first).max() < 8 < np.abs(middle.astype(int) - first).max()


@needs_pybullet
def test_it_stands_and_moves_its_arms():
    with open_robot("pybullet", fixed_base=False, table=NAO) as robot:
        assert {(c.link, c.other) for c in robot.state().contacts} == {(foot, "floor") for foot in NAO.feet}
        assert robot.perform(with_nao_arms(gesture_trajectory("house"))) and robot.events == []
        state = robot.state()
        assert state.base_position_m[2] == pytest.approx(NAO.standing_height_m, abs=0.02)
        assert np.degrees(np.abs(state.base_rpy_rad[:2])).max() < 5.0


@needs_pybullet
def test_lying_is_no_fall():
    with open_robot("pybullet", fixed_base=False, locked=["head_joint_1", "head_joint_2"]) as robot:
        robot.reset(HOAP2.rest_rad, "back")
        assert robot.hold(1.0) and robot.events == []


def test_without_qi_the_extra_is_named(monkeypatch):
    monkeypatch.setitem(sys.modules, "qi", None)
    with pytest.raises(ImportError, match=r"pip install libhri\[nao\]"):
        NaoqiRobot("tcp://127.0.0.1:1")


def test_commands_know_nao(tmp_path):
    testing = pytest.importorskip("click.testing")
    from hri.cli.robot import robot

    def run(*arguments):
        return testing.CliRunner().invoke(robot, [str(argument) for argument in arguments])

    assert "LElbowRoll" in run("joints", "--robot", "nao").output
    played = run("play", "house", "--robot", "nao", "--backend", "kinematic")
    assert played.exit_code == 0 and "LShoulderPitch\t" in played.output
    listed = [line.split("\t") for line in run("gestures", "--robot", "nao").output.splitlines()]
    assert len(listed) == 91 and all(len(fields) == 5 and float(fields[3]) < 3.0 for fields in listed)
    for wrong in (
        ("--url", "tcp://x"),
        ("--robot", "nao", "--wake-up"),
        ("--robot", "nao", "--url", "tcp://x", "--gui"),
    ):
        assert run("play", "house", *wrong).exit_code == 2
    taken = run("render", "house", tmp_path / "h.png", "--still", "1", "--robot", "nao", "--backend", "kinematic")
    assert taken.exit_code == 0 and (tmp_path / "h.png").stat().st_size > 1000
    short = tmp_path / "short.csv"
    short.write_text("time_s,LElbowRoll\n0,-20\n0.1,-20\n0.2,10\n")
    checked = run("check", short, "--robot", "nao")
    assert checked.exit_code == 3 and "LElbowRoll" in checked.output
    pulses = tmp_path / "pulses.csv"
    pulses.write_text("1,2" + ",R" * 25 + "\n")
    assert isinstance(run("check", pulses, "--robot", "nao").exception, InvalidArgument)
