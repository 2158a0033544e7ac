# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Shapes of hands, from masks (uint8, shape (height, width), 255 where the hand is) and from their outlines."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hri import _native
from hri._native import OrientationHistogramOptions


def trace_contour(mask: ArrayLike) -> NDArray[np.int32]:
    """Outer outline of the largest region of a mask.

    Returns
    -------
    ndarray of int32, shape (num_points, 2)
        x and y, clockwise as the picture is seen.
    """
    return _native.trace_contour(_mask(mask))


def resample_contour(contour: ArrayLike, num_points: int) -> NDArray[np.float32]:
    """Points at equal distances along the smoothed outline, float32, shape (num_points, 2)."""
    return _native.resample_contour(np.asarray(contour, np.int32), num_points)


def chain_code(contour: ArrayLike) -> NDArray[np.uint8]:
    """Freeman's directions from point to point: 0 right, 2 up, 4 left, 6 down."""
    return _native.chain_code(np.asarray(contour, np.int32))


def shape_number(contour: ArrayLike) -> NDArray[np.uint8]:
    """Turns of the outline from their least start on, which no rotation by 90 degrees changes."""
    return _native.shape_number(np.asarray(contour, np.int32))


def shape_axis(mask: ArrayLike) -> tuple[float, float]:
    """Angle of the longer axis in radians, from x towards y (down), and elongation: 0 round, 1 a line."""
    return _native.shape_axis(_mask(mask))


def shape_moments(mask: ArrayLike) -> dict[str, float]:
    """Moments to the third order, named as OpenCV names them."""
    moments: dict[str, float] = _native.shape_moments(_mask(mask))
    return moments


def hu_moments(mask: ArrayLike) -> NDArray[np.float64]:
    """Hu's seven invariants."""
    return _native.hu_moments(_mask(mask))


def hu_features(mask: ArrayLike) -> NDArray[np.float32]:
    """The root of each of Hu's invariants by its degree, shape (7,)."""
    return _native.hu_features(_mask(mask))


def orientation_histogram(image: ArrayLike, options: OrientationHistogramOptions | None = None) -> NDArray[np.float32]:
    """Histograms of the directions of edges, normalised by block.

    Parameters
    ----------
    image : array_like, shape (height, width)
        Grey values.
    options : OrientationHistogramOptions, optional

    Returns
    -------
    ndarray of float32
    """
    return _native.orientation_histogram(np.asarray(image, np.float32), options or OrientationHistogramOptions())


def b_spline_wavelet(r: float) -> float:
    """The wavelet along the radius that wavelet descriptors use (thesis eq. 3.22)."""
    return float(_native.b_spline_wavelet(r))


def _mask(mask: ArrayLike) -> NDArray[np.uint8]:
    values = np.asarray(mask)
    return values.astype(np.uint8) * 255 if values.dtype == np.bool_ else np.ascontiguousarray(values)
