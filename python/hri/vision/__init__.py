# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Hands in pictures: silhouettes, landmarks, drawings and reports of what was found.

What is of `hri.vision.silhouettes` is loaded on first use, and OpenCV with it.
"""

from typing import TYPE_CHECKING

from hri.core.lazy import loader
from hri.vision.hands import (
    background_of,
    find_hands,
    find_silhouettes,
)

if TYPE_CHECKING:
    from hri.vision.silhouettes import (
        HandColourOptions,
        HandColours,
        MaskSmoothingOptions,
        SilhouetteExtractor,
        SilhouetteOptions,
        smooth_masks,
    )
else:
    __getattr__ = loader(
        __name__,
        {
            "hri.vision.silhouettes": (
                "HandColourOptions",
                "HandColours",
                "MaskSmoothingOptions",
                "SilhouetteExtractor",
                "SilhouetteOptions",
                "smooth_masks",
            )
        },
    )

__all__ = [
    "HandColourOptions",
    "HandColours",
    "MaskSmoothingOptions",
    "SilhouetteExtractor",
    "SilhouetteOptions",
    "background_of",
    "find_hands",
    "find_silhouettes",
    "smooth_masks",
]
