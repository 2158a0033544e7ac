# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Pictures and video clips as BGR frames with their times."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import islice
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.errors import FormatError, InvalidArgument, IoError
from hri.media.optional import import_opencv

IMAGE_SUFFIXES = (".jpg", ".jpeg", ".png", ".bmp")
VIDEO_SUFFIXES = (".mp4", ".m4v", ".mov", ".avi", ".mkv", ".webm")
_CODECS = {
    ".mp4": "mp4v",
    ".m4v": "mp4v",
    ".mov": "mp4v",
    ".avi": "MJPG",
    ".mkv": "MJPG",
    ".webm": "VP80",
}

Frame = NDArray[np.uint8]


@dataclass(frozen=True)
class Clip:
    """Frames in the order in which they were taken.

    Attributes
    ----------
    frames : list of ndarray of uint8, shape (height, width, 3)
        BGR; at least one, all of one size.
    times_s : list of float
        Time of each frame, never falling; the rate of a webcam changes with the light.
    path : Path
    """

    frames: list[Frame]
    times_s: list[float]
    path: Path


def read_image(path: str | PathLike[str]) -> Frame:
    """Read a picture as uint8 BGR, shape (height, width, 3).

    Raises
    ------
    FormatError
        For a file that is no picture.
    IoError
        For a file that cannot be opened.
    """
    cv2 = import_opencv("to read pictures")
    path = Path(path)
    try:
        data = np.fromfile(path, dtype=np.uint8)
    except OSError as error:
        raise IoError(f"{path}: {error.strerror or error}") from error
    try:
        image = cv2.imdecode(data, cv2.IMREAD_COLOR) if data.size else None
    except cv2.error as error:  # a picture too large to decode, for one
        raise FormatError(f"{path}: OpenCV refuses this picture: {error}") from error
    if image is None:
        raise FormatError(f"{path}: not a picture that OpenCV reads")
    return np.asarray(image, dtype=np.uint8)


def iterate_frames(path: str | PathLike[str]) -> Iterator[tuple[Frame, float]]:
    """Yield (frame, time in seconds) of a video, one at a time, so that its length does not matter.

    Raises
    ------
    FormatError
        For a file that is no video, holds no frame, or whose time runs backwards.
    IoError
        For a file that cannot be opened.
    """
    cv2 = import_opencv("to read video")
    path = Path(path)
    try:
        path.open("rb").close()
    except OSError as error:
        raise IoError(f"{path}: {error.strerror or error}") from error
    capture = cv2.VideoCapture(str(path))
    try:
        if not capture.isOpened():
            raise FormatError(f"{path}: not a video that OpenCV reads")
        yield from _captured(capture, path, cv2.CAP_PROP_POS_MSEC)
    finally:
        capture.release()


def _captured(capture: Any, path: Path, time_property: int) -> Iterator[tuple[Frame, float]]:
    last_s = -np.inf
    count = 0
    while True:
        ok, frame = capture.read()
        if not ok:
            break
        time_s = capture.get(time_property) / 1000.0
        if not time_s >= last_s:
            raise FormatError(
                f"{path}: time runs backwards: frame {count} is at {time_s:g} s, the one before at {last_s:g} s"
            )
        yield np.asarray(frame, dtype=np.uint8), time_s
        last_s = time_s
        count += 1
    if count == 0:
        raise FormatError(f"{path}: video without frames")


def read_frames(path: str | PathLike[str], max_frames: int | None = None) -> Clip:
    """Read a clip, or a picture as a clip of one frame.

    Parameters
    ----------
    path : path-like
        A picture (.jpg, .png, .bmp) or a video (.mp4, .m4v, .avi, .mkv, .webm, ...).
    max_frames : int, optional
        Stop after so many frames, at least 1; all by default.

    Raises
    ------
    InvalidArgument
        For `max_frames` below 1.
    FormatError
        For a file that is neither, holds no frame, or whose time runs backwards.
    IoError
        For a file that cannot be opened.
    """
    path = Path(path)
    if max_frames is not None and max_frames < 1:
        raise InvalidArgument(f"max_frames is {max_frames}, must be at least 1")
    if path.suffix.lower() in IMAGE_SUFFIXES:
        return Clip([read_image(path)], [0.0], path)
    timed = list(islice(iterate_frames(path), max_frames))
    return Clip([frame for frame, _ in timed], [time_s for _, time_s in timed], path)


def write_image(path: str | PathLike[str], image: Frame, quality: int = 92) -> None:
    """Write a BGR picture in the format of the suffix; the file appears whole or not at all.

    Parameters
    ----------
    path : path-like
    image : ndarray of uint8, shape (height, width, 3) or (height, width)
    quality : int, 0..100
        Of JPEG files.

    Raises
    ------
    InvalidArgument
        For a suffix that is no picture's.
    IoError
        When the file cannot be written.
    """
    cv2 = import_opencv("to write pictures")
    path = Path(path)
    if path.suffix.lower() not in IMAGE_SUFFIXES:
        raise InvalidArgument(f"{path}: suffix must be one of {', '.join(IMAGE_SUFFIXES)}")
    ok, data = cv2.imencode(path.suffix.lower(), image, [cv2.IMWRITE_JPEG_QUALITY, quality])
    if not ok:
        raise InvalidArgument(f"{path}: an array of shape {image.shape} is no picture")
    part = _temporary_beside(path)
    try:
        part.write_bytes(data.tobytes())
        part.replace(path)
    except OSError as error:
        raise IoError(f"{path}: {error.strerror or error}") from error
    finally:
        part.unlink(missing_ok=True)


def write_video(path: str | PathLike[str], frames: Iterable[Frame], fps: float) -> None:
    """Write BGR frames as a video; the file appears whole or not at all.

    Parameters
    ----------
    path : path-like
        The suffix chooses the format: .mp4, .m4v, .mov, .avi, .mkv, or .webm (which browsers play).
    frames : iterable of ndarray of uint8, shape (height, width, 3)
        At least one, all of one size; may be a generator.
    fps : float
        Frames a second, above 0.

    Raises
    ------
    InvalidArgument
        For no frames, a frame of another size or type (the message gives its index), or a bad rate
        or suffix.
    IoError
        When the file cannot be written.
    """
    cv2 = import_opencv("to write video")
    path = Path(path)
    codec = _CODECS.get(path.suffix.lower())
    if codec is None:
        raise InvalidArgument(f"{path}: suffix must be one of {', '.join(_CODECS)}")
    if not 0.0 < fps < np.inf:
        raise InvalidArgument(f"fps is {fps}, must be above 0 and finite")
    part = _temporary_beside(path)
    writer = None
    shape: tuple[int, ...] = ()
    try:
        for index, frame in enumerate(frames):
            if writer is None:
                shape = frame.shape
                _require_frame(frame, shape, index)
                size = (shape[1], shape[0])
                fourcc = cv2.VideoWriter_fourcc(*codec)
                with _silent_stderr(path.suffix.lower() == ".webm"):
                    writer = cv2.VideoWriter(str(part), fourcc, fps, size)
                if not writer.isOpened():
                    raise IoError(f"{path}: this OpenCV cannot write {path.suffix} video here")
            _require_frame(frame, shape, index)
            writer.write(np.ascontiguousarray(frame))
        if writer is None:
            raise InvalidArgument(f"{path}: no frames to write")
        writer.release()
        part.replace(path)
    except OSError as error:
        raise error if isinstance(error, IoError) else IoError(f"{path}: {error}") from error
    finally:
        if writer is not None:
            writer.release()
        part.unlink(missing_ok=True)


def _require_frame(frame: Frame, shape: tuple[int, ...], index: int) -> None:
    if frame.dtype != np.uint8 or frame.ndim != 3 or frame.shape[2] != 3 or frame.shape != shape:
        raise InvalidArgument(
            f"frame {index} has shape {frame.shape} and type {frame.dtype}, "
            f"expected uint8 of shape (height, width, 3), all alike; frame 0 has {shape}"
        )


@contextmanager
def _silent_stderr(wanted: bool) -> Iterator[None]:
    """OpenCV prints a remark about every WebM file, whatever its log level, that means nothing."""
    if not wanted:
        yield
        return
    sys.stderr.flush()
    kept = os.dup(2)
    sink = os.open(os.devnull, os.O_WRONLY)
    try:
        os.dup2(sink, 2)
        yield
    finally:
        os.dup2(kept, 2)
        os.close(kept)
        os.close(sink)


def _temporary_beside(path: Path) -> Path:
    if not path.parent.is_dir():
        raise IoError(f"{path}: the folder {path.parent} does not exist")
    return path.with_name(f".{path.stem}.{os.getpid()}{path.suffix.lower()}")
