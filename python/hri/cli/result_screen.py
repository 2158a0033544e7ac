# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What a watcher finds, in a window or as a film."""

from __future__ import annotations

import os
import sys

import click

from hri.cli.output import in_a_folder
from hri.core.optional import import_opencv
from hri.live import draw_result
from hri.live.frame_results import FrameResult
from hri.media import VideoWriter
from hri.recognition import Decision

_WINDOW = "hri watch"


class ResultScreen:
    """Draws every result into a window, a film, both or neither; a film is kept also when Ctrl-C ends the watch."""

    def __init__(self, video_path: str | None, fps: float, show: bool, top: int) -> None:
        if show:
            _require_windows()
        self._writer = None if video_path is None else VideoWriter(in_a_folder(video_path), fps)
        self._show = show
        self._top = top

    def __enter__(self) -> ResultScreen:
        return self

    def __exit__(self, *_: object) -> None:
        if self._writer is not None and self._writer.num_frames:
            self._writer.close()
        if self._show:
            import_opencv("to show a window").destroyAllWindows()

    def draw(self, result: FrameResult, decision: Decision | None) -> None:
        """Show a result with the newest decision."""
        if self._writer is None and not self._show:
            return
        picture = draw_result(result, decision, self._top)
        if picture is None:
            return
        if self._writer is not None:
            self._writer.write(picture)
        if self._show:
            cv2 = import_opencv("to show a window")
            cv2.imshow(_WINDOW, picture)
            cv2.waitKey(1)


def _require_windows() -> None:
    """Asked before OpenCV is, which may end the whole program where there is no display."""
    cv2 = import_opencv("to show a window")
    if sys.platform.startswith("linux") and not (os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")):
        raise click.UsageError("--show: there is no display here; --video FILE films the same")
    try:
        cv2.namedWindow(_WINDOW)
    except (cv2.error, AttributeError) as error:
        raise click.UsageError("--show: this OpenCV has no windows; --video FILE films the same") from error
