// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/hand/regions.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>

#include "core/numbers.hpp"

namespace hri {
namespace {

using detail::at;

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

void RegionFinder::fill(const Region& region, GreyImage* mask) {
  for (int i = region.first_run; i < static_cast<int>(runs_.size()); ++i) {
    if (root(i) != region.first_run) continue;
    const Run& run = runs_[at(i)];
    if (run.y >= region.bottom) return;
    std::uint8_t* row = mask->pixels.data() + at(run.y) * at(mask->width_px);
    std::fill(row + run.first, row + run.end, std::uint8_t{255});
  }
}

void RegionFinder::keep(const Region& region, GreyImage* mask) {
  std::fill(mask->pixels.begin(), mask->pixels.end(), std::uint8_t{0});
  fill(region, mask);
}

const std::vector<Region>& RegionFinder::find_largest(const GreyImage& mask, double min_area,
                                                      int max_regions) {
  find(mask);
  const double least = min_area * static_cast<double>(mask.pixels.size());
  largest_.clear();
  for (const Region& r : regions_) {
    if (r.area < least) continue;
    const auto before = std::find_if(largest_.begin(), largest_.end(),
                                     [&](const Region& other) { return other.area < r.area; });
    largest_.insert(before, r);
    if (static_cast<int>(largest_.size()) > max_regions) largest_.pop_back();
  }
  return largest_;
}

bool RegionFinder::keep_largest(GreyImage* mask, double min_area, int max_regions) {
  find_largest(*mask, min_area, max_regions);
  std::fill(mask->pixels.begin(), mask->pixels.end(), std::uint8_t{0});
  for (const Region& r : largest_) fill(r, mask);
  return !largest_.empty();
}

}  // namespace hri
