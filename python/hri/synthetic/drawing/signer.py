# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Made-up people: proportions, colours, clothes, and the room and light they are filmed in."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from hri.synthetic.drawing.hand_pose import HandShape
from hri.synthetic.drawing.height_field import Colour
from hri.synthetic.drawing.light import Camera, Light
from hri.synthetic.drawing.options import BACKGROUNDS, LIGHTS, SKINS, SLEEVES, SignerOptions

# BGR. Clothes and rooms keep clear of skin and of each other's brightness.
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


@dataclass(frozen=True)
class Signer:
    """One made-up person and the place of recording; `options` are what was asked for."""

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
    options: SignerOptions


def make_signer(index: int, seed: int = 0, options: SignerOptions | None = None) -> Signer:
    """The person with this number; neighbours in number differ in every colour that is not asked for."""
    person = _person(index, seed)
    return person if options is None else _changed(person, options)


def _changed(person: Signer, options: SignerOptions) -> Signer:
    """The same person as asked for: what is not, stays."""
    seen = {name: getattr(options, name) for name in ("exposure", "cast", "noise", "vignette")}
    place = {name: getattr(options, name) for name in ("blur_px", "zoom", "shift_x", "shift_y", "roll_deg")}
    camera = replace(person.camera, **place, **{name: value for name, value in seen.items() if value is not None})
    return replace(
        person,
        skin=person.skin if options.skin is None else SKINS[options.skin],
        sleeve_start=person.sleeve_start if options.sleeve is None else SLEEVES[options.sleeve],
        light=person.light if options.light is None else LIGHTS[options.light],
        background=options.background or person.background,
        wall=person.wall if options.wall is None else options.wall,
        camera=camera,
        options=options,
    )


def _person(index: int, seed: int) -> Signer:
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
        skin=pick(tuple(SKINS.values()), 1),
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
        options=SignerOptions(),
    )
