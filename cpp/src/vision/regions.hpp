// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Connected regions of a mask, found row by row in runs of set pixels.
#pragma once

#include <vector>

#include "hri/core/image_view.hpp"

namespace hri::detail {

class RegionFinder {
 public:
  /// Leaves only the largest region (of several the first); nothing and false where it covers less
  /// than `min_area` of the mask. Pixels that touch at a corner belong together.
  bool keep_largest(GreyImage* mask, double min_area);

 private:
  struct Run {
    int y, first, end;  // pixels first .. end - 1 of row y
    int region;         // of a run, where the region began; follow to the one that is its own
  };
  void find_runs(const GreyImage& mask);
  void join_runs();
  [[nodiscard]] int root(int run);

  std::vector<Run> runs_;
  std::vector<int> areas_;
};

}  // namespace hri::detail
