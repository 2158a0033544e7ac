# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Pictures and movements of one drawn hand (synthetic), as a webcam of 640 x 480 would see it."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from hri.synthetic.signer import draw_still, make_signer

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


def sign_picture(sign: str, person: int, take: int) -> Frame:
    """A sign held before the camera."""
    rng = np.random.default_rng([person, take, 8])
    x, y = rng.normal(0, 0.03, 2)
    return hand_picture(draw_still(make_signer(person), sign, take), x, y, rng)


def _arrival(still: Frame, x: float, y: float, wait: int, rng: np.random.Generator) -> list[Frame]:
    """The wall, the hand that comes from below to a place, and `wait` frames in which it holds still."""
    heights = [*[_AWAY] * 10, *np.linspace(_AWAY, y, 15), *[y] * wait]
    return [hand_picture(still, x, height, rng) for height in heights]


def sign_stream(sign: str, person: int, take: int, wait: int) -> tuple[list[Frame], int]:
    """A hand that comes and holds a sign, and the frame from which on it holds still."""
    rng = np.random.default_rng([person, take, 7])
    frames = _arrival(draw_still(make_signer(person), sign, take), 0.0, 0.0, wait, rng)
    return frames, len(frames) - wait


def movement_stream(movement: str, person: int, take: int, wait: int) -> tuple[list[Frame], int]:
    """A hand that comes, holds still, moves and holds still again, and the frame from which on it does so."""
    rng = np.random.default_rng([person, take, 9])
    still = draw_still(make_signer(person), "5", take)
    far = np.array(_FAR[movement])
    frames = _arrival(still, *(-far / 2), wait, rng)
    way = np.sin(np.linspace(0, np.pi / 2, 18)) ** 2
    frames += [hand_picture(still, *(far * (share - 0.5)), rng) for share in way]
    end = len(frames)
    return frames + [hand_picture(still, *(far / 2), rng) for _ in range(wait)], end
