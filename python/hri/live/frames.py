# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Where live pictures come from: the interface, and clips played as a stream."""

from __future__ import annotations

import time
from collections.abc import Iterable, Iterator
from os import PathLike, fspath
from pathlib import Path
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import FormatError
from hri.live.sources import require_positive
from hri.media import frame_rate, iterate_frames, kind_of_file

Frame = NDArray[np.uint8]
TimedFrame = tuple[Frame, float]


class FrameSource(Protocol):
    """A stream of pictures.

    Attributes
    ----------
    name : str
        What people call it.
    fps : float
        Pictures a second, roughly: the rate of a webcam changes with the light.
    num_lost : int
        Pictures that were lost on the way so far.
    """

    name: str
    fps: float

    @property
    def num_lost(self) -> int: ...

    def read(self) -> TimedFrame | None:
        """The next picture (uint8 BGR) and its time in seconds, never falling; None when the stream has ended. Raises
        Stalled when none comes in time."""
        ...

    def reconnect(self) -> bool:
        """Try once to get pictures again after `read` raised Stalled; returns in bounded time."""
        ...

    def close(self) -> None:
        """Give the device back; returns in bounded time, also when the device is gone."""
        ...


class ClipSource:
    """Frames as a stream.

    Parameters
    ----------
    frames : iterable of uint8 arrays, shape (height, width, 3), BGR
    fps : float
    name : str
    paced : bool
        As fast as they were filmed; otherwise as fast as they are read.
    """

    def __init__(self, frames: Iterable[Frame], fps: float, name: str = "frames", paced: bool = False) -> None:
        require_positive("fps", fps)
        self.name = name
        self.fps = fps
        self.num_lost = 0
        self._paced = paced
        self._timed = self._play(frames)
        self._started_s: float | None = None

    def _play(self, frames: Iterable[Frame]) -> Iterator[TimedFrame]:
        for index, frame in enumerate(frames):
            yield frame, index / self.fps

    def read(self) -> TimedFrame | None:
        """The next frame and its time, None at the end."""
        timed = next(self._timed, None)
        if timed is not None and self._paced:
            if self._started_s is None:
                self._started_s = time.monotonic() - timed[1]
            time.sleep(max(0.0, self._started_s + timed[1] - time.monotonic()))
        return timed

    def reconnect(self) -> bool:
        """What has been played does not come back."""
        return False

    def close(self) -> None:
        """What has not been read is dropped."""
        self._timed = iter(())


class VideoSource(ClipSource):
    """A video file as a stream, with its own times; read as it is played, so that its length does not matter.

    Raises
    ------
    FormatError
        For a file that is no video; from `read`, when its time runs backwards.
    """

    def __init__(self, path: str | PathLike[str], paced: bool = False) -> None:
        kind = kind_of_file(Path(path))
        if kind not in ("", "a video"):
            raise FormatError(f"{fspath(path)} is {kind}, and a video is needed here")
        super().__init__((), frame_rate(path), Path(path).name, paced)
        self._timed = iterate_frames(path)
