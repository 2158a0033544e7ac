// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The outline of a hand: Moore's neighbour tracing round the largest region of a mask, and points
// at equal distances along it.
#pragma once

#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/image_view.hpp"
#include "hri/core/types.hpp"

namespace hri {

/// A point of a closed outline. Outlines run clockwise in image axes (y down), one pixel a step,
/// straight or diagonal; where a region is one pixel wide, they come back over the same pixels.
struct ContourPoint {
  int x_px = 0;
  int y_px = 0;
};

inline bool operator==(const ContourPoint& a, const ContourPoint& b) {
  return a.x_px == b.x_px && a.y_px == b.y_px;
}

/// Outer outline of the largest region (8-connected, most pixels; of equals the first in reading
/// order) of a one-channel mask, from its first pixel in reading order; holes do not matter.
/// Empty where no pixel is above 0. `contour` is written over, and grows only where it is too
/// small.
HRI_API void trace_contour(ImageView mask, std::vector<ContourPoint>* contour);

/// The same of values above `threshold`.
HRI_API void trace_contour(ConstMatrixRefF image, float threshold,
                           std::vector<ContourPoint>* contour);

/// As many points as `x_px` and `y_px` have room for, at equal distances along the outline, which
/// is smoothed over five pixels: the stairs of pixels make slanting edges longer than they are. An
/// outline of one pixel gives it throughout. Throws InvalidArgument for an empty outline.
HRI_API void resample_contour(Span<const ContourPoint> contour, Span<float> x_px, Span<float> y_px);

namespace detail {
/// One step along an outline, clockwise from the right: directions 0..7.
inline constexpr ContourPoint kContourSteps[8] = {{1, 0},  {1, 1},   {0, 1},  {-1, 1},
                                                  {-1, 0}, {-1, -1}, {0, -1}, {1, -1}};
}  // namespace detail

}  // namespace hri
