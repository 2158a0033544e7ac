# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Whether the quality of a silhouette separates good masks from bad ones: against the hull of MediaPipe's joints."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.core.optional import import_opencv
from hri.datasets import Dataset
from hri.media import read_frames
from hri.studies.registry import Layout, Progress, Study
from hri.studies.webcam import FOLDER, PATTERN
from hri.vision.landmarks import find_landmarks

WAYS = ("learned", "chroma_otsu", "hsv_narrow", "hsv_wide", "grey_otsu")
ALL = "all"
TARGET = 0.85
GOOD, BAD = 0.5, 0.3
"""Masks share so much with the hull, or so little; a hand does not fill its hull, so that good ones share 0.65."""

_STEP = 8
_FLESH = 0.12
"""Joints lie within the hand: by how much of its size the hull grows."""


def _finders(frames: Sequence[NDArray[np.uint8]], ways: Sequence[Any]) -> dict[str, Any]:
    from hri.vision import HandColours, SilhouetteExtractor, SilhouetteOptions

    finders: dict[str, Any] = {}
    for way in ways:
        if way != "learned":
            finders[way] = SilhouetteExtractor(SilhouetteOptions(method=way))
        elif (colours := HandColours.learn(list(frames))) is not None:
            finders[way] = colours
    return finders


def shared_with_hull(mask: NDArray[np.bool_], joints: NDArray[np.float32], frame_size: tuple[int, int]) -> float:
    """What mask and hull share, of what either covers."""
    cv2 = import_opencv("to draw hulls")
    height, width = mask.shape
    places = (joints * np.array([width / frame_size[0], height / frame_size[1]])).astype(np.int32)
    hull = np.zeros(mask.shape, np.uint8)
    cv2.fillConvexPoly(hull, cv2.convexHull(places), 1)
    side = max(3, int(_FLESH * np.sqrt(hull.sum())) | 1)
    grown = cv2.dilate(hull, np.ones((side, side), np.uint8)) > 0
    return float((mask & grown).sum() / (mask | grown).sum())


def _separated(shared: NDArray[np.float64], quality: NDArray[np.float64]) -> float | None:
    """Of how many pairs of a good and a bad mask the good one has the higher quality; None without both."""
    good, bad = quality[shared >= GOOD], quality[shared < BAD]
    return float((good[:, None] > bad).mean()) if len(good) and len(bad) else None


def _row(way: str, pairs: Sequence[tuple[float, float]]) -> dict[str, Any]:
    shared, quality = np.array(pairs).reshape(-1, 2).T
    varied = len(pairs) > 1 and shared.std() > 0 and quality.std() > 0
    return {
        "way": way,
        "counts": {"masks": len(pairs)},
        "shared_mean": float(shared.mean()) if len(pairs) else None,
        "quality_mean": float(quality.mean()) if len(pairs) else None,
        "correlation_mean": float(np.corrcoef(shared, quality)[0, 1]) if varied else None,
        "separated_mean": _separated(shared, quality),
    }


def _run(data_dir: Path, progress: Progress, *, way: Sequence[str] = WAYS) -> dict[str, Any]:
    dataset = Dataset.load(data_dir / FOLDER, "gesture", PATTERN)
    pairs: dict[str, list[tuple[float, float]]] = {name: [] for name in way}
    for done, sample in enumerate(dataset.samples):
        frames = read_frames(sample.path).frames
        finders, chosen = _finders(frames, way), frames[::_STEP]
        for frame, joints in zip(chosen, find_landmarks(chosen, each_alone=True), strict=True):
            if joints is None:
                continue
            for name, finder in finders.items():
                found = finder.extract(np.ascontiguousarray(frame))
                if (mask := np.asarray(found.mask) > 0).any():
                    size = (frame.shape[1], frame.shape[0])
                    pairs[name].append((shared_with_hull(mask, joints, size), float(found.quality)))
        progress("finding hands", done + 1, len(dataset))
    rows = [_row(name, pairs[name]) for name in way]
    rows.append(_row(ALL, [pair for found in pairs.values() for pair in found]))
    return {"rows": rows, "every": _STEP, "passed": (rows[-1]["separated_mean"] or 0.0) >= TARGET}


STUDIES = (
    Study(
        "mask-quality",
        "whether the quality of a silhouette separates masks that fit MediaPipe's joints from those that do not",
        (FOLDER,),
        f"all ways together: {100 * TARGET:.0f} % of pairs of a good and a bad mask in the right order",
        _run,
        layout=Layout(measure="separated"),
        axes={"way": WAYS},
        sources=("cpp/vision",),
    ),
)
