// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Viterbi, and the parts of training that are not a recursion.
#include <algorithm>
#include <cmath>

#include "models/hmm/forward_backward.hpp"
#include "models/hmm/log_steps.hpp"

namespace hri::detail {

VectorD safe_log(const VectorD& values) {
  return values.unaryExpr([](double v) { return v > 0 ? std::log(v) : kMinusInf; });
}

MatrixD safe_log(const MatrixD& values) {
  return values.unaryExpr([](double v) { return v > 0 ? std::log(v) : kMinusInf; });
}

template <class Scalar>
double viterbi(const MarkovChain& chain, const Rows<Scalar>& log_b, std::vector<int>* path) {
  const int n = chain.num_states();
  const std::ptrdiff_t num_frames = log_b.num_frames;
  thread_local PaddedMatrix table;
  table.resize(num_frames, n);
  const std::ptrdiff_t stride = table.stride();
  double* delta = table.row(0);
  for (int j = 0; j < n; ++j) delta[j] = chain.log_start()[j] + static_cast<double>(log_b[0][j]);
  for (std::ptrdiff_t t = 1; t < num_frames; ++t) {
    chain.propagate_max(delta, delta + stride);
    delta += stride;
    const Scalar* row = log_b[t];
    for (int j = 0; j < n; ++j) delta[j] += static_cast<double>(row[j]);
  }
  const auto last = static_cast<int>(std::max_element(delta, delta + n) - delta);
  const double score = delta[last];
  if (path == nullptr) return score;
  path->clear();
  if (score == kMinusInf) return score;
  path->resize(static_cast<std::size_t>(num_frames));
  int state = last;
  for (std::ptrdiff_t t = num_frames - 1; t > 0; --t) {
    (*path)[static_cast<std::size_t>(t)] = state;
    delta -= stride;
    state = chain.best_previous(delta, state);
  }
  path->front() = state;
  return score;
}

template double viterbi<float>(const MarkovChain&, const Rows<float>&, std::vector<int>*);
template double viterbi<double>(const MarkovChain&, const Rows<double>&, std::vector<int>*);

MarkovChain estimate_chain(const ChainCounts& counts, const MarkovChain& previous) {
  constexpr double kUnvisited = 1e-8;
  VectorD start = previous.start();
  MatrixD band = previous.band();
  VectorD leave = previous.leave();
  VectorD land = previous.land();
  if (counts.start.sum() > kUnvisited) start = counts.start / counts.start.sum();
  for (Eigen::Index i = 0; i < band.rows(); ++i) {
    const double sum = counts.band.row(i).sum() + counts.leave[i];
    if (!(sum > kUnvisited)) continue;
    band.row(i) = counts.band.row(i) / sum;
    if (previous.jumps()) leave[i] = counts.leave[i] / sum;
  }
  if (!previous.jumps()) return {previous.topology(), start, band};
  if (counts.land.sum() > kUnvisited) land = counts.land / counts.land.sum();
  return {previous.topology(), start, band, leave, land};
}

void add_pseudo_counts(const MarkovChain& chain, double pseudo_count, ChainCounts* counts) {
  for (int i = 0; i < chain.num_states(); ++i) {
    if (chain.start()[i] > 0) counts->start[i] += pseudo_count;
    const int end = chain.topology().end_next(i);
    for (int j = chain.topology().first_next(i); j < end; ++j) counts->band(i, j) += pseudo_count;
    if (!chain.jumps()) continue;
    counts->leave[i] += pseudo_count;
    counts->land[i] += pseudo_count;
  }
}

std::vector<int> uniform_segmentation(Eigen::Index num_frames, int num_states) {
  std::vector<int> states(static_cast<std::size_t>(num_frames));
  for (Eigen::Index t = 0; t < num_frames; ++t) {
    states[static_cast<std::size_t>(t)] = static_cast<int>(t * num_states / num_frames);
  }
  return states;
}

}  // namespace hri::detail
