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

const std::vector<Region>& RegionFinder::find(const GreyImage& mask) {
  find_runs(mask);
  join_runs();
  regions_.clear();
  numbers_.resize(runs_.size());
  for (int i = 0; i < static_cast<int>(runs_.size()); ++i) {
    const Run& run = runs_[at(i)];
    const int first = root(i);  // never after i
    if (first == i) {
      numbers_[at(i)] = static_cast<int>(regions_.size());
      regions_.push_back({0, run.first, run.y, run.end, run.y + 1, i});
    }
    Region& region = regions_[at(numbers_[at(first)])];
    region.area += run.end - run.first;
    region.left = std::min(region.left, run.first);
    region.right = std::max(region.right, run.end);
    region.bottom = run.y + 1;
  }
  return regions_;
}

void RegionFinder::keep(const Region& region, GreyImage* mask) {
  std::fill(mask->pixels.begin(), mask->pixels.end(), std::uint8_t{0});
  for (int i = region.first_run; i < static_cast<int>(runs_.size()); ++i) {
    if (root(i) != region.first_run) continue;
    const Run& run = runs_[at(i)];
    std::uint8_t* row = mask->pixels.data() + at(run.y) * at(mask->width_px);
    std::fill(row + run.first, row + run.end, std::uint8_t{255});
  }
}

bool RegionFinder::keep_largest(GreyImage* mask, double min_area) {
  find(*mask);
  const auto largest =
      std::max_element(regions_.begin(), regions_.end(),
                       [](const Region& a, const Region& b) { return a.area < b.area; });
  if (largest == regions_.end() ||
      largest->area < min_area * static_cast<double>(mask->pixels.size())) {
    std::fill(mask->pixels.begin(), mask->pixels.end(), std::uint8_t{0});
    return false;
  }
  keep(*largest, mask);
  return true;
}

}  // namespace hri::detail
