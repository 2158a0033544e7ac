# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
# Written by tools/generate_stubs.py from the compiled module; do not edit.
"""
libhri's vision part: silhouettes of hands in colour pictures.
"""

from __future__ import annotations
import collections.abc
import hri._native
from hri._native import HandColourOptions
from hri._native import HandFinderOptions
from hri._native import HandObservation
from hri._native import MaskSmoothingOptions
from hri._native import SilhouetteOptions
import numpy
import numpy.typing
import os
import typing

__all__: list[str] = [
    "Face",
    "FaceFinder",
    "FaceFinderOptions",
    "GestureEvent",
    "GestureSpotter",
    "GestureStream",
    "GestureStreamOptions",
    "HandColourOptions",
    "HandColours",
    "HandFinder",
    "HandFinderOptions",
    "HandObservation",
    "HandStream",
    "MaskSmoothingOptions",
    "PersonHands",
    "PersonOptions",
    "SilhouetteExtractor",
    "SilhouetteOptions",
    "background_of",
    "gesture_features",
    "recognise_gesture",
    "smooth_masks",
]

class SilhouetteExtractor:
    """
    Finds the hand in colour pictures.
    """
    def __init__(
        self,
        options: hri._native.SilhouetteOptions = ...,
        background: typing.Annotated[numpy.typing.ArrayLike, numpy.uint8] | None = None,
    ) -> None:
        """
        background: uint8, shape (height, width, 3), the place without a person.
        """
    def extract(self, bgr: typing.Annotated[numpy.typing.ArrayLike, numpy.uint8]) -> hri._native.HandObservation:
        """
        bgr: uint8, shape (height, width, 3).
        """

class HandColours:
    """
    Finds the hand by the colours it has in its own clip.
    """
    @staticmethod
    def learn(
        frames: collections.abc.Sequence[typing.Annotated[numpy.typing.ArrayLike, numpy.uint8]],
        options: hri._native.HandColourOptions = ...,
    ) -> HandColours | None:
        """
        frames: uint8, each of shape (height, width, 3), BGR. None where no hand stands out.
        """
    def extract(self, bgr: typing.Annotated[numpy.typing.ArrayLike, numpy.uint8]) -> hri._native.HandObservation:
        """
        bgr: uint8, shape (height, width, 3).
        """
    @property
    def quality(self) -> float:
        """
        How well the pixels on both sides of the outline separate, 0..1.
        """

class FaceFinderOptions:
    """
    How faces are found.

    Parameters
    ----------
    max_side_px : int, default 640
        larger pictures are scaled down to this first; 32..4096 px
    min_side : float, default 0.025
        side of the smallest face, as a share of the picture's longer side; 0..1
    scale_step : float, default 1.1
        ratio of one size that is tried to the next; 1.01..2
    min_neighbours : int, default 2
        windows that must agree on a face, a pixel or a size apart; 1..100
    sure_neighbours : int, default 15
        a single picture in which fewer agree is searched again at twice its size, where small faces stand out; 0: never; 0..1000
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[hri._native.OptionField]:
        """
        What each field is, in their order.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(
        self,
        *,
        max_side_px: int = 640,
        min_side: float = 0.025,
        scale_step: float = 1.1,
        min_neighbours: int = 2,
        sure_neighbours: int = 15,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def max_side_px(self) -> int:
        """
        larger pictures are scaled down to this first
        """
    @max_side_px.setter
    def max_side_px(self, arg1: typing.Any) -> None: ...
    @property
    def min_neighbours(self) -> int:
        """
        windows that must agree on a face, a pixel or a size apart
        """
    @min_neighbours.setter
    def min_neighbours(self, arg1: typing.Any) -> None: ...
    @property
    def min_side(self) -> float:
        """
        side of the smallest face, as a share of the picture's longer side
        """
    @min_side.setter
    def min_side(self, arg1: typing.Any) -> None: ...
    @property
    def scale_step(self) -> float:
        """
        ratio of one size that is tried to the next
        """
    @scale_step.setter
    def scale_step(self, arg1: typing.Any) -> None: ...
    @property
    def sure_neighbours(self) -> int:
        """
        a single picture in which fewer agree is searched again at twice its size, where small faces stand out; 0: never
        """
    @sure_neighbours.setter
    def sure_neighbours(self, arg1: typing.Any) -> None: ...

class PersonOptions:
    """
    How the hands of a person whose face is seen are found.

    Parameters
    ----------
    face_side_px : int, default 32
        pictures with larger faces are scaled down to this first; 8..512 px
    reach : float, default 4.8
        distance of a hand's centre from that of the face, at most, in sides of the face; 0.5..10
    signing_reach : float, default 3.2
        where one hand is looked for, one farther away hangs: it is chosen where there is no other; 0.5..10
    min_area : float, default 0.06
        smallest area of a hand, in areas of the face; 0..100
    max_area : float, default 2.2
        largest; 0..100
    min_log_ratio : float, default 0.0
        from which logarithm of the ratio of the histograms of skin and room on a pixel is skin; -4..4
    num_rounds : int, default 1
        rounds of adding the colours of the hand that was found to those of the face; 0..10
    face_interval : int, default 5
        the face is looked for in one frame of so many; 1..1000
    max_hands : int, default 1
        regions that masks hold, the most likely; HandPairTracker decides which is which; 1..2
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[hri._native.OptionField]:
        """
        What each field is, in their order.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(
        self,
        *,
        face_side_px: int = 32,
        reach: float = 4.8,
        signing_reach: float = 3.2,
        min_area: float = 0.06,
        max_area: float = 2.2,
        min_log_ratio: float = 0.0,
        num_rounds: int = 1,
        face_interval: int = 5,
        max_hands: int = 1,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def face_interval(self) -> int:
        """
        the face is looked for in one frame of so many
        """
    @face_interval.setter
    def face_interval(self, arg1: typing.Any) -> None: ...
    @property
    def face_side_px(self) -> int:
        """
        pictures with larger faces are scaled down to this first
        """
    @face_side_px.setter
    def face_side_px(self, arg1: typing.Any) -> None: ...
    @property
    def max_area(self) -> float:
        """
        largest
        """
    @max_area.setter
    def max_area(self, arg1: typing.Any) -> None: ...
    @property
    def max_hands(self) -> int:
        """
        regions that masks hold, the most likely; HandPairTracker decides which is which
        """
    @max_hands.setter
    def max_hands(self, arg1: typing.Any) -> None: ...
    @property
    def min_area(self) -> float:
        """
        smallest area of a hand, in areas of the face
        """
    @min_area.setter
    def min_area(self, arg1: typing.Any) -> None: ...
    @property
    def min_log_ratio(self) -> float:
        """
        from which logarithm of the ratio of the histograms of skin and room on a pixel is skin
        """
    @min_log_ratio.setter
    def min_log_ratio(self, arg1: typing.Any) -> None: ...
    @property
    def num_rounds(self) -> int:
        """
        rounds of adding the colours of the hand that was found to those of the face
        """
    @num_rounds.setter
    def num_rounds(self, arg1: typing.Any) -> None: ...
    @property
    def reach(self) -> float:
        """
        distance of a hand's centre from that of the face, at most, in sides of the face
        """
    @reach.setter
    def reach(self, arg1: typing.Any) -> None: ...
    @property
    def signing_reach(self) -> float:
        """
        where one hand is looked for, one farther away hangs: it is chosen where there is no other
        """
    @signing_reach.setter
    def signing_reach(self, arg1: typing.Any) -> None: ...

class Face:
    """
    The square around a face.
    """
    def __init__(
        self,
        left_px: typing.SupportsFloat | typing.SupportsIndex,
        top_px: typing.SupportsFloat | typing.SupportsIndex,
        side_px: typing.SupportsFloat | typing.SupportsIndex,
    ) -> None:
        """
        In pixels of the picture.
        """
    @property
    def left_px(self) -> float:
        """
        Column of its left side.
        """
    @property
    def side_px(self) -> float:
        """
        Width and height.
        """
    @property
    def top_px(self) -> float:
        """
        Row of its upper side.
        """

class FaceFinder:
    """
    Finds the face in pictures.
    """
    def __init__(self, cascade: str | bytes | os.PathLike[str], options: FaceFinderOptions = ...) -> None:
        """
        cascade: path of a cascade of classifiers, as OpenCV writes them.
        """
    def find(self, bgr: typing.Annotated[numpy.typing.ArrayLike, numpy.uint8]) -> Face | None:
        """
        The Face on which most windows agree, or None. bgr: uint8, shape (height, width, 3).
        """
    def find_in_still(self, bgr: typing.Annotated[numpy.typing.ArrayLike, numpy.uint8]) -> Face | None:
        """
        The same of a single picture: where fewer than sure_neighbours windows agree it is searched at twice its size, too, for faces that are small.
        """

class PersonHands:
    """
    Finds the hands of a person whose face is seen.
    """
    def __init__(self, options: PersonOptions = ...) -> None: ...
    def extract(
        self, bgr: typing.Annotated[numpy.typing.ArrayLike, numpy.uint8], face: Face
    ) -> hri._native.HandObservation:
        """
        The HandObservation of the person with this face. bgr: uint8, shape (height, width, 3).
        """

class HandStream:
    """
    The hand in one stream of pictures.
    """
    def push(
        self,
        bgr: typing.Annotated[numpy.typing.ArrayLike, numpy.uint8],
        time_s: typing.SupportsFloat | typing.SupportsIndex,
        in_gesture: bool = False,
    ) -> hri._native.HandObservation:
        """
        The HandObservation of the next picture.
        """
    @property
    def renewed(self) -> bool:
        """
        Hands are found in another way since the last picture.
        """

class HandFinder:
    """
    Finds hands in clips and streams.
    """
    def __init__(
        self,
        options: hri._native.HandFinderOptions = ...,
        background: typing.Annotated[numpy.typing.ArrayLike, numpy.uint8] | None = None,
        faces: FaceFinder | None = None,
        person: PersonOptions = ...,
    ) -> None:
        """
        background: uint8, shape (height, width, 3), the place without a person. faces: where one is seen, hands are found as that person's.
        """
    def find(
        self,
        clip: collections.abc.Sequence[typing.Annotated[numpy.typing.ArrayLike, numpy.uint8]],
        progress: collections.abc.Callable[[int, int], None] | None = None,
    ) -> list[hri._native.HandObservation]:
        """
        A HandObservation for every frame.
        """
    def find_pair(
        self,
        clip: collections.abc.Sequence[typing.Annotated[numpy.typing.ArrayLike, numpy.uint8]],
        progress: collections.abc.Callable[[int, int], None] | None = None,
    ) -> typing.Annotated[list[list[hri._native.HandObservation]], "FixedSize(2)"]:
        """
        The observations of the left hand of the picture, and those of the right one.
        """
    def stream(self, dynamic: bool = True, max_hands: typing.SupportsInt | typing.SupportsIndex = 1) -> HandStream:
        """
        A HandStream of its own, of masks of one hand or both; `dynamic`: by colours learned from the stream.
        """
    @property
    def options(self) -> hri._native.HandFinderOptions:
        """
        As passed, with defaults filled in.
        """

class GestureSpotter:
    """
    Gesture segments in a stream of pictures.
    """
    def __init__(
        self,
        hands: HandFinder,
        dynamic: bool = True,
        options: hri._native.GestureSegmenterOptions = ...,
        max_hands: typing.SupportsInt | typing.SupportsIndex = 1,
    ) -> None: ...
    def finish(self) -> hri._native.GestureSegment:
        """
        The stream has ended: the GestureSegment that ends with it.
        """
    def interrupt(self) -> hri._native.GestureSegment:
        """
        Pictures are missing: drops the gesture that has begun.
        """
    def push(
        self,
        bgr: typing.Annotated[numpy.typing.ArrayLike, numpy.uint8],
        time_s: typing.SupportsFloat | typing.SupportsIndex,
    ) -> hri._native.GestureSegment:
        """
        The GestureSegment event of the next picture.
        """
    @property
    def hand(self) -> hri._native.HandObservation:
        """
        The hand in the last picture, a HandObservation.
        """
    @property
    def in_gesture(self) -> bool:
        """
        A gesture has begun and not ended.
        """
    @property
    def kept_since_s(self) -> float:
        """
        Pictures from then on may belong to a gesture.
        """
    @property
    def place(self) -> typing.Any:
        """
        x, y and area in shares; None without a hand.
        """

class GestureStreamOptions:
    """
    How the gestures of a stream are decided on.

    Parameters
    ----------
    segmenter : GestureSegmenterOptions or dict
        when a gesture begins and ends
    max_pause_s : float, default 2.5
        after a longer pause, what was shown before it is another gesture; 0..1000000 s
    partial_interval_s : float, default 0.5
        between decisions on a gesture that has not ended; 0..1000000, 0 excluded, or infinite s
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[hri._native.OptionField]:
        """
        What each field is, in their order.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(
        self,
        *,
        segmenter: hri._native.GestureSegmenterOptions | collections.abc.Mapping[str, typing.Any] = ...,
        max_pause_s: float = 2.5,
        partial_interval_s: float = 0.5,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def max_pause_s(self) -> float:
        """
        after a longer pause, what was shown before it is another gesture
        """
    @max_pause_s.setter
    def max_pause_s(self, arg1: typing.Any) -> None: ...
    @property
    def partial_interval_s(self) -> float:
        """
        between decisions on a gesture that has not ended
        """
    @partial_interval_s.setter
    def partial_interval_s(self, arg1: typing.Any) -> None: ...
    @property
    def segmenter(self) -> hri._native.GestureSegmenterOptions:
        """
        when a gesture begins and ends
        """
    @segmenter.setter
    def segmenter(self, arg1: typing.Any) -> None: ...

class GestureEvent:
    """
    What happened with a picture of a stream.
    """
    @property
    def decision(self) -> hri._native.Decision:
        """
        The Decision; empty for segments.
        """
    @property
    def kind(self) -> typing.Literal["segment", "partial", "preliminary", "decision"]:
        """
        'segment', 'partial', 'preliminary' or 'decision'.
        """
    @property
    def segment(self) -> hri._native.GestureSegment:
        """
        The GestureSegment that this is about.
        """

class GestureStream:
    """
    Decides on the gestures of a stream.
    """
    @staticmethod
    def options_for(recognizer: hri._native.GestureRecognizer) -> GestureStreamOptions: ...
    def __init__(
        self,
        recognizer: hri._native.GestureRecognizer,
        options: GestureStreamOptions | None = None,
        faces: FaceFinder | None = None,
    ) -> None:
        """
        faces: a FaceFinder, by which hands are found while a face is seen.
        """
    def finish(self) -> list[GestureEvent]:
        """
        The stream has ended: preliminary decisions settle.
        """
    def interrupt(self) -> list[GestureEvent]:
        """
        What was shown and has not settled is forgotten.
        """
    def push(
        self,
        bgr: typing.Annotated[numpy.typing.ArrayLike, numpy.uint8],
        time_s: typing.SupportsFloat | typing.SupportsIndex,
        landmarks: collections.abc.Sequence[typing.Annotated[numpy.typing.ArrayLike, numpy.float32]] = [],
    ) -> list[GestureEvent]:
        """
        The events of the next picture; landmarks of every hand found, the surest first, in pixels, float32, shape (21, 2).
        """
    @property
    def hand(self) -> hri._native.HandObservation:
        """
        The hand in the last picture, a HandObservation.
        """
    @property
    def in_gesture(self) -> bool:
        """
        A gesture has begun and not ended.
        """
    @property
    def options(self) -> GestureStreamOptions:
        """
        As passed, with defaults filled in.
        """
    @property
    def place(self) -> typing.Any:
        """
        x, y and area in shares; None without a hand.
        """

def background_of(
    clip: collections.abc.Sequence[typing.Annotated[numpy.typing.ArrayLike, numpy.uint8]],
) -> numpy.typing.NDArray[numpy.uint8]:
    """
    Every pixel's median over up to 25 frames spread over the clip.
    """

def gesture_features(
    clip: collections.abc.Sequence[typing.Annotated[numpy.typing.ArrayLike, numpy.uint8]],
    options: hri._native.GestureRecognizerOptions,
    faces: FaceFinder | None = None,
) -> numpy.typing.NDArray[numpy.float32]:
    """
    Rows of features of a clip, float32.
    """

def recognise_gesture(
    recognizer: hri._native.GestureRecognizer,
    clip: collections.abc.Sequence[typing.Annotated[numpy.typing.ArrayLike, numpy.uint8]],
) -> hri._native.Decision:
    """
    The Decision on a clip of BGR frames.
    """

def smooth_masks(
    silhouettes: collections.abc.Sequence[hri._native.HandObservation], options: hri._native.MaskSmoothingOptions = ...
) -> list[hri._native.HandObservation]:
    """
    Silhouettes of a clip, with masks repaired that jump for a frame or two between frames that agree, and have less quality than these.
    """
