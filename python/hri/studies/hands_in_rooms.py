# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Hands of persons in a furnished room, with faces, sleeves and wood: masks against the hull of MediaPipe's joints."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.core.optional import import_opencv
from hri.media import read_image
from hri.studies.mask_quality import shared_with_hull
from hri.studies.registry import Layout, Progress, Study
from hri.vision.faces import face_finder
from hri.vision.hands import find_hands
from hri.vision.landmarks import Landmarks, LandmarkTracker

Frame = NDArray[np.uint8]

DATA = "people"
FOLDERS = ("hand", "body")
WAYS = ("without-face", "with-face")
TARGETS = {"found": 0.93, "shared": 0.65}
FOUND = 0.3
"""What mask and hull share, of what either covers, from which on the hand is found."""

_NO_SIGN = "no_class"
_CHOSEN_ON = 4
"""The options were chosen on every fourth picture of `hand`, in the order of paths, and on all of `body`."""


def _hands_of(joints: Sequence[Landmarks], folder: str) -> list[Landmarks]:
    """Those that are measured: of signs of one hand the upper one, as the other hangs."""
    if folder == "body":
        return list(joints)
    return sorted(joints, key=lambda points: float(points[:, 1].mean()))[:1]


def _regions(mask: Frame) -> list[NDArray[np.bool_]]:
    cv2 = import_opencv("to separate regions")
    count, labels = cv2.connectedComponents((mask > 0).astype(np.uint8))
    return [labels == number for number in range(1, count)]


def _shares(frame: Frame, joints: Sequence[Landmarks], max_hands: int, faces: Any) -> list[float]:
    """Of every hand, what its hull shares with the mask that fits it best."""
    sides = find_hands([frame], max_hands, faces=faces).values()
    masks = [region for (hand,) in sides for region in _regions(np.asarray(hand.mask))]
    size = (frame.shape[1], frame.shape[0])
    return [max((shared_with_hull(mask, points, size) for mask in masks), default=0.0) for points in joints]


def _row(folder: str, pictures: str, way: str, shared: Sequence[float], faces: Sequence[bool]) -> dict[str, Any]:
    return {
        "signs": folder,
        "pictures": pictures,
        "way": way,
        "counts": {"pictures": len(faces), "hands": len(shared)},
        "found_mean": float(np.mean(np.array(shared) >= FOUND)) if shared else None,
        "shared_mean": float(np.mean(shared)) if shared else None,
        "face_mean": float(np.mean(faces)) if faces else None,
    }


def _measure(
    paths: Sequence[Path], folder: str, way: Sequence[str], faces: Any, progress: Progress
) -> list[dict[str, Any]]:
    max_hands = 2 if folder == "body" else 1
    parts = ("chosen on", "others") if folder == "hand" else ("chosen on",)
    shared: dict[tuple[str, str], list[float]] = {(part, name): [] for part in parts for name in way}
    seen: dict[str, list[bool]] = {part: [] for part in parts}
    with LandmarkTracker(each_alone=True, max_hands=2) as tracker:
        for number, path in enumerate(paths):
            frame = read_image(path)
            part = "others" if folder == "hand" and number % _CHOSEN_ON else "chosen on"
            joints = _hands_of(tracker.find_all(frame), folder)
            if joints and _NO_SIGN not in path.parts:
                seen[part].append(faces.find(frame) is not None)
                for name in way:
                    used = faces if name == "with-face" else "never"
                    shared[part, name] += _shares(frame, joints, max_hands, used)
            progress(f"finding hands in {folder}", number + 1, len(paths))
    return [_row(folder, part, name, shared[part, name], seen[part]) for part in parts for name in way]


def _run(
    data_dir: Path, progress: Progress, *, signs: Sequence[str] = FOLDERS, way: Sequence[str] = WAYS
) -> dict[str, Any]:
    faces = face_finder(required=True)
    rows: list[dict[str, Any]] = []
    for folder in signs:
        paths = sorted((data_dir / DATA / folder).glob("*/*.jpg"))
        rows += _measure(paths, folder, way, faces, progress)
    wanted = {"signs": "hand", "pictures": "others", "way": "with-face"}
    of_hand = [row for row in rows if wanted.items() <= row.items()]
    reached = [all((row[f"{name}_mean"] or 0.0) >= least for name, least in TARGETS.items()) for row in of_hand]
    return {"rows": rows, "found_from": FOUND, "passed": all(reached) if reached else None}


STUDIES = (
    Study(
        "hands-in-rooms",
        "whether silhouettes are the signing hand where persons stand in a furnished room, with and without their face",
        (DATA,),
        f"signs of one hand, pictures that nothing was chosen on: {100 * TARGETS['found']:.0f} % found, "
        f"mean shared area {TARGETS['shared']:.2f}",
        _run,
        layout=Layout(measure="found"),
        axes={"signs": FOLDERS, "way": WAYS},
        sources=("cpp/vision",),
    ),
)
