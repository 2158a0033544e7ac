// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "recognition/word/word_threshold.hpp"

#include <algorithm>

#include "hri/core/error.hpp"

namespace hri::detail {

float balanced_threshold(std::vector<float> right, std::vector<float> others, double false_reject,
                         double false_accept) {
  require(!right.empty(), "a threshold needs scores of right words");
  std::sort(right.begin(), right.end());
  std::sort(others.begin(), others.end());
  const auto num_right = static_cast<double>(right.size());
  const auto num_others = static_cast<double>(std::max<std::size_t>(1, others.size()));
  for (const float threshold : right) {
    const auto share_of = [&](auto first, auto last, double of) {
      return static_cast<double>(last - first) / of;
    };
    const double rejected =
        share_of(right.begin(), std::lower_bound(right.begin(), right.end(), threshold), num_right);
    const double accepted = share_of(std::lower_bound(others.begin(), others.end(), threshold),
                                     others.end(), num_others);
    if (rejected * false_accept >= accepted * false_reject) return threshold;
  }
  return right.back();
}

}  // namespace hri::detail
