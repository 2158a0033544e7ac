// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "recognition/word/vector_choice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace hri::detail {
namespace {

// How far streams spread over classes beside vectors; of equals, the first.
constexpr std::array<double, 9> kShares{1, 0.5, 2, 0.2, 5, 0.1, 10, 0.05, 20};
constexpr double kLeastTemperature = 1.0 / 16;
constexpr double kTemperatureStep = 1.4;
constexpr int kNumTemperatures = 24;
constexpr double kMaxWeight = 1e6;  // that a scorer takes, where vectors hardly differ

double spread(const VectorD& scores) {
  return std::sqrt((scores.array() - scores.mean()).square().mean());
}

// Minus the mean log posterior of the label.
double cross_entropy(const std::vector<HeldOutScores>& words, double stream_weight,
                     double temperature) {
  double sum = 0;
  for (const HeldOutScores& word : words) {
    const VectorD scores =
        (stream_weight * word.streams.cast<double>() + word.vectors.cast<double>()) / temperature;
    const double best = scores.maxCoeff();
    sum += best + std::log((scores.array() - best).exp().sum()) - scores[word.label];
  }
  return sum / static_cast<double>(words.size());
}

}  // namespace

double choose_vector_weight(const std::vector<HeldOutScores>& words) {
  double of_streams = 0;
  double of_vectors = 0;
  for (const HeldOutScores& word : words) {
    of_streams += spread(word.streams.cast<double>());
    of_vectors += spread(word.vectors.cast<double>());
  }
  if (!(of_streams > 0 && of_vectors > 0)) return 1;
  double result = 1;
  double least = std::numeric_limits<double>::infinity();
  for (const double share : kShares) {
    const double stream_weight = share * of_vectors / of_streams;
    double temperature = kLeastTemperature;
    for (int t = 0; t < kNumTemperatures; ++t, temperature *= kTemperatureStep) {
      const double entropy = cross_entropy(words, stream_weight, temperature);
      if (entropy >= least) continue;
      least = entropy;
      result = std::min(1 / stream_weight, kMaxWeight);
    }
  }
  return result;
}

}  // namespace hri::detail
