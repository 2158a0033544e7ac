# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What of made-up people, their rooms, lights and cameras is asked for; the rest differs from person to person."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from typing import Any

from hri.core.errors import InvalidArgument
from hri.synthetic.drawing.height_field import Colour
from hri.synthetic.drawing.light import Light

# BGR.
SKINS: dict[str, Colour] = {
    "tan": (120.0, 156.0, 212.0),
    "pale": (176.0, 198.0, 238.0),
    "brown": (62.0, 88.0, 138.0),
    "olive": (98.0, 134.0, 194.0),
    "light": (150.0, 182.0, 232.0),
    "bronze": (78.0, 110.0, 168.0),
    "fair": (164.0, 192.0, 228.0),
    "dark": (52.0, 74.0, 118.0),
}
SLEEVES = {"long": 0.12, "cuffed": 0.26, "rolled": 0.75, "short": 1.35}
"""Where the sleeve begins, below the wrist, in hand lengths."""

BACKGROUNDS = ("plain", "window", "picture", "board")

LIGHTS = {
    "left": Light((-0.9, 0.3, 0.5), 0.40),
    "right": Light((0.9, 0.3, 0.5), 0.40),
    "above": Light((0.0, 1.0, 0.35), 0.45),
    "soft": Light((0.0, 0.5, 0.8), 0.95),
    "hard": Light((-0.5, 0.6, 0.4), 0.15),
}

RANGES = {
    "exposure": (0.05, 4.0),
    "noise": (0.0, 64.0),
    "vignette": (0.0, 1.0),
    "blur_px": (0.0, 16.0),
    "zoom": (0.5, 2.0),
    "shift_x": (-0.3, 0.3),
    "shift_y": (-0.3, 0.3),
    "roll_deg": (-45.0, 45.0),
    "fps": (5.0, 120.0),
    "tempo": (0.25, 4.0),
}
_CHOICES = {"skin": tuple(SKINS), "sleeve": tuple(SLEEVES), "light": tuple(LIGHTS), "background": BACKGROUNDS}


@dataclass(frozen=True)
class SignerOptions:
    """What is asked for; None is left to the person, of whom everybody is another.

    Attributes
    ----------
    skin, sleeve, light, background : str, optional
        One of `SKINS`, `SLEEVES`, `LIGHTS`, `BACKGROUNDS`. Close-ups have a bare wall unless a background is asked for.
    wall : (float, float, float), optional
        Its blue, green and red, 0..255.
    exposure : float, optional
        Factor on all light, 0.05..4.
    cast : (float, float, float), optional
        Factors of blue, green and red, 0..2: the colour of the light, or a camera's white balance.
    noise : float, optional
        Standard deviation in grey levels, 0..64.
    vignette : float, optional
        How much darker the corners are, 0..1.
    blur_px : float
        Standard deviation of a lens out of focus, 0..16.
    zoom : float
        Of the camera, 0.5..2.
    shift_x, shift_y : float
        Where the camera looks: how far the picture moves right and down, in shares of its size, -0.3..0.3.
    roll_deg : float
        By which the camera leans: the picture turns clockwise, -45..45.
    fps : float
        Frames a second of clips, 5..120.
    tempo : float
        How fast people move, 0.25..4; at 2, clips take half the time.

    Raises
    ------
    InvalidArgument
        Naming the field that cannot be.
    """

    skin: str | None = None
    sleeve: str | None = None
    light: str | None = None
    background: str | None = None
    wall: Colour | None = None
    exposure: float | None = None
    cast: tuple[float, float, float] | None = None
    noise: float | None = None
    vignette: float | None = None
    blur_px: float = 0.0
    zoom: float = 1.0
    shift_x: float = 0.0
    shift_y: float = 0.0
    roll_deg: float = 0.0
    fps: float = 15.0
    tempo: float = 1.0

    def __post_init__(self) -> None:
        for name, choices in _CHOICES.items():
            value = getattr(self, name)
            if value is not None and value not in choices:
                raise InvalidArgument(f"{name} is {value!r}, must be one of {', '.join(choices)}")
        for name, (low, high) in RANGES.items():
            value = getattr(self, name)
            if value is not None and not low <= value <= high:
                raise InvalidArgument(f"{name} is {value}, must lie in {low:g}..{high:g}")
        for name, high in (("wall", 255.0), ("cast", 2.0)):
            values = getattr(self, name)
            if values is not None and (len(values) != 3 or not all(0.0 <= v <= high for v in values)):
                raise InvalidArgument(f"{name} is {values}, must be three numbers in 0..{high:g}")

    def asked_for(self) -> dict[str, Any]:
        """The fields that differ from the default, as a manifest holds them."""
        given = {f.name: value for f in fields(self) if (value := getattr(self, f.name)) != f.default}
        return {name: list(value) if isinstance(value, tuple) else value for name, value in given.items()}


def num_clip_frames(seconds: float, options: SignerOptions) -> int:
    """Frames of a clip that takes so long at the usual tempo; at least 3."""
    return max(3, math.floor(seconds * options.fps / options.tempo + 0.5))
