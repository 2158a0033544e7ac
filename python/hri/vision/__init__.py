# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Hands in pictures: silhouettes, landmarks, drawings and reports of what was found.

What needs OpenCV is loaded on first use.
"""

from typing import TYPE_CHECKING

from hri._native import HandColourOptions, HandFinderOptions, HandObservation, MaskSmoothingOptions, SilhouetteOptions
from hri.core.lazy import loader
from hri.vision.hands import background_of, find_hands, find_silhouettes

if TYPE_CHECKING:
    from hri._native_vision import HandColours, HandFinder, HandStream, SilhouetteExtractor, smooth_masks
else:
    _LOADED = ("HandColours", "HandFinder", "HandStream", "SilhouetteExtractor", "smooth_masks")
    __getattr__ = loader(__name__, {"hri._native_vision": _LOADED})

__all__ = [
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
    "find_hands",
    "find_silhouettes",
    "smooth_masks",
]
