# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Camera, light and colours of the pictures, the same for every backend."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import InvalidArgument

EYE_M = (1.18, 0.20, 0.50)
TARGET_M = (0.0, 0.0, 0.325)
UP = (0.0, 0.0, 1.0)
FIELD_OF_VIEW_DEG = 34.0  # vertical
TO_LIGHT = (0.62, 0.42, 0.95)
FLOOR_COLOUR = (0.80, 0.85, 0.90)
FLOOR_HALF_M = 0.36
SCREEN_COLOUR = (0.10, 0.10, 0.12)
WALK_HALF_M = 3.0  # of the floor of a robot that walks; the camera goes with it
SKY_TOP = (0.86, 0.91, 0.96)
SKY_BOTTOM = (0.97, 0.98, 0.99)
MAX_SIDE_PX = 4096


def check_size(width: int, height: int) -> None:
    """Raise InvalidArgument unless both sides are 16 to 4096 pixels."""
    for name, value in (("width", width), ("height", height)):
        if not 16 <= value <= MAX_SIDE_PX:
            raise InvalidArgument(f"{name} is {value}, must be 16 to {MAX_SIDE_PX} pixels")


def backdrop(width: int, height: int) -> NDArray[np.uint8]:
    """Fill a picture from light blue above to near white below; shape (height, width, 3)."""
    part = np.linspace(0.0, 1.0, height)[:, np.newaxis, np.newaxis]
    column = (1.0 - part) * np.array(SKY_TOP) + part * np.array(SKY_BOTTOM)
    return np.rint(255.0 * np.broadcast_to(column, (height, width, 3))).astype(np.uint8)


def camera(base_m: tuple[float, float, float] | None = None) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Positions of the camera and of what it looks at; it goes along with a base that moves over the floor."""
    along = np.array((base_m[0], base_m[1], 0.0)) if base_m is not None else np.zeros(3)
    return np.array(EYE_M) + along, np.array(TARGET_M) + along


def camera_axes() -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Position of the camera and its right, up and forward axes as rows, shape (3, 3)."""
    eye, target = camera()
    forward = target - eye
    forward /= np.linalg.norm(forward)
    right = np.cross(forward, UP)
    right /= np.linalg.norm(right)
    return eye, np.stack((right, np.cross(right, forward), forward))
