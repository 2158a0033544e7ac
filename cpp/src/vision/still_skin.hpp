// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// What has the colours of a hand but never moves, while something else does: a face, or wood.
#pragma once

#include <vector>

#include "hri/core/image_view.hpp"

namespace hri::detail {

/// Where such things are, with a margin, in masks of all that has the hand's colours, from frames
/// spread over a clip. Empty (no pixels) where nothing else moves, or masks differ in size: what
/// stays in place alone is the hand. Regions below `min_area`, a share of the picture, do not
/// count.
GreyImage find_still_skin(const std::vector<GreyImage>& masks, double min_area);

}  // namespace hri::detail
