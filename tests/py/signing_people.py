# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""People who sign sentences before a camera, synthetic: discs of skin for the face and both hands."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

import hri

FPS = 25.0
HEAD = (160.0, 60.0)
FACE_PX = 40.0
REST = ((60.0, 95.0), (-60.0, 95.0))
"""The person's left and right hand from the head."""
SIGNS = {
    "ball": [[(60, 20), (-60, 20)], [(35, 60), (-35, 60)]],
    "cat": [[(60, 95), (-50, -15)], [(60, 95), (-100, -15)]],
    "stop": [[(80, 30), (-60, 95)], [(110, 90), (-60, 95)]],
}
Tracks = NDArray[np.float32]
Sentence = tuple[Tracks, list[tuple[str, int, int]]]


def signed(words: Sequence[str], seed: int = 0, rest_s: float = 0.32, noise: float = 1.0) -> Sentence:
    """Tracks of shape (num_frames, 3, 2), and the frames of the words, with rest before and behind them."""
    rng = np.random.default_rng(seed)
    rest = [np.array(REST)] * round(rest_s * FPS)
    places, spans = list(rest), []
    for word in words:
        for stroke, frames in zip(SIGNS[word], (6, 12), strict=True):
            before, first = places[-1], len(places)
            places += [before + (np.array(stroke) - before) * t / frames for t in range(1, frames + 1)]
        spans.append((word, first, len(places)))
    places += [places[-1] + (np.array(REST) - places[-1]) * t / 6 for t in range(1, 7)]
    points = np.concatenate([np.array([*places, *rest]), np.zeros((len(places) + len(rest), 1, 2))], axis=1)
    return (points + np.array(HEAD) + noise * rng.normal(size=points.shape)).astype(np.float32), spans


def train_sentences() -> hri.SentenceRecognizer:
    """A recogniser of sentences of ball, cat and stop."""
    rng = np.random.default_rng(3)
    made = [signed([str(w) for w in rng.choice(list(SIGNS), rng.integers(1, 5))], 100 + i) for i in range(30)]
    recognizer = hri.SentenceRecognizer(frames_per_state=4, choose_weights=False)
    return recognizer.fit([tracks for tracks, _ in made], [words for _, words in made])


def film(tracks: Tracks, height: int = 240, seed: int = 0) -> list[NDArray[np.uint8]]:
    """Pictures of a person with the face and the hands at these places; NaN hides one."""
    rng = np.random.default_rng(seed)
    y, x = np.mgrid[:height, : height * 4 // 3] * (240.0 / height)
    wall = np.clip(np.array((120, 90, 60)) + rng.normal(0, 4, (*x.shape, 3)), 0, 255).astype(np.uint8)
    frames = []
    for left, right, head in tracks:
        frame = wall.copy()
        for centre, radius in ((head, 0.55 * FACE_PX), (left, 13.0), (right, 13.0)):
            if np.isfinite(centre).all():
                frame[(x - centre[0]) ** 2 + (y - centre[1]) ** 2 < radius**2] = (110, 140, 205)
        frames.append(frame)
    return frames


class DrawnFace:
    """Finds the face where the drawn person has it."""

    def __init__(self, seen: bool = True) -> None:
        self.seen = seen

    def find(self, bgr: NDArray[np.uint8]) -> Any:
        from hri.vision import Face

        if not self.seen:
            return None
        scale = bgr.shape[0] / 240
        return Face(scale * (HEAD[0] - FACE_PX / 2), scale * (HEAD[1] - FACE_PX / 2), scale * FACE_PX)
