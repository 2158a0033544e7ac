# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What was found of a hand, drawn into its picture: mask, outline, joints, track, edges and lines of text."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.core.optional import import_opencv
from hri.features import OrientationHistogramOptions, orientation_histogram

Frame = NDArray[np.uint8]
Colour = tuple[int, int, int]

HAND: Colour = (80, 220, 80)
TRACK: Colour = (60, 160, 255)
TEXT: Colour = (255, 255, 255)
LINE_PX = 18

_EDGE: Colour = (0, 0, 0)
_SHADE = 0.35
_CELLS = 8
_GLYPH_PX = 15
_INSET_SHARE = 4
_WRIST = 0
_FINGERS = tuple(tuple(range(first, first + 4)) for first in (1, 5, 9, 13, 17))


def paint_mask(picture: Frame, mask: NDArray[np.uint8], colour: Colour = HAND) -> None:
    """Tint and outline the hand; a smaller mask is scaled up."""
    cv2 = import_opencv("to draw hands")
    height, width = picture.shape[:2]
    inside = (cv2.resize(mask, (width, height), interpolation=cv2.INTER_NEAREST) > 0).astype(np.uint8)
    tinted = picture[inside > 0] * (1 - _SHADE) + np.array(colour) * _SHADE
    picture[inside > 0] = tinted.astype(np.uint8)
    outlines, _ = cv2.findContours(inside, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_SIMPLE)
    cv2.drawContours(picture, outlines, -1, colour, 1)


def paint_joints(picture: Frame, joints: NDArray[np.float32], colour: Colour = HAND) -> None:
    """The 21 joints of a hand (in pixels) and the bones between them."""
    cv2 = import_opencv("to draw hands")
    places = [(round(float(x)), round(float(y))) for x, y in joints]
    for finger in _FINGERS:
        for start, end in zip((_WRIST, *finger), finger, strict=False):
            cv2.line(picture, places[start], places[end], colour, 1, cv2.LINE_AA)
    for place in places:
        cv2.circle(picture, place, 2, TEXT, -1)


def paint_track(picture: Frame, track: Sequence[tuple[float, float]], colour: Colour = TRACK) -> None:
    """A way through places in shares of the picture's width and height."""
    cv2 = import_opencv("to draw hands")
    height, width = picture.shape[:2]
    places = np.array([(x * width, y * height) for x, y in track], dtype=np.int32).reshape(-1, 1, 2)
    cv2.polylines(picture, [places], False, colour, 2)


def paint_edges(picture: Frame, grey: Frame, mask: Frame) -> None:
    """In the upper right corner, the orientation histograms of the hand, as recognisers get them: strokes along the
    edges, the longer and brighter the more edges run that way."""
    if not mask.any():
        return
    cv2 = import_opencv("to draw hands")
    height, width = picture.shape[:2]
    side = width // _INSET_SHARE
    glyphs = cv2.resize(_glyphs(_square(grey, mask, cv2), cv2), (side, side), interpolation=cv2.INTER_AREA)
    picture[: min(side, height), width - side :] = glyphs[:height]


def paint_lines(picture: Frame, lines: Iterable[str]) -> None:
    """Lines of text from the upper left corner on; letters that OpenCV's font has not become question marks."""
    for number, line in enumerate(lines):
        paint_text(picture, line, (6, LINE_PX * (number + 1)), 0.5)


def paint_text(picture: Frame, text: str, place: tuple[int, int], size: float) -> None:
    """White letters with a dark edge, from the lower left corner of the first one on."""
    cv2 = import_opencv("to draw hands")
    printable = text.encode("ascii", "replace").decode()
    # Thicker letters would be wider in some versions of OpenCV: the edge is the same letters, moved.
    for across, down, colour in ((-1, 0, _EDGE), (1, 0, _EDGE), (0, -1, _EDGE), (0, 1, _EDGE), (0, 0, TEXT)):
        corner = (place[0] + across, place[1] + down)
        cv2.putText(picture, printable, corner, cv2.FONT_HERSHEY_SIMPLEX, size, colour, 1, cv2.LINE_AA)


def _glyphs(square: NDArray[np.float32], cv2: Any) -> Frame:
    options = OrientationHistogramOptions(num_cells=_CELLS, num_bins=9)
    histogram = np.asarray(orientation_histogram(square, options))
    blocks: NDArray[np.float32] = histogram.reshape(_CELLS - 1, _CELLS - 1, 4, options.num_bins)
    glyphs = np.zeros(((_CELLS - 1) * _GLYPH_PX, (_CELLS - 1) * _GLYPH_PX, 3), np.uint8)
    for (row, column), weights in ((place, blocks[place][0]) for place in np.ndindex(blocks.shape[:2])):
        centre = np.array((column + 0.5, row + 0.5)) * _GLYPH_PX
        for number in np.argsort(weights):  # the strongest on top
            share = float(weights[number]) / max(1e-6, float(blocks.max()))
            along = np.pi * (number + 0.5) / options.num_bins + np.pi / 2  # an edge runs across its gradient
            reach = 0.5 * _GLYPH_PX * share * np.array((np.cos(along), np.sin(along)))
            start, end = ([round(float(v)) for v in centre + sign * reach] for sign in (-1, 1))
            cv2.line(glyphs, start, end, tuple(int(share * v) for v in TEXT), 1)
    return glyphs


def _square(grey: Frame, mask: Frame, cv2: Any) -> NDArray[np.float32]:
    """The square around the hand, 0..1."""
    rows, columns = np.nonzero(mask)
    side = int(max(np.ptp(rows), np.ptp(columns))) + 1
    top, left = int(rows.min()), int(columns.min())
    crop = grey[top : top + side, left : left + side]
    return np.sqrt(cv2.resize(crop, (8 * _CELLS, 8 * _CELLS)).astype(np.float32) / 255.0)
