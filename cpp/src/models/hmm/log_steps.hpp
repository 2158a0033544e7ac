// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Single steps of the recursions in logs.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/numbers.hpp"
#include "hri/models/hmm/markov_chain.hpp"

namespace hri::detail {

constexpr double kLog2 = 0.69314718055994530941723212145818;

/// log of the sum of exp(term(i)) for i in [begin, end).
template <class F>
double log_sum(int begin, int end, const F& term) {
  double top = kMinusInf;
  for (int i = begin; i < end; ++i) top = std::max(top, term(i));
  if (top == kMinusInf) return kMinusInf;
  // Added to a sum of exp(highest) or more, what lies this far below is lost in rounding.
  constexpr double kLost = 39;
  double sum = 0;
  double highest = kMinusInf;
  for (int i = begin; i < end; ++i) {
    const double exponent = term(i) - top;
    if (exponent < highest - kLost) continue;
    sum += std::exp(exponent);
    highest = std::max(highest, exponent);
  }
  return top + std::log(sum);
}

/// after[j] = log of the sum over i of exp(before[i]) a_ij. Both are padded() with -inf; `scratch`
/// holds twice as many values.
void log_forward_step(const MarkovChain& chain, const double* before, double* scratch,
                      double* after);

/// before[i] = log of the sum over j of a_ij exp(after[j]).
void log_backward_step(const MarkovChain& chain, const double* after, double* scratch,
                       double* before);

}  // namespace hri::detail
