# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Video files, frame by frame or at once."""

from __future__ import annotations

from collections.abc import Iterable
from contextlib import ExitStack, nullcontext
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from hri.core.errors import FormatError, InvalidArgument, IoError
from hri.core.files import AtomicFile, utf8_name
from hri.core.optional import import_opencv
from hri.core.quiet import silent_stderr
from hri.media.video import Frame, open_video

_CODECS = {
    ".mp4": "mp4v",
    ".m4v": "mp4v",
    ".mov": "mp4v",
    ".avi": "MJPG",
    ".mkv": "MJPG",
    ".webm": "VP80",
}


class VideoWriter:
    """A video that is written frame by frame; the file appears when it is closed, whole.

    As a context manager it is closed at the end, and discarded after an exception.

    Parameters
    ----------
    path : path-like
        The suffix chooses the format: .mp4, .m4v, .mov, .avi, .mkv, or .webm (which browsers play).
    fps : float
        Frames a second, above 0.

    Notes
    -----
    Coders want even sizes: of frames of an odd size the last row or column stands twice in the video.

    Raises
    ------
    InvalidArgument
        For a bad rate or suffix.
    IoError
        When there is no such folder, or no file can be written in it.
    """

    def __init__(self, path: str | PathLike[str], fps: float) -> None:
        self._cv2 = import_opencv("to write video")
        self.path = Path(path)
        self._fps = fps
        if self.path.suffix.lower() not in _CODECS:
            raise InvalidArgument(f"{self.path}: suffix must be one of {', '.join(_CODECS)}")
        if not 0.0 < fps < np.inf:
            raise InvalidArgument(f"fps is {fps}, must be above 0 and finite")
        self._file = AtomicFile(self.path)
        self._name = ExitStack()  # under which OpenCV knows the file
        self._writer: Any = None
        self._shape: tuple[int, ...] = ()
        self._is_done = False
        self.num_frames = 0

    def __enter__(self) -> VideoWriter:
        return self

    def __exit__(self, kind: object, *_: object) -> None:
        if self._is_done:
            return
        if kind is None:
            self.close()
        else:
            self.discard()

    def write(self, frame: Frame) -> None:
        """Add a BGR frame of uint8, shape (height, width, 3).

        Raises
        ------
        InvalidArgument
            For a frame of another size or type than the first (the message gives its index), or after `close`.
        IoError
            When this OpenCV cannot write the format.
        """
        if self._is_done:
            raise InvalidArgument(f"{self.path}: the video is closed")
        if self._writer is None:
            self._shape = frame.shape
            _require_frame(frame, self._shape, self.num_frames)
            self._writer = self._open()
        _require_frame(frame, self._shape, self.num_frames)
        height, width = self._shape[:2]
        even = np.pad(frame, ((0, height % 2), (0, width % 2), (0, 0)), mode="edge") if (height | width) % 2 else frame
        self._writer.write(np.ascontiguousarray(even))
        self.num_frames += 1

    def close(self) -> None:
        """Finish the file, and read it again: OpenCV does not report what it could not write. A second time this does
        nothing.

        Raises
        ------
        InvalidArgument
            When no frame was written.
        IoError
            When a frame is missing in the file, as on a full disk. An old file stays whole.
        """
        if self._is_done:
            return
        try:
            if self._writer is None:
                raise InvalidArgument(f"{self.path}: no frames to write")
            self._writer.release()
            found, size = _measured(Path(self._file.temporary_path))
            if found and size != self._even_size():
                raise IoError(f"{self.path}: cannot write: frames of {self._even_size()} pixels were written as {size}")
            if found != self.num_frames:
                raise IoError(
                    f"{self.path}: cannot write: {found} of {self.num_frames} frames are in the file: is the disk full?"
                )
            self._file.commit()
        finally:
            self.discard()

    def discard(self) -> None:
        """Leave nothing behind; after `close` this does nothing."""
        self._is_done = True
        if self._writer is not None:
            self._writer.release()
        self._name.close()
        self._file.discard()

    def _even_size(self) -> tuple[int, int]:
        height, width = self._shape[:2]
        return width + width % 2, height + height % 2

    def _open(self) -> Any:
        suffix = self.path.suffix.lower()
        fourcc = self._cv2.VideoWriter_fourcc(*_CODECS[suffix])
        name = self._name.enter_context(utf8_name(self._file.temporary_path))
        # OpenCV prints a remark about every WebM file, whatever its log level, that means nothing.
        with silent_stderr() if suffix == ".webm" else nullcontext():
            writer = self._cv2.VideoWriter(name, fourcc, self._fps, self._even_size())
        if not writer.isOpened():
            raise IoError(f"{self.path}: this OpenCV cannot write {self.path.suffix} video here")
        return writer


def write_video(path: str | PathLike[str], frames: Iterable[Frame], fps: float) -> None:
    """Write BGR frames as a video; the file appears whole or not at all.

    Parameters
    ----------
    path : path-like
        The suffix chooses the format, see `VideoWriter`.
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
    with VideoWriter(path, fps) as writer:
        for frame in frames:
            writer.write(frame)


def _measured(path: Path) -> tuple[int, tuple[int, int]]:
    """Frames that a reader finds in a file, their width and height; 0 in one that is none."""
    cv2 = import_opencv("to read video")
    count = 0
    try:
        with open_video(path) as capture:
            size = (int(capture.get(cv2.CAP_PROP_FRAME_WIDTH)), int(capture.get(cv2.CAP_PROP_FRAME_HEIGHT)))
            while capture.grab():
                count += 1
    except FormatError:
        return 0, (0, 0)
    return count, size


def _require_frame(frame: Frame, shape: tuple[int, ...], index: int) -> None:
    if frame.dtype != np.uint8 or frame.ndim != 3 or frame.shape[2] != 3 or frame.shape != shape:
        raise InvalidArgument(
            f"frame {index} has shape {frame.shape} and type {frame.dtype}, "
            f"expected uint8 of shape (height, width, 3), all alike; frame 0 has {shape}"
        )
