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
LANDMARKS = "landmarks"
WAYS = ("without-face", "with-face", LANDMARKS)
TARGETS = {"found": 0.93, "shared": 0.65}
"""Of silhouettes with the face, of `hand` where nothing was chosen, and of `body`."""
LANDMARKS_TARGET = 0.99
"""Of all pictures with a sign, those in which MediaPipe finds a hand."""
FOUND = 0.3
"""What mask and hull share, of what either covers, from which on the hand is found."""

NO_SIGN = "no_class"
ALL = "all"
_CHOSEN_ON = 4
"""The options were chosen on every fourth picture of `hand`, in the order of paths, and on all of `body`."""


def measured_hands(joints: Sequence[Landmarks], folder: str) -> list[Landmarks]:
    """Those that are measured: of signs of one hand the upper one, as the other hangs."""
    if folder == "body":
        return list(joints)
    return sorted(joints, key=lambda points: float(points[:, 1].mean()))[:1]


def off_face(joints: Sequence[Landmarks], face: Any) -> list[Landmarks]:
    """Hands whose middle is not in the face that is seen: of small persons MediaPipe takes the face for a hand."""
    if face is None:
        return list(joints)
    corner = np.array([face.left_px, face.top_px])
    places = [(points[:, :2].mean(axis=0) - corner) / face.side_px for points in joints]
    return [points for points, place in zip(joints, places, strict=True) if (place < 0).any() or (place > 1).any()]


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


def _row(
    folder: str, pictures: str, way: str, shared: Sequence[float], faces: Sequence[bool], others: dict[str, int]
) -> dict[str, Any]:
    return {
        "signs": folder,
        "pictures": pictures,
        "way": way,
        "counts": {"pictures": len(faces), "hands": len(shared), **others},
        "found_mean": float(np.mean(np.array(shared) >= FOUND)) if shared else None,
        "shared_mean": float(np.mean(shared)) if shared else None,
        "face_mean": float(np.mean(faces)) if faces else None,
    }


def _landmarks_row(folder: str, hands: Sequence[int]) -> dict[str, Any]:
    """Of the numbers of hands that MediaPipe finds, picture by picture."""
    return {
        "signs": folder,
        "pictures": ALL,
        "way": LANDMARKS,
        "counts": {"pictures": len(hands), "hands": sum(hands), "without joints": hands.count(0)},
        "found_mean": float(np.mean(np.array(hands) > 0)) if hands else None,
    }


def _measure(
    paths: Sequence[Path], folder: str, way: Sequence[str], faces: Any, progress: Progress
) -> list[dict[str, Any]]:
    max_hands = 2 if folder == "body" else 1
    parts = ("chosen on", "others") if folder == "hand" else ("chosen on",)
    by_masks = [name for name in way if name != LANDMARKS]
    shared: dict[tuple[str, str], list[float]] = {(part, name): [] for part in parts for name in by_masks}
    seen: dict[str, list[bool]] = {part: [] for part in parts}
    hands: dict[str, list[int]] = {part: [] for part in parts}
    on_face = dict.fromkeys(parts, 0)
    with LandmarkTracker(each_alone=True, max_hands=2) as tracker:
        for number, path in enumerate(paths):
            progress(f"finding hands in {folder}", number + 1, len(paths))
            if NO_SIGN in path.parts:
                continue
            frame = read_image(path)
            part = "others" if folder == "hand" and number % _CHOSEN_ON else "chosen on"
            face, all_joints = faces.find_in_still(frame), tracker.find_all(frame)
            there = off_face(all_joints, face)
            on_face[part] += len(all_joints) - len(there)
            joints = measured_hands(there, folder)
            hands[part].append(len(joints))
            if joints and by_masks:
                seen[part].append(face is not None)
                for name in by_masks:
                    used = faces if name == "with-face" else "never"
                    shared[part, name] += _shares(frame, joints, max_hands, used)
    rows = [
        _row(
            folder,
            part,
            name,
            shared[part, name],
            seen[part],
            {"without joints": hands[part].count(0), "joints on a face": on_face[part]},
        )
        for part in parts
        for name in by_masks
    ]
    every = [count for part in parts for count in hands[part]]
    return [*rows, _landmarks_row(folder, every)] if LANDMARKS in way else rows


def _verdicts(rows: Sequence[dict[str, Any]]) -> dict[str, bool]:
    """Whether what was measured meets its targets."""
    met = {}
    for row in rows:
        place = f"{row['signs']}, {row['way']}"
        if row["way"] == LANDMARKS:
            met[f"{place}, found"] = (row["found_mean"] or 0.0) >= LANDMARKS_TARGET
        elif row["way"] == "with-face" and (row["signs"], row["pictures"]) != ("hand", "chosen on"):
            for name, least in TARGETS.items():
                met[f"{place}, {name}"] = (row[f"{name}_mean"] or 0.0) >= least
    return met


def _run(
    data_dir: Path, progress: Progress, *, signs: Sequence[str] = FOLDERS, way: Sequence[str] = WAYS
) -> dict[str, Any]:
    faces = face_finder(required=True)
    rows: list[dict[str, Any]] = []
    for folder in signs:
        paths = sorted((data_dir / DATA / folder).glob("*/*.jpg"))
        rows += _measure(paths, folder, way, faces, progress)
    met = _verdicts(rows)
    return {"rows": rows, "found_from": FOUND, "passed_by": met, "passed": all(met.values()) if met else None}


STUDIES = (
    Study(
        "hands-in-rooms",
        "whether silhouettes are the signing hand where persons stand in a furnished room, with and without their face",
        (DATA,),
        f"silhouettes with the face, of one hand where nothing was chosen and of both hands: "
        f"{100 * TARGETS['found']:.0f} % found, mean shared area {TARGETS['shared']:.2f}; landmarks: "
        f"{100 * LANDMARKS_TARGET:.0f} % of pictures",
        _run,
        layout=Layout(measure="found"),
        axes={"signs": FOLDERS, "way": WAYS},
        sources=("cpp/vision",),
    ),
)
