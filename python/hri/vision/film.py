# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""A film of what is found of the hand in a clip: frame, mask, outline, track, features and quality."""

from __future__ import annotations

from collections.abc import Callable
from os import PathLike

import numpy as np
from numpy.typing import NDArray

from hri.core.optional import import_opencv
from hri.media import VideoWriter
from hri.vision.drawing import (
    HAND,
    TEXT,
    TRACK,
    Colour,
    Frame,
    paint_edges,
    paint_joints,
    paint_lines,
    paint_mask,
    paint_text,
    paint_track,
)
from hri.vision.report import FrameHand, HandReport

_NARROWEST_PX = 480
_QUALITY_PX = 56
_FEATURES_PX = 72
_TRACK_S = 2.0
_CORNER = (6, 12)
_COLOURS: dict[str, Colour] = {"hand": HAND, "left": HAND, "right": (230, 170, 60)}
_MOST_VALUES = 16
"""Features that are also written as numbers; more would hide the picture."""
_SPREAD = 2.5
"""Standard deviations from the mean at which a feature is drawn as black or white."""


class HandFilm:
    """Draws the frames of a report.

    Above, the frame with the hand tinted and outlined (or its joints), its way over two seconds, the edges that
    orientation histograms see, and numbers. Below, over the whole clip with a line at this frame, the quality, 0 to 1,
    and the features as a picture, a row each, scaled by its own mean and spread; black where there is no hand. Of two
    hands, each has its colour and its strips.

    Parameters
    ----------
    report : HandReport
    """

    def __init__(self, report: HandReport) -> None:
        import_opencv("to draw hands")
        self._report = report
        height, width = report.clip.frames[0].shape[:2]
        self._scale = max(1, -(-_NARROWEST_PX // width))
        self._panel = self._draw_panel(width * self._scale + (width * self._scale) % 2)
        self._odd_rows = (height * self._scale) % 2  # coders of video want even sizes

    def draw(self, number: int) -> Frame:
        """The picture of one frame, uint8 BGR, larger than the clip's."""
        cv2 = import_opencv("to draw hands")
        frame = self._report.clip.frames[number]
        if self._scale > 1:
            frame = cv2.resize(frame, None, fx=self._scale, fy=self._scale, interpolation=cv2.INTER_CUBIC)
        picture = np.zeros((frame.shape[0] + self._odd_rows, self._panel.shape[1], 3), np.uint8)
        picture[: frame.shape[0], : frame.shape[1]] = frame
        seen = picture[: frame.shape[0], : frame.shape[1]]
        lines = [f"{self._report.clip.times_s[number]:6.2f} s  frame {number}"]
        for side, hands in self._report.hands.items():
            hand = hands[number]
            if hand.mask is not None and hand.grey is not None:
                paint_mask(seen, hand.mask, _COLOURS[side])
                if side == "hand":
                    paint_edges(seen, hand.grey, hand.mask)
            if hand.joints is not None:
                paint_joints(seen, hand.joints * self._scale, _COLOURS[side])
            paint_track(seen, self._track(hands, number))
            lines += self._lines(side, hand)
        paint_lines(seen, lines)
        panel = self._panel.copy()
        column = int((number + 0.5) * panel.shape[1] / len(self._report.clip.frames))
        panel[:, column : column + 1] = TEXT
        return np.vstack([picture, panel])

    def _track(self, hands: list[FrameHand], number: int) -> list[tuple[float, float]]:
        times = self._report.clip.times_s
        first = next(i for i, time_s in enumerate(times) if time_s > times[number] - _TRACK_S)
        recent = hands[first : number + 1]
        return [(hand.x, hand.y) for hand in recent if hand.x is not None and hand.y is not None]

    def _lines(self, side: str, hand: FrameHand) -> list[str]:
        if hand.features is None or hand.x is None or hand.y is None or hand.area is None:
            return [f"no {side}" if side == "hand" else f"no {side} hand"]
        place = f"at {hand.x:.3f} {hand.y:.3f}  area {hand.area:.3f}"
        lines = [f"{side}: quality {hand.quality:.2f}  {place}{'  repaired' if hand.repaired else ''}"]
        if len(self._report.names) <= _MOST_VALUES and side == "hand":
            lines += [f"{name} {value:.3g}" for name, value in zip(self._report.names, hand.features, strict=True)]
        return lines

    def _draw_panel(self, width: int) -> Frame:
        columns = np.arange(width) * len(self._report.clip.frames) // width
        strips = []
        for side, hands in self._report.hands.items():
            quality = np.full((_QUALITY_PX, width, 3), 24, np.uint8)
            levels = np.arange(_QUALITY_PX, 0, -1)[:, None] / _QUALITY_PX
            quality[levels <= np.array([hand.quality for hand in hands])[columns]] = _COLOURS[side]
            quality[_QUALITY_PX // 2] = TRACK  # a half
            features = np.ascontiguousarray(self._draw_features(hands)[:, columns])
            paint_text(quality, f"{side}: quality", _CORNER, 0.4)
            what = f"{side}: {self._report.kind}, {len(self._report.names)} features"
            paint_text(features, what, _CORNER, 0.4)
            strips += [quality, features]
        return np.vstack(strips)

    def _draw_features(self, hands: list[FrameHand]) -> Frame:
        """A column a frame."""
        cv2 = import_opencv("to draw hands")
        picture = cv2.applyColorMap(_scaled(hands, len(self._report.names)), cv2.COLORMAP_MAGMA)
        picture[:, [not hand.found for hand in hands]] = 0
        if picture.shape[0] > _FEATURES_PX:
            return cv2.resize(picture, (picture.shape[1], _FEATURES_PX), interpolation=cv2.INTER_AREA)
        return picture[np.arange(_FEATURES_PX) * picture.shape[0] // _FEATURES_PX]


def _scaled(hands: list[FrameHand], num_features: int) -> NDArray[np.uint8]:
    """Features in grey levels, a row a feature, a column a frame."""
    found = [hand.features for hand in hands if hand.features is not None]
    scaled = np.zeros((num_features, len(hands)), np.uint8)
    if not found:
        return scaled
    values = np.array(found)
    spread = values.std(axis=0)
    apart = (values - values.mean(axis=0)) / np.where(spread > 0, spread, 1.0)
    levels = 127.5 + 127.5 * np.clip(apart / _SPREAD, -1, 1)
    scaled[:, [hand.found for hand in hands]] = levels.T.astype(np.uint8)
    return scaled


def film_hands(
    report: HandReport, path: str | PathLike[str], progress: Callable[[int, int], None] | None = None
) -> None:
    """Write the film of a report; the file appears whole or not at all.

    Parameters
    ----------
    report : HandReport
        From `hri.vision.report.inspect_hands`.
    path : path-like
        The suffix chooses the format, see `hri.media.VideoWriter`.
    progress : callable, optional
        Called with (done, total) frames.
    """
    film = HandFilm(report)
    with VideoWriter(path, report.clip.fps) as writer:
        total = len(report.clip.frames)
        for number in range(total):
            writer.write(film.draw(number))
            if progress is not None:
                progress(number + 1, total)
