# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Light on a height field, and the camera that sees it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.synthetic.drawing.height_field import HeightField

Image = NDArray[np.float32]


@dataclass(frozen=True)
class Light:
    """A lamp far away and light from all sides.

    Attributes
    ----------
    direction : (float, float, float)
        Towards the lamp.
    ambient : float, 0..1
    """

    direction: tuple[float, float, float] = (-0.45, 0.65, 0.75)
    ambient: float = 0.55


@dataclass(frozen=True)
class Camera:
    """What a cheap camera does to a picture.

    Attributes
    ----------
    exposure : float
    cast : (float, float, float)
        Factors of blue, green and red.
    noise : float
        Standard deviation, in grey levels.
    vignette : float, 0..1
        How much darker the corners are.
    blur_px : float
        Standard deviation of a lens out of focus.
    zoom, shift_x, shift_y, roll_deg : float
        Where it stands: its zoom, how far the picture moves right and down in shares of its size, and turns clockwise.
    """

    exposure: float = 1.0
    cast: tuple[float, float, float] = (1.0, 1.0, 1.0)
    noise: float = 2.5
    vignette: float = 0.12
    blur_px: float = 0.0
    zoom: float = 1.0
    shift_x: float = 0.0
    shift_y: float = 0.0
    roll_deg: float = 0.0

    @property
    def moved(self) -> bool:
        """Whether it stands elsewhere than pictures are drawn for."""
        return (self.zoom, self.shift_x, self.shift_y, self.roll_deg) != (1.0, 0.0, 0.0, 0.0)


def shade(field: HeightField, light: Light, crease_px: float, cv2: Any) -> Image:
    """Lit colours, float32 BGR; dark where a surface lies close behind the edge of another."""
    lamp = np.array(light.direction, dtype=np.float32)
    lamp /= np.linalg.norm(lamp)
    lit = np.clip(field.normal @ lamp, -0.15, 1.0)
    level = light.ambient + (1.08 - light.ambient) * lit
    rim = 1.0 - 0.22 * np.clip(1.0 - field.normal[..., 2], 0, 1) ** 2
    drawn = field.part > 0
    floor = float(field.depth[drawn].min()) if drawn.any() else 0.0
    depth = np.where(drawn, field.depth, floor).astype(np.float32)
    near = cv2.GaussianBlur(depth, (0, 0), crease_px)
    hollow = np.clip((near - depth) / (4.0 * crease_px), 0, 0.5)
    step = cv2.dilate(depth, np.ones((3, 3), np.uint8)) - depth
    outline = np.clip((step - 1.2 * crease_px) / (2.0 * crease_px), 0, 1) * drawn
    factor = level * rim * (1.0 - 0.9 * hollow) * (1.0 - 0.45 * outline)
    # Light that went through skin is redder: shadows keep more red.
    tone = np.stack([factor**1.12, factor**1.05, factor**0.94], axis=-1)
    return (field.colour * tone).astype(np.float32)


def over(background: Image, drawn: Image, mask: NDArray[np.bool_]) -> Image:
    """The drawing in front of the background."""
    return np.where(mask[..., None], drawn, background).astype(np.float32)


def cast_shadow(background: Image, mask: NDArray[np.bool_], offset_px: tuple[float, float], cv2: Any) -> Image:
    """The background with a soft shadow of the mask on it."""
    height, width = mask.shape
    move = np.array([[1, 0, offset_px[0]], [0, 1, offset_px[1]]], dtype=np.float32)
    blur = 0.6 * float(np.hypot(*offset_px)) + 1.0
    shadow = cv2.warpAffine(mask.astype(np.float32), move, (width, height))
    shadow = cv2.GaussianBlur(shadow, (0, 0), blur)
    return np.asarray(background * (1.0 - 0.28 * shadow[..., None]), dtype=np.float32)


def photograph(picture: Image, camera: Camera, rng: np.random.Generator, cv2: Any) -> NDArray[np.uint8]:
    """The picture as the camera delivers it, uint8 BGR; what is drawn at its borders goes on beyond them."""
    height, width = picture.shape[:2]
    if camera.moved:
        turn = cv2.getRotationMatrix2D((width / 2, height / 2), -camera.roll_deg, camera.zoom)
        turn[:, 2] += (camera.shift_x * width, camera.shift_y * height)
        picture = cv2.warpAffine(picture, turn, (width, height), borderMode=cv2.BORDER_REPLICATE)
    if camera.blur_px > 0:
        picture = cv2.GaussianBlur(picture, (0, 0), camera.blur_px)
    y, x = np.ogrid[-1 : 1 : height * 1j, -1 : 1 : width * 1j]
    corner = 1.0 - camera.vignette * (0.5 * (x**2 + y**2)).astype(np.float32)
    gain = camera.exposure * np.array(camera.cast, dtype=np.float32)
    seen = picture * corner[..., None] * gain
    seen += camera.noise * rng.standard_normal(seen.shape, dtype=np.float32)
    return np.clip(seen + 0.5, 0, 255).astype(np.uint8)
