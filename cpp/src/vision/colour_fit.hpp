// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// How HandColours learns from a few small frames.
#pragma once

#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <vector>

#include "hri/vision/hand_colours.hpp"

namespace hri::detail {

struct FitPixels {
  std::vector<cv::Mat> frames;  // CV_8UC3
};

/// score = sum over channels of weights[c] * log_level + weights[c + 3] * level; hand above the
/// threshold.
struct ColourFit {
  std::array<float, 6> weights{};
  float threshold = 0;
  double quality = 0;  // share of the variance between both sides of the outline
};

/// Channel values on 0..1, linear and logarithmic. The 2 keeps camera noise in the dark from
/// becoming large.
inline float level(int value) { return static_cast<float>(value) / 255.0F; }
inline float log_level(int value) {
  return std::log(static_cast<float>(value) + 2.0F) / std::log(257.0F);
}

std::optional<ColourFit> fit_colours(const FitPixels& pixels, const HandColourOptions& options);

/// Leaves only the largest region; nothing and false where it covers less than `min_area` of the
/// mask.
bool keep_largest(cv::Mat& mask, double min_area);

}  // namespace hri::detail
