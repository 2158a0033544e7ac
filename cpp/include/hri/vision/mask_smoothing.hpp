// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Masks that jump for a frame or two and come back are repaired by the frames around them.
#pragma once

#include <vector>

#include "hri/core/export.hpp"
#include "hri/vision/silhouette.hpp"

namespace hri {

struct MaskSmoothingOptions {
  int max_gap = 2;             ///< frames in a row that may be repaired, 0 (none)..10
  double min_agreement = 0.6;  ///< what the masks on both sides must share, of what either covers,
                               ///< 0..1
  double max_overlap = 0.5;    ///< what a mask that jumps may share with either, as a share of what
                               ///< these share, 0..1
};

/// Repairs the silhouettes of a clip, frame by frame, and gives the numbers of those that were. Up
/// to `max_gap` frames in a row jump where each shares little with the frames before and after
/// them, which agree with one another, and each has less quality than both: of two outlines that
/// take turns, only the better one stays. Pixels of a repaired mask are what most of its own and
/// those two masks say; its quality is half the lower one of these. Frames without a hand are
/// repaired in the same way, the first and last frame never; masks of different sizes are not
/// compared. Throws InvalidArgument naming the field that is out of range.
HRI_API std::vector<int> smooth_masks(const MaskSmoothingOptions& options,
                                      std::vector<Silhouette>* clip);

}  // namespace hri
