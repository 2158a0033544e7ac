// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "vision/mask_quality.hpp"

#include <cmath>

namespace hri::detail {
namespace {

// Shares of the picture that hands cover: all between the middle two are as likely, none beyond the
// outer ones is likely at all.
constexpr double kAreas[4] = {0.002, 0.03, 0.35, 0.8};
// The same of the upper and side borders, from where on it counts, and where nothing is left.
constexpr double kBorders[2] = {0.2, 0.5};
// Runs of set pixels in rows, against the root of their number; five spread fingers make 3.3.
constexpr double kMostRuns = 3.4;

double falling(double value, double from, double to) {
  return std::clamp((to - value) / (to - from), 0.0, 1.0);
}

double plausible_area(double area) {
  const double large = falling(area, kAreas[2], kAreas[3]);
  return large * falling(-std::log(area), -std::log(kAreas[1]), -std::log(kAreas[0]));
}

}  // namespace

double mask_quality(const MaskStatistics& statistics, const GreyImage& mask, int max_hands) {
  if (statistics.area == 0) return 0;
  const double area = statistics.area;
  const double runs = statistics.num_runs / std::sqrt(area * max_hands);
  const double border =
      statistics.at_border / static_cast<double>(mask.width_px + 2 * mask.height_px);
  return statistics.sides.apart() * plausible_area(area / static_cast<double>(mask.pixels.size())) *
         falling(border, kBorders[0], kBorders[1]) * std::min(1.0, kMostRuns / runs);
}

}  // namespace hri::detail
