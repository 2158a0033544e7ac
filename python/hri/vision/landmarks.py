# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The joints of hands, as MediaPipe's tracker finds them, and their features."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import ExitStack
from types import TracebackType

import numpy as np
from numpy.typing import NDArray

from hri.core.optional import import_optional

Frame = NDArray[np.uint8]
Landmarks = NDArray[np.float32]


class LandmarkTracker:
    """Finds the joints of the hand in pictures that follow on one another (extra `mediapipe`).

    Parameters
    ----------
    each_alone : bool
        Look for the hand anew in every picture, for pictures that do not follow on one another.
    max_hands : int
        Hands that `find_all` gives, at most.

    Raises
    ------
    ImportError
        Without MediaPipe; the message names the extra.
    """

    def __init__(self, *, each_alone: bool = False, max_hands: int = 1) -> None:
        mediapipe = import_optional("mediapipe", "mediapipe", "to find the landmarks of hands")
        tracker = mediapipe.solutions.hands.Hands(
            static_image_mode=each_alone,
            max_num_hands=max_hands,
            model_complexity=1,
            min_detection_confidence=0.3,
            min_tracking_confidence=0.3,
        )
        self._held = ExitStack()
        self._tracker = self._held.enter_context(tracker)

    def __enter__(self) -> LandmarkTracker:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def find(self, frame: Frame) -> Landmarks | None:
        """x and y of the 21 joints in pixels, float32, shape (21, 2); None where no hand is found.

        `frame` is uint8, shape (height, width, 3), BGR.
        """
        return next(iter(self.find_all(frame)), None)

    def find_all(self, frame: Frame) -> list[Landmarks]:
        """The same of every hand that is found."""
        hands = self._tracker.process(np.ascontiguousarray(frame[:, :, ::-1])).multi_hand_landmarks or []
        size = np.array([frame.shape[1], frame.shape[0]], np.float32)
        return [np.array([(p.x, p.y) for p in hand.landmark], np.float32) * size for hand in hands]

    def close(self) -> None:
        """Give back what the tracker holds."""
        self._held.close()


def find_landmarks(
    clip: Sequence[Frame], progress: Callable[[int, int], None] | None = None, *, each_alone: bool = False
) -> list[Landmarks | None]:
    """The joints of the hand in every frame of a clip, as `LandmarkTracker` finds them.

    Parameters
    ----------
    clip : sequence of uint8 arrays, shape (height, width, 3), BGR
    progress : callable, optional
        Called with (done, total) frames.
    each_alone : bool
        Look for the hand anew in every frame.
    """
    found: list[Landmarks | None] = []
    with LandmarkTracker(each_alone=each_alone) as tracker:
        for done, frame in enumerate(clip, 1):
            found.append(tracker.find(frame))
            if progress is not None:
                progress(done, len(clip))
    return found


def find_landmark_pairs(
    clip: Sequence[Frame], progress: Callable[[int, int], None] | None = None, *, each_alone: bool = False
) -> dict[str, list[Landmarks | None]]:
    """The joints of both hands in every frame of a clip, as `LandmarkTracker` finds them.

    Parameters
    ----------
    clip, progress, each_alone
        As for `find_landmarks`.

    Returns
    -------
    dict of str to list of ndarray or None
        "left" and "right": of the hand that was on that side of the picture when both were first seen. Labels stay with
        the hands when these touch or cross (`hri.features.LandmarkPairTracker`).
    """
    from hri import _native

    sides: dict[str, list[Landmarks | None]] = {"left": [], "right": []}
    pairs = _native.LandmarkPairTracker()
    with LandmarkTracker(each_alone=each_alone, max_hands=2) as tracker:
        for done, frame in enumerate(clip, 1):
            hands = tracker.find_all(frame)
            for side, number in zip(sides.values(), pairs.push(hands, frame.shape[1]), strict=True):
                side.append(None if number < 0 else hands[number])
            if progress is not None:
                progress(done, len(clip))
    return sides


def landmark_pair_features(
    sides: dict[str, list[Landmarks | None]], frame_size: tuple[int, int], relation_weight: float
) -> NDArray[np.float32]:
    """Features of both hands, a row for every frame that shows one, as `GestureRecognizer.features` gives them.

    Parameters
    ----------
    sides : dict
        As `find_landmark_pairs` gives it.
    frame_size : tuple of int
        Width and height of the frames in pixels.
    relation_weight : float
        The option of `GestureRecognizer`.
    """
    from hri import _native

    rows = []
    for side in (sides["left"], sides["right"]):
        of_side = np.full((len(side), len(_native.landmark_column_names())), np.nan, np.float32)
        for row, points in zip(of_side, side, strict=True):
            if points is not None:
                row[:] = _native.landmark_features(points, *frame_size)
        rows.append(of_side)
    return np.asarray(_native.pair_rows(rows[0], rows[1], relation_weight))


def landmark_features(landmarks: Sequence[Landmarks | None], frame_size: tuple[int, int]) -> NDArray[np.float32]:
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
    from hri import _native

    width = len(_native.landmark_column_names())
    rows = [_native.landmark_features(points, *frame_size) for points in landmarks if points is not None]
    return np.asarray(rows, np.float32).reshape(len(rows), width)


def landmark_column_names() -> list[str]:
    """Names of the columns that `landmark_features` gives; joints are numbered as MediaPipe's are, 0 is the wrist."""
    from hri import _native

    return list(_native.landmark_column_names())
