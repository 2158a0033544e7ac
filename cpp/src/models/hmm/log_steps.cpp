// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "models/hmm/log_steps.hpp"

#include "models/hmm/dense_kernels.hpp"

namespace hri::detail {
namespace {

// Sums are taken of probabilities scaled by the largest, with one exp and one log a state; a sum so
// small that terms may have underflowed is taken again in logs.
constexpr double kSafeSum = 1e-200;

double log_of(double probability) { return probability > 0 ? std::log(probability) : kMinusInf; }

double log_add(double a, double b) {
  const double top = std::max(a, b);
  return top == kMinusInf ? top : top + std::log(std::exp(a - top) + std::exp(b - top));
}

// The sums that `propagate` takes of exp(logs), scaled by the largest, into the second half of
// `scratch`, and their logs into `out`. Gives the largest of `logs`; where that is -inf all is
// impossible, and there are no sums.
template <class Propagate>
double scaled_sums(const double* logs, int n, double* scratch, double* out,
                   const Propagate& propagate) {
  const std::ptrdiff_t count = padded(n);
  const DenseKernels& kernels = dense_kernels();
  const double top = kernels.largest(logs, count);
  if (top == kMinusInf) {
    std::fill(out, out + count, kMinusInf);
    return top;
  }
  double* sums = scratch + count;
  std::fill(sums + n, sums + count, 1.0);
  kernels.exponentials(logs, top, count, scratch);
  propagate(scratch, sums);
  kernels.logarithms(sums, top, count, out);
  std::fill(out + n, out + count, kMinusInf);
  return top;
}

}  // namespace

void log_forward_step(const MarkovChain& chain, const double* before, double* scratch,
                      double* after) {
  const int n = chain.num_states();
  const double top = scaled_sums(before, n, scratch, after,
                                 [&chain](const double* x, double* y) { chain.propagate(x, y); });
  if (top == kMinusInf) return;
  const double* sums = scratch + padded(n);
  double left = 1;  // log probability of leaving by a jump; 1: not known yet
  for (int j = 0; j < n; ++j) {
    if (sums[j] > kSafeSum) continue;
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
  const double top = scaled_sums(after, n, scratch, before, [&chain](const double* x, double* y) {
    chain.propagate_back(x, y);
  });
  if (top == kMinusInf) return;
  const double* sums = scratch + padded(n);
  double landed = 1;  // as `left` above
  for (int i = 0; i < n; ++i) {
    if (sums[i] > kSafeSum) continue;
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
