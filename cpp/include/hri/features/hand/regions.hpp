// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Connected regions of a mask, found row by row in runs of set pixels.
#pragma once

#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/image_view.hpp"

namespace hri {

/// A connected region: pixels left .. right - 1 of rows top .. bottom - 1.
struct Region {
  int area = 0;
  int left = 0, top = 0, right = 0, bottom = 0;
  int first_run = 0;  ///< by which the finder knows it
};

/// Finds regions of masks of 0 and 255; memory is kept, so that a stream of masks allocates
/// nothing.
class HRI_API RegionFinder {
 public:
  /// All regions, in the order of their first pixels. Pixels that touch at a corner belong
  /// together.
  const std::vector<Region>& find(const GreyImage& mask);
  /// The largest regions, the largest first (of equals the first), at most `max_regions`, that
  /// cover at least `min_area` of the mask.
  const std::vector<Region>& find_largest(const GreyImage& mask, double min_area, int max_regions);

  /// Leaves only a region that was found in the mask.
  void keep(const Region& region, GreyImage* mask);
  /// Sets its pixels, and leaves the others as they are.
  void fill(const Region& region, GreyImage* mask);

  /// Leaves only the regions that find_largest gives; false where there is none.
  bool keep_largest(GreyImage* mask, double min_area, int max_regions = 1);

 private:
  struct Run {
    int y, first, end;  // pixels first .. end - 1 of row y
    int region;         // of a run, where the region began; follow to the one that is its own
  };
  void find_runs(const GreyImage& mask);
  void join_runs();
  [[nodiscard]] int root(int run);

  std::vector<Run> runs_;
  std::vector<int> numbers_;  // of the region that a run begins
  std::vector<Region> regions_, largest_;
};

}  // namespace hri
