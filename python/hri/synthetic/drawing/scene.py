# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""A whole signer in a room, drawn so that a moving arm costs little."""

from __future__ import annotations

from typing import Any

import numpy as np

from hri.synthetic.drawing.body import draw_body, draw_upper_arm
from hri.synthetic.drawing.hand import HandLook, draw_hand, tinted
from hri.synthetic.drawing.hand_pose import Array, Skeleton
from hri.synthetic.drawing.height_field import HeightField, View
from hri.synthetic.drawing.light import Image, over, shade
from hri.synthetic.drawing.room import draw_room
from hri.synthetic.drawing.signer import Signer

RAISED_ELBOW = np.array([-1.54, -2.62, 0.75])  # in hand lengths from the middle of the head
_FOREARM = 1.42
_HAND_SCALE = 1.12  # the hand is nearer to the camera than the head


class Scene:
    """A signer in a room, drawn once; only the columns in which the arm moves are redrawn."""

    def __init__(self, signer: Signer, height: int, width: int, rng: np.random.Generator, cv2: Any) -> None:
        self._signer, self._cv2 = signer, cv2
        self._scale = height / 3.25
        self._view = View((width * rng.uniform(0.54, 0.58), height * rng.uniform(0.33, 0.36)), self._scale)
        self._body = HeightField(height, width)
        draw_body(self._body, self._view, signer, cv2)
        self._room = draw_room(height, width, signer.wall, signer.background, rng, cv2)
        self._still = self._lit(self._body, self._room)
        self._kept_columns = int(self._view.origin_px[0] - 0.25 * self._scale)

    def with_arm(self, skeleton: Skeleton, elbow: Array, turn: Array) -> Image:
        """The picture with the forearm from `elbow` along the turned y axis, and the hand."""
        margin = int(0.1 * self._scale)  # light looks at the neighbourhood
        field = self._body.columns(0, self._kept_columns + margin)
        upper_end = (float(elbow[0]), float(elbow[1]), 0.35)
        draw_upper_arm(field, self._view, self._signer, upper_end, self._cv2)

        column, row, depth = self._view.project(elbow + _FOREARM * turn[:, 1] * (1.0, 1.0, 0.3))
        scale = self._scale * _HAND_SCALE
        top, left = int(row - 1.25 * scale), int(column - 0.85 * scale)
        if top < field.shape[0]:
            rows = field.shape[0] - max(top, -field.shape[0])
            hand = HeightField(rows, int(1.7 * scale))
            view = View((float(column - left), float(row - top)), scale)
            draw_hand(hand, view, skeleton, self._signer.hand_shape, arm_look(self._signer), self._cv2)
            field.add_field(hand, top, left, float(depth))
        picture = self._still.copy()
        lit = self._lit(field, self._room[:, : field.shape[1]])
        picture[:, : self._kept_columns] = lit[:, : self._kept_columns]
        return picture

    def _lit(self, field: HeightField, room: Image) -> Image:
        lit = shade(field, self._signer.light, 0.02 * self._scale, self._cv2)
        return over(room, lit, field.part > 0)


def arm_look(signer: Signer) -> HandLook:
    """Skin (the palm is paler than the face), sleeve and cuff of a signer."""
    return HandLook(
        skin=tinted(signer.skin, 1.0, (150.0, 175.0, 226.0), 0.15),
        sleeve=signer.clothes,
        cuff=tinted(signer.clothes, 0.8),
        sleeve_start=signer.sleeve_start,
    )
