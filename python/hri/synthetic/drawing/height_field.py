# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Solid round shapes seen straight from the front, as depth, surface normal and colour per pixel.

Everything is drawn with spheres swept along a line and with ellipsoids. x points right, y up, z to
the viewer.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Points = NDArray[np.float64]
Colour = tuple[float, float, float]  # BGR, 0..255


@dataclass(frozen=True)
class View:
    """Where a place in the world falls on the picture.

    Attributes
    ----------
    origin_px : (float, float)
        Column and row of the world's origin.
    scale : float
        Pixels for one unit of the world.
    """

    origin_px: tuple[float, float]
    scale: float

    def project(self, points: Points) -> Points:
        """World (..., 3) to column, row and depth in pixels (..., 3)."""
        points = np.asarray(points, dtype=float)
        out = points * self.scale
        out[..., 0] += self.origin_px[0]
        out[..., 1] = self.origin_px[1] - out[..., 1]
        return out


class HeightField:
    """The nearest surface at every pixel.

    Attributes
    ----------
    depth : float32 (height, width)
        In pixels towards the viewer; -inf where nothing is.
    normal : float32 (height, width, 3)
        Unit length, y up.
    colour : float32 (height, width, 3)
        BGR before light.
    part : int16 (height, width)
        Number of the shape group on top, 0 for none.
    """

    def __init__(self, height: int, width: int) -> None:
        self.depth = np.full((height, width), -np.inf, dtype=np.float32)
        self.normal = np.zeros((height, width, 3), dtype=np.float32)
        self.colour = np.zeros((height, width, 3), dtype=np.float32)
        self.part = np.zeros((height, width), dtype=np.int16)

    @property
    def shape(self) -> tuple[int, int]:
        """Height and width."""
        return self.depth.shape[0], self.depth.shape[1]

    def add_limb(
        self,
        start: Points,
        end: Points,
        start_radius: float,
        end_radius: float,
        colour: Colour,
        part: int,
    ) -> None:
        """A sphere swept from `start` to `end` (column, row, depth) while its radius changes."""
        reach = max(start_radius, end_radius)
        window = self._window(np.stack([start, end]), reach)
        if window is None:
            return
        rows, cols = window
        y, x = np.mgrid[rows, cols].astype(np.float32)
        axis = (end - start).astype(np.float32)
        flat = float(np.hypot(axis[0], axis[1]))
        length = float(np.sqrt(flat**2 + axis[2] ** 2)) + 1e-6
        dx, dy = x - start[0], y - start[1]
        if flat > 1e-3:
            # The sphere in front at this pixel stands at t: the maximum over t of its surface.
            along = (dx * axis[0] + dy * axis[1]) / flat**2
            across2 = np.maximum(dx**2 + dy**2 - (along * flat) ** 2, 0)
            radius = start_radius + np.clip(along, 0, 1) * (end_radius - start_radius)
            lean = np.sqrt(np.maximum(radius**2 - across2, 0)) * axis[2] / (flat * length)
            t = np.clip(along + lean, 0, 1)
        else:
            t = np.full(x.shape, 1.0 if axis[2] > 0 else 0.0, dtype=np.float32)
        radius = start_radius + t * (end_radius - start_radius)
        nx, ny = dx - t * axis[0], dy - t * axis[1]
        height2 = radius**2 - nx**2 - ny**2
        height = np.sqrt(np.maximum(height2, 0))
        normal = np.stack([nx, -ny, height], axis=-1) / np.maximum(radius, 1e-6)[..., None]
        self._put(window, height2 > 0, start[2] + t * axis[2] + height, normal, colour, part)

    def add_ellipsoid(self, centre: Points, radii: Points, colour: Colour, part: int) -> None:
        """An ellipsoid with its axes along x, y and z; `radii` in pixels."""
        window = self._window(centre[None], float(max(radii[0], radii[1])))
        if window is None:
            return
        rows, cols = window
        y, x = np.mgrid[rows, cols].astype(np.float32)
        ux, uy = (x - centre[0]) / radii[0], (y - centre[1]) / radii[1]
        height2 = 1.0 - ux**2 - uy**2
        uz = np.sqrt(np.maximum(height2, 0))
        normal = np.stack([ux / radii[0], -uy / radii[1], uz / radii[2]], axis=-1)
        normal /= np.linalg.norm(normal, axis=-1, keepdims=True) + 1e-9
        self._put(window, height2 > 0, centre[2] + uz * radii[2], normal, colour, part)

    @contextmanager
    def merged(self, cv2: Any, softness_px: float) -> Iterator[HeightField]:
        """Shapes added to the field that this gives come out as one smooth surface."""
        layer = HeightField(*self.shape)
        yield layer
        inside = layer.part > 0
        if not inside.any():
            return
        ys, xs = np.nonzero(inside)
        pad = int(3 * softness_px) + 1
        window = (
            slice(max(ys.min() - pad, 0), ys.max() + pad + 1),
            slice(max(xs.min() - pad, 0), xs.max() + pad + 1),
        )
        weight = inside[window].astype(np.float32)
        spread = np.maximum(cv2.GaussianBlur(weight, (0, 0), softness_px), 1e-3)
        height = np.where(weight > 0, layer.depth[window], 0)
        height = cv2.GaussianBlur(height, (0, 0), softness_px) / spread
        normal = cv2.GaussianBlur(layer.normal[window], (0, 0), softness_px) / spread[..., None]
        normal /= np.linalg.norm(normal, axis=-1, keepdims=True) + 1e-6
        colour = cv2.GaussianBlur(layer.colour[window], (0, 0), softness_px) / spread[..., None]
        nearer = inside[window] & (height > self.depth[window])
        self._store(window, nearer, height, normal, colour, layer.part[window])

    def add_field(self, other: HeightField, row: int, column: int, lift: float) -> None:
        """Another field with its upper left corner at (row, column), its depth raised by `lift`."""
        height, width = self.shape
        top, left = max(row, 0), max(column, 0)
        bottom, right = min(row + other.shape[0], height), min(column + other.shape[1], width)
        if top >= bottom or left >= right:
            return
        window = (slice(top, bottom), slice(left, right))
        source = (slice(top - row, bottom - row), slice(left - column, right - column))
        depth = other.depth[source] + np.float32(lift)
        nearer = depth > self.depth[window]
        planes = (other.normal[source], other.colour[source], other.part[source])
        self._store(window, nearer, depth, *planes)

    def columns(self, first: int, last: int) -> HeightField:
        """An independent copy of some columns, to draw what moves over what is still."""
        other = HeightField(0, 0)
        for name in ("depth", "normal", "colour", "part"):
            setattr(other, name, getattr(self, name)[:, first:last].copy())
        return other

    def _window(self, points: Points, reach: float) -> tuple[slice, slice] | None:
        low = np.floor(points[:, :2].min(axis=0) - reach).astype(int)
        high = np.ceil(points[:, :2].max(axis=0) + reach).astype(int) + 1
        height, width = self.shape
        x0, x1 = max(low[0], 0), min(high[0], width)
        y0, y1 = max(low[1], 0), min(high[1], height)
        return (slice(y0, y1), slice(x0, x1)) if x0 < x1 and y0 < y1 else None

    def _put(
        self,
        window: tuple[slice, slice],
        inside: NDArray[np.bool_],
        depth: NDArray[Any],
        normal: NDArray[Any],
        colour: Colour,
        part: int,
    ) -> None:
        nearer = inside & (depth > self.depth[window])
        shape = (*depth.shape, 3)
        flat_colour = np.broadcast_to(np.asarray(colour, np.float32), shape)
        self._store(window, nearer, depth, normal, flat_colour, np.full(depth.shape, part))

    def _store(
        self,
        window: tuple[slice, slice],
        where: NDArray[np.bool_],
        depth: NDArray[Any],
        normal: NDArray[Any],
        colour: NDArray[Any],
        part: NDArray[Any],
    ) -> None:
        self.depth[window][where] = depth[where]
        self.normal[window][where] = normal[where]
        self.colour[window][where] = colour[where]
        self.part[window][where] = part[where]
