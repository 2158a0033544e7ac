# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""A robot on its feet learns what its legs are off by, and tilts no sole that stands on its edge any further."""

import numpy as np
import pytest

from hri.robot import HOAP2, NAO
from hri.robot.control.balance import Balance
from hri.robot.control.soles import Soles

STEP_S = 0.005
FOLLOW_PER_S = 10.0
WEIGHT_N = 9.81 * 7.16
LEFT, RIGHT = "lleg_joint_5", "rleg_joint_5"  # ankles, + is toes down
MIDDLE, HEEL = (0.0112, 0.0), (-0.0358, 0.0)


def pitched(rad: float) -> np.ndarray:
    """From the base's frame to the world: leaning forward by so much."""
    c, s = np.cos(rad), np.sin(rad)
    return np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])


def on(left: float, right: float, where=MIDDLE) -> np.ndarray:
    """Both soles' share of the weight, and its centre."""
    return np.array([(left * WEIGHT_N, *where), (right * WEIGHT_N, *where)])


def stand(balance: Balance, seconds: float, pressures: np.ndarray, off_rad: float = 0.0) -> float:
    """By how much the left ankle is turned while the robot stands on its left sole, flat, that ankle off by so much."""
    turned = 0.0
    for _ in range(round(seconds / STEP_S)):
        found = balance.corrections({}, pitched(-off_rad - turned), np.zeros(3), pressures, STEP_S)
        turned += (1.0 - (1.0 - FOLLOW_PER_S * 0.001) ** (1000.0 * STEP_S)) * (found[LEFT] - turned)
    return turned


@pytest.fixture
def balance() -> Balance:
    return Balance(HOAP2, FOLLOW_PER_S)


def test_an_ankle_learns_what_its_leg_is_off_by_and_keeps_it_in_the_air(balance):
    assert stand(balance, 0.3, on(1.0, 0.0), 0.04) == pytest.approx(-0.04 / 3, rel=0.5), "at first a part of it"
    assert stand(balance, 10.0, on(1.0, 0.0), 0.04) == pytest.approx(-0.04, rel=0.05), "then the base is upright"
    for _ in range(200):
        found = balance.corrections({}, np.eye(3), np.zeros(3), on(0.0, 1.0), STEP_S)
    assert found[LEFT] == pytest.approx(-0.04, rel=0.05) and abs(found[RIGHT]) < 0.002
    balance.start({})
    assert abs(stand(balance, 0.1, on(1.0, 0.0))) < 1e-9, "a start forgets it"


def test_nothing_is_learned_of_both_feet_or_from_a_sole_on_its_edge(balance):
    for pressures in (on(0.5, 0.5), on(1.0, 0.0, HEEL)):
        balance.start({})
        for _ in range(2000):
            balance.corrections({}, pitched(-0.04), np.zeros(3), pressures, STEP_S)
        for _ in range(200):
            found = balance.corrections({}, np.eye(3), np.zeros(3), on(0.5, 0.5), STEP_S)
        assert abs(found[LEFT]) < 0.002


def test_an_ankle_does_not_tilt_a_sole_on_its_edge_further(balance):
    def ankle(pitch, where):
        balance.start({})
        for _ in range(40):
            found = balance.corrections({}, pitched(pitch), np.zeros(3), on(1.0, 0.0, where), STEP_S)
        return found[LEFT]

    back, forward = ankle(-0.1, MIDDLE), ankle(0.1, MIDDLE)
    assert back < -0.03 and forward > 0.03
    assert abs(ankle(-0.1, HEEL)) < 0.1 * abs(back), "toes up would tilt it further over its heel"
    assert ankle(0.1, HEEL) == pytest.approx(forward, abs=0.02), "toes down lays it flat"


def test_soles_tell_where_between_their_edges_they_are_loaded():
    soles = Soles(HOAP2)
    for _ in range(100):
        soles.feel(np.array([(30.0, 0.0582, -0.031), (1.0, -0.0358, 0.0)]), STEP_S)
    np.testing.assert_allclose(soles.loads_n, (30.0, 1.0), rtol=1e-6)
    np.testing.assert_allclose(soles.off_middle, ((1.0, -1.0), (0.0, 0.0)), atol=1e-6)  # 1 N is below the noise
    soles.start()
    assert not soles.loads_n.any() and not np.any(soles.off_middle)
    assert np.shape(Soles(NAO).off_middle) == (2, 2)
