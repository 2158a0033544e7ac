// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/hand/hand_place.hpp"

#include "core/simd.hpp"

namespace hri {
namespace {

struct RowSums {
  int count = 0;
  int places = 0;  // of what is set
};

HRI_SIMD_CLONES RowSums sums_of(const std::uint8_t* row, int width) {
  RowSums s;
  for (int x = 0; x < width; ++x) {
    s.count += row[x] != 0 ? 1 : 0;
    s.places += row[x] != 0 ? x : 0;
  }
  return s;
}

}  // namespace

std::optional<HandPlace> hand_place(ImageView mask) {
  double sum = 0;
  double sum_x = 0;
  double sum_y = 0;
  for (int y = 0; y < mask.height_px; ++y) {
    const RowSums row = sums_of(mask.row(y), mask.width_px);
    sum += row.count;
    sum_x += row.places;
    sum_y += static_cast<double>(row.count) * y;
  }
  if (sum == 0) return std::nullopt;
  return HandPlace{(sum_x / sum + 0.5) / mask.width_px, (sum_y / sum + 0.5) / mask.height_px,
                   sum / (static_cast<double>(mask.width_px) * mask.height_px)};
}

}  // namespace hri
