// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Masks that jump for a frame or two and come back are repaired by the frames around them.
#pragma once

#include <vector>

#include "hri/core/export.hpp"
#include "hri/features/hand/hand_finder_options.hpp"
#include "hri/features/hand/hand_source.hpp"

namespace hri {

/// Repairs the silhouettes of a clip, frame by frame, and gives the numbers of those that were. Up
/// to `max_gap` frames in a row jump where each shares little with the frames before and after
/// them, which agree with one another, and each has less quality than both: of two outlines that
/// take turns, only the better one stays. Pixels of a repaired mask are what most of its own and
/// those two masks say; its quality is half the lower one of these. Frames without a hand are
/// repaired in the same way, the first and last frame never; masks of different sizes are not
/// compared. Throws InvalidArgument naming the field that is out of range.
HRI_API std::vector<int> smooth_masks(const MaskSmoothingOptions& options,
                                      std::vector<HandObservation>* clip);

}  // namespace hri
