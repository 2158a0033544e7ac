# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What a watcher sees, drawn: the picture, the hand's mask, outline, track and features, and the n-best list."""

from __future__ import annotations

import numpy as np

from hri.live.frames import Frame
from hri.live.sights import Sight
from hri.recognition import Decision
from hri.vision.drawing import paint_edges, paint_lines, paint_mask, paint_track


def draw_sight(sight: Sight, decision: Decision | None, top: int = 3) -> Frame | None:
    """The picture of a sight with what was found in it; None for a sight without a picture.

    In the upper right corner, the orientation histograms of the hand, as recognisers get them: strokes along the edges.
    Letters that OpenCV's font has not become question marks.
    """
    if sight.frame is None or sight.mask is None:
        return None
    picture = np.array(sight.frame, dtype=np.uint8)
    paint_mask(picture, sight.mask)
    paint_track(picture, sight.track)
    if sight.silhouette is not None:
        paint_edges(picture, sight.silhouette.grey, sight.silhouette.mask)
    paint_lines(picture, _lines(sight, decision, top))
    return picture


def _lines(sight: Sight, decision: Decision | None, top: int) -> list[str]:
    state = "moving" if sight.running else "hand" if sight.mask is not None and sight.mask.any() else "no hand"
    lines = [f"{sight.time_s:6.2f} s  {state}  quality {sight.quality:.2f}"]
    if decision is not None:
        lines.append(decision.label)
        lines += [f"{entry.label} {entry.probability:.2f}" for entry in decision.nbest[:top]]
    return lines
