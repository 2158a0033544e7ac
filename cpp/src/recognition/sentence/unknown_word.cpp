// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "recognition/sentence/unknown_word.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

namespace hri::detail {

WordChain unknown_chain(int num_states, double penalty) {
  constexpr double kNever = -std::numeric_limits<double>::infinity();
  const double log_half = std::log(0.5);
  WordChain chain;
  chain.log_start = VectorD::Constant(num_states, kNever);
  chain.log_start[0] = penalty;
  chain.log_transition = MatrixD::Constant(num_states, num_states, kNever);
  for (int s = 0; s < num_states; ++s) {
    chain.log_transition(s, s) = log_half;
    if (s + 1 < num_states) chain.log_transition(s, s + 1) = log_half;
  }
  chain.log_exit = VectorD::Constant(num_states, kNever);
  chain.log_exit[num_states - 1] = log_half;
  return chain;
}

void score_unknown(const std::vector<bool>& is_of_word, int rank, MatrixF* log_emissions) {
  const auto num_known = static_cast<Eigen::Index>(is_of_word.size());
  std::vector<float> scores;
  for (Eigen::Index t = 0; t < log_emissions->rows(); ++t) {
    scores.clear();
    for (Eigen::Index s = 0; s < num_known; ++s) {
      if (is_of_word[static_cast<std::size_t>(s)]) scores.push_back((*log_emissions)(t, s));
    }
    const auto num_best =
        std::min(static_cast<std::ptrdiff_t>(rank), static_cast<std::ptrdiff_t>(scores.size()));
    const auto last = scores.begin() + num_best;
    std::nth_element(scores.begin(), last - 1, scores.end(), std::greater<>());
    const double sum = std::accumulate(scores.begin(), last, 0.0);
    const auto mean = static_cast<float>(sum / static_cast<double>(num_best));
    log_emissions->row(t).tail(log_emissions->cols() - num_known).setConstant(mean);
  }
}

}  // namespace hri::detail
