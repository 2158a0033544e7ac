# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What a watcher sees, drawn: the picture, the hand's mask, outline and track, and the n-best list."""

from __future__ import annotations

import numpy as np

from hri.live.frames import Frame
from hri.live.sights import Sight
from hri.optional import import_opencv
from hri.recognition import Decision

_HAND = (80, 220, 80)
_TRACK = (60, 160, 255)
_TEXT = (255, 255, 255)
_SHADE = 0.35
_LINE_PX = 18


def draw_sight(sight: Sight, decision: Decision | None, top: int = 3) -> Frame | None:
    """The picture of a sight with what was found in it; None for a sight without a picture.

    Letters that OpenCV's font has not become question marks.
    """
    if sight.frame is None or sight.mask is None:
        return None
    cv2 = import_opencv("to draw what is seen")
    picture = np.array(sight.frame, dtype=np.uint8)
    height, width = picture.shape[:2]
    mask = (cv2.resize(sight.mask, (width, height), interpolation=cv2.INTER_NEAREST) > 0).astype(np.uint8)
    tinted = picture[mask > 0] * (1 - _SHADE) + np.array(_HAND) * _SHADE
    picture[mask > 0] = tinted.astype(np.uint8)
    outlines, _ = cv2.findContours(mask, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_SIMPLE)
    cv2.drawContours(picture, outlines, -1, _HAND, 1)
    places = np.array([(x * width, y * height) for x, y in sight.track], dtype=np.int32).reshape(-1, 1, 2)
    cv2.polylines(picture, [places], False, _TRACK, 2)
    for number, line in enumerate(_lines(sight, decision, top)):
        place = (6, _LINE_PX * (number + 1))
        for colour, thickness in (((0, 0, 0), 3), (_TEXT, 1)):
            cv2.putText(picture, line, place, cv2.FONT_HERSHEY_SIMPLEX, 0.5, colour, thickness, cv2.LINE_AA)
    return picture


def _lines(sight: Sight, decision: Decision | None, top: int) -> list[str]:
    state = "moving" if sight.running else "hand" if sight.mask is not None and sight.mask.any() else "no hand"
    lines = [f"{sight.time_s:6.2f} s  {state}  quality {sight.quality:.2f}"]
    if decision is not None:
        lines.append(decision.label)
        lines += [f"{entry.label} {entry.probability:.2f}" for entry in decision.nbest[:top]]
    return [line.encode("ascii", "replace").decode() for line in lines]
