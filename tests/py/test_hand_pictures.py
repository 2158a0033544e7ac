# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The library's own steps over pixels give what OpenCV gives."""

from __future__ import annotations

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray

from hri import _native_vision

Frame = NDArray[np.uint8]


def film(size: tuple[int, int]) -> list[Frame]:
    """A hand of two fingers that goes right, with specks of skin colour beside it."""
    rng = np.random.default_rng(0)
    frames = []
    for t in range(8):
        picture = np.full((120, 160, 3), (170, 150, 140), np.uint8)
        skin, x = (110, 140, 200), 50 + 3 * t
        cv2.circle(picture, (x, 70), 16, skin, -1)
        cv2.line(picture, (x - 6, 70), (x - 12, 36), skin, 7)
        cv2.line(picture, (x + 6, 70), (x + 14, 38), skin, 7)
        for speck in rng.integers(5, 115, (4, 2)):
            cv2.circle(picture, tuple(int(v) for v in speck), 3, skin, -1)
        large = cv2.resize(picture, size, interpolation=cv2.INTER_LINEAR)
        frames.append(np.clip(large + rng.normal(0, 6, large.shape), 0, 255).astype(np.uint8))
    return frames


@pytest.mark.parametrize(
    "size", [(160, 120), (320, 240), (480, 360), (640, 480), (800, 600), (1280, 720), (480, 640), (333, 250), (90, 67)]
)
def test_pictures_are_scaled_down_and_greyed_as_opencv_does(size: tuple[int, int]) -> None:
    clip = film(size)
    colours = _native_vision.HandColours.learn(clip)
    assert colours is not None
    scale = min(1.0, 160 / max(size))
    small = cv2.resize(clip[3], (round(size[0] * scale), round(size[1] * scale)), interpolation=cv2.INTER_AREA)
    found = colours.extract(clip[3])
    np.testing.assert_array_equal(found.grey, cv2.cvtColor(small, cv2.COLOR_BGR2GRAY))


def test_the_mask_is_the_largest_region_of_what_most_neighbours_are() -> None:
    clip = film((640, 480))
    options = _native_vision.HandColourOptions
    everything = _native_vision.HandColours.learn(clip, options(min_area=0.0))
    for frame in clip:
        mask = everything.extract(frame).mask
        count, _, stats, _ = cv2.connectedComponentsWithStats(mask)
        assert count == 2 and stats[1, cv2.CC_STAT_AREA] > 1000
        # The rule of this picture by hand: red above blue is skin.
        small = cv2.resize(frame, (160, 120), interpolation=cv2.INTER_AREA).astype(int)
        skin = cv2.medianBlur(np.where(small[:, :, 2] > small[:, :, 0] + 25, 255, 0).astype(np.uint8), 3)
        _, labels, regions, _ = cv2.connectedComponentsWithStats(skin)
        wanted = labels == 1 + np.argmax(regions[1:, cv2.CC_STAT_AREA])
        assert ((mask > 0) & wanted).sum() > 0.95 * ((mask > 0) | wanted).sum()


@pytest.mark.parametrize("size", [(640, 480), (320, 240), (333, 250), (1280, 720), (31, 7)])
def test_a_single_picture_is_split_as_opencv_does_it(size: tuple[int, int]) -> None:
    frame = film(size)[2]
    scale = min(1.0, 320 / max(size))
    small = frame
    if scale < 1:
        small = cv2.resize(frame, (round(size[0] * scale), round(size[1] * scale)), interpolation=cv2.INTER_AREA)
    _, red, blue = cv2.split(cv2.cvtColor(cv2.GaussianBlur(small, (5, 5), 0), cv2.COLOR_BGR2YCrCb))
    redness = cv2.addWeighted(red, 1.0, blue, -1.0, 128.0)
    _, raw = cv2.threshold(redness, 0, 255, cv2.THRESH_BINARY | cv2.THRESH_OTSU)
    _, labels, stats, _ = cv2.connectedComponentsWithStats(cv2.medianBlur(raw, 5))
    hand = 1 + int(np.argmax(stats[1:, cv2.CC_STAT_AREA]))
    options = _native_vision.SilhouetteOptions(remove_face=False)
    found = _native_vision.SilhouetteExtractor(options).extract(frame)
    np.testing.assert_array_equal(found.grey, cv2.cvtColor(small, cv2.COLOR_BGR2GRAY))
    np.testing.assert_array_equal(found.mask, np.where(labels == hand, 255, 0))
    assert found.quality == pytest.approx(quality(redness, found.mask > 0), rel=1e-6)


def quality(values: NDArray[np.uint8], mask: NDArray[np.bool_]) -> float:
    """As Silhouette's documentation says."""
    inner, outer, num_runs = [], [], 0
    for row, level in zip(mask, values.astype(float), strict=True):
        edges = np.flatnonzero(np.diff(np.concatenate([[False], row, [False]]).astype(int)))
        for first, end in edges.reshape(-1, 2):
            num_runs += 1
            if first >= 2:
                inner.append(level[min(first + 1, end - 1)])
                outer.append(level[first - 2])
            if end + 1 < len(row):
                inner.append(level[max(end - 2, first)])
                outer.append(level[end + 1])
    both = np.array(inner + outer)
    apart = (np.mean(inner) - np.mean(outer)) ** 2 / 4 / both.var()
    area, height, width = mask.mean(), *mask.shape
    border = (mask[0].sum() + mask[:, 0].sum() + mask[:, -1].sum()) / (width + 2 * height)
    size = np.clip((0.8 - area) / 0.45, 0, 1) * np.clip(np.log(area / 0.002) / np.log(15.0), 0, 1)
    outline = min(1.0, 3.4 * np.sqrt(mask.sum()) / num_runs)
    return float(apart * size * np.clip((0.5 - border) / 0.3, 0, 1) * outline)
