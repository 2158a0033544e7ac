# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Hands in pictures against the same steps written with OpenCV in Python."""

from __future__ import annotations

import cv2
import numpy as np

from hri import _native, _native_vision
from timing import Bench, Timed, medians

cv2.setNumThreads(1)


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
    extractor = _native_vision.SilhouetteExtractor(_native_vision.SilhouetteOptions())
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
    options = _native.OrientationHistogramOptions(num_cells=8, num_bins=9)
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

    assert np.allclose(_native.orientation_histogram(image, options), peer().ravel(), atol=1e-3)
    return medians(lambda: _native.orientation_histogram(image, options), peer, 101)


BENCHES = [
    Bench("silhouette", silhouette, "OpenCV in Python"),
    Bench("orientation_histogram", orientation_histogram, "OpenCV and NumPy"),
]
