# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Hands in pictures: silhouettes, landmarks, drawings and reports of what was found.

What needs OpenCV is loaded on first use.
"""

from typing import TYPE_CHECKING

from hri._native import HandColourOptions, HandFinderOptions, HandObservation, MaskSmoothingOptions, SilhouetteOptions
from hri.core.lazy import loader
from hri.vision.faces import find_cascade
from hri.vision.hands import background_of, find_hands, find_silhouettes
from hri.vision.persons import PersonTracker, TrackedPerson

if TYPE_CHECKING:
    from hri._native_vision import (
        Face,
        FaceFinder,
        FaceFinderOptions,
        HandColours,
        HandFinder,
        HandStream,
        PersonHands,
        PersonOptions,
        SilhouetteExtractor,
        smooth_masks,
    )
else:
    _LOADED = (
        "Face",
        "FaceFinder",
        "FaceFinderOptions",
        "HandColours",
        "HandFinder",
        "HandStream",
        "PersonHands",
        "PersonOptions",
        "SilhouetteExtractor",
        "smooth_masks",
    )
    __getattr__ = loader(__name__, {"hri._native_vision": _LOADED})

__all__ = [
    "Face",
    "FaceFinder",
    "FaceFinderOptions",
    "HandColourOptions",
    "HandColours",
    "HandFinder",
    "HandFinderOptions",
    "HandObservation",
    "HandStream",
    "MaskSmoothingOptions",
    "PersonHands",
    "PersonOptions",
    "PersonTracker",
    "SilhouetteExtractor",
    "SilhouetteOptions",
    "TrackedPerson",
    "background_of",
    "find_cascade",
    "find_hands",
    "find_silhouettes",
    "smooth_masks",
]
