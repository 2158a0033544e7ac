# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Draws a signer's head and body. Units are hand lengths, the origin is the middle of the head."""

from __future__ import annotations

import itertools
from typing import Any

import numpy as np

from hri.synthetic.drawing.hand import tinted
from hri.synthetic.drawing.height_field import Colour, HeightField, View
from hri.synthetic.drawing.signer import Signer

FACE, HAIR, BODY, EYE, ARM = 20, 21, 22, 23, 24  # parts
Point = tuple[float, float, float]


class _Pencil:
    """Draws in the units of the world."""

    def __init__(self, field: HeightField, view: View) -> None:
        self.field, self.view = field, view

    def limb(self, start: Point, end: Point, radius: float, end_radius: float, colour: Colour, part: int) -> None:
        a, b = (self.view.project(np.array(point)) for point in (start, end))
        scale = self.view.scale
        self.field.add_limb(a, b, radius * scale, end_radius * scale, colour, part)

    def ball(self, centre: Point, radii: Point, colour: Colour, part: int) -> None:
        place = self.view.project(np.array(centre))
        self.field.add_ellipsoid(place, np.array(radii) * self.view.scale, colour, part)


def draw_body(field: HeightField, view: View, signer: Signer, cv2: Any) -> None:
    """Everything but the raised arm."""
    _draw_torso(field, view, signer, cv2)
    _draw_head(field, view, signer, cv2)
    _draw_face(_Pencil(field, view), signer)
    _draw_hair(field, view, signer, cv2)


def draw_upper_arm(field: HeightField, view: View, signer: Signer, elbow: Point, cv2: Any) -> None:
    """From the shoulder on the left of the picture to the elbow."""
    with field.merged(cv2, 0.03 * view.scale) as layer:
        shoulder = (-1.06 * signer.build, -1.42, 0.0)
        _Pencil(layer, view).limb(shoulder, elbow, 0.31, 0.24, signer.clothes, ARM)


def _draw_torso(field: HeightField, view: View, signer: Signer, cv2: Any) -> None:
    build, clothes = signer.build, signer.clothes
    with field.merged(cv2, 0.02 * view.scale) as layer:
        skin = tinted(signer.skin, 0.93)
        _Pencil(layer, view).limb((0, -0.45, 0.0), (0, -1.05, 0.0), 0.22, 0.26, skin, FACE)
    with field.merged(cv2, 0.06 * view.scale) as layer:
        pencil = _Pencil(layer, view)
        pencil.limb((-0.22, -1.16, 0.06), (0.22, -1.16, 0.06), 0.30, 0.30, clothes, BODY)
        for side in (-1, 1):
            x = side * build
            pencil.limb((0.20 * x, -0.98, -0.2), (0.95 * x, -1.36, -0.1), 0.22, 0.36, clothes, BODY)
            pencil.limb((0.62 * x, -1.5, -0.1), (0.50 * x, -4.2, 0.0), 0.42, 0.50, clothes, BODY)
            pencil.limb((0.25 * x, -1.45, -0.1), (0.2 * x, -4.2, 0.1), 0.48, 0.55, clothes, BODY)
    with field.merged(cv2, 0.03 * view.scale) as layer:
        arm = (1.08 * build, -1.42, 0.0), (1.28 * build, -3.4, 0.1)
        _Pencil(layer, view).limb(*arm, 0.31, 0.24, clothes, ARM)
    if signer.hair_style == "scarf":
        return
    collar = tinted(clothes, 0.82)
    ring = [(0.31 * np.sin(a), -0.83 - 0.16 * np.cos(a), 0.12 + 0.28 * np.cos(a)) for a in np.linspace(-1.45, 1.45, 15)]
    with field.merged(cv2, 0.012 * view.scale) as layer:
        for start, end in itertools.pairwise(ring):
            _Pencil(layer, view).limb(start, end, 0.062, 0.062, collar, BODY)


def _draw_head(field: HeightField, view: View, signer: Signer, cv2: Any) -> None:
    skin = signer.skin
    with field.merged(cv2, 0.035 * view.scale) as layer:
        pencil = _Pencil(layer, view)
        pencil.ball((0, 0.10, 0), (0.42, 0.52, 0.48), skin, FACE)
        pencil.ball((0, -0.20, 0.06), (0.345, 0.42, 0.42), skin, FACE)
        for side in (-1, 1):
            pencil.ball((side * 0.19, -0.16, 0.30), (0.13, 0.12, 0.16), tinted(skin, 1, amount=0.10), FACE)
    with field.merged(cv2, 0.02 * view.scale) as layer:
        pencil = _Pencil(layer, view)
        for side in (-1, 1):
            pencil.ball((side * 0.425, -0.04, -0.05), (0.06, 0.125, 0.08), tinted(skin, 0.95), FACE)
        pencil.limb((0, 0.04, 0.43), (0, -0.15, 0.50), 0.035, 0.062, tinted(skin, 1.02), FACE)


def _draw_face(pencil: _Pencil, signer: Signer) -> None:
    brow = tinted(signer.hair, 0.9)
    lips = tinted(signer.skin, 0.80, (90.0, 80.0, 190.0), 0.35)
    for side in (-1, 1):
        x = side * 0.165
        pencil.ball((x, 0.015, 0.44), (0.078, 0.043, 0.06), (232.0, 234.0, 236.0), EYE)
        pencil.ball((x, 0.015, 0.47), (0.038, 0.041, 0.05), (48.0, 44.0, 44.0), EYE)
        pencil.ball((x - 0.012, 0.028, 0.52), (0.012, 0.012, 0.01), (255.0, 255.0, 255.0), EYE)
        pencil.limb((x - 0.078, 0.03, 0.47), (x, 0.062, 0.49), 0.010, 0.012, brow, EYE)
        pencil.limb((x, 0.062, 0.49), (x + 0.078, 0.03, 0.47), 0.012, 0.010, brow, EYE)
        pencil.limb((x - 0.085, 0.13, 0.44), (x + 0.085, 0.14, 0.44), 0.020, 0.020, brow, HAIR)
        corner, middle = (side * 0.140, -0.308, 0.42), (side * 0.055, -0.352, 0.47)
        pencil.limb(corner, middle, 0.012, 0.022, lips, EYE)
        pencil.limb(middle, (0, -0.358, 0.48), 0.022, 0.023, lips, EYE)
    if signer.glasses:
        for side in (-1, 1):
            rim = [
                (side * 0.165 + 0.115 * np.cos(a), 0.01 + 0.085 * np.sin(a), 0.50)
                for a in np.linspace(0, 2 * np.pi, 17)
            ]
            for a, b in itertools.pairwise(rim):
                pencil.limb(a, b, 0.010, 0.010, (40.0, 38.0, 38.0), EYE)
        pencil.limb((-0.05, 0.02, 0.54), (0.05, 0.02, 0.54), 0.010, 0.010, (40.0, 38.0, 38.0), EYE)


def _draw_hair(field: HeightField, view: View, signer: Signer, cv2: Any) -> None:
    hair = signer.hair
    style = signer.hair_style
    if style == "scarf":
        hair = tinted(signer.clothes, 1.5, (190.0, 150.0, 90.0), 0.35)
    with field.merged(cv2, 0.03 * view.scale) as layer:
        pencil = _Pencil(layer, view)
        pencil.ball((0, 0.24, -0.12), (0.47, 0.47, 0.46), hair, HAIR)
        pencil.limb((-0.27, 0.46, 0.22), (0.22, 0.52, 0.24), 0.15, 0.17, hair, HAIR)
        pencil.limb((0.20, 0.50, 0.22), (0.37, 0.34, 0.10), 0.16, 0.10, hair, HAIR)
        pencil.limb((-0.25, 0.46, 0.20), (-0.39, 0.30, 0.08), 0.14, 0.08, hair, HAIR)
        reach = {"bob": -0.38, "long": -1.2}.get(style)
        if reach is not None:
            for side in (-1, 1):
                top, end = (side * 0.41, 0.30, 0.04), (side * 0.45, reach, -0.12)
                pencil.limb(top, end, 0.12, 0.16, hair, HAIR)
                pencil.limb((side * 0.3, 0.2, -0.3), (side * 0.3, reach, -0.4), 0.2, 0.2, hair, HAIR)
        if style == "bun":
            pencil.ball((0, 0.74, -0.05), (0.22, 0.20, 0.22), hair, HAIR)
        if style == "scarf":
            _add_scarf(pencil, hair)
    if style == "curly":
        pencil = _Pencil(field, view)
        rng = np.random.default_rng(7)
        for angle in np.linspace(-0.15 * np.pi, 1.15 * np.pi, 22):
            for ring, size in ((0.98, 0.105), (0.80, 0.115)):
                x, y = 0.46 * ring * np.cos(angle), 0.24 + 0.47 * ring * np.sin(angle)
                if y > 0.24 or ring > 0.9:
                    jump = rng.uniform(-0.02, 0.02, size=2)
                    pencil.ball((x + jump[0], y + jump[1], 0.24), (size, size, size), hair, HAIR)


def _add_scarf(pencil: _Pencil, colour: Colour) -> None:
    """Round the face and under the chin, falling on the chest."""
    rim = [(0.40 * np.sin(a), -0.02 - 0.58 * np.cos(a), 0.16 + 0.10 * np.cos(a)) for a in np.linspace(-2.4, 2.4, 25)]
    for start, end in itertools.pairwise(rim):
        pencil.limb(start, end, 0.10, 0.10, colour, HAIR)
    for x in (-0.20, 0.0, 0.20):
        pencil.limb((x, -0.66, 0.14), (1.5 * x, -1.04, 0.40), 0.21, 0.20, colour, HAIR)
