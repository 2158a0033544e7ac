# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What the C++ library sees in pictures: the only module that loads its part with OpenCV."""

from hri._native_vision import (
    HandColourOptions,
    HandColours,
    MaskSmoothingOptions,
    SilhouetteExtractor,
    SilhouetteOptions,
    smooth_masks,
)

__all__ = [
    "HandColourOptions",
    "HandColours",
    "MaskSmoothingOptions",
    "SilhouetteExtractor",
    "SilhouetteOptions",
    "smooth_masks",
]
