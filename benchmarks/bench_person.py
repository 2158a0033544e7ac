# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The hand of a person whose face is known, against the same steps written with OpenCV in Python."""

from __future__ import annotations

from typing import Any

import cv2
import numpy as np

from hri.vision import Face, PersonHands
from timing import Bench, Timed, medians

cv2.setNumThreads(1)
_REPEATS = 201
_FACE = Face(280, 120, 64)


def _room() -> tuple[np.ndarray, np.ndarray]:
    """A person beside wood, before a wall, uint8 BGR, 640 x 480; and where the hand is."""
    skin = (125, 150, 200)
    frame = np.full((480, 640, 3), (170, 185, 190), np.uint8)
    frame[180:, 480:] = (60, 100, 165)
    frame[196:, 224:400] = (40, 35, 35)
    cv2.ellipse(frame, (312, 156), (30, 38), 0, 0, 360, skin, -1)
    hand = np.zeros(frame.shape[:2], np.uint8)
    cv2.circle(hand, (160, 240), 22, 255, -1)
    for tip in (-18, 0, 18):
        cv2.line(hand, (160, 240), (160 + tip, 196), 255, 10)
    frame[hand > 0] = skin
    noise = np.random.default_rng(7).normal(0, 2, frame.shape)
    return np.clip(frame + noise, 0, 255).astype(np.uint8), hand


def _shares(ycrcb: np.ndarray, mask: np.ndarray) -> np.ndarray:
    counts = cv2.calcHist([ycrcb], [1, 2], mask, [128, 128], [0, 256, 0, 256])
    smooth = cv2.GaussianBlur(counts, (0, 0), 1.0)
    return smooth / smooth.sum() + 1e-5


def _python_hand(frame: np.ndarray) -> np.ndarray:
    """The steps of PersonHands: histograms of face and room, their ratio on every pixel, regions in reach, twice."""
    scale = 32 / _FACE.side_px
    small = cv2.resize(frame, None, fx=scale, fy=scale, interpolation=cv2.INTER_AREA)
    cv2.cvtColor(small, cv2.COLOR_BGR2GRAY)
    ycrcb = cv2.cvtColor(cv2.GaussianBlur(small, (3, 3), 0), cv2.COLOR_BGR2YCrCb)
    x, y = int((_FACE.left_px + _FACE.side_px / 2) * scale), int((_FACE.top_px + _FACE.side_px / 2) * scale)
    skin, room = np.zeros(small.shape[:2], np.uint8), np.full(small.shape[:2], 255, np.uint8)
    cv2.ellipse(skin, (x, y), (10, 13), 0, 0, 360, 255, -1)
    cv2.rectangle(room, (x - 19, y - 25), (x + 19, y + 30), 0, -1)
    of_room, light = _shares(ycrcb, room), np.median(ycrcb[..., 0][skin > 0])
    dark = (ycrcb[..., 0] < 0.3 * light) | (ycrcb[..., 0] > 2.2 * light)
    hand = skin
    for _ in range(2):
        ratios = np.log(_shares(ycrcb, skin) / of_room).astype(np.float32)
        scores = ratios[ycrcb[..., 1] // 2, ycrcb[..., 2] // 2]
        scores[dark] = -3
        scores = np.clip(cv2.GaussianBlur(scores, (3, 3), 0), -4, 4)
        mask = cv2.medianBlur(np.where((scores > 0) & (room > 0), 255, 0).astype(np.uint8), 3)
        count, labels, stats, centres = cv2.connectedComponentsWithStats(mask)
        near = [i for i in range(1, count) if np.hypot(*(centres[i] - (x, y))) < 3.2 * 32]
        best = max(near, key=lambda i: float(stats[i, cv2.CC_STAT_AREA]))
        hand = np.where(labels == best, 255, 0).astype(np.uint8)
        skin = skin | hand
    return hand


def _shared(mask: np.ndarray, hand: np.ndarray) -> float:
    there = cv2.resize(hand, mask.shape[::-1], interpolation=cv2.INTER_AREA) > 127
    return float(np.sum((mask > 0) & there) / np.sum((mask > 0) | there))


def person_hands() -> Timed:
    """The mask of a person's hand in a picture of 640 x 480 whose face is known."""
    frame, hand = _room()
    hands = PersonHands()

    def ours() -> Any:
        return hands.extract(frame, _FACE).mask

    assert _shared(np.asarray(ours()), hand) > 0.75
    assert _shared(_python_hand(frame), hand) > 0.75
    return medians(ours, lambda: _python_hand(frame), _REPEATS)


BENCHES = [Bench("person_hands", person_hands, "OpenCV in Python")]
