# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Pictures and movements of one drawn hand (synthetic), as a webcam of 640 x 480 would see it."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from hri.datasets.synthetic_signer import draw_still, make_signer

WIDTH, HEIGHT = 640, 480
FPS = 30.0
MOVEMENTS = ("left", "right", "up", "down")
_ZOOM = 1.5
_AWAY = 1.6
_FAR = {"left": (-0.28, 0.0), "right": (0.28, 0.0), "up": (0.0, -0.24), "down": (0.0, 0.24)}

Frame = NDArray[np.uint8]


def hand_picture(still: Frame, x: float, y: float, rng: np.random.Generator) -> Frame:
    """The hand of a close-up at a place (shares of the picture off its middle), with the noise of a camera.

    Borders of the close-up go on: the wall at its sides, the forearm below.
    """
    height, width = still.shape[:2]
    left, top = WIDTH * (0.5 + x) - _ZOOM * width / 2, HEIGHT * (0.5 + y) - _ZOOM * height / 2
    place = np.array([[_ZOOM, 0, left], [0, _ZOOM, top]])
    picture = cv2.warpAffine(still, place, (WIDTH, HEIGHT), flags=cv2.INTER_CUBIC, borderMode=cv2.BORDER_REPLICATE)
    return np.clip(picture + rng.normal(0, 2, picture.shape), 0, 255).astype(np.uint8)


def hand_clip(movement: str, person: int, take: int = 0, rest: int = 6) -> list[Frame]:
    """An open hand that rests, makes one of `MOVEMENTS`, and rests again."""
    rng = np.random.default_rng([person, take, MOVEMENTS.index(movement)])
    still = draw_still(make_signer(person), "5", take)
    far = np.array(_FAR[movement]) * rng.uniform(0.8, 1.0)
    length = int(rng.integers(14, 20))
    way = np.concatenate([np.zeros(rest), np.sin(np.linspace(0, np.pi / 2, length)) ** 2, np.ones(rest)])
    start = -far / 2 + rng.normal(0, 0.02, 2)
    return [hand_picture(still, *(start + share * far), rng) for share in way]


def hand_stream(movement: str, person: int, take: int, wait: int) -> tuple[list[Frame], int]:
    """The same as a stream, and where it ends: the hand comes from below, holds for `wait` frames, moves, holds."""
    rng = np.random.default_rng([person, take, 9])
    still = draw_still(make_signer(person), "5", take)
    far = np.array(_FAR[movement])
    wall = [hand_picture(still, 0.0, _AWAY, rng) for _ in range(10)]
    rise = [hand_picture(still, *(-far / 2 + (0, height)), rng) for height in np.linspace(_AWAY, 0, 15)]
    held = [hand_picture(still, *(-far / 2), rng) for _ in range(wait)]
    way = np.sin(np.linspace(0, np.pi / 2, 18)) ** 2
    moving = [hand_picture(still, *(far * (share - 0.5)), rng) for share in way]
    after = [hand_picture(still, *(far / 2), rng) for _ in range(wait)]
    return [*wall, *rise, *held, *moving, *after], len(wall) + len(rise) + len(held) + len(moving)
