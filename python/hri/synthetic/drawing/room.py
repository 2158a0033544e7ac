# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Walls behind the signer."""

from __future__ import annotations

from typing import Any

import numpy as np

from hri.synthetic.drawing.height_field import Colour
from hri.synthetic.drawing.light import Image


def draw_wall(height: int, width: int, colour: Colour, rng: np.random.Generator) -> Image:
    """A wall that a lamp lights unevenly, float32 BGR."""
    y, x = np.ogrid[-1 : 1 : height * 1j, -1 : 1 : width * 1j]
    slope = rng.uniform(-0.07, 0.07, size=2)
    level = (1.0 + slope[0] * x + slope[1] * y).astype(np.float32)
    return np.asarray(level[..., None] * np.array(colour, dtype=np.float32), dtype=np.float32)


def draw_room(height: int, width: int, colour: Colour, background: str, rng: np.random.Generator, cv2: Any) -> Image:
    """A wall with a window, a picture or a board on it (`background`), a little out of focus."""
    image = draw_wall(height, width, colour, rng)
    unit = height / 24.0

    def box(x0: float, y0: float, x1: float, y1: float, fill: Colour) -> None:
        corners = [round(value * unit) for value in (x0, y0, x1, y1)]
        cv2.rectangle(image, tuple(corners[:2]), tuple(corners[2:]), fill, -1)

    edge = width / unit
    if background == "window":
        box(edge - 8.5, 1.5, edge - 1.0, 11.0, (150.0, 150.0, 150.0))
        for column in (edge - 8.1, edge - 4.6):
            box(column, 1.9, column + 3.2, 6.1, (244.0, 226.0, 196.0))
            box(column, 6.5, column + 3.2, 10.6, (236.0, 218.0, 190.0))
            box(column, 9.0, column + 3.2, 10.6, (96.0, 138.0, 92.0))
    elif background == "picture":
        box(edge - 7.5, 2.0, edge - 1.5, 8.5, (66.0, 60.0, 58.0))
        box(edge - 7.0, 2.5, edge - 2.0, 8.0, (222.0, 214.0, 200.0))
        box(edge - 7.0, 5.8, edge - 2.0, 8.0, (132.0, 152.0, 104.0))
        box(edge - 7.0, 5.0, edge - 2.0, 5.8, (186.0, 160.0, 118.0))
    elif background == "board":
        box(edge - 9.5, 1.0, edge + 1.0, 10.0, (128.0, 124.0, 122.0))
        box(edge - 9.1, 1.4, edge + 1.0, 9.6, (238.0, 236.0, 232.0))
        for line in range(3):
            box(edge - 8.3, 3.0 + 2 * line, edge - 3.5 + line, 3.3 + 2 * line, (150.0, 96.0, 60.0))
    else:
        box(0.0, 20.5, edge + 1.0, 24.5, tuple(0.86 * c for c in colour))  # type: ignore[arg-type]
    return np.asarray(cv2.GaussianBlur(image, (0, 0), 0.12 * unit), dtype=np.float32)
