# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What a watcher sees, drawn: the picture, the hand's mask, outline, track and features, and the n-best list."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri import _native
from hri.live.frames import Frame
from hri.live.sights import Sight
from hri.optional import import_opencv
from hri.recognition import Decision

_HAND = (80, 220, 80)
_TRACK = (60, 160, 255)
_TEXT = (255, 255, 255)
_SHADE = 0.35
_LINE_PX = 18
_CELLS = 8
_GLYPH_PX = 15
_INSET_SHARE = 4


def draw_sight(sight: Sight, decision: Decision | None, top: int = 3) -> Frame | None:
    """The picture of a sight with what was found in it; None for a sight without a picture.

    In the upper right corner, the orientation histograms of the hand, as recognisers get them: strokes along the edges.
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
    if sight.silhouette is not None and mask.any():
        side = width // _INSET_SHARE
        glyphs = cv2.resize(_glyphs(sight.silhouette, cv2), (side, side), interpolation=cv2.INTER_AREA)
        picture[: min(side, height), width - side :] = glyphs[:height]
    for number, line in enumerate(_lines(sight, decision, top)):
        place = (6, _LINE_PX * (number + 1))
        for colour, thickness in (((0, 0, 0), 3), (_TEXT, 1)):
            cv2.putText(picture, line, place, cv2.FONT_HERSHEY_SIMPLEX, 0.5, colour, thickness, cv2.LINE_AA)
    return picture


def _glyphs(silhouette: Any, cv2: Any) -> Frame:
    """The histogram of every cell as strokes, the longer and brighter the more edges run that way."""
    options = _native.OrientationHistogramOptions(num_cells=_CELLS, num_bins=9)
    histogram = np.asarray(_native.orientation_histogram(_square(silhouette, cv2), options))
    blocks: NDArray[np.float32] = histogram.reshape(_CELLS - 1, _CELLS - 1, 4, options.num_bins)
    glyphs = np.zeros(((_CELLS - 1) * _GLYPH_PX, (_CELLS - 1) * _GLYPH_PX, 3), np.uint8)
    for (row, column), weights in ((place, blocks[place][0]) for place in np.ndindex(blocks.shape[:2])):
        centre = np.array((column + 0.5, row + 0.5)) * _GLYPH_PX
        for number in np.argsort(weights):  # the strongest on top
            share = float(weights[number]) / max(1e-6, float(blocks.max()))
            along = np.pi * (number + 0.5) / options.num_bins + np.pi / 2  # an edge runs across its gradient
            reach = 0.5 * _GLYPH_PX * share * np.array((np.cos(along), np.sin(along)))
            start, end = ([round(float(v)) for v in centre + sign * reach] for sign in (-1, 1))
            cv2.line(glyphs, start, end, tuple(int(share * v) for v in _TEXT), 1)
    return glyphs


def _square(silhouette: Any, cv2: Any) -> NDArray[np.float32]:
    """The square around the hand, 0..1."""
    rows, columns = np.nonzero(silhouette.mask)
    side = int(max(np.ptp(rows), np.ptp(columns))) + 1
    top, left = int(rows.min()), int(columns.min())
    grey = silhouette.grey[top : top + side, left : left + side]
    return np.sqrt(cv2.resize(grey, (8 * _CELLS, 8 * _CELLS)).astype(np.float32) / 255.0)


def _lines(sight: Sight, decision: Decision | None, top: int) -> list[str]:
    state = "moving" if sight.running else "hand" if sight.mask is not None and sight.mask.any() else "no hand"
    lines = [f"{sight.time_s:6.2f} s  {state}  quality {sight.quality:.2f}"]
    if decision is not None:
        lines.append(decision.label)
        lines += [f"{entry.label} {entry.probability:.2f}" for entry in decision.nbest[:top]]
    return [line.encode("ascii", "replace").decode() for line in lines]
