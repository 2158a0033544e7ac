// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The variance below which a feature counts as constant, in whatever unit features are.
#pragma once

#include <algorithm>

#include "hri/core/types.hpp"

namespace hri::detail {

/// `usual`, but less where even the feature that varies most has a variance below 1e-4, as of
/// metres where millimetres would be meant. Features that do not vary beyond the rounding of
/// floats count for nothing.
inline double least_variance(const VectorD& mean, const VectorD& variance, double usual) {
  constexpr double kUsualSpread = 1e-4;
  constexpr double kRounding = 1e-13;  // of the square of a mean; floats have 7 digits
  double widest = 0;
  for (Eigen::Index d = 0; d < variance.size(); ++d) {
    if (variance[d] > kRounding * mean[d] * mean[d]) widest = std::max(widest, variance[d]);
  }
  // The square of the smallest float of full precision.
  constexpr double kNothing = 1.3e-76;
  return widest > kNothing ? usual * std::min(1.0, widest / kUsualSpread) : usual;
}

}  // namespace hri::detail
