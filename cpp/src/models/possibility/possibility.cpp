// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/possibility/possibility.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "hri/core/error.hpp"

namespace hri {
namespace {

// Which outcomes belong to the event, after checking both arguments.
std::vector<bool> members(Span<const double> distribution, const std::vector<int>& event) {
  for (std::size_t i = 0; i < distribution.size(); ++i) {
    if (distribution[i] >= 0 && distribution[i] <= 1) continue;
    fail(ErrorKind::invalid_argument, "distribution[" + std::to_string(i) + "] = " +
                                          std::to_string(distribution[i]) + " lies outside 0..1");
  }
  std::vector<bool> inside(distribution.size(), false);
  for (const int i : event) {
    if (i < 0 || static_cast<std::size_t>(i) >= distribution.size()) {
      fail(ErrorKind::invalid_argument, "event: outcome " + std::to_string(i) +
                                            " lies outside the distribution of " +
                                            std::to_string(distribution.size()));
    }
    inside[static_cast<std::size_t>(i)] = true;
  }
  return inside;
}

double max_where(Span<const double> distribution, const std::vector<bool>& inside, bool wanted) {
  double top = 0;
  for (std::size_t i = 0; i < distribution.size(); ++i) {
    if (inside[i] == wanted) top = std::max(top, distribution[i]);
  }
  return top;
}

}  // namespace

double possibility_of(Span<const double> distribution, const std::vector<int>& event) {
  return max_where(distribution, members(distribution, event), true);
}

double necessity_of(Span<const double> distribution, const std::vector<int>& event) {
  return 1.0 - max_where(distribution, members(distribution, event), false);
}

Possibilities possibilities(const VectorF& log_densities) {
  const Eigen::Index n = log_densities.size();
  require(n > 0, "log_densities must not be empty");
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (Eigen::Index c = 0; c < n; ++c) {
    if (log_densities[c] < kInfinity) continue;  // false for NaN
    fail(ErrorKind::invalid_argument,
         "log_densities[" + std::to_string(c) + "] is " + std::to_string(log_densities[c]));
  }
  Eigen::Index best = 0;
  const float top = log_densities.maxCoeff(&best);
  Possibilities result{VectorF::Ones(n), VectorF::Zero(n)};
  if (top == -kInfinity) return result;
  result.possibility = (log_densities.array() - top).exp();
  float other = 0;
  for (Eigen::Index c = 0; c < n; ++c) {
    if (c != best) other = std::max(other, result.possibility[c]);
  }
  result.necessity[best] = 1.0F - other;
  return result;
}

}  // namespace hri
