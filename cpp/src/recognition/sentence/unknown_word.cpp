// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "recognition/sentence/unknown_word.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

namespace hri::detail {
namespace {

constexpr double kPriorFrames = 40;  // about a word: what the prior counts as, in frames of speech
constexpr std::ptrdiff_t kStatesPerRank = 4;
constexpr int kLongestWord = 500;  // frames

}  // namespace

WordChain unknown_chain(int longest) {
  constexpr double kNever = -std::numeric_limits<double>::infinity();
  WordChain chain;
  chain.log_start = VectorD::Constant(longest, kNever);
  chain.log_start[0] = 0;
  chain.log_transition = MatrixD::Constant(longest, longest, kNever);
  for (int s = 0; s + 1 < longest; ++s) chain.log_transition(s, s + 1) = 0;
  chain.log_exit = VectorD::Constant(longest, kNever);
  chain.log_exit.tail(longest - longest / 4).setZero();
  return chain;
}

int mean_word_length(const std::vector<GaussianMixtureHmm>& models, const VectorD& final_stays) {
  const std::size_t num_words = models.size() - 1;
  double sum = 0;
  for (std::size_t m = 0; m < num_words; ++m) {
    const WordChain chain =
        WordChain::of(models[m].chain(), final_stays[static_cast<Eigen::Index>(m)]);
    for (const double log_stay : chain.log_transition.diagonal()) {
      // A state that was never left in training lasts as long as there is anything to decode.
      sum += 1 / std::max(1.0 / kLongestWord, 1 - std::exp(log_stay));
    }
  }
  const double mean = sum / static_cast<double>(num_words);
  return static_cast<int>(std::clamp(mean, 4.0, static_cast<double>(kLongestWord)));
}

VectorF UnknownBackground::scores(double expected_lead, double margin) const {
  const double lead =
      (lead_sum + kPriorFrames * expected_lead) / (static_cast<double>(num_speech) + kPriorFrames);
  return means.array() + static_cast<float>(lead - margin);
}

UnknownBackground unknown_background(const MatrixF& models, const std::vector<bool>& is_of_word,
                                     int num_silence, const MatrixF& fillers, int rank) {
  UnknownBackground result;
  result.means.resize(models.rows());
  std::vector<float> scores;
  scores.reserve(static_cast<std::size_t>(models.cols() + fillers.cols()));
  for (Eigen::Index t = 0; t < models.rows(); ++t) {
    scores.clear();
    for (Eigen::Index s = 0; s < models.cols(); ++s) {
      if (is_of_word[static_cast<std::size_t>(s)]) scores.push_back(models(t, s));
    }
    const float best = *std::max_element(scores.begin(), scores.end());
    for (Eigen::Index s = 0; s < fillers.cols(); ++s) scores.push_back(fillers(t, s));
    const auto num_states = static_cast<std::ptrdiff_t>(scores.size());
    const auto num_best = std::min(static_cast<std::ptrdiff_t>(rank),
                                   std::max(num_states / kStatesPerRank, std::ptrdiff_t{1}));
    const auto last = scores.begin() + num_best;
    std::nth_element(scores.begin(), last - 1, scores.end(), std::greater<>());
    const double sum = std::accumulate(scores.begin(), last, 0.0);
    result.means[t] = static_cast<float>(sum / static_cast<double>(num_best));
    const bool is_speech = best > models.row(t).tail(num_silence).maxCoeff();
    const double lead = static_cast<double>(best) - static_cast<double>(result.means[t]);
    if (!is_speech || !std::isfinite(lead)) continue;
    result.lead_sum += lead;
    ++result.num_speech;
  }
  return result;
}

}  // namespace hri::detail
