// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// How far a mask can be trusted to be a hand.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "hri/core/image_view.hpp"

namespace hri::detail {

/// Values on both sides of an outline.
class Sides {
 public:
  void add(double inner, double outer) {
    ++count_;
    sum_[0] += outer;
    sum_[1] += inner;
    squares_ += inner * inner + outer * outer;
  }

  /// Between-class share of their variance.
  [[nodiscard]] double apart() const {
    if (count_ == 0) return 0;
    const double mean = (sum_[0] + sum_[1]) / (2 * count_);
    const double variance = squares_ / (2 * count_) - mean * mean;
    const double between = (sum_[1] - sum_[0]) / count_;
    return variance > 0 ? std::min(1.0, between * between / (4 * variance)) : 0;
  }

 private:
  double count_ = 0;
  std::array<double, 2> sum_{};
  double squares_ = 0;
};

/// What speaks for a mask and against it.
struct MaskStatistics {
  Sides sides;
  int area = 0;
  int at_border = 0;  // of its pixels, on the upper and side borders
  int num_runs = 0;   // of set pixels in rows
};

/// The quality by the statistics (`HandObservation::quality`) of a mask of at most `max_hands`
/// regions; 0 for an empty one.
double mask_quality(const MaskStatistics& statistics, const GreyImage& mask, int max_hands);

/// The quality of a mask in a picture of the values by which it was found: `value_at(i)` is that of
/// pixel i, counted row by row. Looks at values one pixel away from the outline, as those at it are
/// mixed of hand and background.
template <class ValueAt>
double mask_quality(const GreyImage& mask, int max_hands, ValueAt value_at) {
  MaskStatistics statistics;
  const int width = mask.width_px;
  for (int y = 0; y < mask.height_px; ++y) {
    const auto row_start = static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
    const auto at = [&](int x) -> double {
      return value_at(row_start + static_cast<std::size_t>(x));
    };
    const std::uint8_t* const row = mask.view().row(y);
    const std::uint8_t* const row_end = row + width;
    const std::uint8_t* pixel = row;
    while (pixel < row_end) {
      const auto rest = static_cast<std::size_t>(row_end - pixel);
      const auto* set = static_cast<const std::uint8_t*>(std::memchr(pixel, 255, rest));
      if (set == nullptr) break;
      const auto* clear = static_cast<const std::uint8_t*>(
          std::memchr(set, 0, static_cast<std::size_t>(row_end - set)));
      pixel = clear == nullptr ? row_end : clear;
      const auto first = static_cast<int>(set - row);
      const auto end = static_cast<int>(pixel - row);
      ++statistics.num_runs;
      statistics.area += end - first;
      if (y == 0) statistics.at_border += end - first;
      statistics.at_border += (first == 0 ? 1 : 0) + (end == width ? 1 : 0);
      if (first >= 2) statistics.sides.add(at(std::min(first + 1, end - 1)), at(first - 2));
      if (end + 1 < width) statistics.sides.add(at(std::max(end - 2, first)), at(end + 1));
    }
  }
  return mask_quality(statistics, mask, max_hands);
}

}  // namespace hri::detail
