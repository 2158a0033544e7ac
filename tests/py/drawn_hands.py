# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Hands of a disc and a bar before a grey wall: the simplest thing that is recognised as a sign, and quick to draw."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

FPS = 15.0
SIDE_PX = 160
HIDDEN = 1.6
Frame = NDArray[np.uint8]


def picture(sign: str, height: float, rng: np.random.Generator) -> Frame:
    """A hand whose middle is at `height` (0 top, 1 bottom; `HIDDEN` is out of view): "flat" or "tall"."""
    y, x = np.mgrid[:SIDE_PX, :SIDE_PX] / SIDE_PX
    frame = np.full((SIDE_PX, SIDE_PX, 3), 120.0)
    disc = (x - 0.5) ** 2 + (y - height) ** 2 < 0.11**2
    wide, high = (0.3, 0.05) if sign == "flat" else (0.05, 0.3)
    bar = (abs(x - 0.5) < wide) & (abs(y - height) < high)
    frame[disc | bar] = (110, 150, 210)
    return (frame + rng.normal(0, 3, frame.shape)).clip(0, 255).astype(np.uint8)


def shown(signs: list[str], seed: int = 0, hold_s: float = 1.2) -> list[Frame]:
    """The hand comes from below, holds each sign and goes again, with half a second of wall around."""
    rng = np.random.default_rng(seed)
    frames = []
    for sign in signs:
        rise = np.linspace(HIDDEN, 0.5, 9)
        heights = [*[HIDDEN] * 8, *rise, *[0.5] * round(hold_s * FPS), *rise[::-1], *[HIDDEN] * 8]
        frames += [picture(sign, height + 0.01 * rng.standard_normal(), rng) for height in heights]
    return frames


def stills(sign: str, seed: int) -> list[Frame]:
    """One picture of the sign held, as a clip."""
    rng = np.random.default_rng(seed)
    return [picture(sign, 0.5 + 0.03 * rng.standard_normal(), rng)]
