# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Draws a hand: flesh round the skeleton, creases, nails, forearm and sleeve."""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from typing import Any

import numpy as np

from hri.synthetic.drawing.hand_pose import Array, HandShape, Skeleton
from hri.synthetic.drawing.height_field import Colour, HeightField, View

PALM, FINGER, THUMB, SLEEVE = 1, 2, 6, 7  # parts; fingers are 2, 3, 4, 5

_FINGER_RADII = np.array([[0.056, 0.051, 0.047, 0.040]] * 3 + [[0.050, 0.044, 0.040, 0.034]])
_WRIST_END = 0.30  # below the wrist, in hand lengths: so far the palm is drawn
_THUMB_RADII = np.array([0.085, 0.064, 0.057, 0.046])


@dataclass(frozen=True)
class HandLook:
    """Colours (BGR) and clothes of one arm."""

    skin: Colour
    sleeve: Colour
    cuff: Colour
    sleeve_start: float = 0.20  # below the wrist, in hand lengths
    sleeve_width: float = 1.0


def tinted(colour: Colour, factor: float, towards: Colour = (96.0, 96.0, 216.0), amount: float = 0.0) -> Colour:
    """Lighter or darker, and mixed with another colour."""
    mixed = np.clip((1 - amount) * np.array(colour) * factor + amount * np.array(towards), 0, 255)
    return float(mixed[0]), float(mixed[1]), float(mixed[2])


def draw_hand(field: HeightField, view: View, skeleton: Skeleton, shape: HandShape, look: HandLook, cv2: Any) -> None:
    """Draw hand, forearm and sleeve; the wrist is at the view's origin."""
    scale = view.scale
    palm_colour = tinted(look.skin, 1.04, amount=0.05)
    with field.merged(cv2, 0.020 * scale) as layer:
        _add_palm(layer, view, skeleton, shape, palm_colour)
    _add_arm(field, view, skeleton, look, cv2)
    for finger in range(4):
        radii = _FINGER_RADII[finger] * shape.finger_width
        with field.merged(cv2, 0.007 * scale) as layer:
            _add_chain(layer, view, skeleton.fingers[finger], radii, look.skin, FINGER + finger)
    with field.merged(cv2, 0.010 * scale) as layer:
        radii = _THUMB_RADII * shape.finger_width
        _add_chain(layer, view, skeleton.thumb[1:], radii[1:], look.skin, THUMB)
    _draw_creases(field, view, skeleton, shape, cv2)
    _draw_nails(field, view, skeleton, shape, look, cv2)


def _add_palm(field: HeightField, view: View, skeleton: Skeleton, shape: HandShape, colour: Colour) -> None:
    def limb(a: Any, b: Any, ra: float, rb: float) -> None:
        a, b = (view.project(skeleton.turn @ np.asarray(point, float)) for point in (a, b))
        field.add_limb(a, b, ra * view.scale, rb * view.scale, colour, PALM)

    width = shape.palm_width
    knuckles = skeleton.fingers[:, 0] @ skeleton.turn  # back in the frame of the palm
    for side in (-0.062, 0.0, 0.062):
        limb((side * width, -0.32, 0), (1.15 * side * width, 0.06, 0), 0.094, 0.090)
    for knuckle in knuckles:
        limb((0.55 * knuckle[0], 0.05, -0.01), np.add(knuckle, (0, 0.015, -0.012)), 0.085, 0.066)
    for first, second in itertools.pairwise(knuckles):  # the web between fingers
        middle = 0.5 * (first + second) + (0, 0.012, -0.02)
        limb((0.5 * middle[0], 0.1, -0.02), middle, 0.08, 0.058)
    limb((-0.100 * width, 0.12, 0.008), (-0.140 * width, 0.34, 0.0), 0.086, 0.074)  # heel
    thumb = skeleton.thumb @ skeleton.turn
    limb(thumb[0] + (-0.02, 0.0, 0.0), thumb[1], 0.092, 0.066)  # ball of the thumb
    limb(thumb[0] + (-0.03, 0.08, -0.01), thumb[1] + (-0.03, 0.03, -0.03), 0.075, 0.050)
    limb(thumb[1] + (-0.02, 0.0, -0.03), knuckles[0] + (0.0, -0.06, -0.03), 0.045, 0.055)  # its web


def _add_arm(field: HeightField, view: View, skeleton: Skeleton, look: HandLook, cv2: Any) -> None:
    start, s = look.sleeve_start, look.sleeve_width
    if start > _WRIST_END:
        _add_forearm(field, view, skeleton, look, cv2)
    cuff = 0.146 + 0.06 * max(0.0, start - _WRIST_END)  # the arm is wider further up
    pieces = [
        (-1.9, -start - 0.03, max(0.200, cuff), cuff - 0.008, look.sleeve),
        (-start - 0.07, -start, cuff, cuff, look.cuff),
    ]
    for low, high, low_radius, high_radius, colour in pieces:
        with field.merged(cv2, 0.02 * view.scale) as layer:
            for side in (-0.045, 0.0, 0.045):
                ends = [skeleton.turn @ np.array([side, y, -0.02]) for y in (low, high)]
                a, b = (view.project(end) for end in ends)
                radii = low_radius * s * view.scale, high_radius * s * view.scale
                layer.add_limb(a, b, *radii, colour, SLEEVE)


def _add_forearm(field: HeightField, view: View, skeleton: Skeleton, look: HandLook, cv2: Any) -> None:
    """Bare skin from the wrist to where the sleeve begins."""
    with field.merged(cv2, 0.02 * view.scale) as layer:
        for side in (-0.045, 0.0, 0.045):
            ends = [skeleton.turn @ np.array([side, y, -0.02]) for y in (-0.25, -look.sleeve_start - 0.1)]
            a, b = (view.project(end) for end in ends)
            layer.add_limb(a, b, 0.092 * view.scale, 0.150 * view.scale, tinted(look.skin, 0.98), PALM)


def _add_chain(field: HeightField, view: View, joints: Array, radii: Array, colour: Colour, part: int) -> None:
    points = view.project(joints)
    last = len(points) - 2
    for bone in range(len(points) - 1):
        start, end = points[bone], points[bone + 1]
        if bone == last:  # the tip joint is the end of the flesh
            axis = joints[bone + 1] - joints[bone]
            axis = axis / (np.linalg.norm(axis) + 1e-9)
            end = view.project(joints[bone + 1] - axis * 0.5 * radii[bone + 1])
        red = tinted(colour, 1.0, amount=0.05 + 0.05 * (bone == last))
        field.add_limb(start, end, radii[bone] * view.scale, radii[bone + 1] * view.scale, red, part)


def _draw_creases(field: HeightField, view: View, skeleton: Skeleton, shape: HandShape, cv2: Any) -> None:
    """Darken the lines of the palm and the folds of the fingers where they can be seen."""
    marks = np.zeros((*field.shape, 1), dtype=np.uint8)
    thickness = max(1, round(0.010 * view.scale))
    width = shape.palm_width
    lines = (
        [(0.165, 0.36), (0.10, 0.335), (0.045, 0.26), (0.02, 0.16), (0.02, 0.06)],
        [(0.165, 0.375), (0.08, 0.345), (-0.02, 0.29), (-0.11, 0.235)],
        [(0.075, 0.445), (0.02, 0.40), (-0.08, 0.36), (-0.185, 0.345)],
    )
    for line in lines:
        flat = np.array([(x * width, y, 0.07) for x, y in line]) @ skeleton.turn.T
        if skeleton.turn[2, 2] > 0.5:
            _polyline(marks, view.project(flat), 80, thickness, cv2, field.part == PALM)
    for finger in range(4):
        joints, sides = skeleton.fingers[finger], skeleton.palm_sides[finger]
        radii = _FINGER_RADII[finger] * shape.finger_width
        for joint in range(3):
            side = sides[joint]
            bone = joints[joint + 1] - joints[joint]
            across = np.cross(bone / np.linalg.norm(bone), side)
            place = joints[joint] + (0.34 * bone if joint == 0 else 0)
            ends = np.stack([place + across * f * radii[joint] for f in (-0.75, 0.75)])
            ends = ends + side * 0.75 * radii[joint]
            if side[2] > 0.35:
                _polyline(marks, view.project(ends), 70, thickness, cv2, field.part == FINGER + finger)
    shade = cv2.GaussianBlur(marks, (0, 0), 0.006 * view.scale + 0.3).astype(np.float32) / 255.0
    field.colour *= 1.0 - shade[..., None] * np.array([1.0, 0.85, 0.6], dtype=np.float32)


def _polyline(marks: Any, points: Array, value: int, thickness: int, cv2: Any, where: Any) -> None:
    layer = np.zeros(marks.shape[:2], dtype=np.uint8)
    path = np.round(points[:, :2] * 16).astype(np.int32)
    cv2.polylines(layer, [path], False, value, thickness, cv2.LINE_AA, 4)
    np.maximum(marks[..., 0], np.where(where, layer, 0), out=marks[..., 0])


def _draw_nails(
    field: HeightField,
    view: View,
    skeleton: Skeleton,
    shape: HandShape,
    look: HandLook,
    cv2: Any,
) -> None:
    """Nails of the fingers that show their back."""
    nail = np.array(tinted(look.skin, 1.10, (210.0, 205.0, 240.0), 0.30), dtype=np.float32)
    for finger in range(4):
        back = -skeleton.palm_sides[finger, 2]
        if back[2] < 0.3:
            continue
        joints = skeleton.fingers[finger]
        radius = _FINGER_RADII[finger, 3] * shape.finger_width
        centre = 0.30 * joints[2] + 0.70 * joints[3] + 0.6 * radius * back
        _ellipse(field, view, centre, joints[3] - joints[2], radius, nail, FINGER + finger, cv2)


def _ellipse(
    field: HeightField,
    view: View,
    centre: Array,
    axis: Array,
    radius: float,
    colour: Any,
    part: int,
    cv2: Any,
) -> None:
    column, row, depth = view.project(centre)
    x, y = round(column), round(row)
    height, width = field.shape
    if not (0 <= x < width and 0 <= y < height) or field.part[y, x] != part:
        return
    if field.depth[y, x] > depth + radius * view.scale:
        return
    layer = np.zeros(field.shape, dtype=np.uint8)
    flat = float(np.hypot(axis[0], axis[1]) / np.linalg.norm(axis))
    angle = float(np.rad2deg(np.arctan2(-axis[1], axis[0])))
    size = (round(max(0.85 * flat, 0.3) * radius * view.scale), round(0.62 * radius * view.scale))
    cv2.ellipse(layer, (x, y), size, angle, 0, 360, 255, -1, cv2.LINE_AA)
    mix = 0.8 * (layer.astype(np.float32) / 255.0 * (field.part == part))[..., None]
    field.colour[:] = (1 - mix) * field.colour + mix * colour
