// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "models/possibility/possibilistic_path.hpp"

#include <algorithm>
#include <utility>

#include "core/numbers.hpp"
#include "models/hmm/forward_backward.hpp"
#include "models/possibility/possibilistic_rule.hpp"

namespace hri::detail {
namespace {

// Shifts logs so that the best is 0, and gives what that took; nothing where all are impossible.
double condition(MatrixD* logs, Eigen::Index row) {
  const double top = logs->row(row).maxCoeff();
  if (!(top > kMinusInf)) return 0;
  logs->row(row).array() -= top;
  return top;
}

}  // namespace

double join(Conjunction conjunction, double a, double b) {
  if (conjunction == Conjunction::product) return a + b;
  return conjunction == Conjunction::min ? std::min(a, b) : std::max(a, b);
}

ForwardTable forward_table(const PossibilityChain& chain, const PossibilisticRule& rule,
                           MatrixD log_b) {
  const Topology& topology = chain.topology;
  const bool jumps = topology.kind == Topology::Kind::rank_one_plus_band;
  const bool conditioned = is_conditioned(rule);
  const VectorD log_start = safe_log(chain.start);
  const Eigen::Index num_frames = log_b.rows();
  const int n = topology.num_states;
  ForwardTable table;
  table.log_s = safe_log(chain.transition(join_of(rule.conjunction)));
  table.log_b = std::move(log_b);
  table.phi.resize(num_frames, n);
  table.from = Matrix<int>::Zero(num_frames, n);
  table.taken = VectorD::Zero(num_frames);
  double scale = 0;
  for (Eigen::Index t = 0; t < num_frames; ++t) {
    if (conditioned) scale += condition(&table.log_b, t);
    for (int j = 0; j < n; ++j) {
      const double b = table.log_b(t, j);
      double came = t == 0 ? log_start[j] : kMinusInf;
      const int end = jumps ? n : topology.end_previous(j);
      for (int i = jumps ? 0 : topology.first_previous(j); t > 0 && i < end; ++i) {
        const double value = join(rule.conjunction, table.phi(t - 1, i), table.log_s(i, j));
        if (value > came) {
          came = value;
          table.from(t, j) = i;
        }
      }
      if (conditioned && b < 0) came *= rule.concentration;
      table.phi(t, j) = join(rule.conjunction, came, b);
    }
    if (!conditioned) continue;
    table.taken[t] = condition(&table.phi, t);
    scale += table.taken[t];
  }
  table.score = table.phi.row(num_frames - 1).maxCoeff(&table.last) + scale;
  return table;
}

double most_possible_path(const PossibilityChain& chain, const PossibilisticRule& rule,
                          MatrixD log_b, std::vector<int>* path) {
  const ForwardTable table = forward_table(chain, rule, std::move(log_b));
  if (path == nullptr) return table.score;
  path->clear();
  if (!(table.score > kMinusInf)) return table.score;
  path->resize(static_cast<std::size_t>(table.phi.rows()));
  int state = table.last;
  for (Eigen::Index t = table.phi.rows() - 1; t >= 0; --t) {
    (*path)[static_cast<std::size_t>(t)] = state;
    state = table.from(t, state);
  }
  return table.score;
}

}  // namespace hri::detail
