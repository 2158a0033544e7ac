// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The hand cut out of its picture: a square around the mask, scaled to a fixed size, so that place
// and size of the hand in the picture do not matter.
#pragma once

#include "hri/core/export.hpp"
#include "hri/core/image_view.hpp"
#include "hri/core/types.hpp"

namespace hri {

/// A square in pixels of the source image; it may reach beyond the borders.
struct HandBox {
  float left_px = 0;
  float top_px = 0;
  float side_px = 0;  ///< 0: the mask is empty
};

/// The square around the mask. A forearm that makes the mask more than `max_aspect` times as high
/// as wide is cut off at the bottom; `padding` (share of the side) is left free on every side.
/// Throws InvalidArgument unless max_aspect > 0 and padding >= 0.
HRI_API HandBox hand_box(ImageView mask, float max_aspect = 1.6F, float padding = 0.08F);

/// Samples `image` (one channel) inside `box` into `out` (square), 0..1; pixels average what they
/// cover, and what lies outside the image repeats its border.
HRI_API void crop(ImageView image, const HandBox& box, MatrixRefF out);

}  // namespace hri
