# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Splitting of a signed sentence into gestures where pictures stand still, as the thesis does it (4.6.3, 5.1.2).

A baseline beside `hri.SentenceRecognizer`, whose models find words and what lies between them at once.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hri.core.errors import InvalidArgument

SIZE = (40, 60)
"""Rows and columns of the pictures that directions are taken of."""
KEY_FRAMES = 15
_SMOOTHED = 3

Span = tuple[int, int]


def subsample(picture: ArrayLike) -> NDArray[np.float32]:
    """A picture of grey levels, shape (height, width), as means of blocks; shape `SIZE`.

    Raises
    ------
    InvalidArgument
        For one that has no rows or no columns, or more dimensions.
    """
    grey = np.asarray(picture, np.float32)
    if grey.ndim != 2 or 0 in grey.shape:
        raise InvalidArgument(f"picture has shape {grey.shape}, must be (height, width)")
    for axis, count in enumerate(SIZE):
        length = grey.shape[axis]
        edges = np.arange(count + 1) * length // count
        first, last = edges[:-1], np.maximum(edges[1:], edges[:-1] + 1)
        zero = np.zeros_like(np.take(grey, [0], axis))
        total = np.concatenate([zero, np.cumsum(grey, axis, dtype=np.float32)], axis)
        sums = np.take(total, last, axis) - np.take(total, first, axis)
        grey = sums / np.expand_dims(last - first, 1 - axis).astype(np.float32)
    return grey


def direction_changes(pictures: ArrayLike, per_pixel: bool = False) -> NDArray[np.float64]:
    """By how much the direction of the gradient changes from each picture to the next.

    Parameters
    ----------
    pictures : array_like, shape (num_frames, height, width)
        Grey levels, such as `subsample` gives them; 0 where there is no hand.
    per_pixel : bool
        The mean over all pixels of the change of direction; otherwise the change of the mean direction, as it is
        written in the thesis.

    Returns
    -------
    ndarray of float64, shape (num_frames - 1,)
        In radians.

    Raises
    ------
    InvalidArgument
        For another shape, pictures smaller than 2 x 2, or none.
    """
    grey = np.asarray(pictures, np.float32)
    if grey.ndim != 3 or len(grey) < 1 or min(grey.shape[1:]) < 2:
        raise InvalidArgument(f"pictures has shape {grey.shape}, must be (num_frames, height, width), 2 x 2 at least")
    dx = np.diff(grey, axis=2)[:, :-1, :]
    dy = np.diff(grey, axis=1)[:, :, :-1]
    directions = np.arctan2(dy, dx)
    if not per_pixel:
        return np.abs(np.diff(directions.mean(axis=(1, 2), dtype=np.float64)))
    turned = np.abs(np.diff(directions, axis=0))
    return np.asarray(np.minimum(turned, 2.0 * np.pi - turned).mean(axis=(1, 2), dtype=np.float64))


def split_at_pauses(
    changes: ArrayLike, share: float = 0.1, min_pause: int = 4, min_part: int = KEY_FRAMES
) -> list[Span]:
    """The parts of a sentence between pauses.

    Parameters
    ----------
    changes : array_like, shape (num_frames - 1,)
        From `direction_changes`.
    share : float
        Frames are a pause whose change, the mean of three, is at most this share of the 90th percentile.
    min_pause, min_part : int
        Frames of a pause, and of a part, at least; shorter ones count as what is around them.

    Returns
    -------
    list of (int, int)
        First frame, and the frame after the last, in the order of time.

    Raises
    ------
    InvalidArgument
        For a share outside 0..1, lengths below 1, changes that are negative or not finite.
    """
    values = np.asarray(changes, np.float64)
    if values.ndim != 1 or not np.isfinite(values).all() or (values < 0).any():
        raise InvalidArgument("changes must be a row of finite numbers, 0 or more")
    if not 0.0 <= share <= 1.0 or min_pause < 1 or min_part < 1:
        raise InvalidArgument(f"share is {share}, min_pause {min_pause}, min_part {min_part}; need 0..1, 1 and 1")
    if not len(values):
        return []
    window = np.ones(min(_SMOOTHED, len(values)))
    smoothed = np.convolve(values, window, "same") / np.convolve(np.ones(len(values)), window, "same")
    still = smoothed <= share * np.percentile(smoothed, 90)
    moving = [span for span in _runs(still, min_pause) if span[1] - span[0] >= min_part]
    return [(first, last + 1) for first, last in moving]  # a change is of two frames


def key_frames(span: Span, count: int = KEY_FRAMES) -> Span:
    """The middle frames of a part, `count` at most."""
    first, last = span
    spare = max(0, last - first - count)
    return first + spare // 2, last - (spare - spare // 2)


def _runs(still: NDArray[np.bool_], min_pause: int) -> Sequence[Span]:
    """Runs of frames that are no pause, over pauses that are too short."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], still, [False]]).astype(np.int8)))
    pauses = [(int(a), int(b)) for a, b in edges.reshape(-1, 2) if b - a >= min_pause]
    begins = [0, *(last for _, last in pauses)]
    ends = [*(first for first, _ in pauses), len(still)]
    return [(a, b) for a, b in zip(begins, ends, strict=True) if b > a]
