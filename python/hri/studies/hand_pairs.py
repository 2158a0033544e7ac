# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Whether labels stay with two hands that go along the ways of signed sentences; the masks are drawn."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.core.optional import import_opencv
from hri.datasets.asl_sentences import SignedSentence, read_asl_sentences
from hri.features import HandPairTracker
from hri.studies.registry import Layout, Progress, Study

FOLDER = "asl_sentences"
RULES = ("tracker", "by place")
TARGET = 0.95

_SIZE = (320, 260)
"""Width and height of a mask; the ways lie within."""
_PALM_PX = 15
_FINGERS = (4, 0)
"""Of the dominant hand, which hides the other one, and of this: a fist."""


def draw_mask(places: Sequence[tuple[float, float]]) -> NDArray[np.uint8]:
    """Two hands, 255 where either is."""
    cv2 = import_opencv("to draw hands")
    mask = np.zeros(_SIZE[::-1], np.uint8)
    for (x, y), num_fingers in zip(places, _FINGERS, strict=True):
        middle = (round(x), round(y))
        cv2.circle(mask, middle, _PALM_PX, 255, -1)
        for finger in range(num_fingers):
            angle = 1.4 * (finger / (num_fingers - 1) - 0.5)
            tip = (x + 2.2 * _PALM_PX * np.sin(angle), y - 2.2 * _PALM_PX * np.cos(angle))
            cv2.line(mask, middle, (round(tip[0]), round(tip[1])), 255, 6)
    return mask


def _ways(sentence: SignedSentence) -> list[list[tuple[float, float]]]:
    """Places of the dominant hand, which is the right one, and of the other, in every frame."""
    return [[(float(x), float(y)) for x, y in (right, left)] for left, right, _ in sentence.positions]


def _labels(ways: Sequence[Sequence[tuple[float, float]]], rule: str) -> list[tuple[bool, bool]]:
    """For every frame in which both are seen: whether "left" is the dominant hand, and whether they touch."""
    tracker = HandPairTracker()
    labels = []
    for places in ways:
        hands = tracker.push(draw_mask(places))
        if not all(hand.seen for hand in hands):
            continue
        far = [[float(np.hypot(hand.x_px - x, hand.y_px - y)) for x, y in places] for hand in hands]
        straight = far[0][0] + far[1][1] <= far[0][1] + far[1][0]
        labels.append((straight if rule == "tracker" else places[0][0] <= places[1][0], hands[0].touching))
    return labels


def _row(rule: str, found: Sequence[Sequence[tuple[bool, bool]]]) -> dict[str, Any]:
    apart = [[straight for straight, touching in labels if not touching] for labels in found]
    apart = [labels for labels in apart if labels]
    kept = [label == labels[0] for labels in apart for label in labels]
    counts = {
        "frames apart": len(kept),
        "sentences": len(apart),
        "times parted": sum(_count_partings([touching for _, touching in labels]) for labels in found),
        "swaps": sum(sum(a != b for a, b in pairwise(labels)) for labels in apart),
    }
    return {
        "rule": rule,
        "counts": counts,
        "kept_mean": float(np.mean(kept)) if kept else None,
        "whole_mean": float(np.mean([len(set(labels)) == 1 for labels in apart])) if apart else None,
    }


def _count_partings(touching: Sequence[bool]) -> int:
    return sum(before and not now for before, now in pairwise(touching))


def _run(data_dir: Path, progress: Progress, *, rule: Sequence[str] = RULES) -> dict[str, Any]:
    sentences = [_ways(sentence) for sentence in read_asl_sentences(data_dir / FOLDER)]
    rows = []
    for name in rule:
        found = []
        for done, ways in enumerate(sentences):
            found.append(_labels(ways, name))
            progress(f"following hands, {name}", done + 1, len(sentences))
        rows.append(_row(name, found))
    ours = [row["kept_mean"] or 0.0 for row in rows if row["rule"] == "tracker"]
    return {"rows": rows, "synthetic": True, "passed": ours[0] >= TARGET if ours else None}


STUDIES = (
    Study(
        "hand-pairs",
        "labels of two drawn hands that go along the ways of 161 signed sentences, while they touch and cross",
        (FOLDER,),
        f"the tracker keeps the first labels in {100 * TARGET:.0f} % of frames in which hands are apart",
        _run,
        layout=Layout(measure="kept"),
        axes={"rule": RULES},
        sources=("cpp/features/hand",),
        quick={"rule": ("tracker",)},
    ),
)
