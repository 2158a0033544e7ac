// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "models/hmm/path_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace hri::detail {
namespace {

constexpr std::size_t kTopStates = 5;  // that a frame is compared with

using Top = std::array<float, kTopStates>;  // falling

void insert(float value, Top* top) {
  if (value <= top->back()) return;
  std::size_t at = kTopStates - 1;
  for (; at > 0 && (*top)[at - 1] < value; --at) (*top)[at] = (*top)[at - 1];
  (*top)[at] = value;
}

// Sum over frames of the density in the aligned state of HMM `index`, less the mean of the highest
// densities in the states of all HMMs.
double state_margin(const std::vector<GaussianMixtureHmm>& hmms, ConstMatrixRefF frames,
                    std::size_t index, int left_out, const std::vector<int>& path) {
  Top lowest;
  lowest.fill(-std::numeric_limits<float>::infinity());
  std::vector<Top> tops(path.size(), lowest);
  double own = 0;
  std::size_t num_states = 0;
  for (std::size_t c = 0; c < hmms.size(); ++c) {
    if (static_cast<int>(c) == left_out) continue;
    MatrixF densities(frames.rows(), hmms[c].num_states());
    hmms[c].bank().log_densities(frames, densities);
    num_states += static_cast<std::size_t>(densities.cols());
    for (std::size_t t = 0; t < path.size(); ++t) {
      const auto row = static_cast<Eigen::Index>(t);
      for (Eigen::Index s = 0; s < densities.cols(); ++s) insert(densities(row, s), &tops[t]);
      if (c == index) own += static_cast<double>(densities(row, path[t]));
    }
  }
  const std::size_t count = std::min(kTopStates, num_states);
  double sum = 0;
  for (const Top& top : tops) {
    for (std::size_t k = 0; k < count; ++k) sum += static_cast<double>(top[k]);
  }
  return own - sum / static_cast<double>(count);
}

// The last state has no exit, so that its duration has no expectation.
void measure_durations(const MarkovChain& chain, const std::vector<int>& path, PathFit* fit) {
  constexpr double kHalf = 0.5;  // a state that was skipped lasted half a frame
  fit->num_states = chain.num_states() - 1;
  if (fit->num_states == 0) return;
  std::vector<double> count(static_cast<std::size_t>(chain.num_states()), 0.0);
  for (const int state : path) count[static_cast<std::size_t>(state)] += 1;
  double total = 0;
  double expected_total = 0;
  for (int s = 0; s < fit->num_states; ++s) {
    const double expected = 1.0 / std::max(1e-3, 1.0 - chain.transition()(s, s));
    const double duration = count[static_cast<std::size_t>(s)];
    fit->duration_deviation += std::abs(std::log((duration + kHalf) / (expected + kHalf)));
    total += duration;
    expected_total += expected;
  }
  fit->log_duration_ratio = std::log((total + kHalf) / (expected_total + kHalf));
}

}  // namespace

PathFit fit_path(const std::vector<GaussianMixtureHmm>& hmms, ConstMatrixRefF frames,
                 std::size_t index, int left_out) {
  PathFit fit;
  std::vector<int> path;
  hmms[index].viterbi(frames, &path);
  fit.state_margin = state_margin(hmms, frames, index, left_out, path);
  measure_durations(hmms[index].chain(), path, &fit);
  return fit;
}

}  // namespace hri::detail
