# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What NAO's camera sees in the simulation: angles of view, a screen, its own arm before it."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

pytest.importorskip("pybullet")
pytest.importorskip("cv2")

import cv2

from hri.core.errors import InvalidArgument
from hri.robot import NAO, Screen
from hri.robot.simulation.pybullet_backend import PyBulletRobot

TOP = NAO.cameras[0]
LEVEL = {"HeadPitch": -TOP.down_rad}  # the camera looks straight forward
GREEN = np.array((0, 255, 0), dtype=np.uint8)


@pytest.fixture(scope="module")
def simulated() -> Iterator[PyBulletRobot]:
    with PyBulletRobot(table=NAO) as robot:
        yield robot


@pytest.fixture
def robot(simulated: PyBulletRobot) -> PyBulletRobot:
    simulated.reset(NAO.rest_rad | LEVEL)
    return simulated


def eye_m(robot: PyBulletRobot) -> np.ndarray:
    """By hand: the head's joint, and the camera in its frame, turned by its pitch."""
    head = np.array(robot.link_positions_m()["HeadPitch"])
    x, _, z = TOP.origin_m
    pitch = LEVEL["HeadPitch"]
    there = (x * math.cos(pitch) + z * math.sin(pitch), 0.0, z * math.cos(pitch) - x * math.sin(pitch))
    return np.add(head, there)


def marked(at: tuple[float, float]) -> np.ndarray:
    """A dark picture with a green spot at these shares of its width and height."""
    picture = np.full((300, 400, 3), 40, dtype=np.uint8)
    cv2.circle(picture, (round(400 * at[0]), round(300 * at[1])), 8, GREEN.tolist(), -1)
    return picture


def spot(image: np.ndarray) -> np.ndarray:
    """Middle of what is green, x and y in pixels."""
    rows, columns = np.nonzero((image[..., 1] > 180) & (image[..., 0] < 90) & (image[..., 2] < 90))
    assert len(rows) > 20
    return np.array((columns.mean(), rows.mean()))


def test_a_screen_that_fills_the_angles_of_view_fills_the_picture(robot: PyBulletRobot) -> None:
    eye = eye_m(robot)
    assert np.degrees(TOP.field_of_view_rad) == pytest.approx((60.97, 47.64))
    width, height = (2 * 0.7 * math.tan(angle / 2) for angle in TOP.field_of_view_rad)
    for share, fills in ((1.01, True), (0.97, False)):
        screen = Screen((eye[0] + 0.7, 0.0, eye[2]), (share * width, share * height))
        screen.show(np.full((8, 8, 3), GREEN))
        robot.put_screen(screen)
        seen = (robot.see("CameraTop") == GREEN).all(axis=2)
        assert seen.shape == (480, 640) and seen.mean() == pytest.approx(min(1.0, share**2), abs=0.01)
        assert seen.all() == fills


@pytest.mark.parametrize("at", [(0.5, 0.5), (0.1, 0.2), (0.9, 0.15), (0.3, 0.9)])
def test_points_are_seen_where_they_are(robot: PyBulletRobot, at: tuple[float, float]) -> None:
    eye = eye_m(robot)
    screen = Screen((eye[0] + 0.9, 0.05, eye[2] - 0.02), (0.8, 0.6))
    screen.show(marked(at))
    robot.put_screen(screen)
    left_m, up_m = 0.05 - 0.8 * (at[0] - 0.5), -0.02 - 0.6 * (at[1] - 0.5)
    across, upright = (math.tan(angle / 2) for angle in TOP.field_of_view_rad)
    expected = (320 * (1 - left_m / 0.9 / across), 240 * (1 - up_m / 0.9 / upright))
    assert spot(robot.see("CameraTop")) == pytest.approx(expected, abs=1.5)


def test_a_head_that_turns_sees_something_else(robot: PyBulletRobot) -> None:
    screen = Screen((0.9, 0.0, eye_m(robot)[2]))
    screen.show(marked((0.5, 0.5)))
    robot.put_screen(screen)
    ahead = spot(robot.see("CameraTop"))
    robot.reset({"HeadYaw": 0.2})
    assert spot(robot.see("CameraTop"))[0] > ahead[0] + 80, "what is in front moves to the right of who turns left"
    robot.reset({"HeadYaw": 0.0, "HeadPitch": LEVEL["HeadPitch"] + 0.15})
    assert spot(robot.see("CameraTop"))[1] < ahead[1] - 60
    robot.reset({"HeadYaw": 2.0, "HeadPitch": 0.0})
    assert not (robot.see("CameraTop") == GREEN).all(axis=2).any()


def test_an_arm_is_seen_before_the_screen_and_the_screen_goes_on(robot: PyBulletRobot) -> None:
    screen = Screen((0.9, 0.0, eye_m(robot)[2]))
    screen.show(np.full((8, 8, 3), GREEN))
    robot.put_screen(screen)
    before = (robot.see("CameraTop") == GREEN).all(axis=2)
    robot.reset({"RShoulderPitch": -0.3, "RShoulderRoll": 0.1, "RElbowRoll": 0.1})
    hidden = before & ~(robot.see("CameraTop") == GREEN).all(axis=2)
    assert 0.01 < hidden.mean() < 0.3
    assert np.nonzero(hidden)[1].mean() > 320, "the right arm is on the right"
    screen.show(np.full((8, 8, 3), (0, 0, 255), dtype=np.uint8))
    image = robot.see("CameraTop")
    assert (image[before & ~hidden] == (0, 0, 255)).all() and not (image[hidden] == (0, 0, 255)).all(axis=1).any()


def test_what_is_no_camera_screen_or_picture_is_refused(robot: PyBulletRobot) -> None:
    with pytest.raises(InvalidArgument, match="no camera 'CameraFront'; it has: CameraTop, CameraBottom"):
        robot.see("CameraFront")
    for values in (
        {"centre_m": (0.0, 0.0, 0.5)}, {"centre_m": (math.nan, 0.0, 0.5)}, {"centre_m": (1.0, 0.0)},
        {"size_m": (0.0, 0.6)}, {"size_m": (0.8, math.inf)}, {"size_m": (11.0, 0.6)},
    ):  # fmt: skip
        with pytest.raises(InvalidArgument, match=next(iter(values))):
            Screen(**values)  # type: ignore[arg-type]
    wrong: list[Any] = [None, np.zeros((4, 4), "u1"), np.zeros((4, 4, 3)), np.zeros((1, 4, 3), "u1")]
    for picture in (*wrong, np.zeros((2, 4097, 3), "u1")):
        with pytest.raises(InvalidArgument, match="a picture"):
            Screen().show(picture)
