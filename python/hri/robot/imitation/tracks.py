# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Hands of a person over time, in pixels, with the nose or the shoulders as reference."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from os import PathLike
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from hri.core.display import short_repr
from hri.core.errors import FormatError, InvalidArgument
from hri.core.files import parse_number, parse_seen, read_csv

Floats = NDArray[np.float64]

MAX_PIXELS = 1e6
_MOST_LEFT_OUT = 100_000  # frames of a file that has a column for them
_HANDS = ("left-x", "left-y", "right-x", "right-y")
_NOSE = ("nose-x", "nose-y")
_SHOULDERS = ("left-shoulder-x", "left-shoulder-y", "right-shoulder-x", "right-shoulder-y")


@dataclass(frozen=True)
@short_repr
class HandTrack:
    """Positions in pixels from the upper left corner, as a camera before the person sees them; NaN where not seen.

    Attributes
    ----------
    name : str
    fps : float
        Frames per second.
    left, right : ndarray of float64, shape (frames, 2)
        The person's own left and right hand; x, y.
    nose : ndarray of float64, shape (frames, 2), optional
    shoulders : ndarray of float64, shape (frames, 2, 2), optional
        Left, then right. One of nose and shoulders is needed.
    """

    name: str
    fps: float
    left: Floats
    right: Floats
    nose: Floats | None = None
    shoulders: Floats | None = None

    def __post_init__(self) -> None:
        frames = len(self.left)
        if not 0.0 < self.fps < np.inf:
            raise InvalidArgument(f"fps is {self.fps}, must be above 0 and finite")
        if frames == 0:
            raise InvalidArgument(f"track {self.name!r} has no frames")
        if self.nose is None and self.shoulders is None:
            raise InvalidArgument(f"track {self.name!r} has neither nose nor shoulders")
        shapes = {"left": (2,), "right": (2,), "nose": (2,), "shoulders": (2, 2)}
        for field, shape in shapes.items():
            values = getattr(self, field)
            if values is None:
                continue
            if values.shape != (frames, *shape):
                raise InvalidArgument(f"{field} has shape {values.shape}, must be {(frames, *shape)}")
            if np.any(np.abs(values[~np.isnan(values)]) > MAX_PIXELS):
                raise InvalidArgument(f"{field} has a position beyond {MAX_PIXELS:g} pixels")

    def __len__(self) -> int:
        return len(self.left)

    def unmirrored(self) -> HandTrack:
        """The track of a picture that was mirrored, as many programs show a webcam's: left and right put back."""
        flip = np.array([-1.0, 1.0])
        body = {"nose": self.nose, "shoulders": self.shoulders}
        flipped = {name: None if points is None else points * flip for name, points in body.items()}
        return HandTrack(self.name, self.fps, self.left * flip, self.right * flip, **flipped)


@dataclass(frozen=True)
class Gap:
    """Frames `first` to `last`, from 0, in which something was not seen and had to be bridged."""

    what: str
    first: int
    last: int


def bridge(values: Floats, what: str) -> tuple[Floats, list[Gap]]:
    """Fill frames that have a NaN: between two seen frames by a straight line, at the ends by the nearest.

    Parameters
    ----------
    values : ndarray of float64, shape (frames, ...)
        Seen in at least one frame.
    what : str
        Name of it, for the gaps.

    Returns
    -------
    filled : ndarray of float64
    gaps : list of Gap
    """
    flat = values.reshape(len(values), -1)
    seen = np.isfinite(flat).all(axis=1)
    if not seen.any():
        raise InvalidArgument(f"{what} is not seen in any frame")
    frames = np.arange(len(flat))
    filled = np.stack([np.interp(frames, frames[seen], column[seen]) for column in flat.T], axis=1)
    edges = np.flatnonzero(np.diff(np.concatenate(([False], ~seen, [False])).astype(np.int8)))
    gaps = [Gap(what, int(a), int(b) - 1) for a, b in zip(edges[0::2], edges[1::2], strict=True)]
    return filled.reshape(values.shape), gaps


def read_hand_tracks(path: str | PathLike[str], fps: float = 30.0) -> dict[str, HandTrack]:
    """Read tracks from a CSV file with a header; its columns may stand in any order.

    ``left-x``, ``left-y``, ``right-x``, ``right-y`` and ``nose-x``, ``nose-y`` or ``left-shoulder-x`` to
    ``right-shoulder-y``; an empty cell or ``nan`` is a position that was not seen. With a column ``video`` there may
    be several tracks, else there is one, named after the file. With a column ``frame`` a frame that is left out
    counts as not seen.

    Returns
    -------
    dict from name to HandTrack
        In the order of the file.

    Raises
    ------
    FormatError
        Names the file, the row and the column.
    IoError
        When the file cannot be read.
    """
    path = Path(path)
    header, rows = _cells(path)
    places = [name for group in (_NOSE, _SHOULDERS) if set(group) <= set(header) for name in group]
    missing = [name for name in _HANDS if name not in header] or ([] if places else [*_NOSE])
    if missing:
        raise FormatError(f"{path}: row 1: no column {', '.join(missing)}")
    wanted = [*_HANDS, *places]
    columns = [header.index(name) for name in wanted]
    video, frame = (header.index(name) if name in header else -1 for name in ("video", "frame"))
    found: dict[str, list[list[float]]] = {}
    num_left_out = 0
    for number, row in rows:
        where = f"{path}: row {number}"
        if len(row) != len(header):
            raise FormatError(f"{where}: {len(row)} fields, must be {len(header)}")
        name = row[video].strip() if video >= 0 else path.stem
        lines = found.setdefault(name, [])
        if frame >= 0:
            index = _number(f"{where}, column frame", row[frame])
            if not len(lines) <= index < len(lines) + 10_000 or index != int(index):
                raise FormatError(f"{where}, column frame: {row[frame]!r}, must count up from 0 within video {name!r}")
            num_left_out += int(index) - len(lines)
            if num_left_out > _MOST_LEFT_OUT:
                raise FormatError(
                    f"{where}, column frame: {row[frame]!r}, more than {_MOST_LEFT_OUT} are left out in all"
                )
            lines += [[np.nan] * len(wanted) for _ in range(int(index) - len(lines))]
        lines.append([_number(f"{where}, column {header[c]}", row[c], parse_seen) for c in columns])
    return {name: _track(name, fps, wanted, np.array(lines)) for name, lines in found.items()}


def _track(name: str, fps: float, columns: list[str], values: Floats) -> HandTrack:
    def points(group: tuple[str, ...]) -> Floats | None:
        if group[0] not in columns:
            return None
        first = columns.index(group[0])
        return values[:, first : first + len(group)]

    shoulders = points(_SHOULDERS)
    shaped = None if shoulders is None else shoulders.reshape(-1, 2, 2)
    return HandTrack(name, fps, values[:, 0:2], values[:, 2:4], points(_NOSE), shaped)


def _cells(path: Path) -> tuple[list[str], list[tuple[int, list[str]]]]:
    rows = [(number, row) for number, row in enumerate(read_csv(path), 1) if row]
    if len(rows) < 2:
        raise FormatError(f"{path}: no rows")
    return [name.strip() for name in rows[0][1]], rows[1:]


def _number(where: str, cell: str, parse: Callable[[str], float | None] = parse_number) -> float:
    value = parse(cell)
    if value is None or abs(value) > MAX_PIXELS:
        raise FormatError(f"{where}: {cell!r} is no number within {MAX_PIXELS:g}")
    return value
