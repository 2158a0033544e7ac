// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Features of the joints of a hand, as trackers such as MediaPipe's give them.
#pragma once

#include <string>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/types.hpp"

namespace hri {

constexpr int kNumLandmarks = 21;            ///< the wrist, then four joints a finger, thumb first
constexpr int kNumLandmarkFeatures = 85;     ///< of a frame
constexpr int kNumLandmarkTrackColumns = 3;  ///< the last of them: x, y, log of the area

/// Features of one frame. Shape: the joints from their centre, scaled by the size of the hand, and
/// the direction of every bone of the fingers. Track: centre x and y and the log of the area, in
/// units of the frame (0..1). `points_px` has kNumLandmarks rows of x and y. Throws InvalidArgument
/// for another shape, values that are not finite, or a frame without pixels.
HRI_API void landmark_features(ConstMatrixRefF points_px, int width_px, int height_px,
                               Span<float> out);

/// A name for each of the kNumLandmarkFeatures columns.
HRI_API std::vector<std::string> landmark_column_names();

}  // namespace hri
