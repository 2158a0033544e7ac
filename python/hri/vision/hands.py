# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Hands in clips: silhouettes by colours learned from the clip, and landmarks of a tracker."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.core.optional import import_optional

Frame = NDArray[np.uint8]
Progress = Callable[[int, int], None]

NUM_LANDMARKS = 21
NUM_TRACK_COLUMNS = 3
SHORTEST_CLIP = 8
"""Frames from which on the colours of hand and background are learned from the clip."""
LEAST_QUALITY = 0.25
"""Of a silhouette that a recogniser takes for a hand. Hands have more in any light; walls without one mostly less."""

_WRIST = 0
_FINGER_JOINTS = tuple(tuple(range(first, first + 4)) for first in (1, 5, 9, 13, 17))


def find_silhouettes(
    clip: Sequence[Frame],
    silhouette: Any = None,
    progress: Progress | None = None,
    *,
    smooth: bool = True,
    background: Frame | None = None,
) -> list[Any]:
    """The silhouette of the hand in every frame.

    Parameters
    ----------
    clip : sequence of uint8 arrays, shape (height, width, 3), BGR
    silhouette : hri._native_vision.SilhouetteOptions, optional
        How the hand is found in every picture by itself. Without it, the colours of hand and background are learned
        from a clip of `SHORTEST_CLIP` frames or more; shorter clips, and those in which no hand stands out, are
        segmented picture by picture with default options.
    progress : callable, optional
        Called with (done, total) frames.
    smooth : bool
        Repair masks that jump for a frame or two (`hri._native_vision.smooth_masks`).
    background : uint8 array of the frames' shape, optional
        The place without a person, by the same camera: every frame is then segmented by itself, and what looks like
        skin in frame or background, but not in both, is the hand. `background_of` finds it in the clip itself.

    Returns
    -------
    list of hri._native_vision.Silhouette
    """
    return _silhouettes(clip, silhouette, progress, 1, smooth, background)


def background_of(clip: Sequence[Frame]) -> Frame:
    """What a clip shows behind whoever moves in it: every pixel's median over up to 25 frames spread over the clip.

    Where somebody stays in place for half of the clip, as a palm does that rests before it moves, this is part of it.

    Raises
    ------
    InvalidArgument
        For a clip without frames, or of frames that differ in size.
    """
    from hri._native import InvalidArgument

    if len({frame.shape for frame in clip}) != 1:
        raise InvalidArgument("a background needs frames, all of one size")
    at = np.unique(np.linspace(0, len(clip) - 1, 25).round().astype(int))
    return np.median([clip[i] for i in at], axis=0).astype(np.uint8)


@dataclass(frozen=True)
class PairedHand:
    """One of two hands in a frame, as recognisers take silhouettes.

    Attributes
    ----------
    grey, mask : ndarray of uint8
        The picture and the hand in it, at the working size; without a hand the mask is all 0.
    quality : float
        0 (no hand) .. 1, of both hands of the frame.
    repaired : bool
        The frames around it made the mask, because it jumped.
    touching : bool
        One region holds both hands: the border between them is a guess.
    """

    grey: NDArray[np.uint8]
    mask: NDArray[np.uint8]
    quality: float
    repaired: bool = False
    touching: bool = False


def find_hands(
    clip: Sequence[Frame],
    max_hands: int = 2,
    silhouette: Any = None,
    progress: Progress | None = None,
    *,
    smooth: bool = True,
    background: Frame | None = None,
) -> dict[str, list[Any]]:
    """The silhouettes of one hand, or of both, in every frame.

    Parameters
    ----------
    clip, silhouette, progress, smooth, background
        As for `find_silhouettes`.
    max_hands : int
        1 or 2.

    Returns
    -------
    dict of str to list
        "hand": what `find_silhouettes` gives; or "left" and "right": a `PairedHand` for every frame, of the hand that
        was on that side of the picture when both were first seen. Labels stay with the hands when these touch or cross
        (`hri._native.HandPairTracker`). A face in view may be taken for a hand.
    """
    from hri import _native

    if max_hands not in (1, 2):
        raise _native.InvalidArgument(f"max_hands is {max_hands}, must be 1 or 2")
    found = _silhouettes(clip, silhouette, progress, max_hands, smooth, background)
    if max_hands == 1:
        return {"hand": found}
    tracker = _native.HandPairTracker()
    sides: dict[str, list[Any]] = {"left": [], "right": []}
    for shape in found:
        for hands, hand in zip(sides.values(), tracker.push(shape.mask), strict=True):
            grey, mask = np.asarray(shape.grey), np.asarray(hand.mask)
            quality = shape.quality if hand.seen else 0.0
            hands.append(PairedHand(grey, mask, quality, shape.repaired, hand.touching))
    return sides


def _silhouettes(
    clip: Sequence[Frame],
    silhouette: Any,
    progress: Progress | None,
    max_hands: int,
    smooth: bool,
    background: Frame | None,
) -> list[Any]:
    from hri import _native_vision

    frames = [np.ascontiguousarray(frame) for frame in clip]
    finder: Any = None
    if silhouette is None and background is None and len(frames) >= SHORTEST_CLIP:
        finder = _native_vision.HandColours.learn(frames, _native_vision.HandColourOptions(max_hands=max_hands))
    if finder is None:
        asked = {} if silhouette is None else silhouette.as_dict()
        options = _native_vision.SilhouetteOptions(**{**asked, "max_hands": max_hands})
        finder = _native_vision.SilhouetteExtractor(options, background)
    found = [finder.extract(frame) for frame in _counted(frames, progress)]
    return list(_native_vision.smooth_masks(found)) if smooth else found


def find_landmarks(
    clip: Sequence[Frame], progress: Progress | None = None, *, each_alone: bool = False
) -> list[NDArray[np.float32] | None]:
    """The joints of the hand in every frame, by MediaPipe's tracker (extra `mediapipe`).

    Parameters
    ----------
    clip : sequence of uint8 arrays, shape (height, width, 3), BGR
    progress : callable, optional
        Called with (done, total) frames.
    each_alone : bool
        Look for the hand anew in every frame, for pictures that do not follow on one another.

    Returns
    -------
    list of ndarray of float32, shape (21, 2), or None
        x and y in pixels; None where no hand is found.

    Raises
    ------
    ImportError
        Without MediaPipe; the message names the extra.
    """
    mediapipe = import_optional("mediapipe", "mediapipe", "to find the landmarks of hands")
    found: list[NDArray[np.float32] | None] = []
    with mediapipe.solutions.hands.Hands(
        static_image_mode=each_alone,
        max_num_hands=1,
        model_complexity=1,
        min_detection_confidence=0.3,
        min_tracking_confidence=0.3,
    ) as tracker:
        for frame in _counted(clip, progress):
            hands = tracker.process(np.ascontiguousarray(frame[:, :, ::-1])).multi_hand_landmarks
            if not hands:
                found.append(None)
                continue
            size = np.array([frame.shape[1], frame.shape[0]], np.float32)
            found.append(np.array([(p.x, p.y) for p in hands[0].landmark], np.float32) * size)
    return found


def _counted(frames: Sequence[Frame], progress: Progress | None) -> Iterator[Frame]:
    """The frames one by one; each is done when the next is asked for."""
    for done, frame in enumerate(frames, 1):
        yield frame
        if progress is not None:
            progress(done, len(frames))


def landmark_features(
    landmarks: Sequence[NDArray[np.float32] | None], frame_size: tuple[int, int]
) -> NDArray[np.float32]:
    """Features of the frames that have landmarks, a row a frame, as `GestureRecognizer.features` gives them.

    Shape: the joints from their centre, scaled by the size of the hand, and the direction of every bone of the fingers.
    Track: centre x and y and the log of the area, in units of the frame.

    Parameters
    ----------
    landmarks : sequence of ndarray of float32, shape (21, 2), or None
        In pixels, as `find_landmarks` gives them.
    frame_size : tuple of int
        Width and height of the frames in pixels.
    """
    rows = [_landmark_row(np.asarray(p, np.float64), frame_size) for p in landmarks if p is not None]
    num_bones = sum(len(finger) for finger in _FINGER_JOINTS)
    width = 2 * NUM_LANDMARKS + 2 * num_bones + NUM_TRACK_COLUMNS
    return np.asarray(rows, np.float32).reshape(len(rows), width)


def landmark_column_names() -> list[str]:
    """Names of the columns that `landmark_features` gives; joints are numbered as MediaPipe's are, 0 is the wrist."""
    joints = [f"joint{joint}_{axis}" for joint in range(NUM_LANDMARKS) for axis in "xy"]
    bones = [f"bone{joint}_{axis}" for finger in _FINGER_JOINTS for joint in finger for axis in "xy"]
    return [*joints, *bones, "x", "y", "log_area"]


def _landmark_row(points: NDArray[np.float64], frame_size: tuple[int, int]) -> NDArray[np.float64]:
    centre = points.mean(axis=0)
    size = max(float(np.sqrt(((points - centre) ** 2).sum(axis=1).mean())), 1e-6)
    joints = (points - centre) / size
    bones = []
    for finger in _FINGER_JOINTS:
        for start, end in zip((_WRIST, *finger), finger, strict=False):
            bone = points[end] - points[start]
            bones.append(bone / max(float(np.linalg.norm(bone)), 1e-6))
    extent = np.ptp(points, axis=0) / np.asarray(frame_size)
    log_area = np.log(max(float(extent.prod()), 1e-6))
    # Bones of one finger have the weight of a joint.
    shape = np.concatenate([joints.ravel(), 0.5 * np.concatenate(bones)])
    return np.concatenate([shape, centre / np.asarray(frame_size), [log_area]])
