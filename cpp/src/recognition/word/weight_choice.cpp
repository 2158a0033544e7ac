// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "recognition/word/weight_choice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace hri::detail {
namespace {

// How far the first spread over classes beside the second; of equals, the first.
constexpr std::array<double, 9> kShares{1, 0.5, 2, 0.2, 5, 0.1, 10, 0.05, 20};
constexpr double kLeastTemperature = 1.0 / 16;
constexpr double kTemperatureStep = 1.4;
constexpr int kNumTemperatures = 24;
constexpr double kMaxWeight = 1e6;  // that a scorer takes, where scores hardly differ

double spread(const VectorD& scores) {
  return std::sqrt((scores.array() - scores.mean()).square().mean());
}

// Minus the mean log posterior of the label.
double cross_entropy(const std::vector<HeldOutScores>& words, double first_weight,
                     double temperature) {
  double sum = 0;
  for (const HeldOutScores& word : words) {
    const VectorD scores =
        (first_weight * word.first.cast<double>() + word.second.cast<double>()) / temperature;
    const double best = scores.maxCoeff();
    sum += best + std::log((scores.array() - best).exp().sum()) - scores[word.label];
  }
  return sum / static_cast<double>(words.size());
}

}  // namespace

double choose_weight(const std::vector<HeldOutScores>& words) {
  double of_first = 0;
  double of_second = 0;
  for (const HeldOutScores& word : words) {
    of_first += spread(word.first.cast<double>());
    of_second += spread(word.second.cast<double>());
  }
  if (!(of_first > 0 && of_second > 0)) return 1;
  double result = 1;
  double least = std::numeric_limits<double>::infinity();
  for (const double share : kShares) {
    const double first_weight = share * of_second / of_first;
    double temperature = kLeastTemperature;
    for (int t = 0; t < kNumTemperatures; ++t, temperature *= kTemperatureStep) {
      const double entropy = cross_entropy(words, first_weight, temperature);
      if (entropy >= least) continue;
      least = entropy;
      result = std::min(1 / first_weight, kMaxWeight);
    }
  }
  return result;
}

}  // namespace hri::detail
