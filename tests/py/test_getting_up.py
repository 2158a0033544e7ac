# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""A robot that gets up leans over its feet until they carry it, and at no other time."""

from importlib.util import find_spec

import numpy as np
import pytest

from conftest import robot_data
from hri.robot import HOAP2, NAO, JointTable, Physics
from hri.robot.control.getting_up import GettingUp

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


@pytest.fixture
def getting_up() -> GettingUp:
    return GettingUp(list(legs(HOAP2)))


def lean(getting_up: GettingUp, pitch: float, carried: float, steps: int = 100, sent: float = 0.5) -> float:
    for _ in range(steps):
        found = getting_up.corrections({"body_joint_1": sent}, pitched(pitch), carried, STEP_S)
    assert set(found) == {"body_joint_1"}
    return found["body_joint_1"]


def test_it_leans_while_hands_carry_and_no_longer(getting_up: GettingUp):
    assert lean(getting_up, -1.5, 0.0) == 0.0  # on its back
    full = lean(getting_up, 0.8, 0.3)
    assert full == pytest.approx(0.3)
    assert 0.0 < lean(getting_up, 0.8, 0.7) < full
    assert lean(getting_up, 0.8, 0.85) == 0.0


def test_it_leans_slowly(getting_up: GettingUp):
    lean(getting_up, -1.5, 0.0)
    leans = [lean(getting_up, 0.8, 0.2, steps=1) for _ in range(80)]
    assert np.diff([0.0, *leans]).max() == pytest.approx(0.8 * STEP_S) and leans[-1] == pytest.approx(0.3)


def test_who_never_lay_is_left_alone_and_so_is_who_stands_again(getting_up: GettingUp):
    assert lean(getting_up, 0.8, 0.3) == 0.0
    lean(getting_up, -1.5, 0.0)
    lean(getting_up, 0.0, 1.0)
    assert lean(getting_up, 0.8, 0.3) == 0.0
    lean(getting_up, -1.5, 0.0)
    getting_up.start()
    assert lean(getting_up, 0.8, 0.3) == 0.0


def test_the_waist_keeps_its_limits(getting_up: GettingUp):
    lean(getting_up, -1.5, 0.0)
    upper = HOAP2["body_joint_1"].upper_rad
    assert lean(getting_up, 0.8, 0.3, sent=upper - 0.05) == pytest.approx(0.05)


def test_a_robot_without_a_waist_gets_no_help():
    getting_up = GettingUp(list(legs(NAO)))
    getting_up.corrections({}, pitched(-1.5), 0.0, STEP_S)
    assert getting_up.corrections({}, pitched(0.8), 0.3, STEP_S) == {}


@pytest.mark.slow
@pytest.mark.skipif(find_spec("pybullet") is None, reason="no pybullet")
@pytest.mark.parametrize(("friction", "mass_scale", "seed"), [(1.1, 1.0, 605), (1.1, 1.1, 602), (1.2, 1.1, 602)])
def test_it_gets_up_from_its_back_on_a_rough_floor(friction: float, mass_scale: float, seed: int):
    """Soles that do not slip brake the way forward; joints are off by up to a degree."""
    from hri.studies.robot_motions import offsets, play

    path = robot_data("stand_up_back.csv")
    assert play(path, "back", Physics(friction, mass_scale, offsets(seed))).success("stand_up_back.csv")
