# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""A robot that gets up leans forward by how far its capture point is behind its feet, and at no other time."""

from importlib.util import find_spec

import numpy as np
import pytest

from conftest import robot_data
from hri.robot import HOAP2, NAO, JointTable, Physics, link_poses
from hri.robot.control.getting_up import GettingUp
from hri.robot.model.kinematics import rotation_about
from hri.robot.model.mass_centre import MassCentre

STEP_S = 0.01


def pitched(rad: float) -> np.ndarray:
    """From the base's frame to the world: leaning forward by so much."""
    c, s = np.cos(rad), np.sin(rad)
    return np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])


def legs(table: JointTable):
    carriers = {joint.child: joint for joint in table.joints}
    for link in table.feet:
        chain = []
        while link in carriers:
            chain.insert(0, carriers[link])
            link = carriers[link].parent
        yield chain


# As the factory's motion is when its hands leave the floor.
LEGS_RAD = {"leg_joint_3": -1.41, "leg_joint_4": 2.18, "leg_joint_5": -0.2}
CROUCH_RAD = dict.fromkeys(HOAP2.names, 0.0) | {"body_joint_1": 1.2, "larm_joint_1": 0.8, "rarm_joint_1": 0.8}
CROUCH_RAD |= {side + name: value for side in "lr" for name, value in LEGS_RAD.items()}
STRAIGHT_RAD = dict.fromkeys(HOAP2.names, 0.0)
FALLING_BACK, OVER_ITS_FEET = 0.75, 1.3  # pitch of the base in this crouch


@pytest.fixture
def getting_up() -> GettingUp:
    return GettingUp(list(legs(HOAP2)), HOAP2)


def lean(getting_up: GettingUp, pitch: float, carried: float, steps: int = 100, **more) -> float:
    joints = more.get("joints", CROUCH_RAD)
    for _ in range(steps):
        sent = {"body_joint_1": more.get("sent", 0.5)}
        found = getting_up.corrections(sent, pitched(pitch), carried, STEP_S, joints)
    assert set(found) == {"body_joint_1"}
    return found["body_joint_1"]


def behind(pitch: float, joints=CROUCH_RAD, table: JointTable = HOAP2) -> float:
    """How far the centre of mass is behind the middle of the soles, from the poses of all links."""
    base = np.eye(4)
    base[:3, :3] = pitched(pitch)
    poses = link_poses(joints, base, table)
    masses = {name: link.mass_kg for name, link in table.links.items()}
    centre = sum(masses[name] * (poses[name] @ (*link.com_m, 1.0))[0] for name, link in table.links.items())
    soles = [(poses[foot] @ (0.0112, 0.0, -0.0405, 1.0))[0] for foot in table.feet]
    return float(np.mean(soles) - centre / sum(masses.values()))


def pitch_where_it_is_behind_by(metres: float) -> float:
    between = np.linspace(FALLING_BACK, OVER_ITS_FEET, 200)
    return float(between[np.argmin(np.abs([behind(pitch) - metres for pitch in between]))])


@pytest.mark.parametrize("table", [HOAP2, NAO])
def test_soles_are_where_the_poses_of_all_links_say(table: JointTable):
    rng = np.random.default_rng(3)
    centre = MassCentre(table)
    for _ in range(5):
        angles = rng.uniform(-1.5, 1.5, len(table))
        turn = rotation_about(np.array([0.6, 0.0, 0.8]), rng.uniform(-3.0, 3.0))
        base = np.eye(4)
        base[:3, :3] = turn
        poses = link_poses(dict(zip(table.names, angles, strict=True)), base, table)
        links = table.links.items()
        middle = sum(link.mass_kg * (poses[name] @ (*link.com_m, 1.0))[:3] for name, link in links)
        middle /= sum(link.mass_kg for _, link in links)
        for foot, corners in zip(table.feet, centre.soles_from_it(angles, turn), strict=True):
            sole = min(table.links[foot].solid, key=lambda shape: shape.start[2] - shape.size[2] / 2.0)
            under = (poses[foot] @ (*sole.start[:2], sole.start[2] - sole.size[2] / 2.0, 1.0))[:3]
            np.testing.assert_allclose(corners.mean(axis=0), under - middle, atol=1e-12)
            sides = np.linalg.norm(corners[[1, 2]] - corners[0], axis=1)
            np.testing.assert_allclose(sides, (sole.size[1], sole.size[0]), atol=1e-12)


def test_it_leans_until_its_capture_point_is_over_its_feet(getting_up: GettingUp):
    assert behind(FALLING_BACK) > 0.03 > 0.0 > behind(OVER_ITS_FEET)
    assert lean(getting_up, -1.5, 0.0) == 0.0  # on its back
    full = lean(getting_up, FALLING_BACK, 0.3)
    assert full == pytest.approx(0.3)
    assert lean(getting_up, FALLING_BACK, 1.0) == pytest.approx(full), "feet carry all of it as it falls back"
    pitch = pitch_where_it_is_behind_by(0.01)
    assert lean(getting_up, pitch, 0.5) == pytest.approx(10.0 * behind(pitch), abs=1e-3)
    assert lean(getting_up, OVER_ITS_FEET, 0.5) == 0.0


def test_it_leans_the_more_the_faster_it_falls_back(getting_up: GettingUp):
    def at_the_end(pitches):
        getting_up.start()
        lean(getting_up, -1.5, 0.0)
        return [lean(getting_up, pitch, 0.5, steps=1) for pitch in pitches][-1]

    end = pitch_where_it_is_behind_by(0.01)
    assert 0.05 < at_the_end(np.full(60, end)) < at_the_end(np.linspace(end + 0.1, end, 60)) <= 0.3


def test_who_gets_up_from_the_belly_is_not_made_to_lean(getting_up: GettingUp):
    """The feet are behind then: leaning forward would turn it over its head."""
    assert behind(1.3, STRAIGHT_RAD) < -0.2
    lean(getting_up, 1.5, 0.0, joints=STRAIGHT_RAD)
    assert lean(getting_up, 1.3, 0.3, joints=STRAIGHT_RAD) == 0.0


def test_it_leans_slowly(getting_up: GettingUp):
    lean(getting_up, -1.5, 0.0)
    leans = [lean(getting_up, FALLING_BACK, 0.2, steps=1) for _ in range(80)]
    assert np.diff([0.0, *leans]).max() == pytest.approx(0.8 * STEP_S) and leans[-1] == pytest.approx(0.3)


def test_who_never_lay_is_left_alone_and_so_is_who_stands_again(getting_up: GettingUp):
    assert lean(getting_up, FALLING_BACK, 0.3) == 0.0 and not getting_up.rising
    lean(getting_up, -1.5, 0.0)
    assert getting_up.rising
    lean(getting_up, 0.0, 1.0)
    assert lean(getting_up, FALLING_BACK, 0.3) == 0.0 and not getting_up.rising
    lean(getting_up, -1.5, 0.0)
    getting_up.start()
    assert lean(getting_up, FALLING_BACK, 0.3) == 0.0


def test_who_stands_leaning_as_it_was_made_to_stands(getting_up: GettingUp):
    lean(getting_up, -1.5, 0.0)
    assert lean(getting_up, FALLING_BACK, 0.5) == pytest.approx(0.3)
    assert lean(getting_up, 0.5, 1.0, steps=1) < 0.3 and not getting_up.rising
    assert lean(getting_up, 0.2, 1.0) == 0.0


def test_it_needs_to_know_where_its_joints_are(getting_up: GettingUp):
    lean(getting_up, -1.5, 0.0)
    assert lean(getting_up, FALLING_BACK, 0.3, joints=None) == 0.0


def test_the_waist_keeps_its_limits(getting_up: GettingUp):
    lean(getting_up, -1.5, 0.0)
    upper = HOAP2["body_joint_1"].upper_rad
    assert lean(getting_up, FALLING_BACK, 0.3, sent=upper - 0.05) == pytest.approx(0.05)


def test_a_robot_without_a_waist_gets_no_help():
    getting_up = GettingUp(list(legs(NAO)), NAO)
    getting_up.corrections({}, pitched(-1.5), 0.0, STEP_S)
    assert getting_up.corrections({}, pitched(0.8), 0.3, STEP_S, dict.fromkeys(NAO.names, 0.0)) == {}
    assert not getting_up.rising


@pytest.mark.slow
@pytest.mark.skipif(find_spec("pybullet") is None, reason="no pybullet")
@pytest.mark.parametrize(
    ("friction", "mass_scale", "seed"),
    [(1.1, 1.0, 605), (1.1, 1.1, 602), (1.2, 1.1, 602), (0.9, 1.1, 605), (0.9, 1.1, 607), (0.8, 1.1, 605)],
)
def test_it_gets_up_from_its_back(friction: float, mass_scale: float, seed: int):
    """Soles that do not slip brake the way forward, a heavy robot's hands leave the floor early; joints are off."""
    from hri.studies.robot_motions import offsets, play

    path = robot_data("stand_up_back.csv")
    assert play(path, "back", Physics(friction, mass_scale, offsets(seed))).success("stand_up_back.csv")
