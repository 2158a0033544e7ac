# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What a watcher finds, drawn: the picture, the hand's mask, outline, track and features, and the n-best list."""

from __future__ import annotations

import numpy as np

from hri.live.frame_results import FrameResult
from hri.live.frames import Frame
from hri.live.visibility import MISSING_TEXTS
from hri.recognition import Decision
from hri.vision.drawing import paint_edges, paint_lines, paint_mask, paint_track


def draw_result(result: FrameResult, decision: Decision | None, top: int = 3) -> Frame | None:
    """The picture of a result with what was found in it; None for a result without a picture.

    In the upper right corner, the orientation histograms of the hand, as recognisers get them: strokes along the edges.
    Letters that OpenCV's font has not become question marks.
    """
    if result.frame is None or result.mask is None:
        return None
    picture = np.array(result.frame, dtype=np.uint8)
    paint_mask(picture, result.mask)
    paint_track(picture, result.track)
    if result.hand is not None:
        paint_edges(picture, result.hand.grey, result.hand.mask)
    paint_lines(picture, _lines(result, decision, top))
    return picture


def _lines(result: FrameResult, decision: Decision | None, top: int) -> list[str]:
    state = "gesture" if result.in_gesture else "hand" if result.mask is not None and result.mask.any() else "no hand"
    lines = [f"{result.time_s:6.2f} s  {state}  quality {result.quality:.2f}"]
    if result.missing:
        lines.append(MISSING_TEXTS[result.missing]["en"])
    if decision is not None:
        lines.append(decision.label)
        lines += [f"{entry.label} {entry.probability:.2f}" for entry in decision.nbest[:top]]
    return lines
