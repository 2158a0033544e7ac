// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "log_steps.hpp"

namespace hri::detail {
namespace {

// Sums are taken of probabilities scaled by the largest, with one exp and one log a state; a sum so
// small that terms may have underflowed is taken again in logs.
constexpr double kSafeSum = 1e-200;

double log_of(double probability) { return probability > 0 ? std::log(probability) : kMinusInf; }

// exp(values - their maximum) into `out`; gives the maximum.
double scaled_exp(const double* values, int count, double* out) {
  const double top = *std::max_element(values, values + count);
  if (top == kMinusInf) return top;
  for (int i = 0; i < count; ++i) out[i] = std::exp(values[i] - top);
  return top;
}

double log_add(double a, double b) {
  const double top = std::max(a, b);
  return top == kMinusInf ? top : top + std::log(std::exp(a - top) + std::exp(b - top));
}

}  // namespace

void log_forward_step(const MarkovChain& chain, const double* before, double* scratch,
                      double* after) {
  const int n = chain.num_states();
  const double top = scaled_exp(before, n, scratch);
  if (top == kMinusInf) {
    std::fill(after, after + n, kMinusInf);
    return;
  }
  chain.propagate(scratch, after);
  double left = 1;  // log probability of leaving by a jump; 1: not known yet
  for (int j = 0; j < n; ++j) {
    if (after[j] > kSafeSum) {
      after[j] = top + std::log(after[j]);
      continue;
    }
    const Topology& topology = chain.topology();
    after[j] = log_sum(topology.first_previous(j), topology.end_previous(j),
                       [&](int i) { return before[i] + log_of(chain.band()(i, j)); });
    if (!chain.jumps()) continue;
    if (left == 1)
      left = log_sum(0, n, [&](int i) { return before[i] - top + log_of(chain.leave()[i]); });
    after[j] = log_add(after[j], top + left + log_of(chain.land()[j]));
  }
}

void log_backward_step(const MarkovChain& chain, const double* after, double* scratch,
                       double* before) {
  const int n = chain.num_states();
  const double top = scaled_exp(after, n, scratch);
  if (top == kMinusInf) {
    std::fill(before, before + n, kMinusInf);
    return;
  }
  chain.propagate_back(scratch, before);
  double landed = 1;  // as `left` above
  for (int i = 0; i < n; ++i) {
    if (before[i] > kSafeSum) {
      before[i] = top + std::log(before[i]);
      continue;
    }
    const Topology& topology = chain.topology();
    before[i] = log_sum(topology.first_next(i), topology.end_next(i),
                        [&](int j) { return log_of(chain.band()(i, j)) + after[j]; });
    if (!chain.jumps()) continue;
    if (landed == 1)
      landed = log_sum(0, n, [&](int j) { return log_of(chain.land()[j]) + after[j] - top; });
    before[i] = log_add(before[i], top + landed + log_of(chain.leave()[i]));
  }
}

}  // namespace hri::detail
