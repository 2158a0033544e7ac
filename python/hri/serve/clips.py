# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Clips that a person drops on the page."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from hri.core.errors import FormatError, IoError
from hri.core.optional import import_opencv
from hri.core.phrases import Phrase, phrase, phrase_of
from hri.live.frames import Frame
from hri.media import iterate_frames, read_image
from hri.media.suffixes import IMAGE_SUFFIXES, kind_of_file
from hri.serve.limits import ServeLimits

_WIDTH_PX = 480
"""As of the pictures that the page takes with the camera; larger ones are made smaller."""


def read_clip(path: Path, name: str, limits: ServeLimits) -> list[Frame]:
    """The pictures of a video, or a picture, as wide as those of the page's camera at most.

    Parameters
    ----------
    path : Path
    name : str
        The file's name in errors.
    limits : ServeLimits

    Raises
    ------
    FormatError
        For a file that is neither, a damaged one, one of more pictures than `limits.max_clip_pictures`, and for
        pictures of more than `limits.max_picture_px` pixels.
    """
    frames: list[Frame] = []
    try:
        for frame in _frames(path):
            height, width = frame.shape[:2]
            if height * width > limits.max_picture_px:
                raise FormatError(phrase("clip_large", name=name, width=width, height=height))
            if len(frames) == limits.max_clip_pictures:
                raise FormatError(phrase("clip_long", name=name, most=limits.max_clip_pictures))
            frames.append(_narrowed(frame))
    except (FormatError, IoError) as error:
        said = phrase_of(error)
        raise FormatError(said if isinstance(said, Phrase) else said.replace(str(path), name)) from error
    return frames


def _frames(path: Path) -> Iterator[Frame]:
    if kind_of_file(path) == "a picture" or path.suffix.lower() in IMAGE_SUFFIXES:
        yield read_image(path)
    else:
        yield from (frame for frame, _ in iterate_frames(path))


def _narrowed(frame: Frame) -> Frame:
    height, width = frame.shape[:2]
    if width <= _WIDTH_PX:
        return frame
    cv2 = import_opencv("to read clips")
    size = (_WIDTH_PX, max(1, round(height * _WIDTH_PX / width)))
    small: Frame = cv2.resize(frame, size, interpolation=cv2.INTER_AREA)
    return small
