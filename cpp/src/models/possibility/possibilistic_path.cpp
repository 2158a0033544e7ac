// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "models/possibility/possibilistic_path.hpp"

#include <algorithm>
#include <limits>

#include "core/numbers.hpp"
#include "models/hmm/forward_backward.hpp"
#include "models/possibility/possibilistic_rule.hpp"

namespace hri::detail {
namespace {

double join(Conjunction conjunction, double a, double b) {
  if (conjunction == Conjunction::product) return a + b;
  return conjunction == Conjunction::min ? std::min(a, b) : std::max(a, b);
}

// Shifts logs so that the best is 0, and gives what that took; nothing where all are impossible.
double condition(VectorD* logs) {
  const double top = logs->maxCoeff();
  if (!(top > kMinusInf)) return 0;
  logs->array() -= top;
  return top;
}

}  // namespace

double most_possible_path(const PossibilityChain& chain, const PossibilisticRule& rule,
                          const MatrixD& log_b, std::vector<int>* path) {
  const Topology& topology = chain.topology;
  const bool jumps = topology.kind == Topology::Kind::rank_one_plus_band;
  const bool conditioned = is_conditioned(rule);
  const VectorD log_start = safe_log(chain.start);
  const MatrixD log_s = safe_log(chain.transition(join_of(rule.conjunction)));
  const Eigen::Index num_frames = log_b.rows();
  const int n = topology.num_states;
  MatrixD phi(num_frames, n);
  Matrix<int> from = Matrix<int>::Zero(num_frames, n);
  double scale = 0;
  for (Eigen::Index t = 0; t < num_frames; ++t) {
    VectorD b = log_b.row(t).transpose();
    if (conditioned) scale += condition(&b);
    for (int j = 0; j < n; ++j) {
      double came = t == 0 ? log_start[j] : kMinusInf;
      const int end = jumps ? n : topology.end_previous(j);
      for (int i = jumps ? 0 : topology.first_previous(j); t > 0 && i < end; ++i) {
        const double value = join(rule.conjunction, phi(t - 1, i), log_s(i, j));
        if (value > came) {
          came = value;
          from(t, j) = i;
        }
      }
      if (conditioned && b[j] < 0) came *= rule.concentration;
      phi(t, j) = join(rule.conjunction, came, b[j]);
    }
    if (!conditioned) continue;
    VectorD now = phi.row(t).transpose();
    scale += condition(&now);
    phi.row(t) = now.transpose();
  }
  int state = 0;
  const double score = phi.row(num_frames - 1).maxCoeff(&state) + scale;
  if (path == nullptr) return score;
  path->clear();
  if (!(score > kMinusInf)) return score;
  path->resize(static_cast<std::size_t>(num_frames));
  for (Eigen::Index t = num_frames - 1; t >= 0; --t) {
    (*path)[static_cast<std::size_t>(t)] = state;
    state = from(t, state);
  }
  return score;
}

}  // namespace hri::detail
