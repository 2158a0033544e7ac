# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What a simulated robot sees: where its camera is, and a screen in front of it that shows pictures."""

from __future__ import annotations

import math
from collections.abc import Callable, Hashable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import InvalidArgument
from hri.core.optional import import_opencv
from hri.robot.control.filming import Image
from hri.robot.model.joints import Camera, JointTable
from hri.robot.model.kinematics import Pose
from hri.robot.simulation.scene import MAX_SIDE_PX, SCREEN_COLOUR

Shot = tuple[Image, NDArray[np.int32]]
"""A picture, and the number of the body that each pixel shows, below 0 for none."""
Matrix = list[float]

_NEAR_M, _FAR_M = 0.08, 8.0
_DEPTH_M = 0.02
_BLACK = np.zeros((2, 2, 3), dtype=np.uint8)
_SMALLER = 0.75  # of its width a picture on the screen has to be seen at, before it is made smaller first
_MOST_M = 10.0


class Screen:
    """A screen that stands upright before a simulated robot, facing it, and shines by itself.

    Parameters
    ----------
    centre_m : three floats
        Of its front, in the world; x points from the robot to it.
    size_m : two floats
        Width and height.

    Raises
    ------
    InvalidArgument
        For a place or size that is not finite, behind the robot, or above 10 m.
    """

    def __init__(
        self, centre_m: tuple[float, float, float] = (0.9, 0.0, 0.52), size_m: tuple[float, float] = (0.8, 0.6)
    ) -> None:
        if len(centre_m) != 3 or not all(abs(value) <= _MOST_M for value in centre_m) or not centre_m[0] > 0.0:
            raise InvalidArgument(f"centre_m is {centre_m}, must be three numbers up to {_MOST_M:g}, x above 0")
        if len(size_m) != 2 or not all(0.0 < value <= _MOST_M for value in size_m):
            raise InvalidArgument(f"size_m is {size_m}, must be two numbers above 0, up to {_MOST_M:g}")
        self.centre_m = tuple(map(float, centre_m))
        self.size_m = tuple(map(float, size_m))
        self._picture: Image = _BLACK

    @property
    def picture(self) -> Image:
        """What it shows, stretched to its size; black at first."""
        return self._picture

    def show(self, picture: Image) -> None:
        """Show a picture from now on.

        Parameters
        ----------
        picture : ndarray of uint8, shape (height, width, 3)
            RGB, as the robot's pictures are. It is not copied.

        Raises
        ------
        InvalidArgument
            For anything else.
        """
        sides: tuple[int, ...] = getattr(picture, "shape", ())
        if len(sides) != 3 or sides[2] != 3 or picture.dtype != np.uint8 or min(sides[:2]) < 2:
            raise InvalidArgument("a picture is uint8 of the shape (height, width, 3), 2 x 2 pixels at least")
        if max(sides) > MAX_SIDE_PX:
            raise InvalidArgument(f"a picture has {MAX_SIDE_PX} pixels a side at most, got {sides[1]} x {sides[0]}")
        self._picture = picture


class Sight:
    """The eyes of a robot in PyBullet, and the screen before them.

    Parameters
    ----------
    bullet : module
        PyBullet.
    client : int
        Which of its simulations.
    """

    def __init__(self, bullet: Any, client: int) -> None:
        self._bullet = bullet
        self._client = client
        self._screen: Screen | None = None
        self._body = -1
        self._seen: tuple[Hashable, Image, NDArray[np.bool_]] | None = None

    def put(self, screen: Screen) -> None:
        """Put a screen into the scene, in place of another one."""
        bullet, client = self._bullet, self._client
        if self._screen is not None:
            bullet.removeBody(self._body, physicsClientId=client)
        half = (0.5 * _DEPTH_M, 0.5 * screen.size_m[0], 0.5 * screen.size_m[1])
        case = bullet.createVisualShape(
            bullet.GEOM_BOX, halfExtents=half, rgbaColor=(*SCREEN_COLOUR, 1.0), physicsClientId=client
        )
        x, y, z = screen.centre_m
        self._body = bullet.createMultiBody(0, -1, case, (x + half[0], y, z), physicsClientId=client)
        self._screen, self._seen = screen, None

    def look(
        self, camera: Camera, link: Pose, still: Hashable | None, shoot: Callable[[int, int, Matrix, Matrix], Shot]
    ) -> Image:
        """What the camera sees.

        Parameters
        ----------
        camera : Camera
        link : ndarray, shape (4, 4)
            Pose of the link that carries it.
        still : hashable, optional
            While it is the same, only what the screen shows changes; without it, anything may.
        shoot : callable of (width, height, view matrix, projection matrix)
        """
        eye, axes = camera_view(camera, link)
        key = None if still is None else (camera.name, still)
        if self._seen is None or key is None or self._seen[0] != key:
            image, bodies = shoot(*camera.size_px, view_matrix(eye, axes), projection_matrix(camera))
            self._seen = key, image, (bodies == self._body) & (self._screen is not None)
        _, image, shows = self._seen
        return image.copy() if self._screen is None else with_screen(image, shows, self._screen, camera, eye, axes)


def camera_of(table: JointTable, name: str) -> Camera:
    """The robot's camera of this name. Raises InvalidArgument where it has none."""
    for camera in table.cameras:
        if camera.name == name:
            return camera
    known = ", ".join(camera.name for camera in table.cameras) or "none"
    raise InvalidArgument(f"{table.name} has no camera {name!r}; it has: {known}")


def camera_view(camera: Camera, link: Pose) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Where the camera is, and its right, up and forward axes as rows, shape (3, 3).

    Parameters
    ----------
    camera : Camera
    link : ndarray, shape (4, 4)
        Pose of the link that carries it.
    """
    down = camera.down_rad
    forward = np.array((math.cos(down), 0.0, -math.sin(down)))
    up = np.array((math.sin(down), 0.0, math.cos(down)))
    axes = np.stack((np.cross(forward, up), up, forward)) @ link[:3, :3].T
    return link[:3, 3] + link[:3, :3] @ np.array(camera.origin_m), axes


def view_matrix(eye: NDArray[np.float64], axes: NDArray[np.float64]) -> Matrix:
    """For OpenGL: the camera looks along -z; by columns."""
    matrix = np.eye(4)
    matrix[:3, :3] = axes * np.array((1.0, 1.0, -1.0))[:, np.newaxis]
    matrix[:3, 3] = -matrix[:3, :3] @ eye
    return [float(value) for value in matrix.T.ravel()]


def projection_matrix(camera: Camera) -> Matrix:
    """For OpenGL, of the camera's own angles; by columns."""
    across, upright = (1.0 / math.tan(0.5 * angle) for angle in camera.field_of_view_rad)
    depth = _NEAR_M - _FAR_M
    matrix = np.diag((across, upright, (_NEAR_M + _FAR_M) / depth, 0.0))
    matrix[2, 3], matrix[3, 2] = 2.0 * _NEAR_M * _FAR_M / depth, -1.0
    return [float(value) for value in matrix.T.ravel()]


def with_screen(
    image: Image,
    shows: NDArray[np.bool_],
    screen: Screen,
    camera: Camera,
    eye: NDArray[np.float64],
    axes: NDArray[np.float64],
) -> Image:
    """The image with the screen's picture where the screen is seen.

    Parameters
    ----------
    image : ndarray of uint8, shape (height, width, 3)
    shows : ndarray of bool, shape (height, width)
        Pixels that show the screen and nothing before it.
    screen : Screen
    camera : Camera
    eye, axes : ndarray
        Of `camera_view`.
    """
    if not shows.any():
        return image.copy()
    cv2 = import_opencv("to see a screen")
    height, width = shows.shape
    picture = screen.picture
    seen_px = np.ptp(np.flatnonzero(shows.any(axis=0))) + 1
    if seen_px < _SMALLER * picture.shape[1]:
        share = float(seen_px) / picture.shape[1]
        size = max(2, round(share * picture.shape[1])), max(2, round(share * picture.shape[0]))
        picture = cv2.resize(picture, size, interpolation=cv2.INTER_AREA)
    # From pixels of the picture to points of the screen, to directions from the eye, to pixels of the image.
    across, upright = np.array((0.0, -1.0, 0.0)), np.array((0.0, 0.0, -1.0))
    rows, columns = picture.shape[:2]
    step_across = across * screen.size_m[0] / columns
    step_down = upright * screen.size_m[1] / rows
    corner = np.array(screen.centre_m) - 0.5 * (across * screen.size_m[0] + upright * screen.size_m[1])
    first = corner + 0.5 * (step_across + step_down) - eye  # the middle of the picture's first pixel
    directions = axes @ np.stack((step_across, step_down, first), axis=1)
    focal = 0.5 * np.array((width, height)) / np.tan(0.5 * np.array(camera.field_of_view_rad))
    lens = np.array(
        ((focal[0], 0.0, 0.5 * (width - 1)), (0.0, -focal[1], 0.5 * (height - 1)), (0.0, 0.0, 1.0)),
    )
    warped = cv2.warpPerspective(
        picture, lens @ directions, (width, height), flags=cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE
    )
    return np.where(shows[..., np.newaxis], warped, image)
