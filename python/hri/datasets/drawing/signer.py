# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Made-up people: proportions, colours, clothes, and the room and light they are filmed in."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hri.datasets.drawing.hand_pose import HandShape
from hri.datasets.drawing.height_field import Colour
from hri.datasets.drawing.light import Camera, Light

# BGR. Clothes and rooms keep clear of skin and of each other's brightness.
_SKINS: tuple[Colour, ...] = (
    (120.0, 156.0, 212.0),
    (176.0, 198.0, 238.0),
    (62.0, 88.0, 138.0),
    (98.0, 134.0, 194.0),
    (150.0, 182.0, 232.0),
    (78.0, 110.0, 168.0),
    (164.0, 192.0, 228.0),
    (52.0, 74.0, 118.0),
)
_HAIRS: tuple[Colour, ...] = (
    (34.0, 32.0, 36.0),
    (28.0, 26.0, 28.0),
    (44.0, 42.0, 50.0),
    (120.0, 118.0, 118.0),
)
_CLOTHES: tuple[Colour, ...] = (
    (92.0, 58.0, 38.0),
    (58.0, 52.0, 50.0),
    (62.0, 76.0, 34.0),
    (96.0, 44.0, 66.0),
    (110.0, 92.0, 40.0),
    (72.0, 66.0, 62.0),
)
_WALLS: tuple[Colour, ...] = (
    (214.0, 210.0, 206.0),
    (206.0, 196.0, 176.0),
    (190.0, 206.0, 192.0),
    (178.0, 174.0, 172.0),
    (216.0, 206.0, 208.0),
    (172.0, 182.0, 160.0),
)
HAIR_STYLES = ("short", "bob", "curly", "long", "bun", "scarf")
BACKGROUNDS = ("plain", "window", "picture", "board")


@dataclass(frozen=True)
class Signer:
    """One made-up person and the place of recording."""

    name: str
    hand_shape: HandShape
    skin: Colour
    clothes: Colour
    hair: Colour
    hair_style: str
    glasses: bool
    build: float
    sleeve_start: float
    wall: Colour
    background: str
    light: Light
    camera: Camera


def make_signer(index: int, seed: int = 0) -> Signer:
    """The person with this number; neighbours in number differ in every colour."""
    rng = np.random.default_rng((seed, 0x51642, index))

    def pick(colours: tuple[Colour, ...], step: int) -> Colour:
        base = np.array(colours[(index * step + seed) % len(colours)])
        mixed = np.clip(base * rng.uniform(0.94, 1.06), 0, 255)
        return float(mixed[0]), float(mixed[1]), float(mixed[2])

    side = rng.choice([-1.0, 1.0])
    warmth = float(rng.uniform(-0.05, 0.05))
    return Signer(
        name=f"signer{index + 1:02d}",
        hand_shape=HandShape(*(float(f) for f in rng.uniform(0.92, 1.08, size=4))),
        skin=pick(_SKINS, 1),
        clothes=pick(_CLOTHES, 1),
        hair=pick(_HAIRS, 1),
        hair_style=HAIR_STYLES[(index + seed) % len(HAIR_STYLES)],
        glasses=bool(rng.random() < 0.3),
        build=float(rng.uniform(0.92, 1.08)),
        sleeve_start=float(rng.uniform(0.12, 0.26)),
        wall=pick(_WALLS, 5),
        background=BACKGROUNDS[(index + seed) % len(BACKGROUNDS)],
        light=Light(
            (float(side * rng.uniform(0.2, 0.7)), float(rng.uniform(0.4, 0.8)), 0.8),
            float(rng.uniform(0.50, 0.65)),
        ),
        camera=Camera(
            exposure=float(rng.uniform(0.82, 1.12)),
            cast=(1.0 - warmth, 1.0, 1.0 + warmth),
            noise=float(rng.uniform(1.5, 4.0)),
            vignette=float(rng.uniform(0.05, 0.22)),
        ),
    )
