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
import typing

__all__: list[str] = [
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
    ) -> None:
        """
        background: uint8, shape (height, width, 3), the place without a person.
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
    def stream(self, dynamic: bool = True) -> HandStream:
        """
        A HandStream of its own; `dynamic`: by colours learned from the stream.
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
        self, hands: HandFinder, dynamic: bool = True, options: hri._native.GestureSegmenterOptions = ...
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
        self, recognizer: hri._native.GestureRecognizer, options: GestureStreamOptions | None = None
    ) -> None: ...
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
        landmarks: typing.Annotated[numpy.typing.ArrayLike, numpy.float32] | None = None,
    ) -> list[GestureEvent]:
        """
        The events of the next picture; landmarks in pixels, float32, shape (21, 2).
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
