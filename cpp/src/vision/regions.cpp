// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "regions.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>

namespace hri::detail {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

}  // namespace

void RegionFinder::find_runs(const GreyImage& mask) {
  runs_.clear();
  const ImageView view = mask.view();
  for (int y = 0; y < mask.height_px; ++y) {
    const std::uint8_t* row = view.row(y);
    const std::uint8_t* const end = row + mask.width_px;
    const std::uint8_t* pixel = row;
    while (pixel < end) {
      const auto rest = static_cast<std::size_t>(end - pixel);
      const auto* first = static_cast<const std::uint8_t*>(std::memchr(pixel, 255, rest));
      if (first == nullptr) break;
      const auto* after = static_cast<const std::uint8_t*>(
          std::memchr(first, 0, static_cast<std::size_t>(end - first)));
      pixel = after == nullptr ? end : after;
      const auto own = static_cast<int>(runs_.size());
      runs_.push_back({y, static_cast<int>(first - row), static_cast<int>(pixel - row), own});
    }
  }
}

int RegionFinder::root(int run) {
  while (runs_[at(run)].region != run) {
    int& region = runs_[at(run)].region;
    region = runs_[at(region)].region;  // halves the way for the next time
    run = region;
  }
  return run;
}

void RegionFinder::join_runs() {
  const auto count = static_cast<int>(runs_.size());
  int above = 0;  // first run of the row before that may touch
  for (int i = 0; i < count; ++i) {
    const Run& run = runs_[at(i)];
    while (above < i && (runs_[at(above)].y < run.y - 1 ||
                         (runs_[at(above)].y == run.y - 1 && runs_[at(above)].end < run.first))) {
      ++above;
    }
    for (int j = above; j < i; ++j) {
      const Run& other = runs_[at(j)];
      if (other.y != run.y - 1 || other.first > run.end) break;
      const int a = root(i);
      const int b = root(j);
      runs_[at(std::max(a, b))].region = std::min(a, b);
    }
  }
}

bool RegionFinder::keep_largest(GreyImage* mask, double min_area) {
  find_runs(*mask);
  join_runs();
  areas_.assign(runs_.size(), 0);
  for (int i = 0; i < static_cast<int>(runs_.size()); ++i)
    areas_[at(root(i))] += runs_[at(i)].end - runs_[at(i)].first;
  const auto largest = std::max_element(areas_.begin(), areas_.end());
  std::fill(mask->pixels.begin(), mask->pixels.end(), std::uint8_t{0});
  if (largest == areas_.end() || *largest < min_area * static_cast<double>(mask->pixels.size()))
    return false;
  const auto kept = static_cast<int>(largest - areas_.begin());
  for (int i = 0; i < static_cast<int>(runs_.size()); ++i) {
    if (root(i) != kept) continue;
    const Run& run = runs_[at(i)];
    std::uint8_t* row = mask->pixels.data() + at(run.y) * at(mask->width_px);
    std::fill(row + run.first, row + run.end, std::uint8_t{255});
  }
  return true;
}

}  // namespace hri::detail
