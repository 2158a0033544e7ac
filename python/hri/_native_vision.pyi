# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
# Written by tools/generate_stubs.py from the compiled module; do not edit.
"""
libhri's vision part: silhouettes of hands in colour pictures.
"""

from __future__ import annotations
import collections.abc
import numpy
import numpy.typing
import typing

__all__: list[str] = [
    "HandColourOptions",
    "HandColours",
    "MaskSmoothingOptions",
    "Silhouette",
    "SilhouetteExtractor",
    "SilhouetteMethod",
    "SilhouetteOptions",
    "smooth_masks",
]

class SilhouetteMethod:
    """
    Members:

      chroma_otsu

      hsv

      grey_otsu
    """

    __members__: typing.ClassVar[dict[str, SilhouetteMethod]]
    chroma_otsu: typing.ClassVar[SilhouetteMethod]
    grey_otsu: typing.ClassVar[SilhouetteMethod]
    hsv: typing.ClassVar[SilhouetteMethod]
    @typing.overload
    def __eq__(self, other: SilhouetteMethod) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: SilhouetteMethod) -> bool: ...
    @typing.overload
    def __ne__(self, other: typing.Any) -> bool: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, state: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __str__(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class SilhouetteOptions:
    """
    How the hand is found in a picture.
    """

    __hash__: typing.ClassVar[None] = None
    method: SilhouetteMethod
    remove_face: bool
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __init__(self, **kwargs) -> None: ...
    def __repr__(self) -> str: ...
    def as_dict(self) -> dict: ...
    @property
    def blur_px(self) -> int: ...
    @blur_px.setter
    def blur_px(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def max_area(self) -> float: ...
    @max_area.setter
    def max_area(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def max_hands(self) -> int: ...
    @max_hands.setter
    def max_hands(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def max_side_px(self) -> int: ...
    @max_side_px.setter
    def max_side_px(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def min_area(self) -> float: ...
    @min_area.setter
    def min_area(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def min_contrast(self) -> float: ...
    @min_contrast.setter
    def min_contrast(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def min_quality(self) -> float: ...
    @min_quality.setter
    def min_quality(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def sure_contrast(self) -> float: ...
    @sure_contrast.setter
    def sure_contrast(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...

class Silhouette:
    """
    What was found in one picture.
    """
    @property
    def grey(self) -> numpy.typing.NDArray[numpy.uint8]: ...
    @property
    def mask(self) -> numpy.typing.NDArray[numpy.uint8]: ...
    @property
    def quality(self) -> float: ...
    @property
    def repaired(self) -> bool:
        """
        The frames around it made the mask, because it jumped: see smooth_masks.
        """

class MaskSmoothingOptions:
    """
    Which masks of a clip are repaired.
    """

    __hash__: typing.ClassVar[None] = None
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __init__(self, **kwargs) -> None: ...
    def __repr__(self) -> str: ...
    def as_dict(self) -> dict: ...
    @property
    def max_gap(self) -> int: ...
    @max_gap.setter
    def max_gap(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def max_overlap(self) -> float: ...
    @max_overlap.setter
    def max_overlap(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def min_agreement(self) -> float: ...
    @min_agreement.setter
    def min_agreement(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...

class SilhouetteExtractor:
    """
    Finds the hand in colour pictures.
    """
    def __init__(
        self,
        options: SilhouetteOptions = ...,
        background: typing.Annotated[numpy.typing.ArrayLike, numpy.uint8] | None = None,
    ) -> None:
        """
        background: uint8, shape (height, width, 3), the place without a person.
        """
    def extract(self, bgr: typing.Annotated[numpy.typing.ArrayLike, numpy.uint8]) -> Silhouette:
        """
        bgr: uint8, shape (height, width, 3).
        """

class HandColourOptions:
    """
    How the colours of hand and background are learned from a clip.
    """

    __hash__: typing.ClassVar[None] = None
    remove_still: bool
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __init__(self, **kwargs) -> None: ...
    def __repr__(self) -> str: ...
    def as_dict(self) -> dict: ...
    @property
    def fit_side_px(self) -> int: ...
    @fit_side_px.setter
    def fit_side_px(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def max_area(self) -> float: ...
    @max_area.setter
    def max_area(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def max_hands(self) -> int: ...
    @max_hands.setter
    def max_hands(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def max_side_px(self) -> int: ...
    @max_side_px.setter
    def max_side_px(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def min_area(self) -> float: ...
    @min_area.setter
    def min_area(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def min_quality(self) -> float: ...
    @min_quality.setter
    def min_quality(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def num_fit_frames(self) -> int: ...
    @num_fit_frames.setter
    def num_fit_frames(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def num_rounds(self) -> int: ...
    @num_rounds.setter
    def num_rounds(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...

class HandColours:
    """
    Finds the hand by the colours it has in its own clip.
    """
    @staticmethod
    def learn(
        frames: collections.abc.Sequence[typing.Annotated[numpy.typing.ArrayLike, numpy.uint8]],
        options: HandColourOptions = ...,
    ) -> HandColours | None:
        """
        frames: uint8, each of shape (height, width, 3), BGR. None where no hand stands out.
        """
    def extract(self, bgr: typing.Annotated[numpy.typing.ArrayLike, numpy.uint8]) -> Silhouette:
        """
        bgr: uint8, shape (height, width, 3).
        """
    @property
    def quality(self) -> float: ...

def smooth_masks(
    silhouettes: collections.abc.Sequence[Silhouette], options: MaskSmoothingOptions = ...
) -> list[Silhouette]:
    """
    Silhouettes of a clip, with masks repaired that jump for a frame or two between frames that agree, and have less quality than these.
    """
