# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Pictures and video clips as BGR frames with their times; pictures are written too."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import islice
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.core.display import count, short_path, summary
from hri.core.errors import FormatError, InvalidArgument, IoError
from hri.core.files import read_bytes, utf8_name, write_bytes
from hri.core.optional import import_opencv
from hri.io import require_whole_video
from hri.media.order import natural_key
from hri.media.picture_size import is_cut, is_picture, picture_size
from hri.media.suffixes import IMAGE_SUFFIXES, kind_of_file

DEFAULT_FPS = 25.0
MAX_CLIP_BYTES = 4 * 2**30
"""Of all frames of a clip at once, as in C++; `iterate_frames` takes any length."""
_READS_PAST_THE_END = (4, 250)
"""At least and at most, as many as frames are missing by the header; a damaged frame may spoil those after it."""
MAX_PIXELS = 100_000_000
"""Of a picture, or a frame; more takes seconds, and is no hand before a camera."""
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

    def __repr__(self) -> str:
        height, width = self.frames[0].shape[:2] if self.frames else (0, 0)
        return summary("Clip", count(len(self.frames), "frame"), f"{width} x {height}", short_path(self.path))

    @property
    def fps(self) -> float:
        """Frames a second by their times; 25 where these are not usable."""
        duration_s = self.times_s[-1] - self.times_s[0]
        return (len(self.times_s) - 1) / duration_s if duration_s > 0 else DEFAULT_FPS


def read_image(path: str | PathLike[str]) -> Frame:
    """Read a picture as uint8 BGR, shape (height, width, 3).

    Raises
    ------
    FormatError
        For a file that is no picture, one that was cut, or one of more than 100 million pixels.
    IoError
        For a file that cannot be opened.
    """
    import_opencv("to read pictures")  # what is missing is named before the file is looked for
    return decode_image(read_bytes(path), str(path))


def decode_image(data: bytes, name: str) -> Frame:
    """A picture in memory, as `read_image` gives it; FormatError with the name of the file that it is from."""
    path = Path(name)
    cv2 = import_opencv("to read pictures")
    if data and not is_picture(data):  # OpenCV reads others, too, whose size is not known before
        raise FormatError(f"{path}: not a picture that OpenCV reads: no PNG, JPEG or BMP")
    if is_cut(data):
        raise FormatError(f"{path}: file ends early")
    _require_size(path, *picture_size(data) or (0, 0))
    try:
        image = cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_COLOR) if data else None
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
        For a file that is no video, holds no frame, ends before its container does, has a damaged frame that others
        follow, or whose time runs backwards.
    IoError
        For a file that cannot be opened.
    """
    cv2 = import_opencv("to read video")
    path = Path(path)
    with open_video(path) as capture:
        yield from _captured(capture, path, cv2.CAP_PROP_POS_MSEC)


@contextmanager
def open_video(path: Path) -> Iterator[Any]:
    """OpenCV's VideoCapture of a whole video; errors as of `iterate_frames`."""
    cv2 = import_opencv("to read video")
    require_whole_video(path)
    with utf8_name(path) as name:
        capture = cv2.VideoCapture(name)
        try:
            if not capture.isOpened():
                raise FormatError(f"{path}: not a video that OpenCV reads")
            size = (capture.get(cv2.CAP_PROP_FRAME_WIDTH), capture.get(cv2.CAP_PROP_FRAME_HEIGHT))
            _require_size(path, *(int(side) for side in size))
            yield capture
        finally:
            capture.release()


def _require_size(path: Path, width: int, height: int) -> None:
    if width * height > MAX_PIXELS:
        raise FormatError(f"{path}: {width} x {height} pixels are more than {MAX_PIXELS}")


def _captured(capture: Any, path: Path, time_property: int) -> Iterator[tuple[Frame, float]]:
    last_s = -np.inf
    interval_s = 0.0  # between the last two frames
    count = 0
    while True:
        ok, frame = capture.read()
        if not ok:
            # A frame that cannot be decoded looks like the end, but others follow.
            if any(capture.grab() for _ in range(_reads_past_the_end(capture, count))):
                raise FormatError(f"{path}: frame {count} is damaged")
            break
        time_s = capture.get(time_property) / 1000.0
        # OpenCV 4.6 gives 0 for the frames that the decoder still held at the end of the file, as any codec that
        # reorders frames does.
        if time_s == 0 and last_s > 0:
            time_s = last_s + interval_s
        if not time_s >= last_s:
            raise FormatError(
                f"{path}: time runs backwards: frame {count} is at {time_s:g} s, the one before at {last_s:g} s"
            )
        yield np.asarray(frame, dtype=np.uint8), time_s
        if count > 0:
            interval_s = time_s - last_s
        last_s = time_s
        count += 1
    if count == 0:
        raise FormatError(f"{path}: video without frames")


def _reads_past_the_end(capture: Any, count: int) -> int:
    number = capture.get(import_opencv("to read video").CAP_PROP_FRAME_COUNT)  # some containers have only a guess
    least, most = _READS_PAST_THE_END
    return int(min(max(number - count, least), most)) if np.isfinite(number) else least


def read_frames(path: str | PathLike[str], max_frames: int | None = None) -> Clip:
    """Read a clip, a picture as a clip of one frame, or the pictures of a folder as a clip of 25 frames a second.

    Parameters
    ----------
    path : path-like
        A picture (.jpg, .png, .bmp), a video (.mp4, .m4v, .avi, .mkv, .webm, ...), or a folder, see `read_pictures`.
    max_frames : int, optional
        Stop after so many frames, at least 1; all by default.

    Raises
    ------
    InvalidArgument
        For `max_frames` below 1.
    FormatError
        For a file that is neither, as `iterate_frames`, and for more than 4 GiB of frames.
    IoError
        For a file that cannot be opened.
    """
    path = Path(path)
    if max_frames is not None and max_frames < 1:
        raise InvalidArgument(f"max_frames is {max_frames}, must be at least 1")
    kind = kind_of_file(path)
    if kind in ("a sound file", "a model") and os.path.exists(path):  # noqa: PTH110 - never raises
        raise FormatError(f"{path} is {kind}, and a picture or video is needed here")
    if kind == "a folder":
        clip = read_pictures(path)
        return Clip(clip.frames[:max_frames], clip.times_s[:max_frames], path)
    if kind == "a picture":
        return Clip([read_image(path)], [0.0], path)
    frames, times_s, num_bytes = [], [], 0
    for frame, time_s in islice(iterate_frames(path), max_frames):
        num_bytes += frame.nbytes
        _require_bytes(path, num_bytes)
        frames.append(frame)
        times_s.append(time_s)
    return Clip(frames, times_s, path)


def _require_bytes(path: Path, num_bytes: int) -> None:
    if num_bytes > MAX_CLIP_BYTES:
        raise FormatError(f"{path}: frames take more than {MAX_CLIP_BYTES} bytes; read them one by one")


def read_pictures(directory: str | PathLike[str], fps: float = DEFAULT_FPS) -> Clip:
    """Read the pictures of a folder, in the order of their names (2 before 10), as a clip.

    Parameters
    ----------
    directory : path-like
        What is in folders within it is not looked at.
    fps : float
        At which they were taken, above 0.

    Raises
    ------
    InvalidArgument
        For a bad rate.
    FormatError
        For a folder without pictures, a file that is no picture, pictures of different sizes, or more than 4 GiB of
        them.
    IoError
        For a folder that cannot be read.
    """
    if not 0.0 < fps < np.inf:
        raise InvalidArgument(f"fps is {fps}, must be above 0 and finite")
    root = Path(directory)
    try:
        found = [path for path in root.iterdir() if path.suffix.lower() in IMAGE_SUFFIXES and path.name[0] != "."]
    except OSError as error:
        raise IoError(f"{root}: {error.strerror or error}") from error
    if not found:
        raise FormatError(f"{root}: no pictures ({', '.join(IMAGE_SUFFIXES)}) in this folder")
    found.sort(key=lambda path: natural_key(path.name))
    frames: list[Frame] = []
    for path in found:
        frame = read_image(path)
        frames.append(frame)
        _require_bytes(root, len(frames) * frame.nbytes)
        if frame.shape != frames[0].shape:
            width, height = frames[0].shape[1::-1]
            raise FormatError(f"{path}: {frame.shape[1]} x {frame.shape[0]}, but {found[0].name} is {width} x {height}")
    return Clip(frames, [i / fps for i in range(len(frames))], root)


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
        For a suffix that is no picture's, and an array that is none.
    IoError
        When the file cannot be written.
    """
    cv2 = import_opencv("to write pictures")
    path = Path(path)
    if path.suffix.lower() not in IMAGE_SUFFIXES:
        raise InvalidArgument(f"{path}: suffix must be one of {', '.join(IMAGE_SUFFIXES)}")
    _require_picture(image, f"{path}: ")
    ok, data = cv2.imencode(path.suffix.lower(), image, [cv2.IMWRITE_JPEG_QUALITY, quality])
    if not ok:
        raise IoError(f"{path}: this OpenCV cannot write {path.suffix} pictures")
    write_bytes(path, data.tobytes())


def _require_picture(image: Any, name: str = "") -> None:
    shape, kind = np.shape(image), getattr(image, "dtype", None)
    if kind != np.uint8 or not image.size or image.ndim not in (2, 3) or shape[2:] not in ((), (3,)):
        raise InvalidArgument(
            f"{name}an array of shape {shape} and type {kind} is no picture, which has uint8 of shape "
            "(height, width, 3) or (height, width)"
        )


def encode_png(image: NDArray[np.uint8]) -> bytes:
    """A picture as a PNG file, quickly rather than small; InvalidArgument for an array that is no picture."""
    cv2 = import_opencv("to write pictures")
    _require_picture(image)
    ok, data = cv2.imencode(".png", image, [cv2.IMWRITE_PNG_COMPRESSION, 1])
    if not ok:
        raise IoError("this OpenCV cannot write PNG pictures")
    return bytes(data.tobytes())


def frame_rate(path: str | PathLike[str]) -> float:
    """Frames a second as the file's header says; 25 where it says nothing sensible.

    Raises
    ------
    FormatError
        For a file that is no video, or ends before its container does.
    IoError
        For a file that cannot be opened.
    """
    cv2 = import_opencv("to read video")
    with open_video(Path(path)) as capture:
        rate = float(capture.get(cv2.CAP_PROP_FPS))
    return rate if 0.0 < rate <= 1000.0 else DEFAULT_FPS
