# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Hands in pictures against the same steps written with OpenCV in Python."""

from __future__ import annotations

import statistics
import tempfile
import time
from collections.abc import Callable, Sequence
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import cv2
import numpy as np

import hand_pictures
from hri import features, vision
from hri.features import GestureFeatureComputer, OrientationHistogramOptions
from hri.media import write_video
from timing import Bench, Details, Timed, medians

cv2.setNumThreads(1)
_FRAME_REPEATS = 301


def _picture(width: int, height: int) -> np.ndarray:
    """A hand-like blob of skin colour on a bluish wall, with noise, uint8 BGR."""
    rng = np.random.default_rng(0)
    image = np.full((height, width, 3), (170, 150, 140), np.uint8)
    centre, skin = (width // 2, height // 2), (110, 140, 200)
    cv2.ellipse(image, centre, (width // 8, height // 6), 0, 0, 360, skin, -1)
    for angle in (-40, -15, 10, 35):
        tip = (
            int(centre[0] + 0.35 * height * np.sin(np.deg2rad(angle))),
            int(centre[1] - 0.35 * height * np.cos(np.deg2rad(angle))),
        )
        cv2.line(image, centre, tip, skin, height // 14)
    return np.clip(image + rng.normal(0, 4, image.shape), 0, 255).astype(np.uint8)


def _python_silhouette(frame: np.ndarray) -> np.ndarray:
    """The steps of SilhouetteExtractor for a picture with one hand."""
    scale = 320 / max(frame.shape[:2])
    small = cv2.resize(frame, None, fx=scale, fy=scale, interpolation=cv2.INTER_AREA)
    cv2.cvtColor(small, cv2.COLOR_BGR2GRAY)
    _, cr, cb = cv2.split(cv2.cvtColor(cv2.GaussianBlur(small, (5, 5), 0), cv2.COLOR_BGR2YCrCb))
    redness = cv2.addWeighted(cr, 1.0, cb, -1.0, 128.0)
    mask = cv2.threshold(redness, 0, 255, cv2.THRESH_OTSU)[1]
    inside, outside = cv2.mean(redness, mask)[0], cv2.mean(redness, 255 - mask)[0]
    assert inside - outside > 5
    _, labels, stats, _ = cv2.connectedComponentsWithStats(cv2.medianBlur(mask, 5))
    return np.where(labels == 1 + np.argmax(stats[1:, cv2.CC_STAT_AREA]), 255, 0).astype(np.uint8)


def silhouette() -> Timed:
    """The hand's mask in a picture of 640 x 480."""
    frame = _picture(640, 480)
    extractor = vision.SilhouetteExtractor(vision.SilhouetteOptions())
    ours, theirs = np.asarray(extractor.extract(frame).mask), _python_silhouette(frame)
    assert np.mean((ours > 0) == (theirs > 0)) > 0.995
    return medians(lambda: extractor.extract(frame), lambda: _python_silhouette(frame), 31)


def _shares(count: int, cells: int) -> np.ndarray:
    """Share of every row (or column) of a picture in every cell, shape (cells, count)."""
    position = (np.arange(count) + 0.5) * cells / count - 0.5
    return np.maximum(0, 1 - np.abs(position - np.arange(cells)[:, None])).astype(np.float32)


def orientation_histogram() -> Timed:
    """Histograms of 8 x 8 cells and 9 bins of a crop of 64 x 64, shared out linearly, blocks normalised."""
    image = cv2.resize(cv2.cvtColor(_picture(320, 240), cv2.COLOR_BGR2GRAY), (64, 64)).astype(np.float32)
    options = OrientationHistogramOptions(num_cells=8, num_bins=9)
    share = _shares(64, 8)
    pixels = np.arange(64 * 64)

    def peer() -> np.ndarray:
        across, down = cv2.Sobel(image, cv2.CV_32F, 1, 0, ksize=1), cv2.Sobel(image, cv2.CV_32F, 0, 1, ksize=1)
        length, angle = cv2.cartToPolar(across, down, angleInDegrees=True)
        length[[0, -1]] = length[:, [0, -1]] = 0
        place = angle.ravel() / 20 - 0.5
        below = np.floor(place)
        upper = (place - below) * length.ravel()
        first = below.astype(int) % 9
        planes = np.zeros((9, 64 * 64), np.float32)
        planes[first, pixels] = length.ravel() - upper
        planes[(first + 1) % 9, pixels] = upper
        counts = (share @ planes.reshape(9, 64, 64) @ share.T).transpose(1, 2, 0)
        blocks = np.concatenate([counts[:-1, :-1], counts[:-1, 1:], counts[1:, :-1], counts[1:, 1:]], axis=2)
        blocks /= np.sqrt(np.sum(blocks * blocks, axis=2, keepdims=True) + 0.01)
        blocks = np.minimum(blocks, 0.2)
        return blocks / np.sqrt(np.sum(blocks * blocks, axis=2, keepdims=True) + 1e-3)

    assert np.allclose(features.orientation_histogram(image, options), peer().ravel(), atol=1e-3)
    return medians(lambda: features.orientation_histogram(image, options), peer, 101)


def _fixed_bounds(frame: np.ndarray) -> np.ndarray:
    """The mask that most programs make: blur, fixed HSV bounds, opening and closing."""
    hsv = cv2.cvtColor(cv2.GaussianBlur(frame, (5, 5), 0), cv2.COLOR_BGR2HSV)
    mask = cv2.inRange(hsv, (0, 0.23 * 255, 40), (25, 0.68 * 255, 255))
    square = np.ones((5, 5), np.uint8)
    return cv2.morphologyEx(cv2.morphologyEx(mask, cv2.MORPH_OPEN, square), cv2.MORPH_CLOSE, square)


def _small_fixed_bounds(frame: np.ndarray) -> np.ndarray:
    """The same in a picture as small as HandColours looks at."""
    return _fixed_bounds(cv2.resize(frame, (160, 120), interpolation=cv2.INTER_AREA))


def _python_hand(mask: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The largest outline, and its moments."""
    outlines, _ = cv2.findContours(mask, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_SIMPLE)
    hand = max(outlines, key=cv2.contourArea)
    moments = cv2.moments(hand)
    return hand, np.append(cv2.HuMoments(moments), (moments["m10"], moments["m01"])) / moments["m00"]


def _agree(mask: np.ndarray, outline: np.ndarray) -> bool:
    """Whether the mask is the hand that fixed bounds find in the whole picture."""
    theirs = np.zeros((hand_pictures.HEIGHT, hand_pictures.WIDTH), np.uint8)
    cv2.drawContours(theirs, [outline], -1, 255, cv2.FILLED)
    found, wanted = mask > 0, cv2.resize(theirs, mask.shape[::-1], interpolation=cv2.INTER_AREA) > 127
    return bool(np.sum(found & wanted) > 0.85 * np.sum(found | wanted))


def _decode_ms(clip: Sequence[np.ndarray]) -> float:
    """A frame of the clip, from a file in MPEG-4; the same for us and for every peer."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "hand.mp4"
        write_video(path, list(clip), hand_pictures.FPS)
        seconds = []
        for _ in range(5):
            capture = cv2.VideoCapture(str(path))
            begun = time.perf_counter()
            while capture.read()[0]:
                pass
            seconds.append((time.perf_counter() - begun) / len(clip))
            capture.release()
    return 1000 * statistics.median(seconds)


def _tracker_ms(clip: Sequence[np.ndarray]) -> float:
    """A frame by MediaPipe's hand tracker, once it has found the hand."""
    import mediapipe

    seconds = []
    with mediapipe.solutions.hands.Hands(max_num_hands=1, model_complexity=1) as tracker:
        for frame in [*clip, *clip]:
            begun = time.perf_counter()
            tracker.process(np.ascontiguousarray(frame[:, :, ::-1]))
            seconds.append(time.perf_counter() - begun)
    return 1000 * statistics.median(seconds[len(clip) :])


def _hand_frame(
    make_finder: Callable[[Sequence[np.ndarray]], Any], python_mask: Callable[[np.ndarray], np.ndarray]
) -> Timed:
    clip = hand_pictures.hand_clip("right", 2)
    frame, finder = clip[len(clip) // 2], make_finder(clip)
    computer = GestureFeatureComputer()

    def ours() -> Any:
        found = finder.extract(frame)
        return found.mask, computer.compute([found])

    mask, row = ours()
    assert row.shape[0] == 1 and np.isfinite(row).all()
    assert mask.shape == python_mask(frame).shape
    assert _agree(mask, _python_hand(_fixed_bounds(frame))[0])
    details: Details = {"decode_ms": _decode_ms(clip)}
    if find_spec("mediapipe") is not None:
        details["mediapipe_ms"] = _tracker_ms(clip)
    return *medians(ours, lambda: _python_hand(python_mask(frame)), _FRAME_REPEATS), details


def hand_frame() -> Timed:
    """A picture of 640 x 480 to the hand's features, by colours learned from its clip; decoding comes on top. The
    peer: fixed bounds of colour in a picture as small (160 x 120), largest outline, Hu's moments."""
    return _hand_frame(vision.HandColours.learn, _small_fixed_bounds)


def hand_frame_otsu() -> Timed:
    """The same, the hand found in the picture by itself at 320 x 240; the peer by the same steps, and Hu's moments."""
    return _hand_frame(lambda _: vision.SilhouetteExtractor(vision.SilhouetteOptions()), _python_silhouette)


BENCHES = [
    Bench("hand_frame", hand_frame, "OpenCV in Python"),
    Bench("hand_frame_otsu", hand_frame_otsu, "OpenCV in Python"),
    Bench("silhouette", silhouette, "OpenCV in Python"),
    Bench("orientation_histogram", orientation_histogram, "OpenCV and NumPy"),
]
