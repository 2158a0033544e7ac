// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// How HandColours learns from a few small frames.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "hri/vision/hand_colours.hpp"
#include "vision/pixels.hpp"

namespace hri::detail {

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

/// What every value of blue, green and red adds to the score.
using ScoreTables = std::array<std::array<float, 256>, 3>;
ScoreTables score_tables(const std::array<float, 6>& weights);

std::optional<ColourFit> fit_colours(const std::vector<ColourImage>& frames,
                                     const HandColourOptions& options);

}  // namespace hri::detail
