# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Hands in clips: silhouettes by the face of a person, or by colours learned from the clip."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.vision.faces import face_finder

Frame = NDArray[np.uint8]
Progress = Callable[[int, int], None]


def find_silhouettes(
    clip: Sequence[Frame],
    silhouette: Any = None,
    progress: Progress | None = None,
    *,
    smooth: bool = True,
    background: Frame | None = None,
    faces: Any = "auto",
) -> list[Any]:
    """The silhouette of the hand in every frame.

    Parameters
    ----------
    clip : sequence of uint8 arrays, shape (height, width, 3), BGR
    silhouette : SilhouetteOptions, optional
        How the hand is found in every picture by itself. Without it, the hand is that of the person whose face is seen;
        where none is, the colours of hand and background are learned from a clip of eight frames or more; shorter
        clips, and those in which no hand stands out, are segmented picture by picture with default options.
    progress : callable, optional
        Called with (done, total) frames.
    smooth : bool
        Repair masks that jump for a frame or two.
    background : uint8 array of the frames' shape, optional
        The place without a person, by the same camera: every frame is then segmented by itself, and what looks like
        skin in frame or background, but not in both, is the hand. `background_of` finds it in the clip itself.
    faces : "auto", "never", a path of a cascade, or hri.vision.FaceFinder
        How faces are found: see `hri.vision.faces.face_finder`. With `silhouette` or `background`, "auto" is "never".

    Returns
    -------
    list of HandObservation
    """
    found: list[Any] = _finder(silhouette, smooth, background, faces).find(_contiguous(clip), progress)
    return found


def find_hands(
    clip: Sequence[Frame],
    max_hands: int = 2,
    silhouette: Any = None,
    progress: Progress | None = None,
    *,
    smooth: bool = True,
    background: Frame | None = None,
    faces: Any = "auto",
) -> dict[str, list[Any]]:
    """The silhouettes of one hand, or of both, in every frame.

    Parameters
    ----------
    clip, silhouette, progress, smooth, background, faces
        As for `find_silhouettes`.
    max_hands : int
        1 or 2.

    Returns
    -------
    dict of str to list of HandObservation
        "hand": what `find_silhouettes` gives; or "left" and "right": of the hand that was on that side of the picture
        when both were first seen. Labels stay with the hands when these touch or cross (`HandPairTracker`). A face that
        `faces` does not find may be mistaken for a hand.
    """
    from hri.core.errors import InvalidArgument

    if max_hands not in (1, 2):
        raise InvalidArgument(f"max_hands is {max_hands}, must be 1 or 2")
    if max_hands == 1:
        hand = find_silhouettes(clip, silhouette, progress, smooth=smooth, background=background, faces=faces)
        return {"hand": hand}
    left, right = _finder(silhouette, smooth, background, faces).find_pair(_contiguous(clip), progress)
    return {"left": left, "right": right}


def background_of(clip: Sequence[Frame]) -> Frame:
    """What a clip shows behind the person who moves in it: every pixel's median over up to 25 of its frames.

    What stays in place for half of the clip, such as a palm that rests before it moves, is part of it.

    Raises
    ------
    InvalidArgument
        For a clip without frames, or of frames that differ in size.
    """
    from hri import _native_vision

    return np.asarray(_native_vision.background_of(_contiguous(clip)), np.uint8)


def hand_place(mask: NDArray[np.uint8]) -> tuple[float, float, float] | None:
    """x and y of the hand's centre, and its area, in shares of the picture; None where the mask is all 0.

    A pixel's centre lies half a pixel from its corner: the centre of a hand that fills the picture is 0.5, 0.5.
    """
    from hri import _native

    place: tuple[float, float, float] | None = _native.hand_place(np.ascontiguousarray(mask))
    return place


def _finder(silhouette: Any, smooth: bool, background: Frame | None, faces: Any) -> Any:
    from hri import _native_vision

    chosen = silhouette is not None or background is not None
    options: dict[str, Any] = {"smooth": smooth}
    if silhouette is not None:
        options |= {"learning": "never", "silhouette": silhouette}
    found = None if chosen and isinstance(faces, str) and faces == "auto" else face_finder(faces)
    return _native_vision.HandFinder(_native_vision.HandFinderOptions(**options), background, faces=found)


def _contiguous(clip: Sequence[Frame]) -> list[Frame]:
    return [np.ascontiguousarray(frame) for frame in clip]
