// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "models/possibility/state_possibilities.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/numbers.hpp"
#include "hri/core/error.hpp"
#include "models/hmm/dense_kernels.hpp"
#include "models/possibility/possibilistic_path.hpp"
#include "models/possibility/possibilistic_rule.hpp"

namespace hri::detail {
namespace {

// In logs the product form is the recursion of the best path of an HMM, but for the scale.
void both_ways_by_product(const MarkovChain& chain, const ChainScale& scale, const MatrixD& log_b,
                          StatePossibilities* result) {
  const double log_transition = std::log(scale.transition);
  const Eigen::Index num_frames = log_b.rows();
  MatrixD& phi = result->log_forward;
  MatrixD& gamma = result->log_backward;
  phi.row(0) = chain.log_start().transpose().array() - std::log(scale.start);
  phi.row(0) += log_b.row(0);
  for (Eigen::Index t = 1; t < num_frames; ++t) {
    chain.propagate_max(phi.row(t - 1).data(), phi.row(t).data());
    phi.row(t).array() += log_b.row(t).array() - log_transition;
  }
  VectorD after(log_b.cols());
  gamma.row(num_frames - 1).setZero();
  for (Eigen::Index t = num_frames - 1; t > 0; --t) {
    after = (gamma.row(t) + log_b.row(t)).transpose();
    chain.propagate_max_back(after.data(), gamma.row(t - 1).data());
    gamma.row(t - 1).array() -= log_transition;
  }
  result->log_possibility = phi.row(num_frames - 1).maxCoeff();
}

// Conditioning divides what arrives in the next frame by m, its best there. On the scale of phi(i)
// the way on is therefore min(s_ij, pi_j, m gamma(j)), as
//   min(min(phi(i), s_ij, pi_j) / m, gamma(j)) = min(phi(i), s_ij, pi_j, m gamma(j)) / m.
void both_ways_by_order(const PossibilityChain& chain, const PossibilisticRule& rule, MatrixD log_b,
                        StatePossibilities* result) {
  ForwardTable table = forward_table(chain, rule, std::move(log_b));
  const Topology& topology = chain.topology;
  const bool jumps = topology.kind == Topology::Kind::rank_one_plus_band;
  const int n = topology.num_states;
  MatrixD& gamma = result->log_backward;
  VectorD after(n);
  for (Eigen::Index t = table.phi.rows() - 1; t > 0; --t) {
    for (int j = 0; j < n; ++j)
      after[j] = join(rule.conjunction, table.log_b(t, j), gamma(t, j) + table.taken[t]);
    for (int i = 0; i < n; ++i) {
      double goes = kMinusInf;
      const int end = jumps ? n : topology.end_next(i);
      for (int j = jumps ? 0 : topology.first_next(i); j < end; ++j)
        goes = std::max(goes, join(rule.conjunction, table.log_s(i, j), after[j]));
      gamma(t - 1, i) = goes;
    }
  }
  result->log_possibility = table.score;
  result->log_forward = std::move(table.phi);
}

// xi(i) of one frame, over the largest, and what it leaves necessary.
void join_both_ways(Conjunction conjunction, Eigen::Index t, double* joined,
                    StatePossibilities* result) {
  const auto n = static_cast<int>(result->log_forward.cols());
  for (int i = 0; i < n; ++i)
    joined[i] = join(conjunction, result->log_forward(t, i), result->log_backward(t, i));
  const DenseKernels& kernels = dense_kernels();
  const double* best = std::max_element(joined, joined + n);
  const std::ptrdiff_t at = best - joined;
  kernels.exponentials(joined, *best, padded(n), joined);
  double other = 0;
  for (int i = 0; i < n; ++i) {
    if (i != at) other = std::max(other, joined[i]);
  }
  std::copy_n(joined, n, result->possibility.row(t).data());
  result->necessity(t, at) = 1 - other;
}

}  // namespace

StatePossibilities state_possibilities(const MarkovChain& chain, const ChainScale& scale,
                                       const PossibilisticRule& rule, MatrixD log_b) {
  // Raised to a power, what arrives is no longer joined with what follows by a conjunction.
  require(!is_conditioned(rule) || rule.concentration == 1,
          "state possibilities under a conditioned minimum need concentration = 1");
  const Eigen::Index num_frames = log_b.rows();
  const Eigen::Index n = log_b.cols();
  StatePossibilities result;
  result.log_forward.resize(num_frames, n);
  result.log_backward.setZero(num_frames, n);
  if (rule.conjunction == Conjunction::product) {
    both_ways_by_product(chain, scale, log_b, &result);
  } else {
    both_ways_by_order({chain, scale}, rule, std::move(log_b), &result);
  }
  result.possibility.setOnes(num_frames, n);
  result.necessity.setZero(num_frames, n);
  if (result.log_possibility == kMinusInf) return result;
  AlignedVector joined(static_cast<std::size_t>(padded(n)), kMinusInf);
  for (Eigen::Index t = 0; t < num_frames; ++t) {
    std::fill(joined.begin(), joined.end(), kMinusInf);
    join_both_ways(rule.conjunction, t, joined.data(), &result);
  }
  return result;
}

}  // namespace hri::detail
